"""Reads the pictures that `lobe report` sends; tools/report/picture_stream.h has the format."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import BinaryIO, Iterator

import numpy

REFERENCE = 2 ** 32 - 1


class Interrupted(Exception):
    """The sender stopped, and has reported the cause."""


@dataclass
class Picture:
    row: int | None  # index of the row in the results; None: the reference
    linear: numpy.ndarray  # height x width x 4 floats
    shown: numpy.ndarray  # height x width x 3 bytes, as displayed

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.linear.shape[1], self.linear.shape[0]


class PictureStream:
    def __init__(self, file: BinaryIO):
        self._file = file
        self.heat_colours = self._array("uint8", 256, 3)

    def _read(self, size: int) -> bytes:
        data = self._file.read(size)
        if len(data) != size:
            raise Interrupted
        return data

    def _array(self, kind: str, *shape: int) -> numpy.ndarray:
        size = numpy.dtype(kind).itemsize
        for extent in shape:
            size *= extent
        return numpy.frombuffer(self._read(size), kind).reshape(shape)

    def _numbers(self, count: int) -> tuple[int, ...]:
        return struct.unpack(f"={count}I", self._read(4 * count))

    def _picture(self) -> Picture:
        row, width, height = self._numbers(3)
        linear = self._array("float32", height, width, 4)
        shown = self._array("uint8", height, width, 4)[..., :3]
        return Picture(None if row == REFERENCE else row, linear, shown)

    def scene(self) -> Iterator[Picture]:
        """The pictures of the next scene, its reference first; the caller must consume all."""
        (count,) = self._numbers(1)
        for _ in range(count):
            yield self._picture()
