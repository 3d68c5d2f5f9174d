#!/usr/bin/env python3
"""Makes one object of an installed static library and makes its hidden names local: names such as
`engine_image_create` are then free for the program that links with it.

Usage: hide_private_names.py STATIC-LIBRARY LD OBJCOPY AR
The library is relative to the prefix that Meson installs to."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    linker, objcopy, archiver = sys.argv[2:5]
    library = Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"]) / sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        whole, archive = Path(folder) / "lobe.o", Path(folder) / library.name
        # Dissolve COMDAT groups, which C++ shares between objects: the linker would discard ours in
        # favour of the host's, and with them names that are local from here on.
        subprocess.run([linker, "-r", "--force-group-allocation", "--whole-archive", library,
                        "-o", whole], check=True)
        # Templates of the C++ library are not hidden.
        subprocess.run([objcopy, "--localize-hidden", "--wildcard", "--localize-symbol=_Z*", whole],
                       check=True)
        subprocess.run([archiver, "rcsD", archive, whole], check=True)
        library.write_bytes(archive.read_bytes())


if __name__ == "__main__":
    main()
