#!/usr/bin/env python3
"""Checks includes: a folder may include only what is below it; Vulkan stays inside engine/ and out
of reach of the folders in ROOMS; a folder in STRATA includes only those before it; the folders in
ACYCLIC have no cycle of includes; what a filter has in its own folder stays there. Checks
allocations: in the library, everything except one file uses the host's allocator. Prints each line
that breaks a rule and fails if there is one. Also fails if it does not find the errors in a small
tree that breaks each rule."""

import re
import sys
import tempfile
from pathlib import Path

# What a folder's files may include, besides headers of the system and of other libraries. "public"
# means only the headers under <folder>/include.
ALLOWED = {
    "third_party": {"third_party"},
    "shaders": {"shaders"},
    "engine": {"engine", "third_party"},
    "scenes": {"scenes", "engine public", "third_party"},
    "passes": {"passes", "scenes public", "engine public", "shaders"},
    "tools": {"tools", "passes", "scenes", "engine", "shaders", "third_party"},
}
# Headers of libraries that only some folders may use.
OWNED = {
    re.compile(r"vulkan/"): {"engine"},
    re.compile(r"spirv_cross/(?!spirv\.hpp)|glslang/"): {"engine"},
    re.compile(r"spirv_cross/spirv\.hpp"): {"third_party"},  # only SPIR-V's numbers
    re.compile(r"openexr"): {"engine"},
    re.compile(r"tiny_gltf|jpeglib\.h|zlib\.h"): {"third_party"},
    re.compile(r"png\.h"): {"engine", "third_party"},
}

# Folders that may include less than the rest of their library: only these folders, and no header of
# Vulkan, neither directly nor through our own headers.
ROOMS = {"engine/graph/plan": ("engine/graph/plan/", "engine/base/", "engine/include/")}
# Folders in which no file may include itself through others. A header and its source count as one.
ACYCLIC = ("engine/", "passes/", "scenes/", "tools/")
# Folders of which each may include headers of those before it alone.
STRATA = ("passes/upload/", "passes/context/", "passes/maps/", "passes/displacement/",
          "passes/environment/", "passes/filters/", "passes/own_shading/", "passes/renderer/")
# What a filter has in its own folder is private to it.
PRIVATE = ("passes/filters/lobes/", "passes/filters/moments/")
VULKAN = re.compile(r"vulkan/|vk_\w+\.h|volk\.h")

# Functions of the C library that allocate or free memory, and where they may be called.
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


def included_file(root, path, quote, name, public):
    """The file of the tree that an include reaches; None for the system and libraries."""
    if name in public:
        return f"{public[name]}/include/{name}"
    if quote == '"' and (path.parent / name).exists():
        name = (path.parent / name).resolve().relative_to(root).as_posix()
    return name if (root / name).exists() and name.split("/")[0] in ALLOWED else None


def target_of(root, path, quote, name, public):
    """The part of the tree that an include refers to; None for the system and libraries."""
    if name in public:
        return f"{public[name]} public"
    file = included_file(root, path, quote, name, public)
    return file.split("/")[0] if file else None


def allowed(folder, target):
    if target is None or target.split()[0] == folder:
        return True
    return target in ALLOWED[folder] or target.split()[0] in ALLOWED[folder]


def breaks_ownership(folder, name):
    return any(pattern.match(name) and folder not in owners for pattern, owners in OWNED.items())


def way_to_vulkan(root, path, public, seen):
    """The files through which `path` includes a header of Vulkan, ending with that header; None if
    it includes none."""
    for quote, name in INCLUDE.findall(path.read_text()):
        if VULKAN.match(name):
            return [name]
        file = included_file(root, path, quote, name, public)
        if file and file not in seen:
            seen.add(file)
            way = way_to_vulkan(root, root / file, public, seen)
            if way:
                return [file, *way]
    return None


def check_room(root, path, public):
    """What a file includes that its room does not allow."""
    relative = path.relative_to(root).as_posix()
    faults = []
    for room, allowed_folders in ROOMS.items():
        if not relative.startswith(room + "/"):
            continue
        for quote, name in INCLUDE.findall(path.read_text()):
            file = included_file(root, path, quote, name, public)
            if file and not file.startswith(allowed_folders):
                faults.append(f"{relative} includes {name}: {room}/ may not know it")
        way = way_to_vulkan(root, path, public, set())
        if way:
            faults.append(f"{relative} includes {' -> '.join(way)}: {room}/ knows no Vulkan")
    return faults


def check_private(relative, text):
    """Headers that belong to others, among what a file of the library includes."""
    forbidden = [folder for folder in PRIVATE if not relative.startswith(folder)]
    for place, folder in enumerate(STRATA):
        forbidden += STRATA[place + 1:] if relative.startswith(folder) else ()
    return [f"{relative} includes {name}: it may not know {folder}"
            for _, name in INCLUDE.findall(text) for folder in forbidden if name.startswith(folder)]


def include_graph(root, paths, public):
    """For each file of the tree, without its suffix, those that it includes."""
    graph = {}
    for path in paths:
        unit = path.relative_to(root).with_suffix("").as_posix()
        files = [included_file(root, path, quote, name, public)
                 for quote, name in INCLUDE.findall(path.read_text())]
        graph.setdefault(unit, set()).update(
            Path(file).with_suffix("").as_posix() for file in files if file)
        graph[unit].discard(unit)
    return graph


def way_back(graph, unit):
    """The files through which `unit` includes itself; None if it does not."""
    ways, seen = [[unit]], set()
    for way in ways:  # grows meanwhile
        for following in sorted(graph.get(way[-1], ())):
            if following == unit:
                return way
            if following not in seen:
                seen.add(following)
                ways.append([*way, following])
    return None


def check_cycles(graph):
    ways = [way_back(graph, unit) for unit in sorted(graph) if unit.startswith(ACYCLIC)]
    return [f"{way[0]} includes itself: {' -> '.join([*way, way[0]])}" for way in ways if way]


def check_memory(relative, text):
    if relative.split("/")[0] not in HEAP_FOLDERS or relative in HEAP_FILES:
        return []
    return [f"{relative} calls {found.strip('( ')}: memory comes from lobe/allocator.h"
            for found in HEAP.findall(COMMENT.sub("", text))]


def check_file(root, path, public):
    relative = path.relative_to(root).as_posix()
    folder = relative.split("/")[0]
    text = path.read_text()
    faults = (check_memory(relative, text) + check_room(root, path, public) +
              check_private(relative, text))
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


def check_tree(root):
    """The faults of all files, and how many files there are."""
    public = public_folders(root)
    paths = [path for folder in ALLOWED for path in sorted((root / folder).rglob("*"))
             if path.suffix in SUFFIXES]
    faults = [fault for path in paths for fault in check_file(root, path, public)]
    return faults + check_cycles(include_graph(root, paths, public)), len(paths)


# A tree for the check of the check: files, and the rule that each breaks (None: no rule).
FAULTY = {
    "engine/include/lobe/graph.h": ("#include <stdint.h>", None),
    "engine/include/lobe/vulkan.h": ("#include <vulkan/vulkan.h>", None),
    "engine/include/lobe/device.h": ("#include <vulkan/vulkan.h>", "public headers speak"),
    "engine/base/arena.h": ("#include <lobe/graph.h>", None),
    "engine/base/hidden.h": ("#include <lobe/vulkan.h>", None),
    "engine/resource/memory.h": ("#include <stdint.h>", None),
    "engine/graph/plan/good.c": ('#include "engine/base/arena.h"', None),
    "engine/graph/plan/direct.c": ("#include <vulkan/vulkan.h>", "knows no Vulkan"),
    "engine/graph/plan/through.c": ('#include "engine/base/hidden.h"', "knows no Vulkan"),
    "engine/graph/plan/outside.c": ('#include "engine/resource/memory.h"', "may not know it"),
    "engine/graph/plan/memory.c": ("void *taken(void) { return malloc(1); }", "calls malloc"),
    "engine/graph/cycle.c": ('#include "engine/graph/store/tie.h"', "includes itself"),
    "engine/graph/cycle.h": ("#include <stdint.h>", None),
    "engine/graph/store/tie.h": ('#include "engine/graph/cycle.h"', "includes itself"),
    "passes/filters/lobes/part.h": ("#include <stdint.h>", None),
    "passes/filters/lobes/whole.c": ('#include "passes/filters/lobes/part.h"', None),
    "passes/renderer/curious.c": ('#include "passes/filters/lobes/part.h"', "may not know passes/"),
    "passes/upload/curious.c": ('#include "passes/maps/map.h"', "may not know passes/maps/"),
    "passes/upward.c": ('#include "engine/resource/memory.h"', "may not know engine"),
    "passes/vulkan.c": ("#include <vulkan/vulkan.h>", "not for passes/"),
}


def check_itself():
    """Compares the faults found in FAULTY with those that are there."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder).resolve()
        for name, (text, _) in FAULTY.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text + "\n")
        faults, _ = check_tree(root)
    wrong = []
    for name, (_, rule) in FAULTY.items():
        subject = Path(name).with_suffix("").as_posix() if rule == "includes itself" else name
        found = [fault for fault in faults if fault.startswith(subject + " ")]
        if len(found) != (rule is not None) or (rule and rule not in found[0]):
            wrong.append(f"layering.py itself: {name} should break '{rule}': {found}")
    return wrong


def main():
    faults, count = check_tree(Path(sys.argv[1]).resolve())
    faults += check_itself()
    print("\n".join(faults) if faults else f"{count} files follow the rules")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
