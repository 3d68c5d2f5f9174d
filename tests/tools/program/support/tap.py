"""Runs test cases written in Python and prints their results as TAP."""

import sys
import traceback


def run(module):
    """Runs all functions of a module (its globals()) whose names start with "test_", in the order
    of their definition. Returns the exit status."""
    cases = [(name, value) for name, value in module.items() if name.startswith("test_")]
    print(f"1..{len(cases)}", flush=True)
    failed = 0
    for number, (name, function) in enumerate(cases, start=1):
        try:
            reason = function()
            skip = f" # SKIP {reason}" if reason else ""
            print(f"ok {number} - {name}{skip}", flush=True)
        except Exception:  # any exception is a failed case, and the next one runs
            failed += 1
            print(f"not ok {number} - {name}")
            for line in traceback.format_exc().splitlines():
                print(f"# {line}")
            sys.stdout.flush()
    return 1 if failed else 0
