"""What `lobe report` draws from a sweep, and how a browser shows it."""

import base64
import collections
import copy
import functools
import json
import math
import os
import re
import sys

import browser
import page
import tap
from files import exr_write, png_decode
from program import FOLDER, check, fails, fresh_folder, leaves, succeeds

WIDTH, HEIGHT = 40, 24
ODD = "walls <b>&amp; \"doors\"</b> 'x'"
SCENES = ("tablecloth", ODD, "checkerboard")
FILTERS = ("direct", "mipmap", "lobes", "moments", "reference")

# A filter's picture has one colour, so that its error is the same everywhere.
GREY = {"direct": 0.5, "mipmap": 0.4, "lobes": 0.3, "moments": 0.22, "reference": 0.201}
TRUTH = 0.2
MILLISECONDS = {"direct": 100, "mipmap": 130, "lobes": 310, "moments": 290, "reference": 12000}
# Ratios of moments to another filter, in the form that tools/targets writes.
TARGETS = [
    {"name": f"{measure}({a}) / {measure}({b})", "measure": kind, "scene": scene, "filter": a,
     "base": b, "limit": limit, "at_least": a == "reference"}
    for measure, kind, scene, a, b, limit in (
        ("error", "error", None, "moments", "lobes", 0.5),
        ("error", "error", None, "moments", "lean", 0.5),
        ("flicker", "flicker", None, "moments", "lobes", 0.3),
        ("bytes", "bytes", None, "moments", "lobes", 1),
        ("time", "rebuilt", "pillow", "moments", "direct", 3.3),
        ("time", "rebuilt", "tablecloth", "moments", "direct", 4),
        ("time", "rebuilt", "tablecloth", "reference", "moments", 40))]
BYTES = {"direct": 0, "mipmap": 8, "lobes": 33, "moments": 30, "reference": 0}


# Supersampling falls from the first error to the last on a straight line of logarithms.
STEPS = [{"samples": 1, "relative_l2": 2}, {"samples": 64, "relative_l2": 0.001}]


def metrics(error):
    return {"rmse": error / 7, "relative_mse": error / 3, "relative_l2": error,
            "relative_l1": error / 2, "psnr": None, "mean_ratio": 1 + error,
            "flip": error / 5}


def one_pass(name, milliseconds, building=False, traffic=0.0, copy_milliseconds=0.0):
    return {"name": name, "milliseconds": milliseconds, "count": 1, "building": building,
            "bytes": traffic, "copy_milliseconds": copy_milliseconds}


def passes(name, total):
    if BYTES[name] == 0:
        return [one_pass("shading", total)]
    return [one_pass(f"{name} <&> build", 0.25 * total, True, 4e9, 0.1 * total),
            one_pass("shading", 0.75 * total)]


def one_row(scene, name, factor, varied="", value="a"):
    total = MILLISECONDS[name] * factor
    error = (GREY[name] - TRUTH) / TRUTH * (1 if not varied else 0.9)
    return {"scene": SCENES[scene], "filter": name,
            "settings": [{"name": "knob<1>", "value": value}, {"name": "probes", "value": "1"}],
            "varied": varied, "rebuilt_ms": total, "rebuilt_p95_ms": 1.1 * total,
            "retained_ms": 0.75 * total, "retained_p95_ms": 0.8 * total,
            "building_ms": 0.25 * total, "shading_ms": 0.75 * total, "changed_ms": 1.2 * total,
            "changed_wall_ms": 2.5 * total, "changed_caller_cpu_ms": 0.4 * total,
            "changed_process_cpu_ms": 3.5 * total, "passes": passes(name, total),
            "memory_bytes": 1 << 25, "bytes_per_texel": BYTES[name], "error": metrics(error),
            "error_lobe_base": metrics(0.8 * error),
            "inside_relative_l2": 0.7 * error, "silhouettes_relative_l2": 1.3 * error,
            "flicker": -1 if name == "reference" else 0.6 * error,
            "picture": None if varied else f"pictures/{name}.exr"}


def make_results():
    rows = []
    for scene in (0, 1):
        for name in FILTERS:
            if (scene, name) != (1, "mipmap"):
                rows.append(one_row(scene, name, 1 + 0.07 * scene * len(name)))
                if BYTES[name]:
                    rows.append(one_row(scene, name, 1.3, "knob<1>", "b & c"))
    scenes = [{"name": name, "triangles": 12 + i, "reference": "pictures/truth.exr",
               "supersampling": STEPS, "skipped": None} for i, name in enumerate(SCENES)]
    scenes[2].update(reference=None, skipped="the folder <none> is missing")
    return {"version": "0.1.0", "device": "a device", "driver": "a driver & more",
            "device_type": "CPU", "size": [WIDTH, HEIGHT], "reference_samples": 256,
            "path_samples": 64, "stations": 4, "frames": 20, "complete": True, "scenes": scenes,
            "rows": rows}


def make_sweep(name, results=None):
    """A folder with a sweep as the benchmark writes it. Returns the file of results."""
    folder = fresh_folder(name)
    (folder / "pictures").mkdir()
    for picture, grey in {**GREY, "truth": TRUTH}.items():
        exr_write(folder / f"pictures/{picture}.exr", WIDTH, HEIGHT, lambda x, y, g=grey: (g, g, g))
    path = folder / "results.json"
    path.write_text(json.dumps(results or make_results()), encoding="utf-8")
    os.utime(path, (1.7e9, 1.7e9))
    return path


def make_report(name, results=None, *options):
    """The text of the page, and the page as a tree."""
    if results is None and not options:
        return plain_report()
    return draw_report(name, results, *options)


@functools.cache
def plain_report():
    return draw_report("plain")


def draw_report(name, results=None, *options):
    path = make_sweep(name, results)
    succeeds("report", path, "-o", path.parent / "report", *options)
    leaves(path.parent / "report", "index.html")
    text = (path.parent / "report/index.html").read_text(encoding="utf-8")
    return text, page.parse(text)


def make_report_with_targets(name, results=None):
    targets = FOLDER / "targets.json"
    targets.write_text(json.dumps(TARGETS), encoding="utf-8")
    return make_report(name, results, "--targets", targets)


def near(a, b):
    return isinstance(a, float) and math.isclose(a, b, rel_tol=2e-6)


def default(results, scene, name):
    return next(row for row in results["rows"] if not row["varied"] and
                (row["scene"], row["filter"]) == (SCENES[scene], name))


# The page --------------------------------------------------------------------------------------

def test_nothing_is_fetched():
    text, root = make_report("fetch")
    for element in root.walk():
        for name, value in element.attributes.items():
            if name in ("src", "href"):
                check(value.startswith(("data:", "#")), f"{element.tag} {name}={value[:60]}")
            check(not name.startswith("on"), f"a script in {element.tag} {name}")
    check(root.all("script") == [], "a script")
    bare = re.sub(r"data:image/png;base64,[A-Za-z0-9+/=]*", "", text)
    check("://" not in bare and "@import" not in bare, "an address")
    check(all(word == "url(#" for word in re.findall(r"url\(.", bare)), "a fetched style")
    check("default-src 'none'" in text, "no policy")


def test_links_reach_what_they_name():
    _, root = make_report("links")
    names = [element.attributes["id"] for element in root.walk() if "id" in element.attributes]
    check(len(names) == len(set(names)), f"an id twice: {names}")
    for link in root.all("a"):
        check(link.attributes["href"][1:] in names, link.attributes["href"])
    for element in root.walk():
        for name in element.attributes.get("aria-labelledby", "").split():
            check(name in names, name)


def test_head_says_what_was_measured():
    _, root = make_report("head")
    head = root.all("header")[0].text()
    for words in ("2023-11-14 22:13 UTC", "0.1.0", "a device", "a driver & more", "CPU",
                  f"{WIDTH} × {HEIGHT}", "256", "64 (path)", "20 of each row", "software renderer"):
        check(words in head, f"no '{words}' in {head}")
    check("interrupted" not in head, head)


def test_every_scene_and_filter_is_there():
    text, root = make_report("all")
    check("<b>&" not in text and "<none>" not in text, "not escaped")
    for index, name in enumerate(SCENES):
        section = page.by_id(root, f"scene-{index}")
        check(section.all("h2")[0].text() == f"Scene {name}", section.all("h2")[0].text())
        shown = [figure.all("b")[0].text() for figure in section.all("figure")
                 if figure.all("img")]
        wanted = [] if index == 2 else [
            "reference", "direct", *(["mipmap"] if index == 0 else []), "lobes", "moments"]
        check(shown == wanted, f"{name}: {shown}")
        check(len(section.all("svg", class_="plot")) == (0 if index == 2 else 4), "plots")
    check("the folder <none> is missing" in page.by_id(root, "scene-2").text(), "why")


def test_plots_show_all_points_and_the_front():
    results = make_results()
    _, root = make_report("plots")
    for index in (0, 1):
        count = sum(row["scene"] == SCENES[index] and row["filter"] != "reference"
                    for row in results["rows"])
        for kind in ("rebuilt", "retained", "memory"):
            plot = next(svg for svg in root.all("svg") if
                        svg.attributes.get("aria-labelledby", "").startswith(
                            f"scene-{index}-{kind}-title"))
            check(len(plot.all("title")) == 1 + count, f"{kind}: {len(plot.all('title'))} marks")
            figure = plot.parent
            front = [item.text() for item in figure.all("ol")[0].all("li")]
            check(len(plot.all("g", class_="ring")) == len(front), f"{front}")
            check(len(plot.all("g", class_="mark")) == count, f"{kind}: marks")
            check(front[0].startswith("direct:") and "moments" in front[-1], f"{front}")
            check("Not drawn: reference" in figure.text(), figure.text())
    titles = [title.text() for title in root.all("title")]
    check("lobes, knob<1> b & c" in titles, str(titles))


# Numbers ---------------------------------------------------------------------------------------

def expected_cells(row):
    worth = 64 ** (math.log(2 / row["error"]["relative_l2"]) / math.log(2000))
    scale = 1 + 0.07 * SCENES.index(row["scene"]) * len("reference")
    gain = worth * 0.75 * MILLISECONDS["reference"] * scale / 64 / row["retained_ms"]
    return [row["rebuilt_ms"], row["retained_ms"], row["building_ms"], row["shading_ms"],
            row["changed_ms"], row["changed_wall_ms"], row["changed_caller_cpu_ms"],
            row["changed_process_cpu_ms"],
            row["bytes_per_texel"], row["memory_bytes"] / 2 ** 20, row["error"]["relative_l2"],
            row["inside_relative_l2"], row["silhouettes_relative_l2"],
            row["error"]["relative_l1"], row["error"]["flip"],
            row["error_lobe_base"]["relative_l2"], row["error"]["mean_ratio"], row["flicker"],
            worth, gain]


def check_cells(cells, row):
    for cell, value in zip(cells, expected_cells(row), strict=True):
        check(cell == "–" if value == -1 else near(cell, value), f"{cell} is not {value} in {row}")


def test_numbers_are_those_of_the_rows():
    results = make_results()
    _, root = make_report("numbers")
    seen = 0
    for index in (0, 1):
        defaults, variations, _ = page.by_id(root, f"scene-{index}").all("table")
        for cells in page.rows(defaults):
            check_cells(cells[1:-1], default(results, index, cells[0]))
            check(cells[-1].replace("\xa0", " ") == "knob<1> a, probes 1", cells[-1])
            seen += 1
        for cells in page.rows(variations):
            row = next(row for row in results["rows"] if row["varied"] and
                       (row["scene"], row["filter"]) == (SCENES[index], cells[0]))
            check(cells[1:3] == ["knob<1>", "b & c"], str(cells))
            check_cells(cells[3:], row)
            seen += 1
    check(seen == len(results["rows"]), f"{seen} rows")


def means(values):
    return [sum(values) / len(values), math.prod(values) ** (1 / len(values))]


def test_summary_averages_over_scenes():
    results = make_results()
    _, root = make_report("summary")
    rows = page.rows(page.by_id(root, "summary").all("table")[0])
    check([cells[0] for cells in rows] == list(FILTERS), str(rows))
    for cells in rows:
        scenes = [0] if cells[0] == "mipmap" else [0, 1]
        own = [default(results, scene, cells[0]) for scene in scenes]
        direct, lobes = ([default(results, scene, name) for scene in scenes]
                         for name in ("direct", "lobes"))
        wanted = []
        for base in (direct, lobes):
            wanted += means([a["error"]["relative_l2"] / b["error"]["relative_l2"]
                             for a, b in zip(own, base)])
        wanted += means([row["flicker"] for row in own]) if cells[0] != "reference" else [None] * 2
        for measure in ("rebuilt_ms", "retained_ms"):
            wanted += means([a[measure] / b[measure] for a, b in zip(own, direct)])
        wanted += means([row["bytes_per_texel"] for row in own])
        check(cells[1] == str(len(scenes)), str(cells))
        for cell, value in zip(cells[2:], wanted, strict=True):
            check(cell == "–" if value is None else near(cell, value), f"{cells}: {value}")


def test_targets_are_computed():
    results = make_results()
    _, root = make_report_with_targets("targets")
    rows = {(cells[0], cells[1]): cells[2:]
            for cells in page.rows(page.by_id(root, "targets").all("table")[0])}
    check(len(rows) == len(TARGETS), str(rows))
    error = [[default(results, scene, name)["error"]["relative_l2"] for scene in (0, 1)]
             for name in ("moments", "lobes")]
    limit, value, verdict, _ = rows["error(moments) / error(lobes)", "means over 2 scenes"]
    check(limit == "≤ 0.5" and near(value, sum(error[0]) / sum(error[1])), str(value))
    check(verdict == "✓ met", verdict)
    limit, value, verdict, _ = rows["time(reference) / time(moments)", "tablecloth"]
    check(limit == "≥ 40" and near(value, 12000 / 290) and verdict == "✓ met", str(value))
    check(near(rows["time(moments) / time(direct)", "tablecloth"][1], 2.9), "time")
    check("lean is not in" in rows["error(moments) / error(lean)", "means over 0 scenes"][1],
          "lean")
    check("pillow was not" in rows["time(moments) / time(direct)", "pillow"][1], "pillow")


def test_a_missed_target_says_by_how_much():
    results = make_results()
    default(results, 0, "moments")["rebuilt_ms"] = 500
    _, root = make_report_with_targets("missed", results)
    rows = {(cells[0], cells[1]): cells[2:]
            for cells in page.rows(page.by_id(root, "targets").all("table")[0])}
    check(rows["time(moments) / time(direct)", "tablecloth"][2] == "✗ missed by 25 %", str(rows))
    check(rows["time(reference) / time(moments)", "tablecloth"][2] == "✗ missed by 67 %", str(rows))


def test_without_targets_nothing_is_said_of_them():
    text, root = make_report("untargeted")
    check("#targets" not in text and page.by_id(root, "paper"), "targets")


def test_broken_targets_are_refused():
    path = make_sweep("broken-targets")
    targets = path.parent / "targets.json"
    targets.write_text(json.dumps([{**TARGETS[0], "limit": None}]))
    refuses(path, "targets.json", options=("--targets", targets))
    targets.unlink()
    refuses(path, "targets.json", options=("--targets", targets))


def test_the_papers_table_is_beside_ours():
    _, root = make_report("paper")
    rows = page.rows(page.by_id(root, "paper").all("table")[0])
    check([cells[0] for cells in rows] == ["Pillow", "Tablecloth", "Bunny", "Dragon", "Sponza"],
          str(rows))
    cloth, hall = rows[1], rows[4]
    wanted = [100, 1, 1.3, 1.75, None, 125, 120, 4, 3.1, 2.9]
    check(cloth[1:3] == ["tablecloth", "0.4"], str(cloth))
    for cell, value in zip(cloth[3:], wanted, strict=True):
        check(cell == "–" if value is None else near(cell, value), f"{cloth}: {value}")
    check(hall[1] == "hall" and near(hall[8], 97 / 1.6) and hall[3] == "–", str(hall))


def test_bandwidth_is_beside_a_copy():
    _, root = make_report("bandwidth")
    rows = page.rows(page.by_id(root, "bandwidth").all("table")[0])
    check([cells[0] for cells in rows] == ["mipmap", "lobes", "moments"], str(rows))
    mipmap = rows[0]
    check(mipmap[1] == "mipmap <&> build", str(mipmap))
    check(near(mipmap[3], 4e9 / 32.5e6) and near(mipmap[4], 4e9 / 13e6), str(mipmap))
    check(all(near(cells[5], 0.4) for cells in rows), str(rows))
    passes_table = page.rows(page.by_id(root, "scene-0").all("table")[2])
    check(near(passes_table[1][4], 32.5) and near(passes_table[1][6], 4e9 / 32.5e6),
          str(passes_table[1]))


def test_what_was_not_measured_is_a_dash():
    results = make_results()
    results["complete"] = False
    for row in results["rows"]:
        row["flicker"] = -1
    default(results, 0, "lobes")["error"]["relative_l2"] = None
    default(results, 0, "direct")["rebuilt_ms"] = None
    text, root = make_report_with_targets("dashes", results)
    check("interrupted" in root.all("header")[0].text(), "not told")
    check(not re.search(r"\b(nan|inf)\b", re.sub(r"base64,[^\"]*", "", text)), "not a number")
    check("no scene was measured" in page.by_id(root, "targets").text(), "flicker")


def test_hostile_results_make_a_page_or_a_line():
    """Values that a parser in another language would read differently."""
    results = make_results()
    make_report("hostile", {**results, "device": "\x00\x1b[31m\x85<script>",
                            "scenes": 2 * results["scenes"], "rows": 2 * results["rows"]})
    for row, value in zip(results["rows"], (1e308, 5e-324, -1, 1e18, 0, -1e308)):
        row.update(rebuilt_ms=value, bytes_per_texel=value, flicker=value)
        row["error"]["relative_l2"] = value
        row["passes"][0].update(milliseconds=value, bytes=value, copy_milliseconds=value)
    make_report("extreme", results)


def test_empty_results_make_a_page():
    results = make_results()
    results["rows"] = []
    results["scenes"] = []
    _, root = make_report("empty", results)
    check("0 filters" in root.all("header")[0].text(), root.all("header")[0].text())


# Environments ----------------------------------------------------------------------------------

def make_lit_results():
    """The first scene in an environment, by three methods; its reference has noise."""
    results = make_results()
    scene = results["scenes"][0]
    scene.update(scene="tablecloth", environment="maps/sun & sky.exr", lighting="no lights",
                 noise=0.06)
    rows = [row for row in results["rows"] if row["scene"] == SCENES[0] and not row["varied"]
            and row["filter"] != "reference"]
    for row in rows:
        row["passes"].insert(0, {**one_pass("environment_cube", 900, True), "once": True})
        row["environment_ms"] = 900
        row["settings"].append({"name": "env", "value": "prefiltered"})
        for factor, method in ((0.7, "mip"), (1.8, "sampled")):
            other = copy.deepcopy(row)
            other.update(varied="env", picture=None, shading_ms=factor * row["shading_ms"])
            other["settings"][-1]["value"] = method
            other["error"]["relative_l2"] = 0.5 * factor
            results["rows"].append(other)
    return results


def test_filters_by_methods_of_an_environment():
    results = make_lit_results()
    text, root = make_report("lit", results)
    section = page.by_id(root, "scene-0")
    check("maps/sun & sky.exr; no lights" in section.text() and "sun & sky" not in text,
          section.all("p")[0].text())
    rows = {cells[0]: cells[1:] for cells in page.rows(section.all("table")[0])}
    check(list(rows) == ["direct", "mipmap", "lobes", "moments"], str(rows))
    for name, cells in rows.items():
        shading = 0.75 * MILLISECONDS[name]
        error = (GREY[name] - TRUTH) / TRUTH
        wanted = [math.sqrt(error ** 2 - 0.06 ** 2), shading, 900,
                  math.sqrt(0.35 ** 2 - 0.06 ** 2), 0.7 * shading, 900,
                  math.sqrt(0.9 ** 2 - 0.06 ** 2), 1.8 * shading, 900]
        check(all(map(near, cells, wanted)), f"{name}: {cells}, not {wanted}")
    check("prepares the environment, once" in section.text(), "passes")
    plot = section.all("svg", class_="plot")[0]
    labels = [label.text() for label in plot.all("text")]
    check({"prefiltered", "mip", "sampled"} <= set(labels), str(labels))
    other = page.by_id(root, "scene-1")
    check("Lit by" not in other.text(), "another scene")
    check("prefiltered" not in [label.text() for label in other.all("text")], "another scene")


# Pictures --------------------------------------------------------------------------------------

def srgb(linear):
    encoded = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return round(255 * encoded)


def pictures(section):
    """(alternative text, width, height, set of colours) of each."""
    found = []
    for image in section.all("img"):
        data = base64.b64decode(image.attributes["src"].removeprefix("data:image/png;base64,"),
                                validate=True)
        width, height, pixels = png_decode(data)
        check((image.attributes["width"], image.attributes["height"]) == (str(width), str(height)),
              str(image.attributes["alt"]))
        found.append((image.attributes["alt"], width, height, set(pixels)))
    return found


def test_pictures_are_those_of_the_sweep():
    _, root = make_report("pictures")
    found = {alt: rest for alt, *rest in pictures(page.by_id(root, "scene-0"))}
    for name, grey in {**GREY, "the reference": TRUTH}.items():
        if name != "reference":
            check(found[name] == [WIDTH, HEIGHT, {(srgb(grey),) * 3}], f"{name}: {found[name]}")
    errors = [found[f"error map of {name}"][2] for name in ("direct", "lobes", "moments")]
    check(all(len(colours) == 1 for colours in errors), str(errors))
    lightness = [sum(next(iter(colours))) for colours in errors]
    check(lightness == sorted(lightness, reverse=True) and lightness[2] < lightness[0],
          f"{lightness}")


def test_wide_pictures_are_reduced_and_a_part_is_kept():
    _, root = make_report("reduced", None, "--picture-width", "16")
    found = {alt: rest for alt, *rest in pictures(page.by_id(root, "scene-0"))}
    check(found["lobes"] == [14, 8, {(srgb(0.3),) * 3}], str(found["lobes"]))
    check(found["detail of lobes"] == [7, 4, {(srgb(0.3),) * 3}], str(found["detail of lobes"]))
    check(found["error map of lobes"][:2] == [14, 8], str(found["error map of lobes"]))


def test_equal_sweeps_give_equal_pages():
    check(draw_report("equal")[0] == plain_report()[0], "two pages")


# Failures --------------------------------------------------------------------------------------

def refuses(path, *says, options=(), **environment):
    fails("report", path, "-o", path.parent / "report", *options, says=says, **environment)
    check(not (path.parent / "report").exists(), "something was written")


def test_what_draws_it_may_be_missing():
    path = make_sweep("libraries")
    for name, package in (("matplotlib", "python3-matplotlib"), ("jinja2", "python3-jinja2")):
        folder = fresh_folder("without")
        (folder / f"{name}.py").write_text(f"raise ImportError('no {name} here')")
        refuses(path, package, f"no {name} here", PYTHONPATH=folder)
    refuses(path, "install python3", PATH=fresh_folder("nothing"))


def test_a_virtual_environment_comes_first():
    """It does not contain the system's packages."""
    folder = fresh_folder("first")
    (folder / "bin").mkdir()
    (folder / "bin/python3").symlink_to("/usr/bin/python3")
    (folder / "pyvenv.cfg").write_text("home = /usr/bin\ninclude-system-site-packages = false\n")
    path = make_sweep("environment")
    succeeds("report", path, "-o", path.parent / "report",
             PATH=f"{folder / 'bin'}:{os.environ['PATH']}")


def test_a_users_matplotlib_is_left_alone():
    path = make_sweep("settings")
    (FOLDER / "matplotlibrc").write_text("axes.facecolor: red\nnonsense: 1\n")
    succeeds("report", path, "-o", path.parent / "report", MPLBACKEND="nonsense",
             PYTHONSAFEPATH="1")
    (FOLDER / "matplotlibrc").unlink()
    check((path.parent / "report/index.html").read_text() == make_report("settings")[0], "settings")


def test_a_missing_picture_is_named():
    path = make_sweep("missing")
    (path.parent / "pictures/lobes.exr").unlink()
    refuses(path, "pictures/lobes.exr")


def test_a_damaged_picture_is_named():
    path = make_sweep("damaged")
    picture = path.parent / "pictures/truth.exr"
    picture.write_bytes(picture.read_bytes()[:400])
    refuses(path, "truth.exr")


def test_pictures_of_other_sizes_are_refused():
    path = make_sweep("sizes")
    exr_write(path.parent / "pictures/lobes.exr", 8, 8, lambda x, y: (1, 1, 1))
    refuses(path, "lobes.exr", "8x8")


def test_broken_results_are_refused():
    path = make_sweep("broken")
    path.write_text(path.read_text()[:200])
    refuses(path, "results.json")
    path.write_text("{}")
    refuses(path, "results.json")
    path.unlink()
    refuses(path, "results.json")


def test_too_many_filters_are_refused():
    results = make_results()
    for index in range(70):
        row = copy.deepcopy(results["rows"][0])
        row["filter"] = f"filter {index}"
        results["rows"].append(row)
    refuses(make_sweep("filters", results), "64")


def test_too_many_rows_are_refused():
    results = make_results()
    results["rows"] += [results["rows"][3]] * 1100
    refuses(make_sweep("rows", results), "1024")


def test_a_folder_that_cannot_be_made_is_told():
    path = make_sweep("folder")
    fails("report", path, "-o", path.parent / "none/report", says="none/report")
    fails("report", path, "-o", path, says="results.json")
    (path.parent / "taken/index.html").mkdir(parents=True)
    fails("report", path, "-o", path.parent / "taken", says="index.html")


# Browser ---------------------------------------------------------------------------------------

def count_near(pixels, colour, tolerance=6):
    return sum(count for pixel, count in collections.Counter(pixels).items()
               if all(abs(a - b) <= tolerance for a, b in zip(pixel, colour)))


def test_a_browser_shows_it():
    plain_report()
    messages, (width, height, pixels) = browser.screenshot(
        FOLDER / "plain/report/index.html", 1200, 5200, 0.5)
    check(messages == [], "\n".join(messages))
    check((width, height) == (600, 2600), f"{width}x{height}")
    # The page's background, text, the pictures of a filter in two scenes, and the bars' fill
    # colours.
    check(count_near(pixels, (255, 255, 255)) > 0.5 * len(pixels), "no white")
    check(count_near(pixels, (27, 27, 27), 40) > 2000, "no text")
    check(count_near(pixels, (srgb(0.3),) * 3, 0) > 10000, "no pictures")
    check(count_near(pixels, (244, 244, 244), 0) > 3000, "no bars")


def test_a_browser_draws_marks_where_they_are():
    text, root = plain_report()
    plot = root.all("svg", class_="plot")[0]
    source = re.search(r'<svg class="plot".*?</svg>', text, re.DOTALL).group()
    style = re.search(r"<style>.*?</style>", text, re.DOTALL).group()
    alone = FOLDER / "plain/plot.html"
    alone.write_text(f"<!DOCTYPE html><meta charset=utf-8>{style}<div style='position:fixed;left:0;"
                     f"top:0;width:560px'>{source}</div>", encoding="utf-8")
    messages, (width, _, pixels) = browser.screenshot(alone, 560, 400)
    check(messages == [], "\n".join(messages))
    marks = {mark.all("title")[0].text(): mark.all("use")[0].attributes
             for mark in plot.all("g", class_="mark")}
    for name, colour in (("direct", (0, 0, 0)), ("mipmap", (230, 159, 0)), ("lobes", (0, 114, 178)),
                         ("moments", (0, 158, 115))):
        x, y = (round(float(marks[name][axis])) for axis in "xy")
        check(count_near([pixels[y * width + x]], colour, 60) == 1, f"{name}: none at {x}, {y}")
    axis = [pixels[y * width + 62] for y in range(100, 300)]
    check(count_near(axis, (85, 85, 85), 90) > 150, "no axis")


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_nothing_is_fetched, test_wide_pictures_are_reduced_and_a_part_is_kept,
        test_what_draws_it_may_be_missing, test_a_missing_picture_is_named,
        test_a_damaged_picture_is_named, test_pictures_of_other_sizes_are_refused,
        test_broken_results_are_refused, test_too_many_filters_are_refused,
        test_too_many_rows_are_refused, test_broken_targets_are_refused,
        test_a_folder_that_cannot_be_made_is_told)))
