#!/usr/bin/env python3
"""Counts the test cases in Meson's logs and prints one line, "N passed, N failed". A program that
prints TAP counts once per case, any other as one case. A program that crashes, or reports fewer
cases than planned, has at least one failure. Before that line it names the programs that took the
most processor time. Exits with 1 if a case failed or none ran."""

import json
import re
import sys

RESULT = re.compile(r"^(not ok|ok)\b([^#]*)(?:#\s*(\w+))?", re.IGNORECASE)
PROCESSOR_TIME = re.compile(r"^# processor time: (\d+\.\d+)$", re.MULTILINE)
SLOWEST = 10
PLAN = re.compile(r"^1\.\.(\d+)")


def count_cases(text):
    """Returns how many cases of a TAP text passed, failed and were skipped, and how many were
    planned."""
    passed = failed = skipped = planned = 0
    for line in text.splitlines():
        plan, result = PLAN.match(line), RESULT.match(line)
        if plan:
            planned += int(plan[1])
        elif result and (result[3] or "").upper().startswith("SKIP"):
            skipped += 1
        elif result and result[1].lower() == "ok":
            passed += 1
        elif result:
            failed += 1
    return passed, failed, skipped, planned


def count_program(entry):
    """Returns passed and failed cases of one program of the log."""
    passed, failed, skipped, planned = count_cases(entry.get("stdout") or "")
    good = entry["result"] in ("OK", "EXPECTEDFAIL")
    if passed + failed + skipped == 0:
        return (0, 0) if entry["result"] == "SKIP" else (int(good), int(not good))
    lost = passed + failed + skipped < planned
    if (lost or (not good and entry["result"] != "SKIP")) and failed == 0:
        failed = 1
    return passed, failed


def processor_time(entry):
    """Seconds that one program took, as tests/run_test.py measured them; 0 if it did not."""
    times = PROCESSOR_TIME.findall(entry.get("stdout") or "")
    return float(times[-1]) if times else 0


def print_slowest(times):
    """Prints the sum of (seconds, name), and the largest."""
    if sum(seconds for seconds, _ in times) == 0:
        return
    print(f"{sum(seconds for seconds, _ in times):.0f} s of processor time, the most in:")
    for seconds, name in sorted(times, reverse=True)[:SLOWEST]:
        print(f"{seconds:8.1f} s  {name}")


def main():
    passed = failed = 0
    times = []
    for path in sys.argv[1:]:
        try:
            with open(path, encoding="utf-8") as log:
                entries = [json.loads(line) for line in log if line.strip()]
        except OSError as error:
            print(f"{path}: {error.strerror}: its tests did not run", file=sys.stderr)
            entries = []
        if not entries:
            failed += 1
        for entry in entries:
            times.append((processor_time(entry), entry["name"]))
            one_passed, one_failed = count_program(entry)
            passed, failed = passed + one_passed, failed + one_failed
            if one_failed:
                print(f"failed: {entry['name']}: {one_failed} of {one_passed + one_failed}",
                      file=sys.stderr)
    print_slowest(times)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
