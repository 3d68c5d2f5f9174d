#!/usr/bin/env python3
"""Checks the names of the library. The shared library exports what the public headers declare and
refers to no function of Vulkan; in each of the static libraries that it consists of, every external
name has that library's prefix, so that it does not collide with a host's names.

Usage: symbols.py ROOT NM SHARED-LIBRARY (PREFIX STATIC-LIBRARY)..."""

import re
import subprocess
import sys
from pathlib import Path

ROOT, NM, SHARED = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
PARTS = list(zip(sys.argv[4::2], sys.argv[5::2]))


def names(*command):
    lines = subprocess.run([NM, *command], check=True, text=True, stdout=subprocess.PIPE).stdout
    return {line.split()[-1].split("@")[0] for line in lines.splitlines()
            if re.search(r" [A-Za-z] ", line)}


def check_exports():
    headers = "".join(path.read_text() for path in ROOT.glob("*/include/lobe/*.h"))
    code = re.sub(r"//[^\n]*", "", headers)
    functions = set(re.findall(r"\b(lobe_\w+)\(", code))
    marked = set(re.findall(r"\bLOBE_API\b[^;(]*?\b(lobe_\w+)\(", code))
    exported = names("--dynamic", "--defined-only", SHARED)
    return [*(f"{name} is declared without LOBE_API" for name in sorted(functions - marked)),
            *(f"{name} is declared, but not exported" for name in sorted(functions - exported)),
            *(f"{name} is exported, but not declared" for name in sorted(exported - functions))]


def check_vulkan():
    used = names("--dynamic", "--undefined-only", SHARED)
    return [f"{name} is called by name: it belongs in engine/device/vulkan_functions.h"
            for name in sorted(used) if re.match(r"vk[A-Z]", name)]


def check_prefixes(prefix, library):
    """C++ names cannot collide with C names."""
    allowed = re.compile(rf"{prefix}_|lobe_|_Z|DW\.ref\.")
    defined = names("--defined-only", "--extern-only", library)
    faults = [f"{Path(library).name}: {name} lacks the prefix {prefix}_"
              for name in sorted(defined) if not allowed.match(name)]
    return faults if defined else [f"{library} is empty"]


def main():
    faults = check_exports() + check_vulkan()
    for prefix, library in PARTS:
        faults += check_prefixes(prefix, library)
    print("\n".join(faults) if faults else "all names are as they should be")
    return bool(faults) or not PARTS


if __name__ == "__main__":
    sys.exit(main())
