"""What `lobe bench --sweep` measures and writes, and how it stops and resumes."""

import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys

import tap
from files import exr_header, gltf_triangle
from program import (FOLDER, PROGRAM, ROOT, check, fails, fresh_folder, is_wrong_usage, leaves,
                     lobe, report, succeeds)

FILTERS = ["direct", "mipmap"]
QUICK = ["--sweep", "--filters", ",".join(FILTERS), "--size", "64x36", "--samples", "4",
         "--frames", "1", "--stations", "2", "--path-samples", "2"]
TIMES = ["rebuilt_ms", "rebuilt_p95_ms", "retained_ms", "retained_p95_ms", "building_ms",
         "shading_ms", "changed_ms", "changed_wall_ms", "changed_caller_cpu_ms",
         "changed_process_cpu_ms"]
ERRORS = ["flip", "mean_ratio", "psnr", "relative_l1", "relative_l2", "relative_mse", "rmse"]


def sweep(folder, *arguments):
    path = folder / "a.json"
    result = succeeds("bench", *QUICK, "--json", path, *arguments)
    return result, json.loads(path.read_text())


def settings_of(row):
    return {setting["name"]: setting["value"] for setting in row["settings"]}


def without_times(row):
    """Everything that must be the same in every run."""
    kept = {name: value for name, value in row.items() if name not in TIMES}
    kept["passes"] = [{name: value for name, value in one.items() if "milliseconds" not in name}
                      for one in row["passes"]]
    return kept


_once = []


def two_scenes():
    """An undisturbed sweep of two scenes, measured once for all cases; its folder and results."""
    if not _once:
        folder = fresh_folder("whole")
        result, results = sweep(folder, "bumps", "checkerboard", "--frames", "3")
        _once.extend([folder, result, results])
    return _once


# What is measured ---------------------------------------------------------------------------

def test_results_have_their_form():
    _, result, results = two_scenes()
    check(results["version"] == succeeds("--version").stdout.split()[1], "version")
    check(results["device_type"] == "CPU" and results["device"] in result.stdout, report(result))
    check(results["size"] == [64, 36] and results["reference_samples"] == 4, str(results))
    check((results["path_samples"], results["stations"], results["frames"]) == (2, 2, 3),
          str(results))
    check(results["complete"] is True, "complete")
    check([one["name"] for one in results["scenes"]] == ["bumps", "checkerboard"], "scenes")
    for scene in results["scenes"]:
        check(scene["triangles"] > 0 and scene["skipped"] is None, str(scene))
        check([step["samples"] for step in scene["supersampling"]] == [1, 2, 4], str(scene))
        check(all(step["relative_l2"] >= 0 for step in scene["supersampling"]), str(scene))
    for row in results["rows"]:
        check(all(isinstance(row[name], (int, float)) and row[name] >= 0 for name in TIMES),
              str(row))
        check(sorted(row["error"]) == ERRORS and sorted(row["error_lobe_base"]) == ERRORS,
              str(row))
        check(row["memory_bytes"] > 0 and row["flicker"] >= 0, str(row))
        parts = row["inside_relative_l2"], row["silhouettes_relative_l2"]
        check(parts[0] >= 0, str(row))
        # The plane of bumps fills the picture; that of the checkerboard ends at the horizon.
        check(parts[1] is None if row["scene"] == "bumps" else parts[1] >= 0, str(row))


def test_each_knob_is_varied_alone():
    *_, results = two_scenes()
    for scene in ("bumps", "checkerboard"):
        rows = [row for row in results["rows"] if row["scene"] == scene]
        check([row["filter"] for row in rows if row["varied"] == ""] == FILTERS, str(rows))
        default = settings_of(next(row for row in rows
                                   if row["filter"] == "mipmap" and row["varied"] == ""))
        changed = set()
        for row in rows:
            if row["filter"] == "mipmap" and row["varied"]:
                settings = settings_of(row)
                differing = [name for name in default if default[name] != settings[name]]
                check(differing == [row["varied"]], f"{row['varied']} varied, but {differing}")
                changed.add((row["varied"], settings[row["varied"]]))
        check({("probes", "2"), ("probes", "4"), ("storage", "float16")} <= changed, str(changed))


def test_times_come_apart():
    *_, results = two_scenes()
    for row in results["rows"]:
        parts = row["building_ms"] + row["shading_ms"]
        check(0.3 * row["rebuilt_ms"] < parts, str(row))
        passes = {one["name"]: one for one in row["passes"]}
        check(not passes["shading"]["building"] and passes["shading"]["bytes"] == 0, str(passes))
        building = [one for one in row["passes"] if one["building"]]
        check((row["filter"] == "direct") == (building == []), str(passes))
        check((row["building_ms"] > 0) == (building != []), str(row))
        for one in building:
            check(one["bytes"] > 0 and one["copy_milliseconds"] > 0 and one["milliseconds"] > 0,
                  str(one))


def test_bytes_are_those_of_the_maps():
    *_, results = two_scenes()
    rows = {settings_of(row).get("storage"): row for row in results["rows"]
            if row["scene"] == "bumps" and row["filter"] == "mipmap"
            and row["varied"] in ("", "storage")}
    moved = {name: sum(one["bytes"] for one in row["passes"] if one["building"])
             for name, row in rows.items()}
    check(rows["float16"]["bytes_per_texel"] < rows["float32"]["bytes_per_texel"], str(moved))
    check(moved["float16"] < moved["float32"], str(moved))


def test_flicker_and_error_tell_filters_apart():
    *_, results = two_scenes()
    direct, mipmap = [next(row for row in results["rows"] if row["scene"] == "checkerboard" and
                           row["filter"] == name and row["varied"] == "") for name in FILTERS]
    check(0 <= mipmap["flicker"] < direct["flicker"], f"{mipmap['flicker']} {direct['flicker']}")
    check(0 < mipmap["error"]["relative_l2"] < direct["error"]["relative_l2"], "errors")


def test_the_reference_has_one_row_without_flicker():
    result, results = sweep(fresh_folder("reference"), "checkerboard", "--filters", "reference")
    check(len(results["rows"]) == 1 and results["rows"][0]["flicker"] < 0, str(results["rows"]))
    shading = next(one for one in results["rows"][0]["passes"] if one["name"] == "shading")
    check(shading["count"] == 64, str(shading))
    check("s left" in result.stderr and "\033" not in result.stderr, report(result))


def test_pictures_are_kept():
    folder, _, results = two_scenes()
    leaves(folder, "a.json", "a.pictures")
    pictures = [scene["reference"] for scene in results["scenes"]] + \
        [row["picture"] for row in results["rows"] if row["picture"]]
    check(len(set(pictures)) == 2 * (1 + len(FILTERS)), str(pictures))
    leaves(folder / "a.pictures", *[name.removeprefix("a.pictures/") for name in pictures])
    for row in results["rows"]:
        check((row["picture"] is not None) == (row["varied"] == ""), str(row["varied"]))
        if row["picture"]:
            header = exr_header(folder / row["picture"])
            check(header["filter"] == row["filter"] and header["scene"] == row["scene"],
                  str(header))
            check(header["channels"]["R"] == "half", str(header))
    check(exr_header(folder / pictures[0])["samples"] == 4, "the reference's samples")


def test_pictures_may_go_elsewhere():
    folder = fresh_folder("elsewhere")
    (folder / "results").mkdir()
    succeeds("bench", *QUICK, "checkerboard", "--filters", "direct", "--json",
             folder / "results" / "a.json", "--pictures", folder / "shown")
    results = json.loads((folder / "results" / "a.json").read_text())
    check(results["rows"][0]["picture"] == "../shown/checkerboard-direct.exr", str(results))
    leaves(folder / "shown", "checkerboard-direct.exr", "checkerboard.exr")
    leaves(folder / "results", "a.json")


def test_scenes_that_do_not_open_are_skipped():
    folder = fresh_folder("skipped")
    result, results = sweep(folder, "nosuch.gltf", "checkerboard", "--filters", "direct")
    check("warning: nosuch.gltf: skipped" in result.stderr, report(result))
    check("skipped" in result.stdout, report(result))
    skipped, measured = results["scenes"]
    check("nosuch.gltf" in skipped["skipped"] and measured["skipped"] is None, str(skipped))
    check({row["scene"] for row in results["rows"]} == {"checkerboard"}, "rows")
    check(results["complete"] is True, "complete")


def test_a_sweep_of_nothing_fails():
    folder = fresh_folder("nothing")
    result = fails("bench", *QUICK, "bunny", "--json", folder / "a.json", LOBE_ASSETS="",
                   says="no scene could be measured")
    check("warning: bunny: skipped" in result.stderr, report(result))
    results = json.loads((folder / "a.json").read_text())
    check("assets" in results["scenes"][0]["skipped"], str(results))


def test_tables_are_made_from_json():
    # tools/targets, which fills README.md and docs/measured.md, reads what the program wrote.
    folder, _, results = two_scenes()
    result = subprocess.run([sys.executable, ROOT / "tools/targets", "--json", folder / "a.json"],
                            capture_output=True, text=True, check=False)
    check(result.returncode == 0, result.stderr)
    check("| error(lobes) / error(direct) | – | – |" in result.stdout, result.stdout)
    check(result.stdout.count("\n| bumps |") == 5, result.stdout)
    check(re.search(r"^\| `direct` \| \d\.\d{3} \| 1\.0 \| 1\.0 \| \d+ \|$", result.stdout,
                    re.MULTILINE), result.stdout)
    noise = next(scene["noise"] for scene in results["scenes"] if scene["name"] == "bumps")
    errors = [math.sqrt(max(row["error"]["relative_l2"] ** 2 - noise ** 2, 0))
              for row in results["rows"] if row["scene"] == "bumps" and row["varied"] == ""]
    check("| bumps | " + " | ".join(f"{error:.3f}" for error in errors) + " |" in result.stdout,
          result.stdout)


# Environments -------------------------------------------------------------------------------

LIT = ["--filters", "direct", "--no-lights", "--set", "env_size=16", "--stations", "1"]


def write_hdr(path, texel):
    """A Radiance picture of one colour with a brighter texel, uncompressed."""
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" +
                     bytes(texel) * 8 + bytes([*texel[:3], 132]) + bytes(texel) * 23)
    return path


def scene_of(results, name):
    return next(scene for scene in results["scenes"] if scene["name"] == name)


def rows_of(results, name):
    return [row for row in results["rows"] if row["scene"] == name]


_lit = []


def lit():
    """A scene in two environments and in none; the folder, the environments and the results."""
    if not _lit:
        folder = fresh_folder("lit")
        maps = [write_hdr(folder / f"{name}.hdr", texel)
                for name, texel in (("warm", (200, 128, 90, 128)), ("cool", (90, 128, 200, 128)))]
        _, results = sweep(folder, "bumps", *LIT, "--environment", maps[0], "--environment",
                           maps[1], "--environment", "none", "--knobs", "env,env_grid")
        _lit.extend([folder, maps, results])
    return _lit


def test_every_scene_is_measured_in_every_environment():
    _, maps, results = lit()
    check([scene["name"] for scene in results["scenes"]] ==
          ["bumps in warm", "bumps in cool", "bumps"], str(results["scenes"]))
    for scene, environment in zip(results["scenes"], [*map(str, maps), None], strict=True):
        check((scene["scene"], scene["environment"], scene["lighting"]) ==
              ("bumps", environment, "no lights"), str(scene))
        # Without any light there is nothing to be relative to.
        check((scene["noise"] is None) == (environment is None), str(scene))
        if environment:
            check(0 < scene["noise"] < 1, str(scene))
    check(results["complete"] is True, "complete")


def test_methods_are_gone_through_where_there_is_an_environment():
    *_, results = lit()
    knobs = ("env", "env_grid", "env_size")
    for name in ("bumps in warm", "bumps in cool"):
        shown = [(row["varied"], *(settings_of(row)[knob] for knob in knobs))
                 for row in rows_of(results, name)]
        check(shown == [("", "prefiltered", "5", "16"), ("env", "mip", "5", "16"),
                        ("env", "sampled", "5", "16"), ("env_grid", "sampled", "3", "16"),
                        ("env_grid", "sampled", "7", "16")], str(shown))
    check([row["varied"] for row in rows_of(results, "bumps")] == [""], "rows without environment")


def test_preparing_an_environment_is_building():
    *_, results = lit()
    row = rows_of(results, "bumps in warm")[0]
    passes = {one["name"]: one["building"] for one in row["passes"]}
    check(passes["environment_cube"] and passes["environment_prefiltering"], str(passes))
    check(not passes["shading"], str(row))
    # The environment is prepared once: frames that build maps of materials do not pay for it.
    once = [one for one in row["passes"] if one["once"]]
    check({"environment_cube", "irradiance_harmonics"} <= {one["name"] for one in once}, str(once))
    # What rough metal reflects is tabulated once for all frames, and `direct` builds nothing else.
    check(not [one for one in row["passes"] if one["building"] and not one["once"]], str(row))
    check(row["building_ms"] == 0, str(row))
    total = sum(one["milliseconds"] for one in once)
    check(total > 0 and abs(row["environment_ms"] - total) < 1e-3 * total, str(row))
    check(all(not one["name"].startswith("environment") for one in
              rows_of(results, "bumps")[0]["passes"]), "without environment")


def test_environments_differ_and_so_do_their_pictures():
    folder, _, results = lit()
    names = [scene["reference"] for scene in results["scenes"]]
    check(len(set(names)) == 3, str(names))
    check(exr_header(folder / names[0])["samples"] == 4, "samples of both halves")
    errors = {row["error"]["relative_l2"] for row in results["rows"]}
    check(len(errors) > 6, str(errors))


def test_resuming_knows_environments():
    folder, maps, results = lit()
    arguments = ["bumps", *LIT, "--knobs", "env,env_grid", "--json", folder / "a.json", "--resume"]
    result = succeeds("bench", *QUICK, *arguments, "--environment", maps[1])
    check("reference" not in result.stderr, report(result))
    check(json.loads((folder / "a.json").read_text())["rows"] == results["rows"], "rows changed")
    fails("bench", *QUICK, *arguments, "--environment", maps[0], "--environment-intensity", "2",
          says=["'bumps in warm' was measured in", "no lights, intensity 2", "--resume"])
    (folder / "other").mkdir(exist_ok=True)
    other = write_hdr(folder / "other/warm.hdr", (9, 9, 9, 128))
    fails("bench", *QUICK, *arguments, "--environment", other, says=["warm.hdr", "--resume"])
    fails("bench", *QUICK, *arguments, "--environment", maps[0], "--environment", other,
          says=["would both be called 'bumps in warm'"])


def picked(folder, *arguments):
    return lobe("render", "bumps", "--size", "64x36", "--sweep", folder / "a.json", "--error", "9",
                *arguments, "-o", folder / "a.exr")


def test_a_choice_goes_by_the_environment():
    folder, maps, results = lit()
    result = picked(folder, "--no-lights", "--environment", maps[1])
    check(result.returncode == 0 and "of 5 choices" in result.stdout, report(result))
    fastest = min(rows_of(results, "bumps in cool"), key=lambda row: row["rebuilt_ms"])
    header = exr_header(folder / "a.exr")
    check(header["knob.env"] == settings_of(fastest)["env"], report(result))
    result = picked(folder, "--no-lights")
    check(result.returncode == 0 and "1 of 1 choices" in result.stdout, report(result))
    for light in (["--no-lights", "--environment", "sky"], ["--environment", maps[1]]):
        result = picked(folder, *light)
        check(result.returncode == 1 and "in environment" in result.stderr, report(result))
        check("contains measurements of bumps in warm, bumps in cool, bumps" in result.stderr,
              report(result))


# Stopping and going on ----------------------------------------------------------------------

def start(*arguments):
    environment = {**os.environ, "XDG_CACHE_HOME": str(FOLDER / "cache")}
    return subprocess.Popen([PROGRAM, "bench", *QUICK, *map(str, arguments)], cwd=FOLDER,
                            env=environment, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, errors="replace")


def interrupt_at(words, *arguments):
    """Sends Ctrl-C when a line with these words appears. Returns all of standard error."""
    with start(*arguments) as process:
        said = []
        for line in process.stderr:
            said.append(line)
            if words in line:
                process.send_signal(signal.SIGINT)
                break
        said.append(process.communicate(timeout=120)[1])
        check(process.returncode == 1, f"status {process.returncode}: {said}")
    return "".join(said)


def test_interrupted_and_resumed_equals_undisturbed():
    *_, whole = two_scenes()
    folder = fresh_folder("resumed")
    arguments = ["bumps", "checkerboard", "--frames", "3", "--json", folder / "a.json"]
    said = interrupt_at("checkerboard: error", *arguments)
    check("has 1 of 2 scenes, continue with --resume" in said and "error:" not in said, said)
    results = json.loads((folder / "a.json").read_text())
    check(results["complete"] is False, "complete")
    check({row["scene"] for row in results["rows"]} == {"bumps"}, "rows")
    leaves(folder, "a.json", "a.pictures")
    first = results["rows"]
    result = succeeds("bench", *QUICK, *arguments, "--resume")
    check("bumps:" not in result.stderr, report(result))
    results = json.loads((folder / "a.json").read_text())
    check(results["complete"] is True, "complete")
    check(results["rows"][:len(first)] == first, "the rows that were there changed")
    check([without_times(row) for row in results["rows"]] ==
          [without_times(row) for row in whole["rows"]], "other rows than those of one sweep")


def test_interrupted_in_the_first_scene():
    folder = fresh_folder("first")
    said = interrupt_at("bumps: reference", "bumps", "--json", folder / "a.json")
    check("has 0 of 1 scenes" in said, said)
    results = json.loads((folder / "a.json").read_text())
    check(results["complete"] is False and results["rows"] == [], str(results))


def test_resuming_measures_more_scenes_and_skipped_ones():
    folder = fresh_folder("more")
    (folder / "scene").mkdir()
    path = folder / "scene" / "a.gltf"
    options = ["--filters", "direct", "--environment", "none"]
    _, results = sweep(folder, path, "checkerboard", *options)
    check({row["scene"] for row in results["rows"]} == {"checkerboard"}, "rows")
    path.write_text(json.dumps(gltf_triangle()), encoding="utf-8")
    result, results = sweep(folder, path, "checkerboard", *options, "--resume")
    check("checkerboard: reference" not in result.stderr, report(result))
    check({row["scene"] for row in results["rows"]} == {str(path), "checkerboard"},
          str(results["rows"]))
    check(all(scene["skipped"] is None for scene in results["scenes"]), str(results["scenes"]))


def test_resuming_refuses_other_measurements():
    folder = fresh_folder("other")
    shutil.copy(two_scenes()[0] / "a.json", folder / "a.json")
    before = (folder / "a.json").read_bytes()
    for option, value, words in [("--size", "32x36", "size 64x36, now it is 32x36"),
                                 ("--samples", "5", "samples 4, now it is 5"),
                                 ("--frames", "7", "frames 3, now it is 7"),
                                 ("--stations", "3", "stations 2, now it is 3"),
                                 ("--path-samples", "3", "path samples 2, now it is 3")]:
        options = [*QUICK, "--frames", "3", option, value]
        fails("bench", *options, "bumps", "--json", folder / "a.json", "--resume",
              says=["a.json", words, "--resume"])
    results = json.loads(before)
    results["driver"] = "another"
    (folder / "a.json").write_text(json.dumps(results))
    before = (folder / "a.json").read_bytes()
    fails("bench", *QUICK, "--frames", "3", "bumps", "--json", folder / "a.json", "--resume",
          says=["driver another"])
    check((folder / "a.json").read_bytes() == before, "the file was changed")
    leaves(folder, "a.json")


def test_resuming_from_a_broken_file_is_refused():
    folder = fresh_folder("broken")
    (folder / "a.json").write_text('{"version": "0.1')
    fails("bench", *QUICK, "bumps", "--json", folder / "a.json", "--resume",
          says="a.json: not JSON")
    leaves(folder, "a.json")


# Usage --------------------------------------------------------------------------------------

def test_options_that_do_not_go_together():
    is_wrong_usage("bench", "bumps", "--sweep", says="--sweep needs --json")
    is_wrong_usage("bench", "bumps", "--sweep", "--json", "a.json", "--set", "probes=2",
                   says="--sweep sets that knob itself")
    is_wrong_usage("bench", "bumps", "--sweep", "--json", "a.json", "--knobs", "env,odd",
                   says="no filter has a knob 'odd'")
    is_wrong_usage("bench", "bumps", "--environment", "sky", "--environment", "none",
                   says="--environment: more than one needs --sweep")
    for option in (["--resume"], ["--knobs", "env"], ["--pictures", "x"], ["--stations", "2"],
                   ["--path-samples", "2"]):
        is_wrong_usage("bench", "bumps", *option, says=f"{option[0]} needs --sweep")
    is_wrong_usage("bench", "bumps", "--sweep", "--json", "a.json", "--stations", "0",
                   says="--stations")
    is_wrong_usage("bench", "bumps", "--sweep", "--json", "a.json", "--path-samples", "0",
                   says="--path-samples")


def test_a_folder_for_pictures_that_cannot_be():
    folder = fresh_folder("no_pictures")
    (folder / "a.pictures").write_text("a file")
    result = lobe("bench", *QUICK, "bumps", "--json", folder / "a.json")
    check(result.returncode == 1 and "a.pictures" in result.stderr, report(result))
    leaves(folder, "a.pictures")


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_results_have_their_form, test_each_knob_is_varied_alone, test_times_come_apart,
        test_bytes_are_those_of_the_maps, test_the_reference_has_one_row_without_flicker,
        test_pictures_are_kept, test_pictures_may_go_elsewhere,
        test_scenes_that_do_not_open_are_skipped, test_a_sweep_of_nothing_fails,
        test_tables_are_made_from_json, test_interrupted_in_the_first_scene,
        test_resuming_measures_more_scenes_and_skipped_ones,
        test_resuming_refuses_other_measurements, test_resuming_from_a_broken_file_is_refused,
        test_options_that_do_not_go_together, test_a_folder_for_pictures_that_cannot_be),
        long=[test_interrupted_and_resumed_equals_undisturbed]))
