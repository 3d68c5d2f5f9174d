#!/usr/bin/env python3
"""Checks that every fallible Vulkan function that the engine calls has a failing stand-in in the
tests (vulkan_faults.c).

Usage: vulkan_calls.py ROOT PROGRAM COMPILER...; PROGRAM is linked to vulkan_faults.c."""

import re
import subprocess
import sys
from pathlib import Path

ROOT, PROGRAM, COMPILER = Path(sys.argv[1]), sys.argv[2], sys.argv[3:]


def output_of(*command, text=None):
    return subprocess.run(command, input=text, text=True, check=True, stdout=subprocess.PIPE).stdout


def main():
    header = output_of(*COMPILER, "-E", "-x", "c", "-", text="#include <vulkan/vulkan.h>\n")
    fallible = set(re.findall(r"\bVkResult\s+(vk\w+)\s*\(", header))
    sources = [path.read_text() for path in sorted((ROOT / "engine").rglob("*.[ch]"))]
    called = set(re.findall(r"\bvk[A-Z]\w+", "".join(sources))) & fallible
    covered = set(re.findall(r" t fault_(vk\w+)", output_of("nm", PROGRAM)))
    missing = sorted(called - covered)
    print("1..1")
    print("ok" if len(called) > 30 and not missing else "not ok", "1 - each fails in a test")
    print(f"# {len(called)} functions that can fail; without one that does: {missing}")
    return len(called) <= 30 or bool(missing)


if __name__ == "__main__":
    sys.exit(main())
