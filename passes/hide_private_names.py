#!/usr/bin/env python3
"""Makes one object of an installed static library, in which only the names that the shared library
shows are global: names such as `shading` are then free for the program that links with it.

Usage: hide_private_names.py SHARED-LIBRARY STATIC-LIBRARY NM LD OBJCOPY AR
The static library is relative to the prefix that Meson installs to."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path


def public_names(nm, library):
    lines = subprocess.run([nm, "--dynamic", "--defined-only", library], check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    return [line.split()[-1].split("@")[0] for line in lines]


def main():
    shared, (nm, linker, objcopy, archiver) = Path(sys.argv[1]), sys.argv[3:7]
    static = Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"]) / sys.argv[2]
    with tempfile.TemporaryDirectory() as folder:
        whole, names = Path(folder) / "lobe.o", Path(folder) / "names"
        names.write_text("".join(f"{name}\n" for name in public_names(nm, shared)))
        # Groups that C++ shares between objects are dissolved: local names cannot stand for them.
        subprocess.run([linker, "-r", "--force-group-allocation", "--whole-archive", static,
                        "-o", whole], check=True)
        subprocess.run([objcopy, f"--keep-global-symbols={names}", whole], check=True)
        archive = Path(folder) / static.name
        subprocess.run([archiver, "rcsD", archive, whole], check=True)
        static.write_bytes(archive.read_bytes())


if __name__ == "__main__":
    main()
