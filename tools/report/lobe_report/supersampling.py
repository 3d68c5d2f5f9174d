"""What supersampling needs for the error of a filter."""

from __future__ import annotations

import math

from .results import NAN, Results, Row, Scene, Supersampling

TIMED_SAMPLES = 64  # of the row of the filter reference


def _interpolate(a: Supersampling, b: Supersampling, error: float) -> float:
    part = math.log(a.relative_l2 / error) / math.log(a.relative_l2 / b.relative_l2)
    return a.samples * (b.samples / a.samples) ** part


def samples_for(steps: list[Supersampling], error: float) -> float:
    """The samples per pixel with an error, interpolated between those measured; the largest number
    measured for smaller errors; for larger ones as if errors fell as the root of the number. As in
    tools/sweep/lookup.c."""
    if not steps or not math.isfinite(error):
        return NAN
    if error >= steps[0].relative_l2:
        return steps[0].samples * (steps[0].relative_l2 / error) ** 2 if error > 0 else NAN
    for a, b in zip(steps, steps[1:]):
        if error >= b.relative_l2 > 0:
            return _interpolate(a, b, error)
    return steps[-1].samples


def sample_ms(results: Results, scene: Scene) -> float:
    """Milliseconds of one sample per pixel."""
    row = results.default(scene.name, "reference")
    return row.retained_ms / TIMED_SAMPLES if row else NAN


def curve(results: Results, scene: Scene) -> list[tuple[float, float]]:
    """Milliseconds and error of supersampling with more and more samples."""
    one = sample_ms(results, scene)
    return [(step.samples * one, step.relative_l2) for step in scene.supersampling]


def is_most(scene: Scene, row: Row) -> bool:
    """Whether a row is worth as many samples as were measured, or more."""
    return bool(scene.supersampling) and row.worth >= scene.supersampling[-1].samples


def add_worth(results: Results):
    """Fills in what each row is worth."""
    for scene in results.scenes:
        one = sample_ms(results, scene)
        for row in results.rows_of(scene):
            row.worth = samples_for(scene.supersampling, row.error.relative_l2)
            row.gain = row.worth * one / row.retained_ms if row.retained_ms > 0 else NAN
