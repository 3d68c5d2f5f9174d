#!/usr/bin/env python3
"""Checks that all C and C++ has the layout of .clang-format.

Usage: formatting.py ROOT CLANG-FORMAT"""

import subprocess
import sys
from pathlib import Path

FOLDERS = ("engine", "scenes", "passes", "tools", "tests", "third_party", "shaders")
SUFFIXES = {".c", ".h", ".cpp", ".hpp"}


def main():
    root, program = Path(sys.argv[1]), sys.argv[2]
    files = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*"))
             if path.suffix in SUFFIXES]
    done = subprocess.run([program, "--dry-run", "-Werror", *map(str, files)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    print(done.stdout, end="")
    print(f"{len(files)} files checked")
    return 1 if done.returncode or not files else 0


if __name__ == "__main__":
    sys.exit(main())
