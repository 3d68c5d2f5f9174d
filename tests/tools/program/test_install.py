"""Installs the library, then builds and runs programs against it: those of docs/embed.md, in C,
also linked statically, and one in C++; with pkg-config and with CMake."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import tap
from program import FOLDER, ROOT, check, fresh_folder

BUILD = Path(sys.argv[3]).resolve()
C_COMPILER, CPP_COMPILER = sys.argv[4].split(), sys.argv[5].split()
TARGET = FOLDER / "installed"

CPP_PROGRAM = """
#include <cstdio>
#include <lobe/lobe.h>
#include <lobe/vulkan.h>
int main() {
    lobe_settings settings;
    const lobe_filter *filter = nullptr;
    if (lobe_filter_find("lobes", nullptr, &filter) != LOBE_OK)
        return 1;
    lobe_settings_default(filter, &settings);
    double epsilon0 = 0;
    if (lobe_settings_get(filter, &settings, "epsilon0", &epsilon0, nullptr) != LOBE_OK)
        return 1;
    std::printf("%s %g\\n", lobe_version(), epsilon0);
}
"""

STATIC_PROGRAM = """
#include <lobe/lobe.h>
int shading(void);
int shading(void) {
    return 7;
}
int main(void) {
    lobe_scene *scene;
    return lobe_scene_open("broken.gltf", NULL, &scene) != LOBE_ERROR_MALFORMED || shading() != 7;
}
"""

HOST_SHADER = """#version 460
#extension GL_GOOGLE_include_directive : require
#define LOBE_SET 2
#define LOBE_BINDING_BASE 5
#define LOBE_CONSTANT_BASE 30
#include "lobe/FILTER.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 colour;
void main() {
    lobe_surface surface = lobe_surface_at(mat3(1.0), vec3(0.0, 0.0, 1.0), uv, dFdx(uv), dFdy(uv));
    lobe_appearance fetched = lobe_fetch(surface);
    vec3 sum = lobe_evaluate(fetched, surface, vec3(0.0, 0.6, 0.8)) + lobe_emission(fetched);
#ifdef LOBE_ENVIRONMENT
    sum += lobe_integrate_environment(fetched, surface);
#endif
    colour = vec4(sum, 1.0);
}
"""

CMAKE_SHARED_PROJECT = """
cmake_minimum_required(VERSION 3.16)
project(embedding C)
find_package(lobe 0.1 REQUIRED)
add_executable(embed embed.c)
target_link_libraries(embed lobe::lobe)
"""

CMAKE_STATIC_PROJECT = """
cmake_minimum_required(VERSION 3.16)
project(embedding C CXX)
find_package(lobe 0.1 REQUIRED COMPONENTS static)
add_executable(embed embed.c)
target_link_libraries(embed lobe::lobe_static)
"""

CMAKE_PROJECT = """
cmake_minimum_required(VERSION 3.16)
project(embedding C CXX)
find_package(lobe 0.1 REQUIRED COMPONENTS static)
add_executable(embed embed.c)
target_link_libraries(embed lobe::lobe)
add_executable(embed-static embed.c)
target_link_libraries(embed-static lobe::lobe_static)
add_executable(settings settings.cpp)
target_link_libraries(settings lobe::lobe)
"""


def run(command, cwd=None, **environment):
    result = subprocess.run(command, env={**os.environ, **environment}, text=True, check=False,
                            cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    check(result.returncode == 0, f"{shlex.join(map(str, command))}\n{result.stdout}")
    return result.stdout


def installed(pattern):
    found = sorted(TARGET.rglob(pattern))
    check(found, f"no {pattern} was installed")
    return found[0]


def flags(folder, *options):
    """The output of pkg-config for the library installed under another root, on a system without
    any other package."""
    package = next(folder.rglob("lobe.pc"))
    return run(["pkg-config", *options, "lobe"], PKG_CONFIG_LIBDIR=str(package.parent),
               PKG_CONFIG_PATH="", PKG_CONFIG_SYSROOT_DIR=str(folder)).split()


def smallest_program():
    return re.search(r"```c\n(.*?)```", (ROOT / "docs/embed.md").read_text(), re.DOTALL)[1]


def test_install():
    run(["meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", TARGET])
    for pattern in ("bin/lobe", "liblobe.a", "liblobe.so", "lobe.pc", "lobe/lobe.h",
                    "lobe/result.h", "cmake/lobe/lobeConfig.cmake",
                    "cmake/lobe/lobeConfigVersion.cmake"):
        installed(pattern)


def test_library_is_versioned():
    library = installed("liblobe.so")
    check(library.is_symlink() and library.readlink().name == "liblobe.so.0", library.readlink())
    said = run(["readelf", "--dynamic", "--wide", library])
    check("libvulkan" not in said, said)
    check("Library soname: [liblobe.so.0]" in said, said)


def test_every_public_header_is_installed():
    for path in ROOT.glob("*/include/lobe/*.h"):
        installed(f"lobe/{path.name}")


def test_shading_is_installed():
    """A shader of a host compiles against what is installed alone, for each filter but those of
    random paths, which have no maps."""
    folder = Path(run(["pkg-config", "--variable=shaderdir", "lobe"],
                      PKG_CONFIG_LIBDIR=str(installed("lobe.pc").parent),
                      PKG_CONFIG_SYSROOT_DIR=str(TARGET)).strip())
    compiler = shutil.which("glslangValidator")
    features = ([], ["-DLOBE_ENVIRONMENT"], ["-DLOBE_CLOSED_SURFACE"],
                ["-DLOBE_WAVES", "-DLOBE_ENVIRONMENT"])
    names = sorted(path.stem for path in (ROOT / "shaders/filters").glob("*.glsl"))
    for number, name in enumerate(names):
        if name == "displaced_reference":
            continue
        for options in features if tap.long_runs() else [features[number % 4]]:
            source = FOLDER / f"{name}.frag"
            source.write_text(HOST_SHADER.replace("FILTER", name))
            run([compiler, "-V", "--target-env", "vulkan1.3", f"-I{folder}", *options, source,
                 "-o", FOLDER / "host.spv"])


def named_paths(text):
    """What looks like a path from the top of the source or the build tree."""
    return re.findall(r"\b(?:build|docs|engine|out|passes|scenes|shaders|tests|third_party|tools)"
                      r"/[\w./-]*\w", text)


def test_headers_name_what_is_installed():
    folder, documents = installed("lobe/lobe.h").parent, installed("doc/lobe")
    headers = {path.name: path.read_text() for path in folder.glob("*.h")}
    code = re.sub(r"//[^\n]*", "", "".join(headers.values()))
    declared = set(re.findall(r"\w+", code))
    for name, text in headers.items():
        missing = [path for path in named_paths(text) if not (documents / path).exists()]
        missing += [path for path in re.findall(r"\blobe/(\w+\.h)", text) if path not in headers]
        missing += set(re.findall(r"\b(?:lobe|engine|passes|scenes)_\w+", text)) - declared
        missing += re.findall(r"\b(?:engine|passes|scenes)_\w+", text)
        check(not missing, f"{name} names {missing}")


def test_documents_name_what_is_installed():
    documents = installed("doc/lobe")
    found = sorted(documents.rglob("*.md"))
    check("embed.md" in [path.name for path in found], found)
    for path in found:
        text = re.sub(r"<!--.*?-->", "", path.read_text(), flags=re.DOTALL)
        links = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text)
        missing = [link for link in links if not (path.parent / link).exists()]
        missing += [name for name in named_paths(text) if not (documents / name).exists()]
        check(not missing, f"{path.name} names {missing}")


def test_library_shows_its_public_names_alone():
    lines = run(["nm", "--dynamic", "--defined-only", installed("liblobe.so")]).splitlines()
    names = {line.split()[-1].split("@")[0] for line in lines}
    check("lobe_renderer_render" in names, names)
    headers = "".join(path.read_text() for path in ROOT.glob("*/include/lobe/*.h"))
    declared = set(re.findall(r"\b(lobe_\w+)\(", headers))
    check(names == declared, f"not declared: {names - declared}; missing: {declared - names}")


def test_static_library_shows_the_same_names():
    lines = run(["nm", "--defined-only", "--extern-only", installed("liblobe.a")]).splitlines()
    names = {line.split()[-1] for line in lines if re.search(r" [A-Zu] ", line)}
    shared = run(["nm", "--dynamic", "--defined-only", installed("liblobe.so")]).splitlines()
    check(names == {line.split()[-1].split("@")[0] for line in shared}, names)


def test_installed_program_runs():
    output = run([installed("bin/lobe"), "--version"])
    check(output.startswith("lobe "), output)


def test_installed_program_draws_reports():
    """Uses the script that was installed with it, wherever both are."""
    moved = FOLDER / "moved"
    shutil.copytree(TARGET, moved, symlinks=True)
    results = FOLDER / "results.json"
    results.write_text(json.dumps({
        "version": "1", "device": "d", "driver": "d", "device_type": "CPU", "size": [1, 1],
        "reference_samples": 1, "path_samples": 1, "stations": 1, "frames": 1, "complete": True,
        "scenes": [], "rows": []}))
    program = next(moved.rglob("bin/lobe"))
    run([program, "report", results, "-o", FOLDER / "report"])
    check("</html>" in (FOLDER / "report/index.html").read_text(), "no page")
    script = next(moved.rglob("lobe-report"))
    script.unlink()
    result = subprocess.run([program, "report", results, "-o", FOLDER / "none"], text=True,
                            capture_output=True, check=False)
    check(result.returncode == 1 and script.name in result.stderr, result.stderr)
    check(len(result.stderr.splitlines()) == 1, result.stderr)


def test_every_subcommand_has_its_manual_page():
    names = re.findall(r"^  (\w+)  ", run([installed("bin/lobe"), "--help"]), re.MULTILINE)
    check("render" in names, names)
    for name in names:
        check(f"lobe\\-{name}" in installed(f"man1/lobe-{name}.1").read_text(), name)
    check("lobe\\-render" in installed("man1/lobe.1").read_text(), "lobe.1")


def test_shells_find_their_scripts():
    for place in ("bash-completion/completions/lobe.bash", "zsh/site-functions/_lobe",
                  "fish/vendor_completions.d/lobe.fish"):
        check("epsilon0" in installed(place).read_text(), place)


def test_program_in_c():
    source = FOLDER / "embed.c"
    source.write_text(smallest_program())
    run([*C_COMPILER, "-std=c17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, "-o",
         FOLDER / "embed", *flags(TARGET, "--cflags", "--libs")])
    run([FOLDER / "embed"], LD_LIBRARY_PATH=str(installed("liblobe.so").parent))


def test_programs_of_the_document_on_embedding():
    text = (ROOT / "docs/embed.md").read_text()
    sources = [code for code in re.findall(r"```c\n(.*?)```", text, re.DOTALL) if "main(" in code]
    check(len(sources) >= 3, "no programs")
    folder = fresh_folder("document")
    # test_program_in_c runs the first.
    for number, code in enumerate(sources[1:]):
        source, program = folder / f"{number}.c", folder / f"{number}"
        source.write_text(code)
        run([*C_COMPILER, "-std=c17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, "-o",
             program, *flags(TARGET, "--cflags", "--libs")])
        run([program], cwd=folder, LD_LIBRARY_PATH=str(installed("liblobe.so").parent))
    check(len(list(folder.glob("frame*.exr"))) == 10, "not ten frames of an animation")
    check((folder / "pipelines.cache").exists(), "no compiled pipelines are kept")


def test_examples():
    """The program itself links the Vulkan functions that it calls."""
    examples = ROOT / "tools" / "examples"
    for source in sorted(examples.glob("*.c")):
        run([*C_COMPILER, "-std=c17", "-Wall", "-Wextra", "-Werror", source, "-o",
             FOLDER / source.stem, f"-I{BUILD / 'tools' / 'examples'}",
             *flags(TARGET, "--cflags", "--libs"), "-lvulkan", "-lm"])


def test_example_of_own_shading_needs_only_what_is_installed():
    """By the commands of its document, with the compiler that this was built with."""
    text = installed("doc/lobe/docs/own-shading.md").read_text()
    commands = re.search(r"```sh\n(.*?)```", text, re.DOTALL)[1]
    check("\ncc " in commands, "no compiler is called")
    folder = FOLDER / "example"
    shutil.copytree(installed("own_shading.c").parent, folder)
    run(["sh", "-e", "-c", commands.replace("\ncc ", f"\n{shlex.join(C_COMPILER)} ")], cwd=folder,
        PKG_CONFIG_LIBDIR=str(installed("lobe.pc").parent), PKG_CONFIG_PATH="",
        PKG_CONFIG_SYSROOT_DIR=str(TARGET))
    run([folder / "own_shading", "lean", "bumps", folder / "picture.exr", "16", "8"],
        LD_LIBRARY_PATH=str(installed("liblobe.so").parent))
    check((folder / "picture.exr").stat().st_size > 0, "no picture")


def test_program_in_c_linked_statically():
    static = FOLDER / "static"
    shutil.copytree(TARGET, static, symlinks=True)
    for library in static.rglob("liblobe.so*"):
        library.unlink()
    run([*C_COMPILER, "-std=c17", FOLDER / "embed.c", "-o", FOLDER / "embed-static",
         *flags(static, "--static", "--cflags", "--libs")])
    run([FOLDER / "embed-static"])
    # A function with the name of one of ours, and a file that makes C++ code report an error.
    (FOLDER / "names.c").write_text(STATIC_PROGRAM)
    (FOLDER / "broken.gltf").write_text('{"asset": {"version": "2.0"}, "nodes": [{"name": "\\ud800')
    run([*C_COMPILER, "-std=c17", FOLDER / "names.c", "-o", FOLDER / "names",
         *flags(static, "--static", "--cflags", "--libs")])
    run([FOLDER / "names"], cwd=FOLDER)


def test_hosts_with_vulkan_of_their_own():
    """Shared and static, beside libvulkan and beside a volk; lobe requires neither."""
    source = ROOT / "tests/engine/device/vulkan_host.c"
    static = FOLDER / "static"
    check("-lvulkan" not in flags(static, "--static", "--libs"), "lobe asks for libvulkan")
    for kind, folder, options in (("shared", TARGET, []), ("static", static, ["--static"])):
        for name, means in (("libvulkan", ["-lvulkan"]), ("volk", ["-DUSE_VOLK", "-ldl"])):
            program = FOLDER / f"host-{kind}-{name}"
            run([*C_COMPILER, "-std=c17", "-Wall", "-Wextra", "-Werror", source, "-o", program,
                 *flags(folder, *options, "--cflags", "--libs"), *means])
            said = run([program], LD_LIBRARY_PATH=str(installed("liblobe.so").parent))
            check("the pictures agree" in said, said)


def test_program_in_cpp():
    source = FOLDER / "settings.cpp"
    source.write_text(CPP_PROGRAM)
    run([*CPP_COMPILER, "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, "-o",
         FOLDER / "settings", *flags(TARGET, "--cflags", "--libs")])
    says_default(FOLDER / "settings")


def says_default(program):
    output = run([program], LD_LIBRARY_PATH=str(installed("liblobe.so").parent))
    check(output.split()[1] == "0.95", output)


def configure(project, *options, folder=TARGET):
    prefix = next(folder.rglob("lib")).parent
    return ["cmake", "-S", project, "-B", project / "build", f"-DCMAKE_C_COMPILER={C_COMPILER[-1]}",
            f"-DCMAKE_CXX_COMPILER={CPP_COMPILER[-1]}", *options, f"-DCMAKE_PREFIX_PATH={prefix}"]


def test_programs_by_cmake():
    if not shutil.which("cmake"):
        return "there is no cmake"
    project = fresh_folder("cmake")
    (project / "CMakeLists.txt").write_text(CMAKE_PROJECT)
    (project / "embed.c").write_text(smallest_program())
    (project / "settings.cpp").write_text(CPP_PROGRAM)
    run(configure(project))
    run(["cmake", "--build", project / "build"])
    for program in ("embed", "embed-static"):
        check((project / "build" / program).exists(), program)
    says_default(project / "build/settings")
    return None


def build_with(kind, gone, project_text, **environment):
    """Builds a project against an installation that lacks some files."""
    folder, project = FOLDER / f"only-{kind}", fresh_folder(f"cmake-only-{kind}")
    shutil.copytree(TARGET, folder, symlinks=True)
    for library in folder.rglob(gone):
        library.unlink()
    (project / "CMakeLists.txt").write_text(project_text)
    (project / "embed.c").write_text(smallest_program())
    run(configure(project, folder=folder), **environment)
    run(["cmake", "--build", project / "build"])
    return folder


def test_either_library_alone():
    """Distributions may package them apart. The shared one needs no other package."""
    if not shutil.which("cmake"):
        return "there is no cmake"
    build_with("shared", "liblobe.a", CMAKE_SHARED_PROJECT, PKG_CONFIG_LIBDIR=str(FOLDER))
    folder = build_with("static", "liblobe.so*", CMAKE_STATIC_PROJECT)
    project = fresh_folder("cmake-none")
    (project / "CMakeLists.txt").write_text(CMAKE_SHARED_PROJECT)
    result = subprocess.run(configure(project, folder=folder), text=True, capture_output=True,
                            check=False)
    check(result.returncode != 0 and "COMPONENTS static finds" in " ".join(result.stderr.split()),
          result.stderr)
    return None


def test_cmake_refuses_what_is_not_installed():
    if not shutil.which("cmake"):
        return "there is no cmake"
    project = fresh_folder("cmake-refused")
    for wanted, message in (("lobe 0.99 REQUIRED", 'requested version "0.99"'),
                            ("lobe 0.1 REQUIRED COMPONENTS vulkan", "no component 'vulkan'")):
        text = CMAKE_SHARED_PROJECT.replace("lobe 0.1 REQUIRED", wanted)
        (project / "CMakeLists.txt").write_text(text)
        result = subprocess.run(configure(project), text=True, capture_output=True, check=False)
        check(result.returncode != 0 and message in " ".join(result.stderr.split()),
              result.stderr)
    return None


if __name__ == "__main__":
    sys.exit(tap.run(globals(), long=[test_hosts_with_vulkan_of_their_own]))
