#!/usr/bin/env python3
"""Checks how the tree is divided: no folder holds too many files, and no source files of engine/,
scenes/, passes/ and tools/ include each other in a cycle, where a source file and its header count
as one. Lists each crowded folder and each cycle.

Usage: rooms.py ROOT"""

import re
import sys
from pathlib import Path

MOST_FILES = 26
FOLDERS = ("docs", "engine", "passes", "scenes", "shaders", "tests", "third_party", "tools")
CODE = ("engine", "scenes", "passes", "tools")
SUFFIXES = {".c", ".h", ".cpp", ".hpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def crowded_folders(root):
    """Describes each folder with too many files in it; files in its subfolders do not count."""
    faults = []
    for top in FOLDERS:
        for folder in (root / top, *sorted((root / top).rglob("*"))):
            if not folder.is_dir() or folder.name == "__pycache__":
                continue
            count = sum(path.is_file() for path in folder.iterdir())
            if count > MOST_FILES:
                faults.append(f"{folder.relative_to(root)}/ holds {count} files; the limit is "
                              f"{MOST_FILES}")
    return faults


def unit_of(path):
    """A source file and its header form one unit: their common path without the suffix."""
    return path.with_suffix("").as_posix()


def include_graph(root):
    """Maps each unit to the other units that it includes."""
    graph = {}
    for top in CODE:
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in SUFFIXES:
                continue
            unit = unit_of(path.relative_to(root))
            targets = {unit_of(Path(name)) for name in INCLUDE.findall(path.read_text("utf-8"))
                       if name.split("/")[0] in CODE and (root / name).is_file()}
            graph.setdefault(unit, set()).update(targets - {unit})
    return graph


def cycles(graph):
    """The strongly connected components with more than one node (Tarjan 1972, Depth-First Search
    and Linear Graph Algorithms)."""
    order, lowest, stack, found = {}, {}, [], []

    def visit(node):
        order[node] = lowest[node] = len(order)
        stack.append(node)
        for target in graph.get(node, ()):
            if target not in order:
                visit(target)
                lowest[node] = min(lowest[node], lowest[target])
            elif target in stack:
                lowest[node] = min(lowest[node], order[target])
        if lowest[node] == order[node]:
            component = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(component) > 1:
                found.append(sorted(component))

    for node in graph:
        if node not in order:
            visit(node)
    return sorted(found)


def main():
    root = Path(sys.argv[1]).resolve()
    graph = include_graph(root)
    faults = crowded_folders(root)
    for cycle in cycles(graph):
        faults.append(f"{len(cycle)} files include each other:")
        faults += [f"    {name} -> {', '.join(sorted(graph[name] & set(cycle)))}" for name in cycle]
    print("\n".join(faults) if faults else
          f"{len(graph)} source files without a cycle, at most {MOST_FILES} files in a folder")
    return 1 if faults or not graph else 0


if __name__ == "__main__":
    sys.exit(main())
