"""The options that light a scene by an environment."""

import json
import re
import sys

import tap
from files import exr_header, gltf_triangle, gltf_write, png_read, png_write
from program import (SCENE, SMALL, check, fails, fresh_folder, is_wrong_usage, leaves, report,
                     said_to_terminal, succeeds)

DIRECT = ["--filter", "direct", "--set", "env_size=16", *SMALL]


def write_hdr(path, width=8, height=4, texel=(128, 128, 128, 129)):
    """A Radiance picture of one colour, uncompressed."""
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" +
                     f"-Y {height} +X {width}\n".encode() + bytes(texel) * (width * height))
    return path


def environment_of(path):
    return exr_header(path).get("environment")


def test_file_and_none():
    folder = fresh_folder("environment")
    light = write_hdr(folder / "light.hdr")
    for given, expected in ((light, str(light)), ("none", None)):
        result = succeeds("render", SCENE, *DIRECT, "--environment", given, "-o",
                          folder / "a.exr")
        check(environment_of(folder / "a.exr") == expected, report(result))
        check("warning" not in result.stderr, report(result))


def test_a_scene_may_be_lit_by_its_environment_alone():
    folder = fresh_folder("alone")
    light = write_hdr(folder / "light.hdr")
    dark = write_hdr(folder / "dark.hdr", texel=(0, 0, 0, 0))
    pictures = {}
    for name, options in (("both", ["--environment", light]), ("own", ["--environment", dark]),
                          ("alone", ["--environment", light, "--no-lights"]),
                          ("none", ["--environment", dark, "--no-lights"])):
        succeeds("render", SCENE, *DIRECT, *options, "-o",
                 folder / f"{name}.exr", "-o", folder / f"{name}.png")
        pictures[name] = sum(map(sum, png_read(folder / f"{name}.png")[2]))
    check(pictures["none"] < pictures["alone"] < pictures["both"], str(pictures))
    check(pictures["none"] < pictures["own"] < pictures["both"], str(pictures))


def test_a_scene_without_light_gets_no_other_beside():
    folder = fresh_folder("unlit")
    scene = folder / "unlit.gltf"
    gltf_write(scene, gltf_triangle())
    result = succeeds("render", scene, *DIRECT, "--environment", "sky", "--background",
                      "--environment-rotation", "-90", "--environment-intensity", "0.5", "-o",
                      folder / "a.exr")
    check(environment_of(folder / "a.exr") == "sky", report(result))
    check("warning" not in result.stderr, report(result))


def test_options_without_an_environment_are_ignored_with_a_warning():
    folder = fresh_folder("ignored")
    result = succeeds("render", SCENE, *DIRECT, "--background", "--environment-intensity", "2",
                      "-o", folder / "a.exr")
    check("no environment; --environment-intensity is ignored" in result.stderr, report(result))
    check(result.stderr.count("\n") == 1, report(result))


def test_limits_with_an_environment_are_warned_of_where_there_is_one():
    folder = fresh_folder("limits")
    light = write_hdr(folder / "light.hdr")
    for given, expected in ((light, 1), ("none", 0)):
        result = succeeds("render", "bumps", *DIRECT, "--filter", "leadr", "--environment", given,
                          "-o", folder / "a.exr")
        check(result.stderr.count("env=sampled") == expected, report(result))


def test_what_is_no_environment():
    folder = fresh_folder("wrong")
    output = ["-o", folder / "a.exr"]
    fails("render", SCENE, *DIRECT, "--environment", folder / "no.hdr", *output, says="no.hdr")
    tall = write_hdr(folder / "tall.hdr", width=3, height=7)
    fails("render", SCENE, *DIRECT, "--environment", tall, *output, says=["tall.hdr", "3 x 7"])
    tall.unlink()
    leaves(folder)
    for option, value in (("rotation", "left"), ("rotation", "1e9"), ("intensity", "-1")):
        is_wrong_usage("render", SCENE, f"--environment-{option}", value, *output,
                       says=f"--environment-{option}")


def test_preparing_light_shows_its_progress():
    """On a terminal alone; the picture is the same."""
    folder = fresh_folder("progress")
    options = ["render", SCENE, *DIRECT, "--environment", "sky", "--no-cache", "-o"]
    said = said_to_terminal(*options, folder / "shown.exr")
    parts = [int(part) for part in re.findall(rf"{SCENE}: preparing sky: (\d+) %", said)]
    check(len(parts) > 3 and parts == sorted(parts) and parts[-1] == 100, said)
    check(said.rstrip().endswith("frame 1 of 1\x1b[K\r\x1b[K"), repr(said))
    result = succeeds(*options, folder / "silent.exr")
    check("preparing" not in result.stderr, report(result))
    error = json.loads(succeeds("compare", folder / "shown.exr", folder / "silent.exr",
                                "--json").stdout)
    check(error["rmse"] == 0, error)


def test_filtered_light_is_kept_for_the_next_time():
    """The renderer uses what `lobe environment` has cached, and adds the same files itself."""
    folder = fresh_folder("kept")
    user = fresh_folder("kept-user")
    light = write_hdr(folder / "light.hdr", 32, 16, (90, 200, 150, 129))

    def draw(name, *arguments, found, **environment):
        result = succeeds("render", SCENE, *DIRECT, "--set", "env_size=16", "--set", "base=lobe",
                          "--environment", light, *arguments, "-o", folder / name, **environment)
        check(("environment_restoring" in result.stdout) == found, report(result))
        check(("environment_prefiltering" in result.stdout) != found, report(result))
        return result

    draw("plain.png", "--no-cache", found=False)
    succeeds("environment", light, "--face", "16", XDG_CACHE_HOME=user)
    draw("found.png", XDG_CACHE_HOME=user, found=True)
    kept = list((user / "lobe" / "environments").iterdir())
    check(len(kept) == 1, f"{kept}")
    whole = kept[0].read_bytes()
    kept[0].write_bytes(whole[:-100])
    result = draw("rebuilt.png", "--cache", kept[0].parent, found=False)
    check("will be replaced" in result.stderr, report(result))
    check(kept[0].read_bytes() == whole, "the damaged file was not replaced")
    pictures = [png_read(folder / name) for name in ("plain.png", "found.png", "rebuilt.png")]
    check(pictures[0] == pictures[1] == pictures[2], "pictures differ")


def test_what_needs_no_filtered_light_keeps_none():
    folder = fresh_folder("unlit-cache")
    cache = fresh_folder("unlit-user")
    succeeds("render", SCENE, *DIRECT, "-o", folder / "a.exr", XDG_CACHE_HOME=cache)
    check(not (cache / "lobe/environments").exists(), "a folder was made without an environment")
    is_wrong_usage("render", SCENE, "--no-cache", "--cache", "a", "-o", "a.exr", says="--cache")


def test_a_material_is_lit_too():
    folder = fresh_folder("material")
    maps = folder / "maps"
    maps.mkdir()
    png_write(maps / "rock_normal.png", 2, 2, (128, 128, 255))
    result = succeeds("render", "--material", maps, *DIRECT, "--environment", "sky", "-o",
                      folder / "a.exr")
    check(environment_of(folder / "a.exr") == "sky", report(result))


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
