"""Runs test cases written in Python and prints their results as TAP."""

import os
import sys
import traceback


def long_runs():
    """Whether cases run that take seconds and find little that others do not: `tools/test --long`
    sets LOBE_LONG_RUNS."""
    return "LOBE_LONG_RUNS" in os.environ


def sanitized():
    """Whether the program that is tested is the sanitizers' build."""
    return "LOBE_TEST_SANITIZERS" in os.environ


def some(values):
    """All as released; under sanitizers the first and the last, where the same code handles each:
    starting the program takes longest."""
    return [values[0], values[-1]] if sanitized() and not long_runs() else values


def run(module, under_sanitizers=None, long=()):
    """Runs all functions of a module (its globals()) whose names start with "test_", in the order
    of their definition. If `under_sanitizers` is given, each case runs in one of the two builds,
    which halves the time: these under sanitizers, the others, which run no C code that these do
    not, as released. Those of `long` run in long runs alone. Returns the exit status."""
    cases = [(name, value) for name, value in module.items() if name.startswith("test_")]
    if not long_runs():
        cases = [(name, value) for name, value in cases if value not in long]
    if under_sanitizers:
        cases = [(name, value) for name, value in cases
                 if (value in under_sanitizers) == sanitized()]
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
