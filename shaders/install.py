#!/usr/bin/env python3
"""Installs the GLSL that shaders of hosts include, below the folder that they give to their
compiler: what shaders/lobe/ needs, not the passes. Run by meson install.

Usage: install.py FOLDER, relative to the installation's prefix"""

import os
import shutil
import sys
from pathlib import Path

FOLDERS = ("environment", "filters", "interface", "lib", "lobe", "shading")


def main():
    source = Path(__file__).resolve().parent
    target = Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"]) / sys.argv[1]
    for path in sorted(path for folder in FOLDERS for path in (source / folder).rglob("*")):
        if path.suffix in (".glsl", ".h"):
            place = target / path.relative_to(source)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, place)


if __name__ == "__main__":
    main()
