"""What `lobe` says about itself, and how it handles wrong usage: one line, exit status 2."""

import sys

import tap
from program import check, fails, is_wrong_usage, leaves, fresh_folder, lobe, report, succeeds

SUBCOMMANDS = ["render", "view", "bench", "report", "compare", "environment", "prepare", "scenes",
               "filters", "info", "manual", "completion"]
OUTPUT = ["-o", "never.exr"]


def test_no_subcommand_shows_help_on_standard_error():
    result = lobe()
    check(result.returncode == 2 and result.stdout == "", report(result))
    check(all(name in result.stderr for name in SUBCOMMANDS), report(result))


def test_help_lists_all_subcommands():
    for arguments in (["--help"], ["help"]):
        result = succeeds(*arguments)
        check(all(name in result.stdout for name in SUBCOMMANDS), report(result))
        check(result.stderr == "", report(result))


def test_version():
    result = succeeds("--version")
    check(result.stdout.startswith("lobe ") and result.stdout.count("\n") == 1, report(result))


def test_help_of_each_subcommand():
    for name in tap.some(SUBCOMMANDS):  # test_manual.py calls for the help of all
        long, short = succeeds(name, "--help"), succeeds("help", name)
        check(long.stdout == short.stdout, f"{name}: two helps")
        check(long.stdout.startswith(f"Usage: lobe {name} "), report(long))
        check("--help" in long.stdout and long.stderr == "", report(long))


def test_help_shows_defaults_and_ranges():
    text = " ".join(succeeds("render", "--help").stdout.split())
    for words in ("(default 1280x720)", "(default moments)", "[1, 4096] (default 64)",
                  "half, float (default half)", "directional:DX,DY,DZ:R,G,B", "point:X,Y,Z:R,G,B",
                  "LOBE_DEVICE"):
        check(words in text, f"no '{words}' in {text}")


def test_unknown_subcommand():
    is_wrong_usage("paint", says="paint")
    is_wrong_usage("help", "paint", says="paint")
    is_wrong_usage("help", "render", "bench", says="bench")


def test_unknown_option():
    is_wrong_usage("--paint", says="--paint")
    for name in tap.some(SUBCOMMANDS):
        is_wrong_usage(name, "--paint", says=["--paint", f"lobe {name}"])
        is_wrong_usage(name, "-z", says="-z")


def test_misspelt_names():
    """The line says which name was probably meant."""
    is_wrong_usage("--verison", says="did you mean '--version'?")
    is_wrong_usage("-help", says="did you mean '--help'?")
    is_wrong_usage("rendr", says="did you mean 'render'?")
    is_wrong_usage("help", "benhc", says="did you mean 'bench'?")
    is_wrong_usage("manual", "veiw", says="did you mean 'view'?")
    is_wrong_usage("render", "bumps", *OUTPUT, "--smaples", "4", says="did you mean '--samples'?")
    is_wrong_usage("render", "bumps", *OUTPUT, "--sampels=4", says="did you mean '--samples'?")
    is_wrong_usage("view", "bumps", "--exposre", "1", says="did you mean '--exposure'?")
    is_wrong_usage("bench", "bumps", "--sweep", "--knobs", "prboes", "--json", "never.json",
                   says="did you mean 'probes'?")
    for misspelt, name in (("tablecloht", "tablecloth"), ("bnuny", "bunny")):
        result = fails("render", misspelt, *OUTPUT, says=misspelt)
        check(f"did you mean '{name}'?" in result.stderr, report(result))
    result = fails("render", "bunny", *OUTPUT, LOBE_ASSETS="", says="bunny")  # has no mesh then
    check("did you mean" not in result.stderr, report(result))
    for arguments in (["--paint"], ["paint"], ["render", "--paint"], ["help", "paint"]):
        result = lobe(*arguments)
        check("did you mean" not in result.stderr, report(result))


def test_unexpected_operands():
    for name in ("scenes", "filters", "info"):
        is_wrong_usage(name, "operand", says="operand")
    is_wrong_usage("render", "bumps", "tablecloth", *OUTPUT, says="tablecloth")


def test_missing_operands():
    is_wrong_usage("render", *OUTPUT, says="SCENE")
    is_wrong_usage("bench", says="SCENE")
    is_wrong_usage("compare", "one.exr")
    is_wrong_usage("report", "-o", "folder", says="RESULTS.json")


def test_missing_and_odd_outputs():
    is_wrong_usage("render", "bumps", says="-o")
    is_wrong_usage("render", "bumps", "-o", says="output")
    is_wrong_usage("render", "bumps", "-o", "picture.jpeg", says="picture.jpeg")
    is_wrong_usage("render", "bumps", "-o", ".png", says=".png")
    is_wrong_usage("render", "bumps", *OUTPUT, "-o", "picture", says="picture")


def test_report_needs_a_folder():
    is_wrong_usage("report", "results.json", says="-o DIR")
    is_wrong_usage("report", "results.json", "-o", "folder", "--picture-width", "0",
                   says="--picture-width")


def test_unknown_filter():
    is_wrong_usage("render", "bumps", *OUTPUT, "--filter", "blur", says=["blur", "direct, mipmap"])
    is_wrong_usage("bench", "bumps", "--filters", "direct,blur", says=["blur", "direct, mipmap"])
    is_wrong_usage("bench", "bumps", "--filters", "direct,", says="filter ''")


def test_unknown_knob():
    is_wrong_usage("render", "bumps", *OUTPUT, "--set", "colours=1",
                   says=["colours", "least_share"])
    is_wrong_usage("render", "bumps", *OUTPUT, "--filter", "direct", "--set", "epsilon0=1",
                   says=["epsilon0", "direct"])
    is_wrong_usage("bench", "bumps", "--set", "colour=1", says="colour")
    is_wrong_usage("bench", "bumps", "--filters", "direct", "--set", "epsilon0=1", says="epsilon0")


def test_knob_out_of_range():
    for value in ("1.1", "-0.1", "nan", "inf", "", "half", "0.5x"):
        is_wrong_usage("render", "bumps", *OUTPUT, "--set", f"least_share={value}",
                       says="least_share")
    is_wrong_usage("render", "bumps", *OUTPUT, "--set", "probes=1.5", says="probes")
    is_wrong_usage("render", "bumps", *OUTPUT, "--set", "view=beauty", says=["beauty", "level"])
    is_wrong_usage("render", "bumps", *OUTPUT, "--set", "probes", says="NAME=VALUE")
    is_wrong_usage("bench", "bumps", "--set", "epsilon0=2", says="epsilon0")
    is_wrong_usage("bench", "bumps", "--set", "epsilon0", says="NAME=VALUE")


def test_numbers_out_of_range():
    for option, values in {"samples": ["0", "4097", "-1", "many", "1e3", "99999999999"],
                           "frames": ["0", "100001", "2.5", "3..2", "1..", "a..b"],
                           "time": ["-1", "3601", "now"],
                           "fov": ["0", "180", "wide", "nan"],
                           "path": ["-0.1", "1.1", "half"],
                           "exposure": ["101", "inf"],
                           "depth": ["double", ""],
                           "carrier": ["cube"],
                           "eye": ["1,2", "1,2,3,4", "1,2,x", "1e999,0,0", ""],
                           "target": ["1;2;3"]}.items():
        for value in tap.some(values):
            is_wrong_usage("render", "bumps", *OUTPUT, f"--{option}", value, says=f"--{option}")
    is_wrong_usage("bench", "bumps", "--frames", "0", says="--frames")
    is_wrong_usage("bench", "bumps", "--samples", "5000", says="--samples")


def test_sizes():
    sizes = ("0x0", "0x100", "100x0", "100", "x", "100x", "-1x5", "99999999999x1", "1.5x2", "")
    for size in sizes:
        is_wrong_usage("render", "bumps", *OUTPUT, "--size", size, says="--size")
    for size in tap.some(sizes):
        is_wrong_usage("bench", "bumps", "--size", size, says="--size")


def test_lights():
    for light in ("sun", "spot:0,0,0:1,1,1", "point:0,0,0", "point:0,0:1,1,1", "point:0,0,0:1,1",
                  "point:0,0,0:1,1,-1", "directional:0,0,0:1,1,1", "directional:0,1,0:1,1,nan",
                  "point:0,0,0:1,1,1:1", ""):
        is_wrong_usage("render", "bumps", *OUTPUT, "--light", light, says="--light")


def test_material_and_scene_exclude_each_other():
    is_wrong_usage("render", "bumps", "--material", "folder", *OUTPUT, says="--material")
    is_wrong_usage("render", "bumps", "--carrier", "sphere", *OUTPUT, says="--material")


def test_scenes_are_listed():
    lines = succeeds("scenes").stdout.splitlines()
    names = [line.split()[0] for line in lines]
    check(names == ["checkerboard", "bumps", "tablecloth", "pillow", "hall", "bunny", "dragon",
                    "rain", "cloth", "ocean", "fields", "flag", "twill", "cobbles",
                    "studs", "furnace", "terrain"], str(names))
    check(all(len(line.split()) > 3 for line in lines), "no summaries")


def test_filters_are_listed_with_their_knobs():
    text = succeeds("filters").stdout
    for words in ("direct: ", "mipmap: ", "lobes: ", "reference: ", "Xu et al. 2017",
                  "epsilon0     0.95  [0, 1]", "epsilon1     0.85  [0, 1]",
                  "probes       1  [1, 16] whole", "anisotropy   1  [1, 16] whole",
                  "{radiance, lobes, level, samples}"):
        check(words in text, f"no '{words}' in {text}")


def test_wrong_usage_writes_nothing():
    folder = fresh_folder("usage")
    is_wrong_usage("render", "bumps", "-o", folder / "a.exr", "--graph", folder / "a.dot",
                   "--set", "probes=70")
    is_wrong_usage("bench", "bumps", "--json", folder / "a.json", "--filters", "blur")
    leaves(folder)


def test_a_full_standard_output_is_told():
    with open("/dev/full", "w", encoding="utf-8") as full:
        fails("filters", says="standard output", stdout=full)
        fails("--version", says="standard output", stdout=full)


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
