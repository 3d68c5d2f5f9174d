#!/usr/bin/env python3
"""Checks that the test of nonsense calls every public function. Lists those it does not call and
fails if there is one.

Usage: nonsense.py ROOT"""

import re
import sys
from pathlib import Path

TEST = "tests/passes/renderer/errors/test_nonsense.c"
DECLARATION = re.compile(r"LOBE_API\b[^;]*?\b(lobe_\w+)\([^;]*;")


def main():
    root = Path(sys.argv[1]).resolve()
    functions = {name for folder in ("engine", "scenes", "passes")
                 for header in (root / folder / "include").rglob("*.h")
                 for name in DECLARATION.findall(header.read_text())}
    called = set(re.findall(r"\b(lobe_\w+)\(", (root / TEST).read_text()))
    missing = sorted(functions - called)
    print("\n".join(f"{TEST} does not call {name}" for name in missing)
          or f"{len(functions)} public functions, all called with nonsense")
    return 1 if missing or not functions else 0


if __name__ == "__main__":
    sys.exit(main())
