#!/usr/bin/env python3
"""Checks that no folder contains more files than a reader can take in at a glance. Files in
subfolders do not count. Lists the folders that hold too many and fails if there is one.

Usage: rooms.py ROOT"""

import sys
from pathlib import Path

MOST_FILES = 26
FOLDERS = ("docs", "engine", "passes", "scenes", "shaders", "tests", "third_party", "tools")


def folders_in(root):
    for top in FOLDERS:
        yield from (folder for folder in (root / top, *sorted((root / top).rglob("*")))
                    if folder.is_dir() and folder.name != "__pycache__")


def main():
    root = Path(sys.argv[1]).resolve()
    counts = {folder.relative_to(root).as_posix(): sum(path.is_file() for path in folder.iterdir())
              for folder in folders_in(root)}
    faults = [f"{folder}/ holds {count} files; the limit is {MOST_FILES}"
              for folder, count in counts.items() if count > MOST_FILES]
    print("\n".join(faults) if faults else f"{len(counts)} folders, none above {MOST_FILES} files")
    return 1 if faults or not counts else 0


if __name__ == "__main__":
    sys.exit(main())
