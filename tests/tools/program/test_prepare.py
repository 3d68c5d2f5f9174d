"""`lobe prepare`: makes what filters fit to materials without drawing, whole or in parts."""

import shutil
import subprocess
import sys

import tap
from files import png_draw
from program import (FOLDER, PROGRAM, check, fails, fresh_folder, is_wrong_usage, leaves, report,
                     said_to_terminal, succeeds)

MAPS = FOLDER / "maps"
MAPS.mkdir()
png_draw(MAPS / "rock_height.png", 32, 32, lambda x, y: (37 * x * y % 256,) * 3)
png_draw(MAPS / "rock_albedo.png", 2, 2, lambda x, y: (200, 90 + 80 * x, 120 * y))
RELIEF = ["--material", MAPS, "--filter", "displaced", "--set", "azimuths=4"]
MODELS = ["--material", MAPS, "--filter", "wu", "--set", "angular=5", "--set", "points=64"]
LAMP = ["--light", "point:0,2,1:20,20,20"]  # its shaders compile in a third of a sky's time


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_what_is_prepared_is_found():
    folder = fresh_folder("found")
    for arguments in (RELIEF, MODELS):
        cache = fresh_folder("found-cache")
        first = succeeds("prepare", *arguments, "--cache", cache)
        check("made for 1 material, found for 0" in first.stdout, report(first))
        check("warning" not in first.stderr, report(first))
        made = files(cache)
        check(len(made) == 1, f"{made.keys()}")
        second = succeeds("prepare", *arguments, "--cache", cache)
        check("made for 0 materials, found for 1" in second.stdout, report(second))
        drawn = succeeds("render", *arguments, *LAMP, "--size", "16x16", "--cache", cache, "-o",
                         folder / "a.exr")
        check("facet_transfer" not in drawn.stdout and "path_vertices" not in drawn.stdout,
              report(drawn))
        check(made.items() <= files(cache).items(), "the file has changed")


def test_damaged_files_are_replaced():
    cache = fresh_folder("damaged")
    succeeds("prepare", *MODELS, "--cache", cache)
    [(name, whole)] = files(cache).items()
    (cache / name).write_bytes(whole[:-9])
    result = succeeds("prepare", *MODELS, "--cache", cache)
    check("will be replaced" in result.stderr and "made for 1" in result.stdout, report(result))
    check(files(cache) == {name: whole}, "the file was not replaced")


def test_kept_in_the_users_folder():
    user = fresh_folder("user")
    succeeds("prepare", *RELIEF, XDG_CACHE_HOME=user)
    check(len(files(user / "lobe" / "mixtures")) == 1, "nothing was kept")


def test_parts_become_what_one_process_makes():
    """By GNU parallel, whose jobs share a folder."""
    if not shutil.which("parallel"):
        return "GNU parallel is not installed"
    whole, parts = fresh_folder("whole"), fresh_folder("parts")
    succeeds("prepare", *RELIEF, "--cache", whole)
    command = ["parallel", "--will-cite", "--jobs", "2", PROGRAM, "prepare", *RELIEF, "--cache",
               parts, "--part", "{}/2", ":::", "1", "2"]
    result = subprocess.run(list(map(str, command)), cwd=FOLDER, text=True, capture_output=True,
                            stdin=subprocess.DEVNULL, timeout=300, check=False)
    check(result.returncode == 0, report(result))
    name = next(iter(files(whole)))
    leaves(parts, f"{name}-1-of-2", f"{name}-2-of-2")
    merged = succeeds("prepare", *RELIEF, "--cache", parts, "--merge", "2")
    check("made for 1 material" in merged.stdout, report(merged))
    check(files(parts) == files(whole), "what was put together differs")
    (parts / f"{name}-2-of-2").write_bytes(b"left by a process that was killed")
    succeeds("prepare", *RELIEF, "--cache", parts, "--merge", "2")
    check(files(parts) == files(whole), "a part was left")
    return None


def test_tiles_of_large_reliefs_are_shared():
    """A relief of two windows."""
    maps, whole, parts = fresh_folder("large"), fresh_folder("tiles"), fresh_folder("tile-parts")
    png_draw(maps / "rock_height.png", 1456, 1456, lambda x, y: (37 * x * y % 251,) * 3)
    png_draw(maps / "rock_albedo.png", 1, 1, lambda x, y: (200, 90, 120))
    relief = ["--material", maps, "--filter", "displaced", "--set", "azimuths=4", "--set",
              "order=4", "--set", "bounces=1"]
    succeeds("prepare", *relief, "--cache", whole)
    check(len(files(whole)) == 2, f"{files(whole).keys()}")
    succeeds("prepare", *relief, "--cache", parts, "--part", "2/2")
    fails("prepare", *relief, "--cache", parts, "--merge", "2", says=["-tile-1-of-2", "part 1 of 2",
                                                                     "missing"])
    succeeds("prepare", *relief, "--cache", parts, "--part", "1/2")
    merged = succeeds("prepare", *relief, "--cache", parts, "--merge", "2")
    check("found for 1" in merged.stdout, report(merged))
    check(files(parts) == files(whole), "the tiles differ")
    drawn = succeeds("render", *relief, *LAMP, "--size", "16x16", "--cache", parts, "-o",
                     maps / "a.exr")
    check("facet_transfer" not in drawn.stdout and "map_restoring" in drawn.stdout, report(drawn))


def test_missing_and_damaged_parts_are_named():
    cache = fresh_folder("missing")
    fails("prepare", *RELIEF, "--cache", cache, "--merge", "2", says=["-1-of-2", "part 1 of 2",
                                                                     "missing"])
    succeeds("prepare", *RELIEF, "--cache", cache, "--part", "1/2")
    fails("prepare", *RELIEF, "--cache", cache, "--merge", "2", says=["-2-of-2", "part 2 of 2"])
    [(name, part)] = files(cache).items()
    (cache / name).write_bytes(part[:-9])
    fails("prepare", *RELIEF, "--cache", cache, "--merge", "2", says="part 1 of 2")
    again = succeeds("prepare", *RELIEF, "--cache", cache, "--part", "1/2")
    check("will be replaced" in again.stderr, report(again))
    check(files(cache) == {name: part}, "the part was not made again")
    (cache / name).rename(cache / name.replace("-1-of-2", "-2-of-2"))
    succeeds("prepare", *RELIEF, "--cache", cache, "--part", "1/2")
    fails("prepare", *RELIEF, "--cache", cache, "--merge", "2", says="part 2 of 2")


def test_progress_is_shown_on_a_terminal():
    said = said_to_terminal("prepare", *RELIEF, "--cache", fresh_folder("shown"), "--part", "1/2")
    check("part 1 of 2" in said and "%" in said, said)


def test_materials_that_change_are_told_of():
    result = succeeds("prepare", "rain", "--filter", "mixture", "--cache", fresh_folder("rain"))
    check("for 1 of the materials nothing" in result.stderr, report(result))
    check("made for 4 materials" in result.stdout, report(result))


def test_wrong_usage():
    is_wrong_usage("prepare", "--filter", "wu", says="SCENE")
    is_wrong_usage("prepare", "bumps", says="--filter")
    is_wrong_usage("prepare", "bumps", *RELIEF, says=["bumps", "--material"])
    is_wrong_usage("prepare", "bumps", "--filter", "moments", says=["--filter", "moments"])
    is_wrong_usage("prepare", *MODELS, "--part", "1/2", says=["--part", "wu"])
    is_wrong_usage("prepare", *MODELS, "--merge", "2", says=["--merge", "wu"])
    is_wrong_usage("prepare", *RELIEF, "--part", "1/2", "--merge", "2", says="--merge")
    for part in ("0/2", "3/2", "1", "1/", "1/2x", "-1/2", "1/5000", " 1/2", "1/+2"):
        is_wrong_usage("prepare", *RELIEF, f"--part={part}", says=["--part", part])
    is_wrong_usage("prepare", *RELIEF, "--merge", "0", says="--merge")


def test_folders_are_tried_before_work():
    fails("prepare", "none.gltf", "--filter", "wu", "--cache", FOLDER / "none", says="none")
    fails("prepare", "none.gltf", "--filter", "wu", "--cache", FOLDER, says="none.gltf")


if __name__ == "__main__":
    sys.exit(tap.run(globals(), long=[test_materials_that_change_are_told_of,
                                       test_tiles_of_large_reliefs_are_shared]))
