#!/usr/bin/env python3
"""Checks that all C and C++ has the layout of .clang-format, and that what clang-format does not
know (shaders, Python, Meson) has no longer lines than that.

Usage: formatting.py ROOT CLANG-FORMAT"""

import subprocess
import sys
from pathlib import Path

FOLDERS = ("engine", "scenes", "passes", "tools", "tests", "third_party", "shaders")
SUFFIXES = {".c", ".h", ".cpp", ".hpp"}
OTHERS = {".glsl", ".vert", ".frag", ".comp", ".py", ".build"}
LONGEST_LINE = 100


def find_files(root, suffixes):
    return [path for folder in FOLDERS for path in sorted((root / folder).rglob("*"))
            if path.suffix in suffixes]


def long_lines(root):
    return [f"{path}:{number}: {len(line)} characters, more than {LONGEST_LINE}"
            for path in find_files(root, OTHERS)
            for number, line in enumerate(path.read_text().splitlines(), start=1)
            if len(line) > LONGEST_LINE]


def main():
    root, program = Path(sys.argv[1]), sys.argv[2]
    files, faults = find_files(root, SUFFIXES), long_lines(root)
    done = subprocess.run([program, "--dry-run", "-Werror", *map(str, files)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    print(done.stdout, end="")
    print("\n".join(faults))
    print(f"{len(files)} files checked")
    return 1 if done.returncode or faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
