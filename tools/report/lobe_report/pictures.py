"""Turns renderings into the pictures that the report shows. Pictures are arrays of height x width,
with colours in a third dimension."""

from __future__ import annotations

import base64
import io
import math
from dataclasses import dataclass

import numpy
from PIL import Image



@dataclass
class Window:
    """A part of a picture, in pixels."""
    x: int
    y: int
    width: int
    height: int

    def of(self, picture: numpy.ndarray) -> numpy.ndarray:
        return picture[self.y:self.y + self.height, self.x:self.x + self.width]


# Errors ---------------------------------------------------------------------------------------

def error_map(linear: numpy.ndarray, reference: numpy.ndarray) -> numpy.ndarray:
    """The distance of each pixel from the reference: the length of the difference of their RGB,
    divided by the root mean square of the reference's length, so that the root mean square of all
    pixels is the relative L2 error. If the reference is completely black, nothing is finite."""
    truth = reference[..., :3].astype(float)
    with numpy.errstate(all="ignore"):
        difference = (linear[..., :3] - reference[..., :3]).astype(float)
        lengths = numpy.sqrt((difference ** 2).sum(axis=-1))
        scale = numpy.sqrt((truth ** 2).sum() / lengths.size)
        return (lengths / scale).astype(numpy.float32)


def quantile(maps: list[numpy.ndarray], part: float) -> float:
    """The value that a fraction [0, 1] of all finite errors do not exceed; 0 if there are none."""
    values = numpy.concatenate([errors.ravel() for errors in maps]) if maps else numpy.empty(0)
    values = values[numpy.isfinite(values)]
    if values.size == 0:
        return 0.0
    return float(numpy.quantile(values, part, method="inverted_cdf"))


def _finite_sum(errors: numpy.ndarray) -> float:
    with numpy.errstate(all="ignore"):
        total = float(errors.sum(dtype=float))
    return total if math.isfinite(total) else 0.0


def worst_window(maps: list[numpy.ndarray], width: int, height: int) -> Window:
    """The window with the largest sum of all error maps, among those that begin at multiples of
    half their extent."""
    whole_height, whole_width = maps[0].shape
    worst, most = Window(0, 0, width, height), 0.0
    for y in range(0, whole_height - height + 1, (height + 1) // 2):
        for x in range(0, whole_width - width + 1, (width + 1) // 2):
            window = Window(x, y, width, height)
            total = sum(_finite_sum(window.of(errors)) for errors in maps)
            if total > most:
                worst, most = window, total
    return worst


# Reduction ------------------------------------------------------------------------------------

def _block_means(picture: numpy.ndarray, factor: int) -> numpy.ndarray:
    """Means of blocks of factor x factor pixels; blocks at the right and lower edge have fewer."""
    rows = numpy.arange(0, picture.shape[0], factor)
    columns = numpy.arange(0, picture.shape[1], factor)
    sums = numpy.add.reduceat(numpy.add.reduceat(picture, rows, axis=0), columns, axis=1)
    heights = numpy.diff(rows, append=picture.shape[0])
    widths = numpy.diff(columns, append=picture.shape[1])
    counts = numpy.outer(heights, widths)
    return sums / counts.reshape(counts.shape + (1,) * (picture.ndim - 2))


def srgb_decode(encoded: numpy.ndarray) -> numpy.ndarray:
    """From [0, 1] to [0, 1], IEC 61966-2-1."""
    return numpy.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def srgb_encode(linear: numpy.ndarray) -> numpy.ndarray:
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def reduce(shown: numpy.ndarray, factor: int) -> numpy.ndarray:
    """Downscales a display picture, averaging each block in linear light: as the screen would look
    from farther away."""
    if factor == 1:
        return shown
    light = srgb_decode(numpy.arange(256) / 255)[shown]
    return numpy.floor(255 * srgb_encode(_block_means(light, factor)) + 0.5).astype(numpy.uint8)


def heat_map(errors: numpy.ndarray, scale: float, factor: int,
             colours: numpy.ndarray) -> numpy.ndarray:
    """Downscales an error map, clamped to `scale`; a block that is not finite counts as 0."""
    with numpy.errstate(all="ignore"):
        values = _block_means(errors.astype(float), factor) / scale
    values = numpy.clip(numpy.where(numpy.isfinite(values), values, 0), 0, 1)
    return colours[numpy.floor((len(colours) - 1) * values + 0.5).astype(int)]


def reduction(width: int, maximum: int) -> int:
    """The smallest factor that makes a picture at most `maximum` wide."""
    return -(-width // maximum)


# Pages ----------------------------------------------------------------------------------------

def data_uri(picture: numpy.ndarray) -> str:
    """A data URI with the picture as PNG."""
    file = io.BytesIO()
    Image.fromarray(numpy.ascontiguousarray(picture)).save(file, "png")
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()
