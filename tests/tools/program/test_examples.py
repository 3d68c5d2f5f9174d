"""Runs the programs of tools/examples, which use only the public library."""

import base64
import json
import os
import re
import struct
import subprocess
import sys
from pathlib import Path

import tap
from files import exr_header, exr_pixels, exr_texels, gltf_triangle, gltf_write, png_draw
from program import FOLDER, check, report, succeeds

EXAMPLES = Path(sys.argv[3]).resolve()
VALIDATED = {
    "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
    "VK_LAYER_ENABLES": "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT",
    "VK_LOADER_DEBUG": "layer",
}


def example(name, *arguments, **environment):
    return subprocess.run([EXAMPLES / name, *map(str, arguments)], cwd=FOLDER, text=True,
                          env={**os.environ, **environment}, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, timeout=120, check=False)


def runs(name, *arguments, **environment):
    result = example(name, *arguments, **environment)
    check(result.returncode == 0, report(result))
    return result


def difference(one, other):
    return json.loads(succeeds("compare", one, other, "--json").stdout)


def is_silent(result):
    """The validation layer was present and reported nothing."""
    check("VK_LAYER_KHRONOS_validation" in result.stderr, report(result))
    check("alidation Error" not in result.stdout + result.stderr, report(result))


def test_host_device_draws_what_render_draws():
    for scene in ("checkerboard", "tablecloth"):
        runs("host_device", scene, "host.exr", 64, 36)
        succeeds("render", scene, "--size", "64x36", "--depth", "float", "-o", "render.exr")
        host, rendered = FOLDER / "host.exr", FOLDER / "render.exr"
        for attribute in ("channels", "compression", "dataWindow"):
            check(exr_header(host)[attribute] == exr_header(rendered)[attribute], attribute)
        check(exr_header(host)["channels"].keys() == set("RGBA"), exr_header(host))
        check(exr_pixels(host) == exr_pixels(rendered), f"{scene}: not bit for bit")


def test_host_device_makes_no_mistakes():
    is_silent(runs("host_device", "checkerboard", "host.exr", 32, 24, **VALIDATED))


def test_own_pass_draws_outlines():
    result = runs("own_pass", "checkerboard", "own.png", 64, 36, **VALIDATED)
    is_silent(result)
    check("outline" in result.stdout, report(result))
    succeeds("render", "checkerboard", "--size", "64x36", "-o", "render.png")
    check(0.01 < difference("own.png", "render.png")["rmse"] < 0.5, "outlines are few and dark")


def test_offscreen_animation_writes_frames():
    result = runs("offscreen_animation", "checkerboard", ".", 3, 48, 32, **VALIDATED)
    is_silent(result)
    passes = [int(number) for number in re.findall(r"(\d+) passes", result.stdout)]
    # The material's roughness is in its maps of lobes; colour maps are unchanged.
    # From the second change on, the device fits bins to the roughness that moves: two passes, and
    # before the first fit one that empties what it would go on from.
    check(len(passes) == 3 and passes[1] + 3 == passes[2] < passes[0], report(result))
    memory = re.search(r"memory: (\d+) bytes at most, (\d+) are left", result.stdout)
    check(memory and int(memory[1]) > 100000 and int(memory[2]) == 0, report(result))
    succeeds("render", "checkerboard", "--size", "48x32", "-o", "render.exr")
    check(difference("frame0000.exr", "render.exr")["rmse"] == 0, "the first frame is the scene")
    for one, other in (("frame0000.exr", "frame0001.exr"), ("frame0001.exr", "frame0002.exr")):
        check(difference(one, other)["rmse"] > 0, f"{one} and {other} are the same")


def draws_the_same(name, scene, width, height, *environment):
    """Each pixel, to 1e-5 of the largest value: 3e-7 on `bumps`, 3e-6 on `pillow`, where what the
    vertex shader rounds differently shows in derivatives of large texture coordinates."""
    own, rendered = FOLDER / "own.exr", FOLDER / "rendered.exr"
    is_silent(runs("own_shading", name, scene, own, width, height, *environment, **VALIDATED))
    options = ["--environment", *environment] if environment else []
    succeeds("render", scene, "--filter", name, "--size", f"{width}x{height}", "--depth",
             "float", *options, "-o", rendered)
    # Only the renderer draws the environment behind the scene, where the host's alpha is 0.
    pairs = [(a, b) for a, b in zip(exr_texels(own), exr_texels(rendered)) if a[0] == 1]
    check(len(pairs) > 500, f"{name}, {scene}: only {len(pairs)} pixels show the scene")
    peak = max(max(b[1:]) for _, b in pairs)
    apart = [max(abs(x - y) for x, y in zip(a, b)) / peak for a, b in pairs]
    check(max(apart) < 1e-5, f"{name}, {scene}: {sum(value >= 1e-5 for value in apart)} pixels of "
                             f"{len(apart)} differ, by up to {max(apart)}")


def test_own_shading_draws_what_render_draws():
    for name in ("toksvig", "lean", "lobes", "moments"):
        draws_the_same(name, "bumps", 64, 36)


def test_own_shading_has_many_materials():
    draws_the_same("moments", "pillow", 64, 36)


def write_triangle(name, attribute, kind, values, **more):
    """A triangle under a sun, whose three vertices have this attribute of a VEC2 or VEC4. Returns
    the scene."""
    document = gltf_triangle() | more
    data = base64.b64encode(struct.pack(f"<{len(values)}f", *values)).decode()
    document["buffers"].append({"byteLength": 4 * len(values),
                                "uri": "data:application/octet-stream;base64," + data})
    document["bufferViews"].append({"buffer": 1, "byteLength": 4 * len(values)})
    document["accessors"].append({"bufferView": 2, "componentType": 5126, "count": 3,
                                  "type": kind})
    document["meshes"][0]["primitives"][0] |= {
        "attributes": {"POSITION": 0, attribute: 2}, "material": 0}
    document["extensionsUsed"] = ["KHR_lights_punctual"]
    document["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}}
    document["nodes"][0]["extensions"] = {"KHR_lights_punctual": {"light": 0}}
    scene = FOLDER / name
    gltf_write(scene, document)
    return scene


def test_own_shading_shows_parts_of_masks():
    """Holes far smaller than pixels, of which as many are drawn as the mask keeps."""
    png_draw(FOLDER / "holes.png", 4, 4,
             lambda x, y: (200, 100, 50, 0 if x % 2 == 0 and y % 2 == 0 else 255))
    scene = write_triangle("holes.gltf", "TEXCOORD_0", "VEC2", (-25, -25, 25, -25, 0, 25),
                           images=[{"uri": "holes.png"}], textures=[{"source": 0}],
                           materials=[{"alphaMode": "MASK",
                                       "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])
    draws_the_same("moments", scene, 96, 54)
    own, rendered = exr_texels(FOLDER / "own.exr"), exr_texels(FOLDER / "rendered.exr")
    check([texel[0] for texel in own] == [texel[0] for texel in rendered], "other pixels are kept")


def test_own_shading_has_vertex_colours():
    """Two-sided, and cut off where their alpha falls below a half."""
    scene = write_triangle("colours.gltf", "COLOR_0", "VEC4",
                           (1, 0.2, 0.1, 1, 0.1, 1, 0.2, 1, 0.2, 0.1, 1, 0),
                           materials=[{"alphaMode": "MASK", "doubleSided": True}])
    draws_the_same("moments", scene, 96, 54)


def test_own_shading_has_an_environment():
    draws_the_same("moments", "bumps", 48, 27, "sky")


def test_examples_say_what_is_wrong():
    check(example("own_shading").returncode == 2, "own_shading")
    result = example("own_shading", "moments", "no-such-scene", "x.exr", 8, 8)
    check(result.returncode == 1 and "no-such-scene" in result.stderr, report(result))
    for name, *rest in (("host_device", 8, 8), ("own_pass", 8, 8),
                        ("offscreen_animation", 1, 8, 8)):
        check(example(name).returncode == 2, name)
        result = example(name, "no-such-scene", "x.exr", *rest)
        check(result.returncode == 1 and "no-such-scene" in result.stderr, report(result))


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_host_device_makes_no_mistakes, test_own_pass_draws_outlines,
        test_own_shading_has_many_materials, test_examples_say_what_is_wrong),
        long=[test_own_shading_has_an_environment]))
