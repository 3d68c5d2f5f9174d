"""Bandwidth of the passes that build maps, over the scenes, next to a plain copy."""

from __future__ import annotations

from dataclasses import dataclass

from .measures import mean_of
from .results import NAN, Pass, Results


def speed(size: float, milliseconds: float) -> float:
    """Gigabytes per second; NaN if bytes or time are unknown."""
    return size / milliseconds * 1e-6 if size > 0 and milliseconds > 0 else NAN


@dataclass
class Bandwidth:
    filter: int  # index into the results'
    name: str  # of the pass
    speeds: list[float]
    copies: list[float]
    ratio: float  # geometric mean of speed over copy


def _bandwidth(index: int, name: str, passes: list[Pass]) -> Bandwidth:
    speeds = [speed(item.bytes, item.milliseconds) for item in passes]
    timed = [item for item in passes if item.copy_milliseconds > 0]
    ratios = [item.copy_milliseconds / item.milliseconds for item in timed]
    return Bandwidth(index, name, speeds,
                     [speed(item.bytes, item.copy_milliseconds) for item in timed],
                     mean_of(ratios).geometric)


def of_results(results: Results) -> list[Bandwidth]:
    """For each filter's passes, in the order in which they first appear in the scenes."""
    found: dict[tuple[int, str], list[Pass]] = {}
    for index, name in enumerate(results.filters):
        for scene in results.scenes:
            row = results.default(scene.name, name)
            for item in row.passes if row else ():
                if item.building and item.bytes > 0 and item.milliseconds > 0:
                    found.setdefault((index, item.name), []).append(item)
    return [_bandwidth(index, name, passes) for (index, name), passes in found.items()]
