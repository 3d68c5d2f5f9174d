"""`lobe environment`: prepares environment light, writes and caches it, and checks it."""

import json
import math
import sys

import tap
from files import exr_header, exr_write
from program import (FOLDER, check, fails, fresh_folder, is_wrong_usage, leaves, report, succeeds)

SMALL = ["--face", "16", "--no-cache"]
LAMPS = FOLDER / "lamps.exr"
exr_write(LAMPS, 32, 16, lambda x, y: (90.0, 60.0, 30.0) if (x, y) == (9, 6) else (1.0, x, 0.1 * y))
METHODS = ["prefiltered", "blended", "mip", "sampled", "sampled_equal_time"]
KAPPAS = [1, 4, 16, 64, 256, 1024, 4096]


def test_levels_are_listed():
    result = succeeds("environment", "sky", *SMALL)
    lines = result.stdout.splitlines()
    check("sky" in lines[0] and "faces of 16" in lines[0] and "vmf" in lines[0], report(result))
    rows = [line.split() for line in lines if line.split()[0].isdigit()]
    check([row[0] for row in rows] == [str(i) for i in range(len(rows))], report(result))
    widths, kappas = [int(row[1]) for row in rows], [float(row[2]) for row in rows]
    check(widths[-1] == 1 and all(a == 2 * b for a, b in zip(widths, widths[1:])), report(result))
    check(all(abs(a - 4 * b) < 1e-3 * a for a, b in zip(kappas, kappas[1:-1])), report(result))
    check("environment_reduction" in result.stdout, report(result))


def test_cube_is_written():
    folder = fresh_folder("cube")
    for kernel in ("vmf", "ggx"):
        path = folder / f"{kernel}.exr"
        result = succeeds("environment", LAMPS, *SMALL, "--kernel", kernel, "-o", path)
        header = exr_header(path)
        check(header["envmap"] == b"\1" and "tiles" in header, f"{header}")
        left, top, right, bottom = header["dataWindow"]
        width = right - left + 1
        check(bottom - top + 1 == 6 * width, f"{header}")
        check(header["environment"] == str(LAMPS) and header["kernel"] == kernel, f"{header}")
        check(header["face"] == 16 and len(header["environmentHash"]) == 16, f"{header}")
        levels = int(math.log2(width)) + 1
        check(sum(name.startswith("kappa") for name in header) == levels, f"{header}")
        check(f"{kernel} lobes" in result.stdout, report(result))
    leaves(folder, "ggx.exr", "vmf.exr")


def test_a_cube_is_kept_for_the_next_time():
    folder = fresh_folder("kept")
    cache = fresh_folder("kept-cache")
    arguments = ["environment", LAMPS, "--face", "16", "--cache", cache, "-o"]
    first = succeeds(*arguments, folder / "a.exr")
    kept = list(cache.iterdir())
    check(len(kept) == 1, f"{kept}")
    second = succeeds(*arguments, folder / "b.exr")
    check("environment_prefiltering" in first.stdout, report(first))
    check("environment_prefiltering" not in second.stdout, report(second))
    check("environment_restoring" in second.stdout, report(second))
    same = (folder / "a.exr").read_bytes() == (folder / "b.exr").read_bytes()
    check(same, "what was kept differs from what was made")
    whole = kept[0].read_bytes()
    kept[0].write_bytes(whole[:-1000])
    third = succeeds(*arguments, folder / "c.exr")
    check("will be replaced" in third.stderr and "environment_prefiltering" in third.stdout,
          report(third))
    check(kept[0].read_bytes() == whole, "the damaged file was not replaced")


def test_a_folder_that_cannot_keep_it_is_no_failure():
    result = succeeds("environment", LAMPS, "--face", "16", "--cache", FOLDER / "none")
    check(result.stderr.count("warning") == 1 and "none" in result.stderr, report(result))


def test_kept_in_the_users_folder():
    cache = fresh_folder("user")
    succeeds("environment", LAMPS, "--face", "16", XDG_CACHE_HOME=cache)
    check(len(list((cache / "lobe" / "environments").iterdir())) == 1, "nothing was kept")


def test_check():
    folder = fresh_folder("check")
    path = folder / "check.json"
    result = succeeds("environment", "sky", "--face", "32", "--check", "--directions", "512",
                      "--json", path)
    found = json.loads(path.read_text())
    check(found["environment"] == "sky" and found["directions"] == 512, f"{found}")
    check(set(found["device"]) == {"name", "driver", "type"}, f"{found}")
    rows = {(row["face"], row["kappa"], row["method"]): row for row in found["results"]}
    check(set(rows) == {(32, kappa, method) for kappa in KAPPAS for method in METHODS}, f"{rows}")
    for (_, kappa, method), row in rows.items():
        check(row["ms"] > 0 and math.isfinite(row["relative_l2"]), f"{row}")
        check(("samples" in row) == method.startswith("sampled"), f"{row}")
        # Lobes sharper than a texel see single texels as squares, which interpolation cannot show.
        if method in ("prefiltered", "blended") and kappa <= 256:
            check(row["relative_l2"] <= 0.01, f"{row}")
            check(row["relative_l2"] <= rows[32, kappa, "mip"]["relative_l2"] / 2, f"{row}")
    check(rows[32, 64, "sampled"]["samples"] == 32, f"{rows}")
    faces = found["prepare"]["faces"]
    check(len(faces) == 1 and faces[0]["face"] == 32, f"{faces}")
    check(faces[0]["first_ms"] > 0 and faces[0]["update_in_mip_chains"] > 0, f"{faces}")
    check(len(found["prepare"]["image"]) == 2, f"{found['prepare']}")
    check("prefiltered" in result.stdout and "update" in result.stdout, report(result))


def test_even_light_is_kept_by_every_method():
    folder = fresh_folder("even")
    exr_write(folder / "even.exr", 32, 16, lambda x, y: (3.0, 2.0, 1.0))
    succeeds("environment", folder / "even.exr", "--face", "32", "--check", "--directions", "64",
             "--json", folder / "even.json")
    for row in json.loads((folder / "even.json").read_text())["results"]:
        # For sharper lobes the sum over so few texels is no longer an integral.
        check(row["kappa"] > 256 or row["relative_l2"] <= 1e-3, f"{row}")


def test_few_directions_see_all_texels():
    path = fresh_folder("few") / "few.json"
    succeeds("environment", "sky", "--face", "64", "--check", "--directions", "16", "--json", path)
    for row in json.loads(path.read_text())["results"]:
        check(row["method"] != "prefiltered" or row["kappa"] > 64 or row["relative_l2"] < 0.02,
              f"{row}")


def test_lobes_between_levels():
    path = fresh_folder("between") / "between.json"
    succeeds("environment", LAMPS, "--face", "16", "--check", "--directions", "64", "--kappa", "2",
             "--json", path)
    rows = json.loads(path.read_text())["results"]
    check({row["kappa"] for row in rows} == {2 * kappa for kappa in KAPPAS}, f"{rows}")
    for row in rows:
        bound = {"prefiltered": 0.14, "blended": 0.04}.get(row["method"], 1)
        check(row["kappa"] > 8 or row["relative_l2"] < bound, f"{row}")


def test_wrong_usage():
    is_wrong_usage("environment")
    is_wrong_usage("environment", "sky", "sky")
    is_wrong_usage("environment", "sky", "--face", "100", says=["--face", "100"])
    is_wrong_usage("environment", "sky", "--face", "8", says="--face")
    is_wrong_usage("environment", "sky", "--kernel", "box", says="box")
    is_wrong_usage("environment", "sky", "-o", "a.png", says="a.png")
    is_wrong_usage("environment", "sky", "--json", "a.json", says=["--json", "--check"])
    is_wrong_usage("environment", "sky", "--directions", "9", says=["--directions", "--check"])
    is_wrong_usage("environment", "sky", "--kappa", "2", says=["--kappa", "--check"])
    is_wrong_usage("environment", "sky", "--no-cache", "--cache", "a", says=["--cache"])


def test_broken_and_missing_files():
    folder = fresh_folder("broken")
    output = ["-o", folder / "a.exr"]
    fails("environment", folder / "none.exr", *SMALL, *output, says="none.exr")
    fails("environment", folder, *SMALL, *output, says=str(folder))
    for name, content in (("a.hdr", b"#?RADIANCE\n\n-Y 4 +X 8\n"), ("b.exr", b"\x76\x2f\x31\x01")):
        (folder / name).write_bytes(content)
        fails("environment", folder / name, *SMALL, *output, says=name)
        (folder / name).unlink()
    leaves(folder)


def test_outputs_are_tried_before_work():
    fails("environment", "none.exr", *SMALL, "-o", "none/a.exr", says="none/a.exr")
    fails("environment", "none.exr", "--check", "--json", "none/a.json", says="none/a.json")


def test_validation_finds_no_fault():
    succeeds("environment", LAMPS, "--face", "16", "--check", "--directions", "16",
             "--validation")


if __name__ == "__main__":
    sys.exit(tap.run(globals(), under_sanitizers=(
        test_levels_are_listed, test_cube_is_written, test_a_cube_is_kept_for_the_next_time,
        test_a_folder_that_cannot_keep_it_is_no_failure, test_kept_in_the_users_folder, test_check,
        test_even_light_is_kept_by_every_method, test_lobes_between_levels, test_wrong_usage,
        test_broken_and_missing_files, test_outputs_are_tried_before_work)))
