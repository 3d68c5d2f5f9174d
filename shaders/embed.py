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
import tempfile
from dataclasses import dataclass
from pathlib import Path

import early_returns

STAGES = (".vert", ".frag", ".comp")
FILTER_INCLUDE = re.compile(r'^\s*#\s*include\s+"filter\.glsl"', re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
VARIANTS = re.compile(r"^\s*#\s*pragma\s+variants\s+(.*)$", re.MULTILINE)
# Drivers inline all functions anyway. Where they need not do it, and meet no variables that merely
# pass arguments, lavapipe creates a shading pipeline in half the time. Branches that a variant does
# not take go before that: they would be inlined at every call. Bindings and specialisation
# constants stay, also those that no code uses.
PRESERVE = ("--preserve-bindings", "--preserve-spec-constants")
BEFORE_INLINING = (*PRESERVE, "--eliminate-dead-branches", "--eliminate-dead-functions")
INLINING = (*PRESERVE, "--inline-entry-points-exhaustive", "--eliminate-dead-functions",
            "--eliminate-local-single-block", "--eliminate-local-single-store",
            "--eliminate-dead-code-aggressive")


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


def files_of(folder, includes, shader):
    """All files that a shader may be compiled from, also those that a macro leaves out."""
    found, unread = set(), [folder / shader.source]
    if shader.substitute:
        unread.append(folder / shader.substitute)
    while unread:
        path = unread.pop()
        if path in found:
            continue
        found.add(path)
        # Every file of that name counts: so it does not matter which one the compiler takes.
        candidates = [Path(os.path.normpath(place / name))
                      for name in content_and_includes(path)[1]
                      for place in (path.parent, *includes)]
        unread += [candidate for candidate in candidates if candidate.is_file()]
    return sorted(found)


def digest_of(tools, folder, includes, shader):
    """Changes with whatever decides a shader's words."""
    parts = [repr(shader), repr((BEFORE_INLINING, INLINING))]
    parts += [os.path.relpath(path, folder) for path in includes]
    for tool in (tools.compiler, tools.validator, tools.optimiser):
        status = os.stat(tool)
        parts.append(f"{tool} {status.st_size} {status.st_mtime_ns}")
    parts += [f"{os.path.relpath(path, folder)} {content_and_includes(path)[0]}"
              for path in files_of(folder, includes, shader)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def run(shader, command):
    """Raises with the command's own output if it fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{shader.name}:\n{done.stdout}")


def compile_shader(tools, folder, includes, shader, scratch):
    """Returns the SPIR-V of one shader. The compiler sometimes generates invalid SPIR-V for
    constants computed from specialisation constants, and the optimiser keeps these: the validator
    sees what a driver will see. It takes ten times as long before functions are inlined."""
    output = Path(scratch) / (shader.name + ".spv")
    substitutes = Path(scratch) / (shader.name + ".include")
    substitutes.mkdir(parents=True)
    if shader.substitute:
        (substitutes / "filter.glsl").write_text(f'#include "{shader.substitute}"\n')
    command = [tools.compiler, "-V", "--quiet", "--target-env", "vulkan1.3"]
    command += [f"-I{path}" for path in (substitutes, *includes)]
    command += [f"-D{definition}" for definition in shader.definitions]
    command += ["-o", str(output), str(folder / shader.source)]
    run(shader, command)
    optimise = [tools.optimiser, "--target-env=vulkan1.3", "--skip-validation", str(output),
                "-o", str(output)]
    run(shader, [*optimise, *BEFORE_INLINING])
    early_returns.mark(output)
    run(shader, [*optimise, *INLINING])
    early_returns.clear(output)
    run(shader, [tools.validator, "--target-env", "vulkan1.3", str(output)])
    return output.read_bytes()


def kept_words(tools, folder, includes, shader, scratch):
    """The file in which the SPIR-V words of one shader are kept."""
    kept = kept_folder(tools) / digest_of(tools, folder, includes, shader)
    if not kept.is_file():
        replace_file(kept, compile_shader(tools, folder, includes, shader, scratch))
    return kept


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
    parser.add_argument("--compiler", required=True, help="glslangValidator")
    parser.add_argument("--validator", required=True, help="spirv-val")
    parser.add_argument("--optimiser", required=True, help="spirv-opt")
    parser.add_argument("--folder", required=True, type=Path, help="where the passes are")
    parser.add_argument("--include", action="append", default=[], type=Path,
                        help="folder to look for includes in, after --folder itself")
    parser.add_argument("--table", required=True, help="name of the C array")
    parser.add_argument("--output", required=True, type=Path)
    parser.add_argument("--depfile", required=True, type=Path)
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    folders = [arguments.folder.resolve(), *(path.resolve() for path in arguments.include)]
    sources = [path for path in sorted(folders[0].rglob("*")) if path.suffix in STAGES]
    # The library uses binary search.
    shaders = sorted((shader for path in sources for shader in variants(folders[0], path)),
                     key=lambda shader: shader.name)
    kept_folder(arguments).mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch, \
            concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        futures = [pool.submit(kept_words, arguments, folders[0], folders, shader, scratch)
                   for shader in shaders]
        failures = [str(future.exception()) for future in futures if future.exception()]
        if failures:
            print("\n".join(failures), file=sys.stderr)
            return 1
        kept = [future.result() for future in futures]
    replace_file(arguments.output, table_text(arguments.table, shaders, kept).encode())
    remove_others(kept_folder(arguments), kept)
    write_dependencies(arguments.depfile, arguments.output, folders)
    return 0


if __name__ == "__main__":
    sys.exit(main())
