"""What `lobe bench` measures and writes."""

import base64
import functools
import json
import math
import struct
import sys

import tap
from files import gltf_triangle, gltf_write, png_draw
from program import FOLDER, check, fails, fresh_folder, leaves, report, succeeds

QUICK = ["--size", "48x32", "--samples", "4", "--frames", "3"]
# With every change of a map mixtures are fitted anew, to maps of built-in scenes for seconds.
BUMPY = FOLDER / "bumpy.gltf"


def write_bumpy():
    """A triangle under a sun, with a small normal map that is repeated on it."""
    png_draw(FOLDER / "bumpy.png", 32, 32,
             lambda x, y: (88 + 37 * x * y % 81, 88 + 53 * x * (y + 3) % 81, 240))
    document = gltf_triangle()
    places = base64.b64encode(struct.pack("<6f", 0, 0, 12, 0, 6, 12)).decode()
    document["buffers"].append({"byteLength": 24,
                                "uri": "data:application/octet-stream;base64," + places})
    document["bufferViews"].append({"buffer": 1, "byteLength": 24})
    document["accessors"].append({"bufferView": 2, "componentType": 5126, "count": 3,
                                  "type": "VEC2"})
    document["images"] = [{"uri": "bumpy.png"}]
    document["textures"] = [{"source": 0}]
    document["materials"] = [{"normalTexture": {"index": 0},
                              "pbrMetallicRoughness": {"roughnessFactor": 0.4}}]
    primitive = document["meshes"][0]["primitives"][0]
    primitive["attributes"]["TEXCOORD_0"] = 2
    primitive["material"] = 0
    document["extensionsUsed"] = ["KHR_lights_punctual"]
    document["extensions"] = {"KHR_lights_punctual": {
        "lights": [{"type": "directional", "intensity": 3}]}}
    document["nodes"].append({"extensions": {"KHR_lights_punctual": {"light": 0}}})
    document["scenes"][0]["nodes"].append(1)
    gltf_write(BUMPY, document)


write_bumpy()


def filters():
    """In the order of the program: all, or those that the cases name."""
    lines = succeeds("filters").stdout.splitlines()
    names = [line.split(":")[0] for line in lines if line and line[0] != " "]
    named = names if tap.long_runs() else ("direct", "lobes", "moments", "reference")
    return [name for name in names if name in named]


def is_number(value, least=0):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and \
        math.isfinite(value) and value >= least


def check_keys(thing, *names):
    check(all(name in thing for name in names), f"{sorted(thing)} lacks one of {names}")


def check_quantiles(thing, median, p95):
    check(is_number(thing[median]) and is_number(thing[p95], thing[median]), str(thing))


def check_error(error):
    check(sorted(error) == ["flip", "relative_l1", "relative_l2"], str(error))
    check(all(is_number(value) for value in error.values()), str(error))


def check_result(result):
    times = ("rebuilt_ms", "retained_ms", "changed_ms", "rebuilt_host_ms", "retained_host_ms",
             "changed_host_ms", "changed_wall_ms", "changed_caller_cpu_ms",
             "changed_process_cpu_ms")
    check_keys(result, "scene", "filter", "size", "knobs", "passes", *times,
               "memory_bytes", "bytes_per_texel", "error", "error_lobe_base")
    check(result["size"] == [48, 32], str(result["size"]))
    check(result["passes"] and result["changed_passes"], "no passes")
    for one in result["passes"] + result["changed_passes"]:
        check(sorted(one) == ["median_ms", "name", "p95_ms"], str(one))
        check_quantiles(one, "median_ms", "p95_ms")
    for name in times:
        check(sorted(result[name]) == ["median", "p95"], str(result[name]))
        check(result[name]["median"] > 0, f"{name} takes no time")
        check_quantiles(result[name], "median", "p95")
    check(is_number(result["memory_bytes"], 1), "memory")
    check(is_number(result["bytes_per_texel"]), "bytes per texel")
    check_error(result["error"])
    check_error(result["error_lobe_base"])


def measure(folder, *arguments):
    result = succeeds("bench", *arguments, "--json", folder / "a.json")
    return result, json.loads((folder / "a.json").read_text())


@functools.cache
def every_filter():
    return measure(fresh_folder("every_filter"), BUMPY, "--filters", ",".join(filters()), *QUICK)


@functools.cache
def two_scenes():
    # The base lobes of bumps are GGX; those of the tablecloth are already von Mises-Fisher lobes.
    return measure(fresh_folder("scenes"), "bumps", "tablecloth", "--filters", "direct", *QUICK)


def test_json_has_its_form():
    result, bench = every_filter()
    leaves(FOLDER / "every_filter", "a.json")
    check_keys(bench, "lobe", "device", "results")
    check(bench["lobe"] == succeeds("--version").stdout.split()[1], "version")
    check(sorted(bench["device"]) == ["driver", "name", "type"], str(bench["device"]))
    check(bench["device"]["name"] in result.stdout, report(result))
    measured = [(one["scene"], one["filter"]) for one in bench["results"]]
    check(measured == [(str(BUMPY), name) for name in filters()], str(measured))
    for one in bench["results"]:
        check_result(one)


def test_what_is_measured_makes_sense():
    _, bench = every_filter()
    results = {one["filter"]: one for one in bench["results"]}
    passes = {name: [one["name"] for one in result["passes"]] for name, result in results.items()}
    check("lobe_clustering" in passes["lobes"] and "lobe_clustering" not in passes["direct"],
          str(passes))
    retained = [one["name"] for one in results["lobes"]["retained_passes"]]
    check("shading" in retained and "lobe_clustering" not in retained, str(retained))
    check(results["direct"]["bytes_per_texel"] == 0, "direct has no maps")
    check(results["lobes"]["bytes_per_texel"] > 1, "lobes has maps")
    check(0 < results["reference"]["error"]["relative_l2"] <
          results["direct"]["error"]["relative_l2"], "the reference is nearer to the truth")


def test_changed_texels_are_paid_for():
    result, bench = every_filter()
    direct, moments = (one for one in bench["results"] if one["filter"] in ("direct", "moments"))
    check("caller's CPU" in result.stdout, report(result))
    for one in (direct, moments):
        built, changed = ([entry["name"] for entry in one[key]]
                          for key in ("passes", "changed_passes"))
        # Bins are fitted on the device only to texels that have changed.
        fits = ("moment_cell_survey", "moment_no_fit", "moment_refit")
        check(built == [name for name in changed if name not in fits],
              f"{built} is not {changed} without fits")
        check(("moment_refit" in changed) == (one is moments), str(changed))
        wall, caller, process = (one[f"changed_{name}_ms"]["median"]
                                 for name in ("wall", "caller_cpu", "process_cpu"))
        check(wall > one["changed_ms"]["median"], "the host takes no time")
        check(process > 0.9 * caller, "the caller is no part of the process")


def test_two_truths():
    _, bench = two_scenes()
    check([one["scene"] for one in bench["results"]] == ["bumps", "tablecloth"], str(bench))
    bumps, cloth = bench["results"]
    check(bumps["error"] != bumps["error_lobe_base"], "one truth, not two")
    check(cloth["error"] == cloth["error_lobe_base"], "two truths, not one")


def test_times_of_a_software_renderer_are_labelled():
    result, bench = two_scenes()
    check(bench["device"]["type"] == "CPU", str(bench["device"]))
    check("software renderer" in result.stdout, report(result))


def test_knobs_are_set_and_recorded():
    _, bench = measure(fresh_folder("knobs"), "checkerboard", "--filters", "direct,lobes", *QUICK,
                       "--set", "epsilon0=0.5", "--set", "base=lobe")
    direct, lobes = bench["results"]
    check(lobes["knobs"]["epsilon0"] == 0.5, str(lobes))
    check(lobes["knobs"]["threshold"] == "dispersion", str(lobes))
    check(lobes["memory_bytes"] > direct["memory_bytes"], "large maps take memory")
    check("epsilon0" not in direct["knobs"] and direct["knobs"]["base"] == "lobe", str(direct))
    check(direct["error"] == direct["error_lobe_base"], "both truths have base=lobe")


def test_scenes_without_assets_are_left_out():
    folder = fresh_folder("assets")
    arguments = ["--filters", "direct", *QUICK, "--json", folder / "a.json"]
    result = succeeds("bench", "bunny", "bumps", "dragon", *arguments, LOBE_ASSETS="")
    check("error: scene 'bunny': no folder of assets" in result.stderr, report(result))
    check("warning: only 1 of 3 scenes were measured" in result.stderr, report(result))
    results = json.loads((folder / "a.json").read_text())["results"]
    check([one["scene"] for one in results] == ["bumps"], str(results))
    nothing = fresh_folder("nothing")
    fails("bench", "bunny", *arguments[:-1], nothing / "a.json", LOBE_ASSETS="", says="bunny")
    fails("bench", "dragon", "--assets", nothing, *arguments[:-1], nothing / "a.json",
          says=["dragon", str(nothing), "--assets DIR"])
    leaves(nothing)


def test_progress_goes_to_standard_error():
    result, _ = two_scenes()
    check("reference" in result.stderr and "times of 3 frames" in result.stderr, report(result))
    check("\033" not in result.stderr + result.stdout, "control characters outside a terminal")


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_json_has_its_form, test_what_is_measured_makes_sense,
        test_changed_texels_are_paid_for, test_scenes_without_assets_are_left_out)))
