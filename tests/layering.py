#!/usr/bin/env python3
"""Checks who includes whom: a folder may include only what stands below it, and Vulkan stays inside
engine/. And who takes memory: in the library, only what gives it to all others, from the host's
allocator. Prints each line that breaks a rule; fails where there is one."""

import re
import sys
from pathlib import Path

# What a folder's files may include, besides the system's and other libraries' headers. A public
# entry means the headers under <folder>/include alone.
ALLOWED = {
    "third_party": {"third_party"},
    "shaders": {"shaders"},
    "engine": {"engine", "third_party"},
    "scenes": {"scenes", "engine public", "third_party"},
    "passes": {"passes", "scenes public", "engine public", "shaders"},
    "tools": {"tools", "passes", "scenes", "engine", "shaders", "third_party"},
}
# Headers of libraries that some folders alone may use.
OWNED = {
    re.compile(r"vulkan/"): {"engine"},
    re.compile(r"spirv_cross/|glslang/"): {"engine"},
    re.compile(r"openexr"): {"engine"},
    re.compile(r"tiny_gltf|jpeglib\.h|zlib\.h"): {"third_party"},
    re.compile(r"png\.h"): {"engine", "third_party"},
}

# Functions of the C library that give memory, or take it back; and where they may be called.
HEAP = re.compile(r"\b(?:malloc|calloc|realloc|reallocarray|free|strdup|strndup|asprintf|vasprintf|"
                  r"open_memstream|getline|getdelim|aligned_alloc|posix_memalign)\s*\(|"
                  r"\brealpath\s*\([^;]*, NULL\)")
HEAP_FOLDERS = {"engine", "scenes", "passes"}
HEAP_FILES = {"engine/base/allocator.c"}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)

SUFFIXES = {".c", ".h", ".cpp", ".hpp", ".vert", ".frag", ".comp", ".glsl"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def public_folders(root):
    """Maps each public header ("lobe/device.h") to its folder."""
    return {path.relative_to(root / folder / "include").as_posix(): folder
            for folder in ALLOWED for path in (root / folder / "include").rglob("*.h")}


def target_of(root, path, quote, name, public):
    """The part of the tree that an include reaches; None for the system and libraries."""
    if name in public:
        return f"{public[name]} public"
    if quote == '"' and (path.parent / name).exists():
        name = (path.parent / name).resolve().relative_to(root).as_posix()
    folder = name.split("/")[0]
    return folder if (root / name).exists() and folder in ALLOWED else None


def allowed(folder, target):
    if target is None or target.split()[0] == folder:
        return True
    return target in ALLOWED[folder] or target.split()[0] in ALLOWED[folder]


def breaks_ownership(folder, name):
    return any(pattern.match(name) and folder not in owners for pattern, owners in OWNED.items())


def check_memory(relative, text):
    if relative.split("/")[0] not in HEAP_FOLDERS or relative in HEAP_FILES:
        return []
    return [f"{relative} calls {found.strip('( ')}: memory comes from lobe/allocator.h"
            for found in HEAP.findall(COMMENT.sub("", text))]


def check_file(root, path, public):
    relative = path.relative_to(root).as_posix()
    folder = relative.split("/")[0]
    text = path.read_text()
    faults = check_memory(relative, text)
    for quote, name in INCLUDE.findall(text):
        target = target_of(root, path, quote, name, public)
        if not allowed(folder, target):
            faults.append(f"{relative} includes {name}: {folder}/ may not know {target}")
        if breaks_ownership(folder, name):
            faults.append(f"{relative} includes {name}: that library is not for {folder}/")
        if "/include/" in relative and name.startswith("vulkan/") and not \
                relative.endswith("lobe/vulkan.h"):
            faults.append(f"{relative} includes {name}: public headers speak of Vulkan in "
                          "lobe/vulkan.h only")
    return faults


def main():
    root = Path(sys.argv[1]).resolve()
    public = public_folders(root)
    faults, count = [], 0
    for folder in ALLOWED:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SUFFIXES:
                faults += check_file(root, path, public)
                count += 1
    print("\n".join(faults) if faults else f"{count} files keep to the table")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
