"""Measures of rows, and their means over scenes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Callable

from .results import NAN, Results, Row

Measure = Callable[[Row], float]  # NaN if it was not measured


def error(row: Row) -> float:
    return row.error.relative_l2


def flicker(row: Row) -> float:
    return row.flicker if row.flicker >= 0 else NAN


def rebuilt(row: Row) -> float:
    return row.rebuilt_ms


def retained(row: Row) -> float:
    return row.retained_ms


def texel_bytes(row: Row) -> float:
    return row.bytes_per_texel


def divide(a: float, b: float) -> float:
    """IEEE division: infinity or NaN instead of Python's exception."""
    if b:
        return a / b
    return math.copysign(math.inf, a) if a else NAN


def logarithm(value: float) -> float:
    if value > 0:
        return math.log(value)
    return NAN if value else -math.inf


@dataclass
class Mean:
    arithmetic: float
    geometric: float
    scenes: int  # those that have a value


def mean_of(values: list[float]) -> Mean:
    """Mean of the finite values."""
    values = [value for value in values if math.isfinite(value)]
    if not values:
        return Mean(NAN, NAN, 0)
    count = len(values)
    return Mean(sum(values) / count, math.exp(sum(map(logarithm, values)) / count), count)


def of_default(results: Results, measure: Measure, scene: str, name: str) -> float:
    row = results.default(scene, name)
    return measure(row) if row else NAN


def ratio(results: Results, measure: Measure, scene: str, name: str, base: str) -> float:
    """The ratio of two filters' measures in a scene, both at their defaults."""
    return divide(of_default(results, measure, scene, name),
                  of_default(results, measure, scene, base))


def mean_ratio(results: Results, measure: Measure, name: str, base: str | None) -> Mean:
    """Means over the scenes of the ratio to the base; without one, of the measure itself."""
    if base is None:
        return mean_of([of_default(results, measure, scene.name, name)
                        for scene in results.scenes])
    return mean_of([ratio(results, measure, scene.name, name, base) for scene in results.scenes])


def ratio_of_means(results: Results, measure: Measure, name: str, base: str) -> float:
    """The ratio of the means over the scenes that have both."""
    pairs = [(of_default(results, measure, scene.name, name),
              of_default(results, measure, scene.name, base)) for scene in results.scenes]
    pairs = [pair for pair in pairs if all(map(math.isfinite, pair))]
    total = sum(second for _, second in pairs)
    return sum(first for first, _ in pairs) / total if total > 0 else NAN
