#!/usr/bin/env python3
"""Checks that compiled shaders do not contain what a scene does not need.

Compiles the shading pass of each filter as the build does, sets its specialisation constants, lets
spirv-opt remove what they make unreachable, and counts what is left.

usage: specialised_shaders.py SHADERS GLSLANG SPIRV_OPT SPIRV_DIS
"""

import functools
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

shaders = glslang = spirv_opt = spirv_dis = scratch = None

FILTERS = ("direct", "mipmap", "toksvig", "lobes")


def identifiers():
    """Constant ids by name, as the shaders see them."""
    found = {}
    for header in ("specialisation.h", "mixture.h"):
        text = (shaders / "interface" / header).read_text()
        for name, value in re.findall(r"#define SPECIALISE_(\w+)\s+(?:SPECIALISE)?\(?([\w +]+?)\)?"
                                      r"\s*(?://|\n)", text):
            value = value.replace("SPECIALISE_FILTER", str(found.get("FILTER", 0)))
            found[name] = sum(int(part) for part in value.split("+"))
    return found


def run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stdout)
    return done.stdout


@functools.lru_cache(maxsize=None)
def compile_shading(name, outputs):
    module = scratch / f"{name}{'_aov' if outputs else ''}.spv"
    (scratch / "filter.glsl").write_text(f'#include "filters/{name}.glsl"\n')
    definitions = ["-DAOV"] if outputs else []
    run(glslang, "-V", "--quiet", "--target-env", "vulkan1.3", f"-I{scratch}", f"-I{shaders}",
        *definitions, "-o", module, shaders / "shading/shading.frag")
    return module


@functools.lru_cache(maxsize=None)
def specialised(name, values, outputs):
    # The build has validated it.
    optimised = scratch / "optimised.spv"
    run(spirv_opt, "--skip-validation", f"--set-spec-const-default-value={values}",
        "--freeze-spec-const", "--fold-spec-const-op-composite", "-O", "--loop-unroll", "-O", "-O",
        compile_shading(name, outputs), "-o", optimised)
    return run(spirv_dis, "--raw-id", "--no-color", optimised)


def disassembly(name, constants, outputs=False):
    """The remaining instructions of a filter's shading pass."""
    ids = identifiers()
    values = " ".join(f"{ids[key]}:{value}" for key, value in constants.items())
    return specialised(name, values, outputs)


def count(text, pattern):
    return len(re.findall(pattern, text))


def light_accesses(text):
    """Reads of the block of lights, which has binding 2."""
    blocks = re.findall(r"OpDecorate (%\d+) Binding 2\n", text)
    return sum(count(text, rf"OpAccessChain %\d+ {block} ") for block in blocks)


# A lobe without maps under one directional light; everything else is off.
BARE = {"MODEL": 1, "DISTRIBUTION": 3, "LOBE_COUNT": 1, "MAPS": 0, "DIFFUSE": "false",
        "ALPHA_MASK": "false", "EMISSION": "false", "VERTEX_COLOUR": "false",
        "NORMAL_CONCENTRATION": "false", "DIRECTIONAL_LIGHTS": "true", "POINT_LIGHTS": "false",
        "SPOT_LIGHTS": "false", "LIGHTS_AT_ONCE": 1, "FILTERED_LOBES": "false"}


def size_of(name, outputs=False, **changes):
    return count(disassembly(name, {**BARE, **changes}, outputs), r"\n")


class SpecialisedShaders(unittest.TestCase):
    def test_a_material_without_maps_samples_none(self):
        for name in FILTERS:
            text = disassembly(name, BARE)
            self.assertEqual(count(text, r"OpImage\w*Sample|OpImageFetch"), 0, name)
            # With a normal map there is something to count.
            text = disassembly(name, {**BARE, "MAPS": 2, "FILTERED_LOBES": "true"})
            self.assertGreater(count(text, r"OpImage\w*Sample|OpImageFetch"), 0, name)

    def test_what_is_absent_costs_instructions_only_where_present(self):
        for name in FILTERS:
            bare = size_of(name)
            for key in ("POINT_LIGHTS", "SPOT_LIGHTS", "DIFFUSE", "ALPHA_MASK", "EMISSION",
                        "NORMAL_CONCENTRATION"):
                self.assertGreater(size_of(name, **{key: "true"}), bare, f"{name}, {key}")

    def test_without_light_no_light_is_read(self):
        for name in FILTERS:
            text = disassembly(name, {**BARE, "DIRECTIONAL_LIGHTS": "false"})
            self.assertEqual(light_accesses(text), 0, name)
            self.assertGreater(light_accesses(disassembly(name, BARE)), 0, name)
            self.assertLess(count(text, r"\n"), size_of(name))

    def test_outputs_cost_where_they_are_wanted(self):
        for name in FILTERS:
            self.assertGreater(size_of(name, outputs=True), size_of(name))

    def test_fewer_clusters_are_less_code(self):
        mixed = {"MAPS": 2, "FILTERED_LOBES": "true"}
        one = size_of("lobes", **mixed, SUBDIVISION=0)
        eight = size_of("lobes", **mixed, SUBDIVISION=2)
        self.assertLess(one, eight)
        self.assertLess(size_of("lobes"), one)


if __name__ == "__main__":
    shaders, glslang, spirv_opt, spirv_dis = (Path(argument) for argument in sys.argv[1:5])
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        unittest.main(argv=sys.argv[:1], verbosity=2)
