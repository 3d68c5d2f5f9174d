"""How `lobe render --budget` and `--error` pick filters and knobs."""

import copy
import json
import re
import sys

import tap
from files import exr_header, gltf_triangle, gltf_write, png_draw
from program import (FOLDER, check, error_lines, fails, fresh_folder, is_wrong_usage, leaves, lobe,
                     report, succeeds)

SIZE = "32x18"
SCENE = ["checkerboard", "--size", SIZE]

# Milliseconds, a quarter of which is building, and errors for the stored sweep.
FIGURES = {
    ("direct", ""): (10, 0.9),
    ("mipmap", ""): (20, 0.5),
    ("mipmap", "storage=float16"): (16, 0.6),
    ("mipmap", "probes=2"): (40, 0.4),
    ("reference", ""): (4, 0.001),
}
OTHERS = (100, 2.0)

_measured = []


def measured():
    """The output of `lobe bench --sweep`, measured once for all cases."""
    if not _measured:
        path = FOLDER / "measured.json"
        succeeds("bench", "checkerboard", "nosuch.gltf", "--sweep", "--filters",
                 "direct,mipmap,reference", "--size", SIZE, "--samples", "2", "--frames", "1",
                 "--stations", "1", "--path-samples", "1", "--json", path)
        _measured.append(json.loads(path.read_text()))
    return copy.deepcopy(_measured[0])


def key_of(row):
    values = {one["name"]: one["value"] for one in row["settings"]}
    varied = row["varied"]
    return row["filter"], f"{varied}={values[varied]}" if varied else ""


def with_figures():
    """The same with known figures."""
    results = measured()
    check(set(FIGURES) < {key_of(row) for row in results["rows"]}, "rows are missing")
    for row in results["rows"]:
        milliseconds, error = FIGURES.get(key_of(row), OTHERS)
        row.update(rebuilt_ms=milliseconds, retained_ms=0.75 * milliseconds,
                   building_ms=0.25 * milliseconds, shading_ms=0.75 * milliseconds)
        row["error"]["relative_l2"] = error
    for scene in results["scenes"]:
        scene["noise"] = None
    return results


def stored(name, results=None):
    """A fresh folder and the sweep in it."""
    folder = fresh_folder(name)
    path = folder / "sweep.json"
    path.write_text(json.dumps(results or with_figures()))
    return folder, path


def picks(folder, *arguments, says=(), knobs=(), filter_name):
    """The picture is rendered with that filter and those knobs. Returns what was printed about
    it."""
    result = succeeds("render", *arguments, "-o", folder / "a.exr")
    check(error_lines(result) == [], report(result))
    header = exr_header(folder / "a.exr")
    check(header["filter"] == filter_name, f"{header['filter']}: {report(result)}")
    for knob, value in knobs:
        check(header[f"knob.{knob}"] == value, f"{knob} is {header[f'knob.{knob}']}")
    lines = result.stdout.splitlines()
    check(lines[0].startswith(f"picked {filter_name}"), report(result))
    for words in says:
        check(words in "\n".join(lines[:2]), f"no '{words}' in: {report(result)}")
    return result


# A stored sweep -----------------------------------------------------------------------------

def test_the_least_error_within_a_budget():
    folder, path = stored("least_error")
    choices = len(measured()["rows"]) - 1  # the reference is not a choice
    picks(folder, *SCENE, "--sweep", path, "--budget", "20", filter_name="mipmap",
          knobs=[("probes", 1), ("storage", "float32")],
          says=["picked mipmap: 20.0 ms with maps rebuilt, relative L2 0.500",
                f"3 of {choices} choices keep to 20 ms, this one errs least",
                "the next more exact is mipmap with probes=2: 40.0 ms with maps rebuilt, relative "
                "L2 0.4",
                f"figures: {path}, 1 frame, errors against 2 samples per pixel"])
    picks(folder, *SCENE, "--sweep", path, "--budget", "19.9", filter_name="mipmap",
          knobs=[("storage", "float16")], says=["mipmap with storage=float16: 16.0 ms"])
    picks(folder, *SCENE, "--sweep", path, "--budget", "10", filter_name="direct",
          says=[f"1 of {choices} choices keeps to 10 ms"])
    picks(folder, *SCENE, "--sweep", path, "--budget", "999", filter_name="mipmap",
          knobs=[("probes", 2)], says=["none is more exact"])


def test_the_least_time_for_an_error():
    folder, path = stored("least_time")
    picks(folder, *SCENE, "--sweep", path, "--error", "0.55", filter_name="mipmap",
          knobs=[("probes", 1), ("storage", "float32")],
          says=["picked mipmap: 20.0 ms", "choices keep to an error of 0.55, this one is fastest",
                "the next faster is mipmap with storage=float16: 16.0 ms"])
    picks(folder, *SCENE, "--sweep", path, "--error", "0.4", filter_name="mipmap",
          knobs=[("probes", 2)])
    picks(folder, *SCENE, "--sweep", path, "--error", "100", filter_name="direct",
          says=["none is faster"])


def test_maps_that_are_retained_cost_less():
    folder, path = stored("retained")
    picks(folder, *SCENE, "--sweep", path, "--budget", "15", "--maps", "retained",
          filter_name="mipmap", knobs=[("probes", 1), ("storage", "float32")],
          says=["15.0 ms with maps retained"])
    picks(folder, *SCENE, "--sweep", path, "--budget", "15", "--maps", "rebuilt",
          filter_name="direct")


def test_another_size_is_scaled():
    folder, path = stored("scaled")
    picks(folder, "checkerboard", "--size", "64x36", "--sweep", path, "--budget", "65",
          filter_name="mipmap", knobs=[("storage", "float32")],
          says=["65.0 ms with maps rebuilt, relative L2 0.500",  # 5 + 4 * 15
                "scaled from 32x18 to 64x36: shading by the pixels, building and errors"])
    picks(folder, "checkerboard", "--size", "64x36", "--sweep", path, "--budget", "60", "--maps",
          "retained", filter_name="mipmap", knobs=[("storage", "float32")], says=["60.0 ms"])


def test_nothing_fits():
    folder, path = stored("nothing")
    for options, words in [(["--budget", "9.5"], ["--budget 9.5", "the cheapest is direct: 10.0 ms",
                                                  "relative L2 0.900"]),
                           (["--error", "0.3"], ["--error 0.3", "the most exact is mipmap with "
                                                 "probes=2: 40.0 ms"])]:
        result = fails("render", *SCENE, "--sweep", path, *options, "-o", folder / "a.exr",
                       says=[f"none of {len(measured()['rows']) - 1} choices", *words])
        check(result.stdout == "", report(result))
    leaves(folder, "sweep.json")


def test_rows_without_figures_are_no_choice():
    results = with_figures()
    for row in results["rows"]:
        if key_of(row) == ("direct", ""):
            row["error"]["relative_l2"] = None
        if key_of(row) == ("mipmap", "storage=float16"):
            row["rebuilt_ms"] = None
    folder, path = stored("gaps", results)
    picks(folder, *SCENE, "--sweep", path, "--budget", "20", filter_name="mipmap",
          says=[f"1 of {len(results['rows']) - 3} choices"])
    for row in results["rows"]:
        row["rebuilt_ms"] = 0
    folder, path = stored("gaps", results)
    fails("render", *SCENE, "--sweep", path, "--budget", "20", "-o", folder / "a.exr",
          says="no filter has both a time and an error")


def test_rows_of_another_version_are_no_choice():
    results = with_figures()
    results["version"] = "0.0.1"
    for row in results["rows"]:
        if key_of(row) == ("mipmap", ""):
            row["filter"] = "blur"
        if key_of(row) == ("mipmap", "probes=2"):
            row["settings"][0]["name"] = "colour"
    folder, path = stored("version", results)
    result = picks(folder, *SCENE, "--sweep", path, "--budget", "50", filter_name="mipmap",
                   knobs=[("storage", "float16")],
                   says=[f"2 of {len(results['rows']) - 3} choices"])
    check("warning: " in result.stderr and "lobe 0.0.1" in result.stderr, report(result))


def test_another_view_is_warned_of():
    folder, path = stored("view")
    for options in (["--eye", "0,0,3"], ["--path", "0.3"], ["--light", "point:0,1,3:9,9,9"]):
        result = succeeds("render", *SCENE, "--sweep", path, "--budget", "20", *options, "-o",
                          folder / "a.png")
        check("own camera and lights" in result.stderr, report(result))
    result = succeeds("render", *SCENE, "--sweep", path, "--budget", "20", "-o", folder / "a.png")
    check(result.stderr == "", report(result))


def test_a_sweep_of_something_else_is_refused():
    for member, value, words in [("device", "a toaster", ["measured on a toaster, ",
                                                           "this device"]),
                                 ("driver", "toast 1.0", ["toast 1.0; this device"])]:
        results = with_figures()
        mine = results[member]
        results[member] = value
        folder, path = stored("other", results)
        fails("render", *SCENE, "--sweep", path, "--budget", "20", "-o", folder / "a.exr",
              says=["sweep.json", mine, *words])
        leaves(folder, "sweep.json")
    folder, path = stored("other")
    fails("render", "bumps", "--size", SIZE, "--sweep", path, "--error", "1", "-o",
          folder / "a.exr", says=["sweep.json", "of checkerboard, not of scene 'bumps'"])
    fails("render", "nosuch.gltf", "--sweep", path, "--error", "1", "-o", folder / "a.exr",
          says=["sweep.json", "nosuch.gltf", "skipped"])
    leaves(folder, "sweep.json")


def test_a_broken_sweep_is_refused():
    folder, path = stored("broken")
    content = path.read_text()
    for length in (0, 1, len(content) // 2, len(content) - 1):
        path.write_text(content[:length])
        fails("render", *SCENE, "--sweep", path, "--budget", "20", "-o", folder / "a.exr",
              says="sweep.json")
    path.unlink()
    fails("render", *SCENE, "--sweep", path, "--budget", "20", "-o", folder / "a.exr",
          says="sweep.json")
    leaves(folder)


# Calibration --------------------------------------------------------------------------------

def test_a_calibration_measures_what_is_drawn():
    folder = fresh_folder("calibrated")
    (folder / "maps").mkdir()
    (folder / "out").mkdir()
    # Stripes that lean to the left and right: averaging them is wrong.
    png_draw(folder / "maps" / "a_normal.png", 128, 128,
             lambda x, y: (218 if x % 2 else 38, 128, 218))
    png_draw(folder / "maps" / "a_rough.png", 128, 128, lambda x, y: (60, 60, 60))
    picture = ["--material", folder / "maps", "--carrier", "cloth", "--size", "24x16", "--light",
               "point:0.3,2,3:30,30,30"]
    result = lobe("render", *picture, "--budget", "100000", "--depth", "float", "-o",
                  folder / "out" / "a.exr")
    check(result.returncode == 0 and "calibrating: " in result.stderr, report(result))
    said = re.match(r"picked (\w+)(?: with (\S+=\S+))?: (\S+) ms with maps rebuilt, relative L2 "
                    r"(\S+); (\d+) of (\d+) choices keep to 100000 ms, this one errs least\n"
                    r"none is more exact; figures: calibrated, up to 3 frames, errors "
                    r"against 64 samples per pixel\n", result.stdout)
    check(said is not None, report(result))
    name, knob, milliseconds, error, within, choices = said.groups()
    most = re.search(r"calibrating: up to (\d+) choices", result.stderr)
    # Averaged maps err by far more than a filter that is as fast, so their knobs are not tried.
    check(within == choices and int(choices) < int(most[1]), report(result))
    check(name not in ("reference", "direct", "mipmap") and float(milliseconds) > 0,
          report(result))
    header = exr_header(folder / "out" / "a.exr")
    check(header["filter"] == name, str(header))
    # The error is that of the picture that was written.
    truth = folder / "out" / "truth.exr"
    succeeds("render", *picture, "--filter", "reference", "--samples", "64", "--depth", "float",
             "-o", truth)
    compared = json.loads(succeeds("compare", folder / "out" / "a.exr", truth, "--json").stdout)
    found = re.search(r"'relative_l2': ([\d.e-]+)", str(compared))
    check(abs(float(found[1]) - float(error)) < 0.006 * float(error),
          f"{found[1]}, said {error}, {knob}")
    leaves(folder / "out", "a.exr", "truth.exr")


def test_a_calibration_that_nothing_meets():
    folder = fresh_folder("unmet")
    gltf_write(folder / "a.gltf", gltf_triangle())
    result = fails("render", folder / "a.gltf", "--size", "16x9", "--light",
                   "point:0.3,2,3:30,30,30", "--error", "0.00001", "-o",
                   folder / "a.exr", says=["--error 1e-05: none of ", "the most exact is",
                                           "figures: calibrated"])
    check("calibrating: " in result.stderr and result.stdout == "", report(result))
    leaves(folder, "a.gltf")


# Usage --------------------------------------------------------------------------------------

def test_options_that_do_not_go_together():
    render = ["render", "bumps", "-o", "never.exr"]
    is_wrong_usage(*render, "--budget", "5", "--error", "1",
                   says="--budget and --error exclude each other")
    for limit in (["--budget", "5"], ["--error", "1"]):
        is_wrong_usage(*render, *limit, "--filter", "lobes",
                       says=f"{limit[0]} and --filter exclude each other")
        is_wrong_usage(*render, *limit, "--set", "probes=2",
                       says=f"{limit[0]} and --set exclude each other")
    is_wrong_usage(*render, "--sweep", "a.json", says="--sweep needs --budget or --error")
    is_wrong_usage(*render, "--maps", "rebuilt", says="--maps needs --budget or --error")
    is_wrong_usage(*render, "--maps", "half", "--budget", "5", says=["half", "rebuilt, retained"])
    is_wrong_usage("render", "--material", "maps", "-o", "never.exr", "--budget", "5", "--sweep",
                   "a.json", says="--sweep and --material exclude each other")


def test_limits_that_are_none():
    for option in ("--budget", "--error"):
        for value in ("0", "-1", "nan", "inf", "-inf", "1e999", "", "5ms"):
            is_wrong_usage("render", "bumps", "-o", "never.exr", f"{option}={value}", says=option)
        is_wrong_usage("render", "bumps", "-o", "never.exr", option, says=option)


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_the_least_error_within_a_budget, test_another_size_is_scaled, test_nothing_fits,
        test_a_sweep_of_something_else_is_refused, test_a_broken_sweep_is_refused,
        test_a_calibration_that_nothing_meets, test_options_that_do_not_go_together,
        test_limits_that_are_none),
        long=[test_a_calibration_measures_what_is_drawn]))
