#!/usr/bin/env python3
"""Compiles the GLSL passes of a folder to SPIR-V and writes a C table of them.

Each *.vert, *.frag and *.comp below the folder is a pass, named by its path
("maps/level_reduction.comp"). One that includes "filter.glsl" is compiled once for each file of
filters/, which replaces that include. A pass or a filter may name macros that it tests, in a line
"#pragma variants ENVIRONMENT AOV": it is compiled without and with each. shading/shading.frag and
filters/lobes.glsl give shading/shading_lobes.frag, shading/shading_lobes_environment.frag, and so
on. The table records the source of each entry, so that the library can recompile it at run time.

Compiled words are kept in a folder beside the output, from where the table includes them: only
shaders whose text, or that of a file they include, has changed are compiled again.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

STAGES = (".vert", ".frag", ".comp")
FILTER_INCLUDE = re.compile(r'^\s*#\s*include\s+"filter\.glsl"', re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
VARIANTS = re.compile(r"^\s*#\s*pragma\s+variants\s+(.*)$", re.MULTILINE)


@dataclass(frozen=True)
class Shader:
    name: str
    source: str
    definitions: tuple = ()
    substitute: str = ""


def definitions_of(text):
    """All sets of the macros that a text names."""
    sets = [()]
    for macro in " ".join(VARIANTS.findall(text)).split():
        sets += [(*others, macro) for others in sets]
    return sets


def variants(folder, path):
    """The shaders compiled from one source file."""
    text = path.read_text()
    filters = [("", "")]
    if FILTER_INCLUDE.search(text):
        filters = [(f"filters/{file.name}", file.read_text())
                   for file in sorted((folder / "filters").glob("*.glsl"))]
    source = path.relative_to(folder)
    found = []
    for substitute, filter_text in filters:
        for definitions in definitions_of(text + filter_text):
            words = [path.stem, *([Path(substitute).stem] if substitute else []),
                     *(word.lower() for word in definitions)]
            found.append(Shader(source.with_name("_".join(words) + path.suffix).as_posix(),
                                source.as_posix(), definitions, substitute))
    return found


@functools.lru_cache(maxsize=None)
def content_and_includes(path):
    """The digest of a file, and the names that it includes."""
    content = path.read_bytes()
    return hashlib.sha256(content).hexdigest(), INCLUDE.findall(content.decode())


def files_of(folders, shader):
    """All files that a shader may be compiled from, also those that a macro leaves out."""
    found, unread = set(), [folders[0] / shader.source]
    if shader.substitute:
        unread.append(folders[0] / shader.substitute)
    while unread:
        path = unread.pop()
        if path in found:
            continue
        found.add(path)
        # Every file of that name counts: so it does not matter which one the compiler takes.
        candidates = [Path(os.path.normpath(place / name))
                      for name in content_and_includes(path)[1]
                      for place in (path.parent, *folders)]
        unread += [candidate for candidate in candidates if candidate.is_file()]
    return sorted(found)


@functools.lru_cache(maxsize=None)
def content_digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def digest_of(tools, folders, shader):
    """Changes with whatever decides a shader's words. Each build has a compiler of its own, but
    they are the same bytes."""
    parts = [repr(shader), content_digest(tools.compiler)]
    parts += [os.path.relpath(path, folders[0]) for path in folders]
    parts += [f"{os.path.relpath(path, folders[0])} {content_and_includes(path)[0]}"
              for path in files_of(folders, shader)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def compile_shaders(tools, folders, outputs, shaders):
    """Compiles several shaders with one process. Raises with its own output if it fails."""
    command = [tools.compiler, *(str(folder) for folder in folders)]
    if len(folders) == 1:
        command.append("")
    for shader in shaders:
        command += [shader.name, shader.source, " ".join(shader.definitions), shader.substitute,
                    str(outputs[shader])]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stdout or f"{tools.compiler}: status {done.returncode}")


def compile_missing(tools, folders, missing):
    """Compiles the shaders whose words are not kept. `missing` maps them to where they will be.
    Raises one error with what all failures say."""
    processes = os.cpu_count()
    shares = [list(missing)[first::processes] for first in range(min(processes, len(missing)))]
    with concurrent.futures.ThreadPoolExecutor(processes) as pool:
        futures = [pool.submit(compile_shaders, tools, folders, missing, share)
                   for share in shares]
    failures = [str(future.exception()) for future in futures if future.exception()]
    if failures:
        raise RuntimeError("\n".join(failures))


def kept_folder(arguments):
    return arguments.output.with_name(arguments.output.name + ".words")


def remove_others(folder, kept):
    """Removes the words of former texts."""
    for path in folder.iterdir():
        if path not in kept:
            path.unlink()


def quoted(text):
    """As a string of C or of the assembler."""
    for character, escape in (("\\", "\\\\"), ('"', '\\"'), ("\n", "\\n")):
        text = text.replace(character, escape)
    return f'"{text}"'


def inclusion(name, path):
    """Declares an array of words and lets the assembler read it from a file: a compiler takes half
    a minute for all shaders."""
    lines = (".pushsection .rodata", ".balign 4", f".globl {name}", f".hidden {name}",
             f"{name}: .incbin {quoted(str(path))}", ".popsection")
    directives = "\n".join(lines)
    return (f'extern __attribute__((visibility("hidden"))) const uint32_t {name}[];\n'
            f'__asm__({quoted(directives)});')


def table_text(table, shaders, kept):
    """The C source of the table. Its paths start where the build's commands, compilers too, run."""
    lines = ["/* Made by shaders/embed.py from GLSL. */", '#include "engine/shader/shader.h"', ""]
    lines += [inclusion(f"{table}_words_{index}", path) for index, path in enumerate(kept)]
    lines.append(f"const engine_shader_code {table}[] = {{")
    for index, (shader, path) in enumerate(zip(shaders, kept)):
        definitions = " ".join(shader.definitions)
        lines.append(f'    {{"{shader.name}", "{shader.source}", "{definitions}", '
                     f'"{shader.substitute}", {table}_words_{index}, {path.stat().st_size}}},')
    # C has no empty arrays: the last entry is a terminator and not counted.
    lines += ["    {0},", "};", f"const size_t {table}_count = {len(shaders)};", ""]
    return "\n".join(lines)


def dependencies(folders):
    """All files and folders: adding or removing a file changes the folder's time."""
    found = [Path(__file__)]
    for folder in folders:
        found.append(folder)
        found += [path for path in sorted(folder.rglob("*")) if "__pycache__" not in path.parts]
    return found


def write_dependencies(path, target, folders):
    names = [str(name).replace(" ", "\\ ") for name in dependencies(folders)]
    path.write_text(f"{target}: " + " ".join(names) + "\n")


def replace_file(path, content):
    temporary = path.with_name(path.name + ".new")
    temporary.write_bytes(content)
    os.replace(temporary, path)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--compiler", required=True, help="compile_shaders")
    parser.add_argument("--folder", required=True, type=Path, help="where the passes are")
    parser.add_argument("--include", type=Path,
                        help="folder to look for includes in, after --folder itself")
    parser.add_argument("--table", required=True, help="name of the C array")
    parser.add_argument("--output", required=True, type=Path)
    parser.add_argument("--depfile", required=True, type=Path)
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    folders = [path.resolve() for path in (arguments.folder, arguments.include) if path]
    sources = [path for path in sorted(folders[0].rglob("*")) if path.suffix in STAGES]
    # The library uses binary search.
    shaders = sorted((shader for path in sources for shader in variants(folders[0], path)),
                     key=lambda shader: shader.name)
    kept_folder(arguments).mkdir(exist_ok=True)
    kept = [kept_folder(arguments) / digest_of(arguments, folders, shader) for shader in shaders]
    missing = {shader: path for shader, path in zip(shaders, kept) if not path.is_file()}
    try:
        compile_missing(arguments, folders, missing)
    except RuntimeError as failures:
        print(failures, file=sys.stderr)
        return 1
    replace_file(arguments.output, table_text(arguments.table, shaders, kept).encode())
    remove_others(kept_folder(arguments), kept)
    write_dependencies(arguments.depfile, arguments.output, folders)
    return 0


if __name__ == "__main__":
    sys.exit(main())
