#!/usr/bin/env python3
"""Draws docs/pictures/viewer.png, the window of `lobe view`, on a screen without a monitor: see
docs/pictures/make. Arguments: the program, the root of the tree, the picture."""

import struct
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/tools/program/support"))
import screen  # noqa: E402

WIDTH, HEIGHT = 960, 560


def paeth(left, above, corner):
    estimate = left + above - corner
    distances = abs(estimate - left), abs(estimate - above), abs(estimate - corner)
    return (left, above, corner)[distances.index(min(distances))]


def chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data +
            struct.pack(">I", zlib.crc32(kind + data)))


def write(path, rows):
    """A PNG of rows of R, G, B, each value told by what is beside and above it."""
    lines, above = [], bytes(3 * WIDTH)
    for row in rows:
        lines.append(b"\4" + bytes(
            (row[i] - paeth(row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0))
            & 255 for i in range(len(row))))
        above = row
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(b"".join(lines), 9)) + chunk(b"IEND", b""))


def main():
    screen.WIDTH, screen.HEIGHT = WIDTH, HEIGHT
    place = screen.Screen()
    window = screen.Window(place, "tablecloth", "--size", f"{WIDTH}x{HEIGHT}", "--filter", "mipmap",
                           "--samples", 128, "--path", 0.115)
    window.do("key", "Left", "key", "c", "mousemove", 600, 300)
    rows = [bytes(value for i in range(0, len(row), 4) for value in (row[i + 2], row[i + 1], row[i]))
            for row in place.picture(0, 0, WIDTH, HEIGHT)]
    write(Path(sys.argv[3]), rows)
    window.close()


if __name__ == "__main__":
    main()
