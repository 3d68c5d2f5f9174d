#!/usr/bin/env python3
"""Checks the documents against the tree: the files that they link to or name exist, and code that
they quote appears word for word in the file named above it.

Usage: documentation.py ROOT"""

import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
# `passes/filters/toksvig.c`, one of our folders first
NAMED = re.compile(r"`((?:engine|scenes|passes|shaders|tools|tests|docs|third_party)/[\w./-]*)`")
QUOTE = re.compile(r"```(?:c|glsl)\n(.*?)```", re.DOTALL)


def broken_links(document, text):
    return [f"links to {target}" for target in LINK.findall(text)
            if not (document.parent / target).exists()]


def missing_files(root, text):
    return [f"names {name}" for name in NAMED.findall(text) if not (root / name).exists()]


def wrong_quotes(root, text):
    """A quote is from the last file named before it. Complete programs are not quotes."""
    faults = []
    for match in QUOTE.finditer(text):
        code, before = match[1], NAMED.findall(text[:match.start()])
        if "main(void) {" in code and "#include <lobe/" in code:
            continue
        name = next((name for name in reversed(before) if (root / name).is_file()), None)
        if not name or code.strip("\n") not in (root / name).read_text():
            faults.append(f"quotes {name} wrongly:\n{code}")
    return faults


def main():
    root = Path(sys.argv[1])
    documents = [*root.glob("*.md"), *sorted((root / "docs").glob("*.md"))]
    faults = []
    for document in documents:
        text = document.read_text(encoding="utf-8")
        faults += [f"{document.relative_to(root)} {fault}" for fault in
                   (*broken_links(document, text), *missing_files(root, text),
                    *wrong_quotes(root, text))]
    print("\n".join(faults) if faults else f"{len(documents)} documents agree with the tree")
    return 1 if faults or not documents else 0


if __name__ == "__main__":
    sys.exit(main())
