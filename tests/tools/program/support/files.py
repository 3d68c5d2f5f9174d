"""Minimal readers and writers of OpenEXR, PNG and glTF, to inspect what `lobe` writes and to create
its input."""

import base64
import json
import struct
import zlib


# OpenEXR ------------------------------------------------------------------------------------

PIXEL_TYPES = {0: "uint", 1: "half", 2: "float"}


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _channels(value):
    channels, at = {}, 0
    while value[at]:
        name, at = _text(value, at)
        channels[name] = PIXEL_TYPES[struct.unpack_from("<i", value, at)[0]]
        at += 16
    return channels


def _value(kind, value):
    if kind == "string":
        return value.decode()
    if kind in ("int", "float"):
        return struct.unpack("<i" if kind == "int" else "<f", value)[0]
    if kind in ("box2i", "chromaticities"):
        return struct.unpack("<4i" if kind == "box2i" else "<8f", value)
    return _channels(value) if kind == "chlist" else value


def exr_header(path):
    """The attributes of an OpenEXR file by name."""
    return _header(path)[0]


def exr_pixels(path):
    """The data after the header and the offset table: all channels, as stored."""
    attributes, data = _header(path)
    window = attributes["dataWindow"]
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    return data[8 * -(-(window[3] - window[1] + 1) // lines):]


def _unpacked(block, size):
    """A block of ZIP compression: differences of bytes, the first halves of words before the
    second."""
    if len(block) == size:
        return block
    values = bytearray(zlib.decompress(block))
    for i in range(1, size):
        values[i] = (values[i - 1] + values[i] - 128) & 255
    words = bytearray(size)
    words[0::2], words[1::2] = values[:(size + 1) // 2], values[(size + 1) // 2:]
    return bytes(words)


def exr_texels(path):
    """The texels of a file with channels A, B, G, R of floats, in blocks of 16 scan lines: tuples
    in that order."""
    attributes = exr_header(path)
    assert list(attributes["channels"].items()) == [(name, "float") for name in "ABGR"], attributes
    left, top, right, bottom = attributes["dataWindow"]
    width, data, at, texels = right - left + 1, exr_pixels(path), 0, []
    while at < len(data):
        first, size = struct.unpack_from("<ii", data, at)
        lines = min(16, bottom - first + 1)
        block = _unpacked(data[at + 8:at + 8 + size], 16 * width * lines)
        for line in range(lines):
            values = struct.unpack_from(f"<{4 * width}f", block, 16 * width * line)
            texels += zip(*(values[width * channel:width * (channel + 1)] for channel in range(4)))
        at += 8 + size
    return texels


def _header(path):
    data = path.read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01", f"{path} is no OpenEXR file"
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        kind, at = _text(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = _value(kind, data[at + 4:at + 4 + size])
        at += 4 + size
    return attributes, data[at + 1:]


def _attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def exr_write(path, width, height, colour_at):
    """An OpenEXR file, scan lines without compression: `colour_at(x, y)` is a pixel's RGB."""
    channels = b"".join(name + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1)
                        for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<2i", 20000630, 2) + b"".join((
        _attribute("channels", "chlist", channels), _attribute("compression", "compression", b"\0"),
        _attribute("dataWindow", "box2i", window), _attribute("displayWindow", "box2i", window),
        _attribute("lineOrder", "lineOrder", b"\0"),
        _attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1)))) + b"\0"
    size = 12 * width
    first = len(header) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * (8 + size) for y in range(height)))
    lines = b""
    for y in range(height):
        row = [colour_at(x, y) for x in range(width)]
        lines += struct.pack("<2i", y, size) + b"".join(
            struct.pack(f"<{width}f", *(colour[channel] for colour in row))
            for channel in (2, 1, 0))
    path.write_bytes(header + offsets + lines)


# PNG ----------------------------------------------------------------------------------------

def _chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data +
            struct.pack(">I", zlib.crc32(kind + data)))


def png_write(path, width, height, colour):
    """A picture of one colour, 8 bits, RGB."""
    png_draw(path, width, height, lambda x, y: colour)


def png_draw(path, width, height, colour_at):
    """The same, `colour_at(x, y)` is a pixel's RGB, or RGBA."""
    kind = 6 if len(colour_at(0, 0)) == 4 else 2
    rows = b"".join(b"\0" + b"".join(bytes(colour_at(x, y)) for x in range(width))
                    for y in range(height))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0)) +
                     _chunk(b"IDAT", zlib.compress(rows)) + _chunk(b"IEND", b""))


def _paeth(left, up, corner):
    estimate = left + up - corner
    distances = [abs(estimate - value) for value in (left, up, corner)]
    return (left, up, corner)[distances.index(min(distances))]


def _unfilter(kind, row, above, size):
    for i, byte in enumerate(row):
        left = row[i - size] if i >= size else 0
        corner = above[i - size] if i >= size else 0
        up = above[i]
        row[i] = (byte + (0, left, up, (left + up) // 2, _paeth(left, up, corner))[kind]) & 255


def png_read(path):
    """Width, height and the pixels' RGB of an 8-bit RGB or RGBA picture."""
    return png_decode(path.read_bytes(), path)


def png_decode(data, path="data"):
    """The same from memory; `path` is for messages."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG file"
    at, packed, width, height, size = 8, b"", 0, 0, 0
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack_from(">IIBB", body)
            assert depth == 8 and colour in (2, 6), f"{path}: depth {depth}, type {colour}"
            size = 3 if colour == 2 else 4
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, stride, above, pixels = zlib.decompress(packed), width * size, bytes(width * size), []
    for y in range(height):
        start = y * (stride + 1)
        row = bytearray(raw[start + 1:start + 1 + stride])
        _unfilter(raw[start], row, above, size)
        pixels += [tuple(row[i:i + 3]) for i in range(0, stride, size)]
        above = row
    return width, height, pixels


# glTF ---------------------------------------------------------------------------------------

def gltf_triangle():
    """A glTF document, as a dictionary: one triangle, its data inside."""
    positions = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
    indices = struct.pack("<3H", 0, 1, 2)
    data = base64.b64encode(positions + indices).decode()
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64," + data}],
        "bufferViews": [{"buffer": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [-1, -1, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    }


def gltf_write(path, document):
    path.write_text(json.dumps(document), encoding="utf-8")
