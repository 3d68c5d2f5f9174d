"""How `lobe render` and `lobe bench` play the animations of glTF files."""

import json
import math
import sys

import tap
from files import exr_header, exr_texels, gltf_write
from motion import (HALF_WIDTH, INTERPOLATIONS, PLACES, WAYS, moving_squares, place,
                    write_moving_square)
from program import SMALL, check, fails, fresh_folder, leaves, report, succeeds

WIDTH, HEIGHT = 128, 8  # of a row


def drawn(rows=1):
    return ["--filter", "direct", "--size", f"{WIDTH}x{HEIGHT * rows}", "--depth", "float",
            "--environment", "none"]


def near(path, *places):
    """The bright square of each row is there, to a pixel and a half."""
    texels = exr_texels(path)
    for row, expected in enumerate(places):
        bright = [n % WIDTH for n in range(row * WIDTH * HEIGHT, (row + 1) * WIDTH * HEIGHT)
                  if texels[n][3] > 0.5]
        check(bright, f"{path}: nothing is bright in row {row}")
        found = ((sum(bright) / len(bright) + 0.5) / WIDTH * 2 - 1) * HALF_WIDTH
        check(abs(found - expected) < 3 * HALF_WIDTH / WIDTH,
              f"{path}, row {row}: {found}, not {expected}")


def test_squares_follow_their_keys():
    folder = fresh_folder("keys")
    ways = [(way, interpolation) for way in WAYS for interpolation in INTERPOLATIONS]
    gltf_write(folder / "squares.gltf", moving_squares(ways))
    succeeds("render", folder / "squares.gltf", *drawn(len(ways)), "--frames", "0..11", "-o",
             folder / "frame.exr")
    for n in range(12):
        path = folder / f"frame-{n:04}.exr"
        check(abs(exr_header(path)["seconds"] - n / 30) < 1e-6, "another time")
        near(path, *(place(interpolation, n / 30) for _, interpolation in ways))


def test_a_picture_is_of_time_zero_or_of_the_time_given():
    folder = fresh_folder("times")
    scene = write_moving_square(folder / "square.gltf")
    for options, expected in ((), PLACES[0]), (("--time", "0.1"), place("LINEAR", 0.1)):
        succeeds("render", scene, *drawn(), *options, "-o", folder / "one.exr")
        near(folder / "one.exr", expected)


def two_animations(folder):
    """The second moves what is above the square."""
    document = moving_squares([("node", "LINEAR")])
    document["nodes"].append({"children": [1]})
    document["animations"].append({
        "name": "shift", "samplers": document["animations"][0]["samplers"],
        "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]})
    gltf_write(folder / "two.gltf", document)
    return folder / "two.gltf"


def test_animations_are_chosen():
    folder = fresh_folder("chosen")
    scene, here = two_animations(folder), place("LINEAR", 0.08)
    for choice, expected in ((), here), (("--animation", "shift"), here), \
            (("--animation", "1"), here), (("--animation", "all"), 2 * here):
        succeeds("render", scene, *drawn(), "--time", "0.08", *choice, "-o", folder / "one.exr")
        near(folder / "one.exr", expected)
    for choice in "walk", "2", "-1", "":
        fails("render", scene, *SMALL, f"--animation={choice}", "-o", folder / "no.png",
              says=["two.gltf", f"no animation '{choice}'", "'slide', 'shift'"])
    leaves(folder, "one.exr", "two.gltf")
    result = succeeds("render", "checkerboard", *SMALL, "--filter", "direct", "--animation", "x",
                      "-o", folder / "still.png")
    check("--animation makes no difference" in result.stderr, report(result))


def test_animated_cameras_are_followed():
    folder = fresh_folder("camera")
    document = moving_squares([("node", "LINEAR")])
    document["animations"][0]["channels"][0]["target"]["node"] = 2
    document["nodes"].append({"children": [0]})
    gltf_write(folder / "camera.gltf", document)
    here = place("LINEAR", 0.1)
    succeeds("render", folder / "camera.gltf", *drawn(), "--time", "0.1", "-o", folder / "a.exr")
    near(folder / "a.exr", -here)
    # A camera of the user's stays.
    succeeds("render", folder / "camera.gltf", *drawn(), "--time", "0.1", "--eye", "0.5,0,5",
             "--target", "0.5,0,0", "-o", folder / "b.exr")
    near(folder / "b.exr", -0.5)


def test_an_added_camera_sees_all_of_the_motion():
    folder = fresh_folder("framed")
    document = moving_squares([("skin", "LINEAR")])
    del document["cameras"], document["nodes"][0]["camera"]
    gltf_write(folder / "framed.gltf", document)
    succeeds("render", folder / "framed.gltf", *drawn(16), "--frames", "0..10", "-o",
             folder / "frame.exr")
    for n in 0, 4, 10:
        texels = exr_texels(folder / f"frame-{n:04}.exr")
        columns = [i % WIDTH for i, texel in enumerate(texels) if texel[3] > 0.5]
        check(columns and min(columns) > 0 and max(columns) < WIDTH - 1, f"frame {n} is cut off")


def test_broken_channels_are_named():
    folder = fresh_folder("broken")
    document = moving_squares([("skin", "LINEAR")])
    document["animations"][0]["samplers"][0]["interpolation"] = "SMOOTH"
    gltf_write(folder / "broken.gltf", document)
    fails("render", folder / "broken.gltf", *SMALL, "-o", folder / "no.png",
          says=["broken.gltf", "channel 0 of animation 'slide'", "SMOOTH"])
    leaves(folder, "broken.gltf")


def test_animated_files_are_measured():
    folder = fresh_folder("bench")
    scene = write_moving_square(folder / "square.gltf", "skin")
    measured = ["bench", scene, *SMALL, "--filters", "direct", "--frames", "2", "--samples", "2",
                "--environment", "none"]
    result = succeeds(*measured)
    check("deform" in result.stdout, report(result))
    succeeds(*measured, "--sweep", "--knobs", "none", "--stations", "2", "--path-samples", "1",
             "--json", folder / "sweep.json")
    rows = json.loads((folder / "sweep.json").read_text())["rows"]
    check(rows and all(math.isfinite(row["flicker"]) for row in rows), str(rows))


sys.exit(tap.run(globals(), under_sanitizers=(
    test_squares_follow_their_keys, test_animations_are_chosen, test_broken_channels_are_named)))
