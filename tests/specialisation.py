#!/usr/bin/env python3
"""Checks that no two specialisation constants have the same identifier: a shader that includes both
would set one when it sets the other.

Usage: specialisation.py ROOT"""

import re
import sys
from pathlib import Path

DEFINED = re.compile(r"#define (SPECIALISE_\w+)\s*(?:\\\n)?\s*"
                     r"(?:SPECIALISE\((\d+)\)|\((SPECIALISE_\w+) \+ (\d+)\))")


def constants_in(folder):
    """Name, the constant that the number is counted from or '', the number."""
    for path in sorted(folder.rglob("*")):
        if path.suffix in (".h", ".glsl"):
            for name, number, base, offset in DEFINED.findall(path.read_text(encoding="utf-8")):
                yield name, base, int(number or offset)


def main():
    constants = list(constants_in(Path(sys.argv[1]) / "shaders"))
    numbers = {name: number for name, base, number in constants if not base}
    names = {}
    for name, base, number in constants:
        names.setdefault(number + (numbers[base] if base else 0), []).append(name)
    # The first of the filters' own is counted from, and none itself.
    faults = [f"{number}: {', '.join(same)}" for number, same in sorted(names.items())
              if len(same) > 1 and "SPECIALISE_FILTER" not in same]
    print("\n".join(faults) if faults else f"{len(names)} identifiers, all different")
    return 1 if faults or not names else 0


if __name__ == "__main__":
    sys.exit(main())
