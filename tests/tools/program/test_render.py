"""What `lobe render` writes and prints."""

import json
import sys

import tap
from files import exr_header, gltf_triangle, gltf_write, png_read, png_write
from program import (FOLDER, SCENE, SMALL, check, fails, fresh_folder, leaves, report,
                     said_to_terminal, succeeds)

DIRECT = ["--filter", "direct", *SMALL]
SMALL_SKY = ["--set", "env_size=16"]  # prepared faster


def compare(test, reference):
    """The metrics of `lobe compare`, by name."""
    lines = succeeds("compare", test, reference).stdout.splitlines()
    return {name: float(value) for name, value in (line.split() for line in lines)}


def is_lit(path):
    return len(set(png_read(path)[2])) > 1


def mean(path):
    pixels = png_read(path)[2]
    return sum(map(sum, pixels)) / len(pixels)


def test_fitted_mixtures_are_kept():
    folder = fresh_folder("mixtures")
    user = fresh_folder("mixtures-user")

    def draw(name, *arguments, found):
        result = succeeds("render", SCENE, "--filter", "mixture", *SMALL, *arguments, "-o",
                          folder / name, XDG_CACHE_HOME=user)
        check(("map_restoring" in result.stdout) == found, report(result))
        check(("mixture_level" in result.stdout) != found, report(result))
        return result

    draw("plain.png", "--no-cache", found=False)
    check(not (user / "lobe/mixtures").exists(), "a folder was made without a cache")
    draw("first.png", found=False)
    kept = list((user / "lobe" / "mixtures").iterdir())
    check(kept and all(path.suffix == ".mixture" for path in kept), f"{kept}")
    draw("second.png", found=True)
    whole = kept[0].read_bytes()
    kept[0].write_bytes(whole[:-100])
    result = succeeds("render", SCENE, "--filter", "mixture", *SMALL, "--cache", kept[0].parent,
                      "-o", folder / "rebuilt.png")
    check("will be replaced" in result.stderr, report(result))
    check(kept[0].read_bytes() == whole, "the damaged file was not replaced")
    names = ("plain.png", "first.png", "second.png", "rebuilt.png")
    pictures = [png_read(folder / name) for name in names]
    check(all(picture == pictures[0] for picture in pictures), "pictures differ")


def test_both_outputs_at_once():
    folder = fresh_folder("both")
    result = succeeds("render", SCENE, *DIRECT, "-o", folder / "a.exr", "-o", folder / "a.png")
    leaves(folder, "a.exr", "a.png")
    check("shading" in result.stdout and "whole frame" in result.stdout, report(result))
    width, height, pixels = png_read(folder / "a.png")
    check((width, height) == (32, 24) and len(set(pixels)) > 1, f"{width}x{height}")
    header = exr_header(folder / "a.exr")
    check(header["dataWindow"] == (0, 0, 31, 23), str(header))
    check(header["channels"] == {name: "half" for name in "ABGR"}, str(header))
    check(header["compression"] in (b"\2", b"\3"), "not ZIP")
    check("chromaticities" in header, "no chromaticities")


def test_metadata():
    folder = fresh_folder("metadata")
    succeeds("render", "tablecloth", *SMALL, "--set", "curvature=0.5", "--set", "probes=2",
             "--set", "storage=float16", "-o", folder / "a.exr")
    header = exr_header(folder / "a.exr")
    expected = {"scene": "tablecloth", "filter": "moments", "samples": 1, "knob.curvature": 0.5,
                "knob.probes": 2, "knob.storage": "float16", "knob.view": "radiance",
                "lobeVersion": succeeds("--version").stdout.split()[1]}
    for name, value in expected.items():
        check(header.get(name) == value, f"{name}: {header.get(name)}, not {value}")
    knobs = [name for name in header if name.startswith("knob.")]
    listed = succeeds("filters").stdout.split("\nmoments: ")[1].split("\n\n")[0]
    check(all(name[5:] in listed for name in knobs) and len(knobs) >= 10, str(knobs))
    device = succeeds("info").stdout.split("Device in use:")[1]
    check(header["device"] in device and header["driver"] in device, str(header))
    check(header["milliseconds"] > 0 and header["milliseconds.shading"] > 0, str(header))


def test_samples_are_recorded():
    folder = fresh_folder("samples")
    result = succeeds("render", SCENE, "--filter", "reference", "--samples", "5", *SMALL, "-o",
                      folder / "a.exr")
    check(exr_header(folder / "a.exr")["samples"] == 5, "samples")
    check("5 samples" in result.stdout, report(result))


def test_depth():
    folder = fresh_folder("depth")
    succeeds("render", SCENE, *DIRECT, "--depth", "float", "-o", folder / "float.exr")
    succeeds("render", SCENE, *DIRECT, "--depth", "half", "-o", folder / "half.exr")
    check(exr_header(folder / "float.exr")["channels"]["R"] == "float", "float")
    check(exr_header(folder / "half.exr")["channels"]["R"] == "half", "half")
    error = compare(folder / "half.exr", folder / "float.exr")["relative_l2"]
    check(0 < error < 2**-11, f"half differs from float by {error}")


def test_layers():
    folder = fresh_folder("layers")
    succeeds("render", SCENE, *DIRECT, "--aov", "-o", folder / "a.exr")
    channels = exr_header(folder / "a.exr")["channels"]
    layers = ["normal.X", "normal.Y", "normal.Z", "depth.Z", "lobes.count", "level.MIP"]
    check(sorted(channels) == sorted(["R", "G", "B", "A", *layers]), str(channels))
    check(all(channels[name] == "float" for name in layers), str(channels))


def test_errors_along_silhouettes():
    folder = fresh_folder("silhouettes")
    png_write(folder / "paint_albedo.png", 8, 8, (200, 40, 40))
    ball = ["--material", folder, "--carrier", "sphere", "--size", "48x48", "--light",
            "point:0,2,1:20,20,20"]
    succeeds("render", *ball, "--filter", "direct", "-o", folder / "a.exr")
    succeeds("render", *ball, "--filter", "reference", "--aov", "-o", folder / "b.exr")

    def measure(*options):
        return json.loads(succeeds("compare", folder / "a.exr", folder / "b.exr", "--json",
                                   *options).stdout)

    whole = measure()
    inside, along = measure("--part", "inside"), measure("--part", "silhouettes")
    check("part" not in whole and inside["part"] == "inside", str(inside))
    check(100 < along["pixels"] < inside["pixels"] < 48 * 48 - along["pixels"], str(along))
    # One sample is wrong where the ball ends, and the background is equal.
    check(along["relative_l2"] > 4 * inside["relative_l2"], f"{along} {inside}")
    squares = sum(part["rmse"]**2 * part["pixels"] for part in (inside, along))
    check(abs(squares / (whole["rmse"]**2 * 48 * 48) - 1) < 1e-6, f"{squares} {whole}")
    result = fails("compare", folder / "b.exr", folder / "a.exr", "--part", "inside")
    check("a.exr: --part needs the reference's depth" in result.stderr, report(result))


def test_motion():
    folder = fresh_folder("motion")
    succeeds("render", "tablecloth", *SMALL, "--path", "0.7", "--motion", "0.65", "-o",
             folder / "a.exr")
    channels = exr_header(folder / "a.exr")["channels"]
    check(sorted(channels) == sorted(["R", "G", "B", "A", "motion.X", "motion.Y"]), str(channels))
    check(channels["motion.X"] == "float", str(channels))
    succeeds("render", "tablecloth", *SMALL, "--path", "0.7", "-o", folder / "b.exr")
    check(compare(folder / "a.exr", folder / "b.exr")["rmse"] == 0, "motion changes the picture")


def test_frames_keep_their_maps():
    folder = fresh_folder("frames")
    succeeds("render", "tablecloth", *SMALL, "-o", folder / "one.exr")
    result = succeeds("render", "tablecloth", *SMALL, "--frames", "3", "-o", folder / "three.exr",
                      "--graph", folder / "three.txt")
    later = {line.split()[0]: line.split()[-2:] for line in result.stdout.splitlines()[2:]}
    check(later["moment_binning"] == ["0", "-"] and later["shading"][0] == "2", report(result))
    timing = [exr_header(folder / name)["timing"] for name in ("one.exr", "three.exr")]
    check("first" in timing[0] and "later" in timing[1], str(timing))
    check(compare(folder / "three.exr", folder / "one.exr")["rmse"] == 0, "frames differ")
    check("skipped" in (folder / "three.txt").read_text(), "no pass was skipped")


def test_time_and_ranges_of_frames():
    folder = fresh_folder("time")
    cloth = ["render", "cloth", *DIRECT]
    succeeds(*cloth, "--frames", "14..15", "--time", "0.1",
             "-o", folder / "cloth.exr", "-o", folder / "cloth.png")
    leaves(folder, "cloth-0014.exr", "cloth-0014.png", "cloth-0015.exr", "cloth-0015.png")
    seconds = [float(exr_header(folder / f"cloth-{n:04}.exr")["seconds"]) for n in (14, 15)]
    check(abs(seconds[0] - 0.1 - 14 / 30) < 1e-6 and abs(seconds[1] - 0.6) < 1e-6, str(seconds))
    succeeds(*cloth, "--time", "0.6", "-o", folder / "one.exr")
    check(compare(folder / "one.exr", folder / "cloth-0015.exr")["rmse"] == 0, "another picture")
    check(compare(folder / "one.exr", folder / "cloth-0014.exr")["rmse"] > 0, "time stands still")
    result = succeeds("render", SCENE, *DIRECT, "--time", "2", "-o", folder / "still.exr")
    check("does not change with time: --time makes no" in result.stderr, report(result))
    check("seconds" not in exr_header(folder / "still.exr"), "a time of what stands still")


def test_ranges_are_checked_before_they_are_drawn():
    folder = fresh_folder("ranges")
    (folder / "taken.png").mkdir()
    succeeds("render", SCENE, *DIRECT, "--frames", "8..9", "-o", folder / "taken.png")
    (folder / "late-0009.png").mkdir()
    fails("render", SCENE, *DIRECT, "--frames", "8..9", "-o", folder / "late.png",
          says="late-0009.png")
    leaves(folder, "late-0009.png", "taken-0008.png", "taken-0009.png", "taken.png")
    fails("render", "cloth", *SMALL, "--frames", "3000..3000", "--time", "3600",
          "-o", folder / "far.png",
          says="the last frame is at 3700.0 s; expected at most 3600 s")


def test_graph():
    folder = fresh_folder("graph")
    for name in ("a.dot", "a.txt"):
        succeeds("render", SCENE, *DIRECT, "-o", folder / "a.png", "--graph", folder / name)
    leaves(folder, "a.dot", "a.png", "a.txt")
    check((folder / "a.dot").read_text().startswith("digraph"), "no Graphviz")
    text = (folder / "a.txt").read_text()
    check("shading" in text and not text.startswith("digraph"), text)


def test_views_are_heat_maps():
    folder = fresh_folder("views")
    pictures = set()
    for view in ("radiance", "lobes", "level"):
        path = folder / f"{view}.png"
        succeeds("render", "tablecloth", *SMALL, "--set", f"view={view}", "-o", path)
        pictures.add(tuple(png_read(path)[2]))
    check(len(pictures) == 3, "views look alike")


def test_lights():
    folder = fresh_folder("lights")
    dark, lamp, sun = (folder / name for name in ("dark.png", "lamp.png", "sun.png"))
    succeeds("render", "bumps", *DIRECT, "--light", "directional:0,-1,0:0,0,0", "-o", dark)
    succeeds("render", "bumps", *DIRECT, "--light", "point:0,1,0:9,9,9", "-o", lamp)
    succeeds("render", "bumps", *DIRECT, "--light", "directional:0,-1,-1:3,3,3", "-o", sun)
    check(set(png_read(dark)[2]) == {(0, 0, 0)}, "light without intensity lights")
    check(is_lit(lamp) and is_lit(sun) and png_read(lamp) != png_read(sun), "lights look alike")


def test_lights_add_up():
    folder = fresh_folder("sum")
    lights = ["--light", "point:0,1,0:9,9,9", "--light", "directional:0,-1,-1:1,2,3"]
    twice = [lights[0], "point:0,1,0:18,18,18", lights[2], "directional:0,-1,-1:2,4,6"]
    floats = [*DIRECT, "--depth", "float", "-o"]
    succeeds("render", "bumps", *lights, *lights, *floats, folder / "four.exr")
    succeeds("render", "bumps", *twice, *floats, folder / "two.exr")
    error = compare(folder / "four.exr", folder / "two.exr")["relative_l2"]
    check(error < 1e-6, f"lights do not add up: {error}")


def test_camera():
    folder = fresh_folder("camera")
    camera = ["--eye", "0,2,2", "--target", "0,0,0"]
    for name, options in {"scene": [], "moved": camera, "again": camera,
                          "wide": [*camera, "--fov", "80"], "path": [*camera, "--path", "0.25"],
                          "away": ["--eye", "0,16,16", "--target", "0,0,0"]}.items():
        succeeds("render", SCENE, *DIRECT, *options, "-o", folder / f"{name}.exr")
    check(compare(folder / "again.exr", folder / "moved.exr")["rmse"] == 0, "not reproducible")
    check(compare(folder / "moved.exr", folder / "scene.exr")["rmse"] > 0, "the eye does nothing")
    check(compare(folder / "wide.exr", folder / "moved.exr")["rmse"] > 0, "--fov does nothing")
    error = compare(folder / "path.exr", folder / "away.exr")["relative_l2"]
    check(error < 1e-4, f"--path 0.25 is not 8 times as far: {error}")


def test_exposure():
    folder = fresh_folder("exposure")
    means = []
    for stops in ("-1", "0", "1"):
        succeeds("render", SCENE, *DIRECT, "--exposure", stops, "-o", folder / "a.png")
        means.append(mean(folder / "a.png"))
    check(means[0] < means[1] < means[2], str(means))


def test_options_that_do_nothing_are_told():
    folder = fresh_folder("ignored")
    for options, output in ((["--aov"], "a.png"), (["--motion", "0"], "a.png"),
                            (["--depth", "float"], "a.png"),
                            (["--exposure", "1"], "a.exr"), (["--samples", "4"], "a.exr")):
        result = succeeds("render", SCENE, *DIRECT, *options, "-o", folder / output)
        check(result.stderr.count("\n") == 1 and f"warning: {options[0]}" in result.stderr,
              report(result))


def test_quiet_where_there_is_nothing_to_say():
    folder = fresh_folder("quiet")
    result = succeeds("render", SCENE, *DIRECT, "-o", folder / "a.exr", "-o", folder / "a.png")
    check(result.stderr == "", report(result))


def test_progress_on_a_terminal():
    shown = said_to_terminal("render", SCENE, "--filter", "reference", *SMALL, "-o", "a.png")
    check("frame 1 of 1: 50 %" in shown and "frame 1 of 1: 100 %" in shown, repr(shown))
    check(shown.endswith("\r\033[K"), repr(shown))


def test_device_from_the_environment():
    succeeds("render", SCENE, *DIRECT, "-o", "a.png", LOBE_DEVICE="llvmpipe")
    succeeds("render", SCENE, *DIRECT, "-o", "a.png", "--device", "LLVM", LOBE_DEVICE="abacus")


def test_validation_is_silent():
    for filter_name in ("direct", "lobes"):
        result = succeeds("render", "tablecloth", "--filter", filter_name, *SMALL, "--validation",
                          "--aov", "-o", "a.exr")
        check(result.stderr == "", report(result))


def test_gltf_file():
    folder = fresh_folder("gltf")
    gltf_write(folder / "a.gltf", gltf_triangle())
    result = succeeds("render", folder / "a.gltf", *DIRECT, *SMALL_SKY, "-o", folder / "a.png")
    check("camera" in result.stderr and "light" in result.stderr, report(result))
    check(is_lit(folder / "a.png"), "a dark triangle")
    leaves(folder, "a.gltf", "a.png")


def test_light_is_noted_only_where_it_is_added():
    folder = fresh_folder("note")
    gltf_write(folder / "a.gltf", gltf_triangle())
    for options, noted in (([], True), (["--light", "directional:0,-1,-1:1,1,1"], False),
                           (["--environment", "sky"], False)):
        result = succeeds("render", folder / "a.gltf", *DIRECT, *SMALL_SKY, *options, "-o",
                          folder / "a.png")
        check(("added the environment" in result.stderr) == noted, report(result))


def test_an_empty_picture_is_explained():
    folder = fresh_folder("empty")
    gltf_write(folder / "a.gltf", gltf_triangle())
    result = succeeds("render", folder / "a.gltf", *DIRECT, *SMALL_SKY, "--eye", "0,0,5",
                      "--target", "0,0,9", "-o", folder / "a.png")
    check("the picture is empty: the camera looks away" in result.stderr, report(result))
    bumps = ["render", "bumps", *DIRECT, "-o", folder / "black.png"]
    result = succeeds(*bumps, "--no-lights")
    check("bumps: the picture is black: nothing lights it" in result.stderr, report(result))
    result = succeeds(*bumps, "--light", "directional:0,1,0:1,1,1")
    check("bumps: the picture is black: no light reaches" in result.stderr, report(result))
    result = succeeds(*bumps, "--no-lights", "--set", "view=level")
    check("black" not in result.stderr, report(result))


def test_material_folder():
    folder = fresh_folder("material")
    png_write(folder / "paint_albedo.png", 8, 8, (200, 40, 40))
    png_write(folder / "paint_normal.png", 8, 8, (140, 128, 250))
    lamp = ["--light", "point:0,2,1:20,20,20"]  # prepared faster than a sky
    pictures = set()
    for carrier, light in (("plane", SMALL_SKY), ("sphere", lamp), ("cloth", lamp)):
        succeeds("render", "--material", folder, "--carrier", carrier, *DIRECT, *light, "-o",
                 folder / "out.png")
        check(is_lit(folder / "out.png"), f"a dark {carrier}")
        pictures.add(tuple(png_read(folder / "out.png")[2]))
        (folder / "out.png").unlink()
    check(len(pictures) == 3, "carriers look alike")
    succeeds("render", folder, *DIRECT, *lamp, "-o", FOLDER / "cloth.png")
    check(tuple(png_read(FOLDER / "cloth.png")[2]) in pictures, "a folder as SCENE is no cloth")


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_both_outputs_at_once, test_metadata, test_depth, test_layers,
        test_frames_keep_their_maps, test_time_and_ranges_of_frames, test_graph, test_lights,
        test_options_that_do_nothing_are_told, test_progress_on_a_terminal,
        test_device_from_the_environment, test_gltf_file, test_an_empty_picture_is_explained,
        test_material_folder), long=[test_fitted_mixtures_are_kept]))
