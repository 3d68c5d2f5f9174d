"""Reading results and targets, and the numbers that come of them."""

import json
import math
import runpy
import sys
import tempfile
from pathlib import Path

import tap
from lobe_report import bandwidth, measures, paper, results, supersampling, targets
from lobe_report.errors import ReportError

ROOT = Path(__file__).resolve().parents[3]
FOLDER = tempfile.TemporaryDirectory(prefix="lobe-test-")
FILE = Path(FOLDER.name) / "file.json"
ERRORS = {"rmse": 0, "relative_l2": 0.5, "relative_l1": None, "flip": 0.1}


def check(condition, message=""):
    """An assertion that python -O keeps."""
    if not condition:
        raise AssertionError(message)


def row(scene, name, rebuilt=1.0, **others):
    return {"scene": scene, "filter": name, "settings": [{"name": "k", "value": "1"}], "varied": "",
            "rebuilt_ms": rebuilt, "retained_ms": 1, "building_ms": 1, "shading_ms": 1,
            "passes": [], "memory_bytes": 1, "bytes_per_texel": 0, "error": ERRORS,
            "error_lobe_base": ERRORS, "flicker": -1, **others}


def document(*rows, scenes=("a", "b")):
    return {"version": "1", "device": "d", "driver": "d", "device_type": "CPU", "size": [1, 1],
            "reference_samples": 1, "path_samples": 1, "stations": 1, "frames": 1,
            "complete": True, "rows": list(rows),
            "scenes": [{"name": name, "triangles": 1} for name in scenes]}


def read(described):
    FILE.write_text(json.dumps(described))
    return results.read(FILE)


def refuses(function, *words):
    try:
        function(FILE)
    except ReportError as error:
        check(str(FILE) in str(error) and all(word in str(error) for word in words), error)
        return
    raise AssertionError("was read")


# Reading --------------------------------------------------------------------------------------

def test_members_are_read():
    found = read(document(row("a", "direct", future=1), row("a", "lobes", varied="k")))
    check(found.filters == ["direct", "lobes"], found.filters)
    first, second = found.rows
    check(first.is_default and second.varied_value == "1", found.rows)
    check(math.isnan(first.error.relative_l1) and math.isnan(first.environment_ms), first)
    check(found.default("a", "direct") is first and found.default("a", "lobes") is None)


def test_what_a_page_may_not_hold_is_replaced():
    for text, wanted in (("a\x01z\x7f", "a\ufffdz\ufffd"), ("\x85", "\ufffd"),
                         ("a\tb\nc", "a\tb\nc"), ("ε₀ – 漢 😀", "ε₀ – 漢 😀"),
                         ("\ud800<", "\ufffd<"), ("\uffff", "\ufffd")):
        check(results.clean(text) == wanted, repr(results.clean(text)))
    check(results.clean({"a": ["\0", 1, None]}) == {"a": ["\ufffd", 1, None]})


def test_bytes_that_are_no_text_are_replaced():
    for data, wanted in ((b"\xff", "\ufffd"), (b"\xc3", "\ufffd"), (b"\xc0\xbc", "\ufffd\ufffd"),
                         (b"\xe2\x82<", "\ufffd<"), (b"\xed\xa0\x80<", "\ufffd\ufffd\ufffd<")):
        FILE.write_bytes(b'["' + data + b'"]')
        check(results.parse_json(FILE) == [wanted], results.parse_json(FILE))


def test_the_first_of_equal_members_counts():
    FILE.write_text('{"a": 1, "a": "x"}')
    check(results.parse_json(FILE) == {"a": 1})


def test_what_is_no_json_is_refused():
    for text in ("", "{", "[1, 2", "[" * 100000):
        FILE.write_text(text)
        refuses(results.parse_json, "not JSON")
    FILE.unlink()
    refuses(results.parse_json, "No such file")


def test_worth_is_where_supersampling_has_the_same_error():
    steps = [results.Supersampling(1, 0.8), results.Supersampling(2, 0.4),
             results.Supersampling(4, 0.1)]
    for error, samples in ((0.8, 1), (1.6, 0.25), (0.4, 2), (0.8 / 2 ** 0.5, 2 ** 0.5),
                           (0.2, 8 ** 0.5), (0.1, 4), (0.01, 4), (0, 4)):
        check(math.isclose(supersampling.samples_for(steps, error), samples), error)
    check(math.isnan(supersampling.samples_for([], 0.1)))
    check(math.isnan(supersampling.samples_for(steps, math.nan)))


def test_gain_is_the_time_of_those_samples():
    described = document(row("a", "lobes", retained_ms=4, error={**ERRORS, "relative_l2": 0.4}),
                         row("a", "reference", retained_ms=128))
    described["scenes"][0]["supersampling"] = [{"samples": 1, "relative_l2": 0.8},
                                               {"samples": 8, "relative_l2": 0.4}]
    found = read(described)
    supersampling.add_worth(found)
    first = found.rows[0]
    check((first.worth, first.gain) == (8, 8 * 2 / 4), first)
    check(supersampling.is_most(found.scenes[0], first), first)
    check(supersampling.curve(found, found.scenes[0]) == [(2, 0.8), (16, 0.4)])
    check(supersampling.curve(found, found.scenes[1]) == [])


def test_noise_is_taken_out_of_errors():
    check(math.isclose(results.without_noise(0.5, 0.3), 0.4))
    check(results.without_noise(0.2, 0.3) == 0 and results.without_noise(0.2, math.nan) == 0.2)
    check(math.isnan(results.without_noise(math.nan, 0.1)))
    described = document(row("a", "direct"), row("b", "direct"))
    described["scenes"][0]["noise"] = 0.3
    check([math.isclose(entry.error.relative_l2, wanted) for entry, wanted in
           zip(read(described).rows, (0.4, 0.5))] == [True, True])


def test_limits_are_kept():
    FILE.write_text(json.dumps(document(*(row("a", f"f{i}") for i in range(65)))))
    refuses(results.read, "64 filters")
    FILE.write_text(json.dumps(document(*(row("a", "f") for i in range(1025)))))
    refuses(results.read, "'a'", "1025", "1024")


# Means ----------------------------------------------------------------------------------------

def test_means_are_over_what_was_measured():
    mean = measures.mean_of([1, 4, math.nan, math.inf])
    check((mean.arithmetic, mean.geometric, mean.scenes) == (2.5, 2.0, 2), mean)
    check(measures.mean_of([]).scenes == 0 and math.isnan(measures.mean_of([]).arithmetic))
    check(measures.mean_of([0, 4]).geometric == 0)


def test_ratios_need_both_filters():
    found = read(document(row("a", "direct", 2.0), row("a", "lobes", 6.0), row("b", "lobes", 9.0)))
    check(measures.ratio(found, measures.rebuilt, "a", "lobes", "direct") == 3)
    check(math.isnan(measures.ratio(found, measures.rebuilt, "b", "lobes", "direct")))
    check(measures.mean_ratio(found, measures.rebuilt, "lobes", "direct").scenes == 1)
    check(measures.ratio_of_means(found, measures.rebuilt, "lobes", "direct") == 3)
    check(measures.mean_ratio(found, measures.rebuilt, "lobes", None).arithmetic == 7.5)
    check(math.isnan(measures.mean_ratio(found, measures.flicker, "lobes", None).arithmetic))


def test_a_ratio_to_nothing_is_no_number():
    check(math.isnan(measures.divide(0, 0)) and measures.divide(1, 0) == math.inf)


def test_bandwidths_are_beside_those_of_copies():
    def item(milliseconds, copy, **others):
        return {"name": "p", "milliseconds": milliseconds, "count": 1, "building": True,
                "bytes": 4e9, "copy_milliseconds": copy, **others}
    found = bandwidth.of_results(read(document(
        row("a", "f", passes=[item(10, 5)]), row("b", "f", passes=[item(20, 0)]),
        row("a", "g", passes=[item(10, 5, building=False)]))))
    check(len(found) == 1, found)
    check(found[0].speeds == [400, 200] and found[0].copies == [800], found)
    check(math.isclose(found[0].ratio, 0.5), found)


def test_the_paper_is_printed_as_ratios():
    found = read(document(row("hall", "direct", 2.0), row("hall", "lobes", 3.0), scenes=["hall"]))
    pairs = paper.ROWS[4].pairs(found)
    check(pairs[0] == (1.6, 2.0) and pairs[4] == (2.5 / 1.6, 1.5), pairs)
    check(math.isnan(pairs[1][1]) and math.isnan(paper.ROWS[4].moments(found)), pairs)


# Targets --------------------------------------------------------------------------------------

TARGET = {"name": "t", "measure": "rebuilt", "scene": "a", "filter": "lobes", "base": "direct",
          "limit": 2, "at_least": False}


def test_targets_are_met_or_missed():
    found = read(document(row("a", "direct", 2.0), row("a", "lobes", 5.0)))
    FILE.write_text(json.dumps([TARGET, {**TARGET, "scene": None, "at_least": True}]))
    most, least = targets.read(FILE)
    check(most.value(found) == 2.5 and not most.is_met(2.5) and most.missed_by(2.5) == "25", most)
    check(least.value(found) == 2.5 and least.is_met(2.5) and least.missed_by(1) == "100", least)
    check(least.missed_by(0) == "∞", least.missed_by(0))


def test_a_target_without_value_says_why():
    found = read(document(row("a", "direct"), row("b", "lobes")))
    target = targets.Target(**TARGET)
    check("scene a was not" in target.absence(found), target.absence(found))
    target.scene = None
    check("no scene" in target.absence(found), target.absence(found))
    target.base = "lean"
    check("lean is not in" in target.absence(found), target.absence(found))


def test_broken_targets_are_refused():
    for broken in ({}, [1], [{}], [{**TARGET, "measure": "beauty"}], [{**TARGET, "limit": "2"}],
                   [{**TARGET, "limit": 0}], [{**TARGET, "scene": 3}],
                   [{**TARGET, "measure": ["error"]}], [TARGET, {**TARGET, "at_least": None}]):
        FILE.write_text(json.dumps(broken))
        refuses(targets.read, "target")
    FILE.write_text(json.dumps([TARGET]).replace("2", "NaN"))
    refuses(targets.read, "[0]")


def test_what_lobe_aims_at_is_understood():
    aims = runpy.run_path(str(ROOT / "tools/targets"))["described_targets"]()
    FILE.write_text(json.dumps(aims))
    found = targets.read(FILE)
    check(len(found) == len(aims) > 15, len(found))
    check({target.scene for target in found} >= {None, "checkerboard", "hall"}, found)


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
