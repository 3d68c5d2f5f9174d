"""How `lobe` fails: one line that names file and cause, exit status 1, nothing half-written."""

import os
import sys

import tap
from program import FOLDER, SMALL, check, fails, fresh_folder, leaves, report, succeeds

NO_DRIVER = {"VK_ICD_FILENAMES": "/nonexistent.json", "VK_DRIVER_FILES": "/nonexistent.json"}
DIRECT = ["--filter", "direct", *SMALL]


def test_missing_scene():
    folder = fresh_folder("missing")
    fails("render", "no-such-scene", *DIRECT, "-o", folder / "a.exr", says="no-such-scene")
    fails("render", folder / "a.gltf", *DIRECT, "-o", folder / "a.exr", says="a.gltf")
    fails("render", folder, *DIRECT, "-o", folder / "a.exr", says=str(folder))
    fails("bench", "no-such-scene", "--json", folder / "a.json", says="no-such-scene")
    leaves(folder)


def test_missing_material_folder():
    folder = fresh_folder("material")
    fails("render", "--material", folder / "none", *DIRECT, "-o", folder / "a.exr", says="none")
    fails("render", "--material", folder, *DIRECT, "-o", folder / "a.exr", says=str(folder))
    leaves(folder)


def test_output_in_a_missing_folder():
    for name in ("none/a.exr", "none/a.png"):
        fails("render", "bumps", *DIRECT, "-o", FOLDER / name, says=[name, "No such file"])
    fails("render", "bumps", *DIRECT, "-o", "a.png", "--graph", "none/a.dot",
          says=["none/a.dot", "No such file"])
    fails("bench", "bumps", "--json", "none/a.json", says=["none/a.json", "No such file"])
    check(not (FOLDER / "a.png").exists(), "a.png was written")


def test_output_that_is_a_folder():
    folder = fresh_folder("outputs")
    (folder / "a.exr").mkdir()
    fails("render", "bumps", *DIRECT, "-o", folder / "a.exr", says=["a.exr", "directory"])
    leaves(folder, "a.exr")


def test_output_in_a_folder_that_takes_no_files():
    # Not even root can create files there.
    fails("render", "bumps", *DIRECT, "-o", "/proc/a.exr", says="/proc/a.exr")
    fails("bench", "bumps", "--json", "/proc/a.json", says="/proc/a.json")


def test_output_with_too_long_a_name():
    name = "a" * 300 + ".png"
    fails("render", "bumps", *DIRECT, "-o", name, says="too long")


def test_unwritable_output_is_told_before_work():
    # The missing scene would be the next error.
    fails("render", "no-such-scene", *DIRECT, "-o", "none/a.exr", says="none/a.exr")
    fails("bench", "no-such-scene", "--json", "none/a.json", says="none/a.json")


def test_a_failure_keeps_the_old_file():
    folder = fresh_folder("old")
    (folder / "a.exr").write_text("old")
    fails("render", "bumps", "--size", "65536x65536", "-o", folder / "a.exr", says="65536")
    check((folder / "a.exr").read_text() == "old", "the old file was touched")
    leaves(folder, "a.exr")


def test_absurd_sizes():
    folder = fresh_folder("sizes")
    for size in ("65536x65536", "65535x1", "1x4294967295"):
        fails("render", "bumps", "--filter", "direct", "--size", size, "-o", folder / "a.exr",
              says=size)
    fails("bench", "bumps", "--size", "65536x65536", "--samples", "1", "--json", folder / "a.json",
          says="65536")
    leaves(folder)


def test_device_memory_exhausted():
    device = succeeds("info").stdout.split("Device in use:")[1]
    memory = next(line.split() for line in device.splitlines() if line.startswith("  memory"))
    if int(memory[1]) > 4096:
        return "a device with more than 4 GiB"
    folder = fresh_folder("memory")
    fails("render", "bumps", "--filter", "direct", "--size", "16384x16384", "-o", folder / "a.exr",
          says="memory")
    leaves(folder)
    return None


def test_no_vulkan_device():
    folder = fresh_folder("device")
    fails("render", "bumps", *DIRECT, "-o", folder / "a.exr", says="Vulkan", **NO_DRIVER)
    fails("bench", "bumps", "--json", folder / "a.json", says="Vulkan", **NO_DRIVER)
    result = fails("info", says="Vulkan", **NO_DRIVER)
    check("Device in use" not in result.stdout, report(result))
    leaves(folder)


def test_no_such_device():
    fails("render", "bumps", *DIRECT, "-o", "a.exr", "--device", "abacus", says="abacus")
    fails("info", says="abacus", LOBE_DEVICE="abacus")
    fails("info", "--device", "99", says="99")


def test_subcommands_without_a_device_need_none():
    for name in ("scenes", "filters"):
        succeeds(name, **NO_DRIVER)


def test_camera_that_looks_nowhere():
    fails("render", "bumps", *DIRECT, "-o", "a.exr", "--eye", "1,2,3", "--target", "1,2,3",
          says=["eye", "target"])


def test_no_home_for_the_pipeline_cache():
    folder = fresh_folder("home")
    for home in ("", "/nonexistent", "/dev/null"):
        succeeds("render", "bumps", *DIRECT, "-o", folder / "a.png", HOME=home, XDG_CACHE_HOME=home)
    leaves(folder, "a.png")


def test_output_without_rights():
    if os.geteuid() == 0:
        return "root may write everywhere"
    folder = fresh_folder("rights")
    folder.chmod(0o500)
    fails("render", "bumps", *DIRECT, "-o", folder / "a.exr", says=["a.exr", "denied"])
    leaves(folder)
    return None


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
