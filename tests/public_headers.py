#!/usr/bin/env python3
"""Compiles each public header on its own, as C17 and as C++17, pedantically.

Usage: public_headers.py ROOT C-COMPILER... -- C++-COMPILER..."""

import subprocess
import sys
import tempfile
from pathlib import Path

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]


def compile_header(compiler, language, standard, includes, header, scratch):
    """The compiler's output for one header; "" if it compiles."""
    source = Path(scratch) / ("header.cpp" if language == "c++" else "header.c")
    # Twice, so that a missing include guard shows.
    source.write_text(f"#include <{header}>\n#include <{header}>\n"
                      "int nothing_else(void);\nint nothing_else(void) { return 0; }\n")
    command = [*compiler, "-x", language, f"-std={standard}", *WARNINGS, *includes,
               "-c", str(source), "-o", str(Path(scratch) / "header.o")]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout if done.returncode else ""


def main():
    root = Path(sys.argv[1])
    split = sys.argv.index("--")
    compilers = [(sys.argv[2:split], "c", "c17"), (sys.argv[split + 1:], "c++", "c++17")]
    folders = [folder for folder in sorted(root.glob("*/include")) if folder.is_dir()]
    includes = [f"-I{folder}" for folder in folders]
    headers = [path.relative_to(folder).as_posix()
               for folder in folders for path in sorted(folder.rglob("*.h"))]
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        for header in headers:
            for compiler, language, standard in compilers:
                complaints = compile_header(compiler, language, standard, includes, header, scratch)
                if complaints:
                    failed += 1
                    print(f"{header} as {standard}:\n{complaints}")
    print(f"{len(headers)} headers, {failed} failures")
    return 1 if failed or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
