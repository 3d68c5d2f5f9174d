"""Compares pictures of the known scenes with the approved ones in tests/golden. Drivers round
differently: the pictures are lavapipe's, with the Mesa version in tests/golden/driver.txt, and are
compared only there. After an intended change, look at the new pictures, then replace the old ones
with `test_golden.py PROGRAM ROOT --write`."""

import json
import sys

import tap
from program import FOLDER, ROOT, check, report, succeeds

GOLDEN = ROOT / "tests" / "golden"
SCENES = ["checkerboard", "bumps", "tablecloth", "pillow", "hall"]
FILTERS = ["direct", "mipmap", "toksvig", "lobes"]
# Relative L2 of linear radiance. Half floats round to 5e-4 at most; one texel of a wrong layer or
# level moves these small pictures by 1e-2 and more.
TOLERANCE = 1e-3


def driver():
    lines = succeeds("info", "--device", "llvmpipe").stdout.splitlines()
    return next(line.split(None, 1)[1] for line in lines if line.split()[:1] == ["driver"])


def render(scene, name, picture):
    succeeds("render", scene, "--filter", name, "--size", "96x54", "--depth", "half", "-o", picture,
             "--device", "llvmpipe")


def compare(scene, name):
    picture = FOLDER / f"{scene}.{name}.exr"
    render(scene, name, picture)
    result = succeeds("compare", picture, GOLDEN / picture.name, "--json")
    found = json.loads(result.stdout)
    check(found["relative_l2"] <= TOLERANCE, f"{scene}, {name}: {report(result)}")


def test_pictures_are_as_they_were():
    stamped = (GOLDEN / "driver.txt").read_text().strip()
    if driver() != stamped:
        return f"the pictures are of {stamped}"
    for scene in SCENES:
        for name in FILTERS:
            compare(scene, name)


def write():
    (GOLDEN / "driver.txt").write_text(driver() + "\n")
    for scene in SCENES:
        for name in FILTERS:
            render(scene, name, GOLDEN / f"{scene}.{name}.exr")


if __name__ == "__main__":
    sys.exit(write() if "--write" in sys.argv else tap.run(globals()))
