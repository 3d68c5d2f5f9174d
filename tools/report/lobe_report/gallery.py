"""The pictures of a scene: the reference, and each filter's with its error map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy

from . import axes, pictures
from .errors import ReportError
from .picture_stream import PictureStream
from .results import Results, Row, Scene

SCALE_STEPS = 50  # of the colours shown beside the reference


@dataclass
class Shown:
    """A picture in the page."""
    kind: str  # class: "whole", "detail" or "errors"
    alt: str
    width: int
    height: int
    source: str


def _shown(kind: str, alt: str, picture: numpy.ndarray) -> Shown:
    return Shown(kind, alt, picture.shape[1], picture.shape[0], pictures.data_uri(picture))


@dataclass
class Entry:
    """What a filter rendered."""
    filter: int  # index into the results'
    row: Row
    picture: numpy.ndarray  # as on a screen
    errors: numpy.ndarray
    views: list[Shown]


@dataclass
class Gallery:
    reference: list[Shown]
    entries: list[Entry]
    factor: int  # by which pictures are downscaled
    detail: pictures.Window | None  # shown at full size if they are
    scale: float  # of all error maps
    scale_colours: list[str]
    scale_axis: axes.Axis


def _receive(results: Results, scene: Scene, stream: PictureStream):
    """The reference as displayed, and one entry per filter, in the order of filters."""
    reference, entries = None, {}
    for picture in stream.scene():
        if picture.row is None:
            reference = picture
            continue
        row = results.rows[picture.row]
        if picture.size != reference.size:
            raise ReportError(
                "{}: {}x{} pixels, but the reference of scene '{}' has {}x{}".format(
                    row.picture, *picture.size, scene.name, *reference.size))
        errors = pictures.error_map(picture.linear, reference.linear)
        index = results.filters.index(row.filter)
        entries.setdefault(index, Entry(index, row, picture.shown, errors, []))
    return reference, [entries[index] for index in sorted(entries)]


def _scale(maps: list[numpy.ndarray]) -> float:
    """The worst tenth of all pixels is beyond the scale; otherwise the worst filter would set it,
    and the maps of the good ones would be black."""
    most = pictures.quantile(maps, 0.9)
    return axes.nice_number(most) if most > 0 else 1.0


def _views(picture: numpy.ndarray, name: str, factor: int,
           detail: pictures.Window | None) -> list[Shown]:
    views = [_shown("whole", name, pictures.reduce(picture, factor))]
    if detail:
        views.append(_shown("detail", f"detail of {name}", detail.of(picture)))
    return views


def _scale_colours(colours: numpy.ndarray) -> list[str]:
    middles = (numpy.arange(SCALE_STEPS) + 0.5) / SCALE_STEPS * (len(colours) - 1)
    return ["#" + bytes(colours[round(middle)]).hex() for middle in middles]


def make(results: Results, scene: Scene, stream: PictureStream, width: int) -> Gallery | None:
    """The gallery of the next scene in the stream; None if it kept no pictures."""
    reference, entries = _receive(results, scene, stream)
    if reference is None:
        return None
    maps = [entry.errors for entry in entries]
    scale = _scale(maps)
    factor = pictures.reduction(reference.size[0], width)
    detail = None
    if factor > 1 and entries:
        detail = pictures.worst_window(
            maps, *((extent // factor + 1) // 2 for extent in reference.size))
    for entry in entries:
        name = entry.row.filter
        heat = pictures.heat_map(entry.errors, scale, factor, stream.heat_colours)
        entry.views = [*_views(entry.picture, name, factor, detail),
                       _shown("errors", f"error map of {name}", heat)]
    return Gallery(_views(reference.shown, "the reference", factor, detail), entries, factor,
                   detail, scale, _scale_colours(stream.heat_colours), axes.linear(scale))
