"""The Debian packages, unpacked: their contents and dependencies, whether the program renders, and
whether an example builds with them and runs. tools/package runs it, because it needs its own build.

Usage: packages.py PROGRAM ROOT FOLDER; the packages are in FOLDER, unpacked in FOLDER/unpacked"""

import re
import subprocess
import sys
from pathlib import Path

import tap
from files import png_read
from program import FOLDER, ROOT, check, report, succeeds

PACKAGES = Path(sys.argv[3]).resolve()
UNPACKED = PACKAGES / "unpacked"


def run(command, **environment):
    result = subprocess.run(command, env={"PATH": "/usr/bin:/bin", **environment}, text=True,
                            check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    check(result.returncode == 0, f"{' '.join(map(str, command))}\n{result.stdout}")
    return result.stdout


def package(name):
    found = list(PACKAGES.glob(f"{name}_*.deb"))
    check(len(found) == 1, f"{name}: {found}")
    return found[0]


def libraries():
    """The folder of the shared library."""
    return next(UNPACKED.rglob("liblobe.so.0")).parent


def test_versions_agree():
    version = re.search(r"version: '([^']+)'", (ROOT / "meson.build").read_text())[1]
    for name in ("liblobe0", "liblobe-dev", "lobe-tools"):
        check(run(["dpkg-deb", "--field", package(name), "Version"]).strip() == version, name)


def test_libraries_are_depended_on():
    for name in ("liblobe0", "lobe-tools"):
        depends = run(["dpkg-deb", "--field", package(name), "Depends"])
        for library in ("libvulkan1", "libopenexr", "libspirv-cross-c-shared", "libc6"):
            check(library in depends, f"{name}: {depends}")
    check("liblobe0 (= " in run(["dpkg-deb", "--field", package("liblobe-dev"), "Depends"]), "dev")


def test_each_file_is_where_it_belongs():
    for name, pattern in (("liblobe0", r"/liblobe\.so\.0$"), ("liblobe-dev", r"/lobe/lobe\.h$"),
                          ("liblobe-dev", r"/lobe/moments\.glsl$"),
                          ("lobe-tools", r"/libexec/lobe/lobe-report$")):
        paths = [line.split()[5] for line in
                 run(["dpkg-deb", "--contents", package(name)]).splitlines()]
        check(any(re.search(pattern, path) for path in paths), f"{name}: {paths}")
        other = [path for path in paths if "/bin/" in path and name != "lobe-tools"]
        check(not other, other)


def test_how_to_embed_comes_along():
    folder = UNPACKED / "usr/share/doc/liblobe-dev"
    for name in ("docs/embed.md", "tools/examples/host_device.c", "docs/pictures/appearance.jpg"):
        check((folder / name).exists(), name)


def test_program_renders():
    picture = FOLDER / "picture.png"
    result = succeeds("render", "bumps", "--size", "32x24", "-o", picture)
    width, height, pixels = png_read(picture)
    check((width, height) == (32, 24) and len(set(pixels)) > 10, report(result))


def test_example_is_built_and_runs():
    example = FOLDER / "example.c"
    text = (ROOT / "docs/embed.md").read_text()
    example.write_text(re.search(r"```c\n(.*?)```", text, re.DOTALL)[1])
    pkgconfig = next(UNPACKED.rglob("lobe.pc")).parent
    flags = run(["pkg-config", "--cflags", "--libs", "lobe"], PKG_CONFIG_PATH=str(pkgconfig),
                PKG_CONFIG_SYSROOT_DIR=str(UNPACKED)).split()
    check(any(str(UNPACKED) in flag for flag in flags), flags)
    run(["cc", "-std=c17", "-Werror", example, "-o", FOLDER / "example", *flags])
    run([FOLDER / "example"], LD_LIBRARY_PATH=str(libraries()))


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
