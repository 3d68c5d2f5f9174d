#!/usr/bin/env python3
"""Compiles each public header on its own, with all values that it defines, as C17, C++11 and C++17,
pedantically; and checks that lobe/lobe.h includes them.

Usage: public_headers.py ROOT C-COMPILER... -- C++-COMPILER..."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
# A macro without parameters whose text is a value, not an attribute.
VALUE = re.compile(r"^ *# *define (LOBE_\w+)[ \t]+(?!__attribute__)\S", re.MULTILINE)
# Needs Vulkan's headers.
SEPARATE = {"lobe/lobe.h", "lobe/vulkan.h"}


def missing_headers(headers):
    """Those that lobe/lobe.h should include and does not, or the other way round."""
    included = set(re.findall(r"#include <(lobe/.*)>", headers["lobe/lobe.h"]))
    return sorted(included ^ (set(headers) - SEPARATE))


def program(header, text):
    """Includes the header twice, so that a missing include guard shows, and uses its values."""
    uses = "".join(f"    (void)({name});\n" for name in VALUE.findall(text))
    return (f"#include <{header}>\n#include <{header}>\n"
            f"int use_all(void);\nint use_all(void) {{\n{uses}    return 0;\n}}\n")


def compile_program(compiler, language, standard, includes, text, scratch):
    """The compiler's output; "" if it compiles."""
    source = Path(scratch) / ("header.cpp" if language == "c++" else "header.c")
    source.write_text(text)
    command = [*compiler, "-x", language, f"-std={standard}", *WARNINGS, *includes,
               "-c", str(source), "-o", str(Path(scratch) / "header.o")]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout if done.returncode else ""


def main():
    root = Path(sys.argv[1])
    split = sys.argv.index("--")
    c_compiler, cpp_compiler = sys.argv[2:split], sys.argv[split + 1:]
    compilers = [(c_compiler, "c", "c17"), (cpp_compiler, "c++", "c++11"),
                 (cpp_compiler, "c++", "c++17")]
    folders = [folder for folder in sorted(root.glob("*/include")) if folder.is_dir()]
    includes = [f"-I{folder}" for folder in folders]
    headers = {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
               for folder in folders for path in sorted(folder.rglob("*.h"))}
    missing = missing_headers(headers)
    if missing:
        print(f"lobe/lobe.h includes other headers than it should: {missing}")
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        for header, text in headers.items():
            for compiler, language, standard in compilers:
                complaints = compile_program(compiler, language, standard, includes,
                                             program(header, text), scratch)
                if complaints:
                    failed += 1
                    print(f"{header} as {standard}:\n{complaints}")
    print(f"{len(headers)} headers, {failed} failures")
    return 1 if failed or missing or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
