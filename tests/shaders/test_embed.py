"""The build step that compiles shaders: an error in one stops it, and leaves no table."""

import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import tap

SCRIPT, COMPILER = sys.argv[1:3]
GOOD = "#version 460\nlayout(local_size_x = 1) in;\nvoid main() {}\n"
LAYERED = """#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter.glsl"
layout(local_size_x = 1) in;
void main() { f(); }
"""

# Numbers of the SPIR-V specification.
MAGIC = 0x07230203
OP_FUNCTION, OP_FUNCTION_CALL, OP_DECORATE = 54, 57, 71
SPECIALISATION, BINDING = 1, 33


def operations(words, code):
    """The operands of each instruction of this kind in a module of SPIR-V."""
    found, at = [], 5
    while at < len(words):
        length = words[at] >> 16
        if words[at] & 0xffff == code:
            found.append(words[at + 1:at + length])
        at += length
    return found


def words_in(table):
    """The words of all shaders of a table."""
    content = b"".join(Path(path).read_bytes() for path in re.findall(r'incbin \\"(.*?)\\"', table))
    return list(struct.unpack(f"<{len(content) // 4}I", content))


def embed_in(scratch, sources, compiler=COMPILER):
    """Returns exit status, output, the table (None if none was written), and its words."""
    folder, output = Path(scratch) / "shaders", Path(scratch) / "table.c"
    for name, text in sources.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    done = subprocess.run(
        [sys.executable, SCRIPT, "--compiler", compiler, "--folder", folder, "--table", "table",
         "--output", output, "--depfile", f"{scratch}/table.d"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    table = output.read_text() if output.exists() else None
    return done.returncode, done.stdout, table, words_in(table) if table else None


def embed(sources, **options):
    with tempfile.TemporaryDirectory() as scratch:
        return embed_in(scratch, sources, **options)


def refuses(sources, *words, **options):
    status, printed, table, _ = embed(sources, **options)
    assert status == 1 and table is None, (status, table)
    for word in words:
        assert word in printed, printed


def test_shaders_become_a_table():
    sources = {"b.comp": GOOD, "a.comp": GOOD, "notes.txt": "no shader"}
    status, printed, table, words = embed(sources)
    assert status == 0 and not printed, printed
    assert table.index('"a.comp"') < table.index('"b.comp"')
    assert "table_count = 2;" in table and words.count(MAGIC) == 2


def test_filters_and_macros_give_variants():
    source = LAYERED.replace("void main", "#pragma variants ENVIRONMENT AOV\nvoid main")
    status, printed, table, _ = embed({"pass.comp": source, "filters/flat.glsl": "void f() {}\n",
                                       "filters/deep.glsl": "#pragma variants DEEP\nvoid f() {}\n"})
    assert status == 0 and not printed, printed
    for name in ("flat", "flat_environment", "flat_aov", "flat_environment_aov", "deep",
                 "deep_deep", "deep_environment_deep", "deep_environment_aov_deep"):
        assert f'"pass_{name}.comp"' in table, name
    assert "table_count = 12;" in table
    status, _, table, _ = embed({"pass.comp": LAYERED, "filters/flat.glsl": "void f() {}\n"})
    assert status == 0 and '"pass_flat.comp"' in table and "aov" not in table


def test_unused_bindings_and_constants_stay():
    status, _, _, words = embed({"a.comp": """#version 460
layout(local_size_x = 1) in;
layout(constant_id = 3) const uint UNUSED = 5;
layout(binding = 2) uniform sampler2D unused;
void f() {}
void main() { f(); }
"""})
    assert status == 0
    assert operations(words, OP_FUNCTION_CALL) == [], "a function is not inlined"
    decorations = [operands[1:] for operands in operations(words, OP_DECORATE)]
    assert [SPECIALISATION, 3] in decorations and [BINDING, 2] in decorations, decorations


def test_functions_that_return_early_stay_as_they_are():
    status, printed, _, words = embed({"a.comp": """#version 460
layout(local_size_x = 1) in;
layout(binding = 0) buffer numbers { float number; };
float early(float x) { if (x > 0) return 1; return x; }
float late(float x) { return 2 * x; }
void main() { number = early(number) + late(number); }
"""})
    assert status == 0 and not printed, printed
    assert len(operations(words, OP_FUNCTION_CALL)) == 1
    assert [operands[2] for operands in operations(words, OP_FUNCTION)] == [0, 0], "marks are left"


def test_only_what_changed_is_compiled():
    def half(value):
        return f"const float HALF = {value};\n"
    reader = """#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/half.glsl"
layout(local_size_x = 1) in;
layout(binding = 0) buffer numbers { float number; };
void main() { number = HALF; }
"""
    with tempfile.TemporaryDirectory() as scratch:
        compiler, log = Path(scratch) / "compiler", Path(scratch) / "log"
        compiler.write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" >> {log}\nexec {COMPILER} "$@"\n')
        compiler.chmod(0o755)

        def compiled(**sources):
            log.write_text("")
            status, printed, _, words = embed_in(
                scratch, {name.replace("_", "."): text for name, text in sources.items()} | library,
                compiler=str(compiler))
            assert status == 0, printed
            return sorted(line for line in set(log.read_text().splitlines())
                          if line.endswith(".comp")), words

        library = {"lib/half.glsl": half(0.5)}
        assert compiled(a_comp=GOOD, b_comp=reader)[0] == ["a.comp", "b.comp"]
        names, first = compiled(a_comp=GOOD, b_comp=reader)
        assert names == []
        library = {"lib/half.glsl": half(0.25)}
        names, second = compiled(a_comp=GOOD, b_comp=reader)
        assert names == ["b.comp"] and second != first
        names, third = compiled(a_comp=GOOD + "\n", b_comp=reader)
        assert names == ["a.comp"] and third == second


def test_faulty_source_is_named():
    refuses({"a.comp": GOOD, "broken.comp": GOOD + "x"}, "broken.comp", "syntax error")


def test_invalid_words_are_refused():
    # Vulkan has no comparison of vectors among operations on constants.
    refuses({"strange.comp": """#version 460
layout(local_size_x = 1) in;
layout(constant_id = 0) const uint COUNT = 4;
layout(binding = 0) buffer numbers { float number; };
const bool equal = ivec2(COUNT, 2) == ivec2(1);
void main() { number = equal ? 1 : 2; }
"""}, "strange.comp", "OpSpecConstantOp")


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
