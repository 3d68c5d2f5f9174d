"""Damaged, odd and hostile scene files: rendered, or rejected with one line and exit status 1.
Files that an attacker or a buggy exporter could write are created here; more come from
../shared/assets/bad/gltf if that exists."""

import copy
import json
import shutil
import struct
import sys

import tap
from files import gltf_triangle, gltf_write, png_write
from program import ASSETS, SMALL, check, error_lines, fails, fresh_folder, leaves, lobe, report

OPTIONS = ["--filter", "direct", "--set", "env_size=16", *SMALL]


def refuses(name, content, says=()):
    folder = fresh_folder("refused")
    path = folder / name
    if isinstance(content, dict):
        gltf_write(path, content)
    else:
        path.write_bytes(content)
    fails("render", path, *OPTIONS, "-o", folder / "a.exr", says=[name, *says])
    leaves(folder, name)


def changed(change):
    """A modified triangle."""
    document = copy.deepcopy(gltf_triangle())
    change(document)
    return document


def glb(document, binary=b"", length=None):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    if binary:
        chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    total = 12 + len(chunks) if length is None else length
    return struct.pack("<III", 0x46546C67, 2, total) + chunks


def test_empty_and_meaningless_files():
    for name in ("a.gltf", "a.glb"):
        refuses(name, b"")
        refuses(name, b"\0" * 100)
        refuses(name, b"lobe " * 1000)


def test_malformed_json():
    whole = json.dumps(gltf_triangle()).encode()
    for part in (whole[:1], whole[:len(whole) // 2], whole[:-1], whole + b"}", b"[" * 100000,
                 b"null", b"[]", b'{"asset":{"version":"2.0"'):
        refuses("a.gltf", part)


def test_truncated_glb():
    whole = glb(gltf_triangle())
    for length in (4, 11, 12, 19, 20, 60, len(whole) - 1):
        refuses("a.glb", whole[:length])
    refuses("a.glb", glb(gltf_triangle(), length=2**32 - 1))


def test_index_out_of_range():
    def vertex(document):
        data = struct.pack("<9f3H", -1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 1, 3)
        import base64
        document["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                         base64.b64encode(data).decode())

    def accessor(document):
        document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7

    def view(document):
        document["accessors"][0]["bufferView"] = 9

    def mesh(document):
        document["nodes"][0]["mesh"] = 1000000

    def material(document):
        document["meshes"][0]["primitives"][0]["material"] = 3

    for change in (vertex, accessor, view, mesh, material):
        refuses("a.gltf", changed(change))


def test_buffer_shorter_than_its_view():
    def buffer(document):
        document["bufferViews"][0]["byteLength"] = 43

    def view(document):
        document["accessors"][0]["count"] = 4

    def offset(document):
        document["accessors"][0]["byteOffset"] = 2**63

    def length(document):
        document["buffers"][0]["byteLength"] = 4096

    for change in (buffer, view, offset, length):
        refuses("a.gltf", changed(change))


def test_absurd_counts():
    def count(document):
        document["accessors"][0]["count"] = 2**31 // 12

    def no_data(document):
        document["accessors"][0].pop("bufferView")
        document["accessors"][0]["count"] = 2**40

    for change in (count, no_data):
        refuses("a.gltf", changed(change))


def test_missing_buffer_and_image():
    def buffer(document):
        document["buffers"][0]["uri"] = "gone.bin"

    refuses("a.gltf", changed(buffer), says=["gone.bin"])

    def image(document):
        document["images"] = [{"uri": "gone.png"}]
        document["textures"] = [{"source": 0}]
        document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        document["meshes"][0]["primitives"][0]["material"] = 0
        document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 0

    result = render("a.gltf", changed(image))
    check(result.returncode == 1 or "gone.png" in result.stderr, report(result))


def render(name, document):
    """Renders a document that is odd but need not be rejected."""
    folder = fresh_folder("odd")
    gltf_write(folder / name, document)
    result = lobe("render", folder / name, *OPTIONS, "-o", folder / "a.exr")
    check_outcome(result, folder / "a.exr")
    leaves(folder, name, *(["a.exr"] if result.returncode == 0 else []))
    return result


def check_outcome(result, output):
    """Either a picture and no error, or one line and no picture."""
    check(result.returncode in (0, 1), report(result))
    check("Sanitizer" not in result.stderr and "runtime error" not in result.stderr,
          report(result))
    check(output.exists() == (result.returncode == 0), report(result))
    check(len(error_lines(result)) == result.returncode, report(result))


def test_numbers_that_are_none():
    # JSON knows no NaN, but buffers do.
    for value in (float("nan"), float("inf"), -float("inf"), 3e38, 1e-45):
        def positions(document, value=value):
            import base64
            data = struct.pack("<9f3H", value, -1, 0, 1, -1, 0, 0, 1, 0, 0, 1, 2)
            document["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                             base64.b64encode(data).decode())
        render("a.gltf", changed(positions))


def test_degenerate_geometry():
    def point(document):
        document["nodes"][0]["scale"] = [0, 0, 0]

    def mirrored(document):
        document["nodes"][0]["scale"] = [-1, 1, 1]

    def huge(document):
        document["nodes"][0]["translation"] = [1e38, 0, 0]

    def normals(document):
        document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 0
        document["accessors"][0].pop("min")

    def nothing(document):
        document["meshes"][0]["primitives"][0].pop("indices")
        document["accessors"][0]["count"] = 2

    for change in (point, mirrored, huge, normals, nothing):
        render("a.gltf", changed(change))


def test_nodes_in_a_circle():
    def circle(document):
        document["nodes"].append({"children": [0]})
        document["nodes"][0]["children"] = [1]

    refuses("a.gltf", changed(circle))


def test_damaged_image_of_a_material():
    folder = fresh_folder("image")
    png_write(folder / "paint_albedo.png", 64, 64, (200, 40, 40))
    whole = (folder / "paint_albedo.png").read_bytes()
    for content in (b"", whole[:20], whole[:-20], whole[:50] + b"\0\0\0\0" + whole[54:],
                    whole.replace(struct.pack(">II", 64, 64), struct.pack(">II", 65536, 65536))):
        (folder / "paint_albedo.png").write_bytes(content)
        fails("render", "--material", folder, *OPTIONS, "-o", folder / "a.exr",
              says="paint_albedo.png")
        leaves(folder, "paint_albedo.png")


def test_collected_files():
    bad = ASSETS / "bad" / "gltf"
    if not bad.exists():
        return f"no {bad}"
    folder = fresh_folder("collected")
    paths = sorted(path for path in bad.rglob("*") if path.suffix in (".gltf", ".glb"))
    check(len(paths) > 100, f"only {len(paths)} files")
    drawn = 0
    for path in paths:
        result = lobe("render", path, *OPTIONS, "-o", folder / "a.exr")
        check_outcome(result, folder / "a.exr")
        drawn += result.returncode == 0
        shutil.rmtree(folder)
        folder.mkdir()
    check(0 < drawn < len(paths), f"{drawn} of {len(paths)} were drawn")
    return None


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
