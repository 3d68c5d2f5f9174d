#!/usr/bin/env python3
"""Runs a test program and passes its output on, with the skipped cases of cmocka 1.1 in TAP's form:
"ok 3 - name # SKIP", not "not ok 3 # SKIP name", which would count as a failure. Adds a comment
with the seconds of processor time that the program and its children took, which tests/summary.py
reads: unlike the time from start to end, they do not depend on what else runs."""

import re
import resource
import subprocess
import sys

SKIPPED = re.compile(rb"^not ok (\d+) # SKIP (.*)$")


def main():
    with subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE) as program:
        for line in program.stdout:
            sys.stdout.buffer.write(SKIPPED.sub(rb"ok \1 - \2 # SKIP", line))
            sys.stdout.buffer.flush()
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"# processor time: {usage.ru_utime + usage.ru_stime:.2f}")
    return program.returncode if program.returncode >= 0 else 128 - program.returncode


if __name__ == "__main__":
    sys.exit(main())
