"""The range, scale and ticks of an axis."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

WANTED_TICKS = 5
TOLERANCE = 1e-9  # for values that are nice except for rounding
LARGEST, SMALLEST = 1e18, 1e-200  # a plot ignores larger values; smaller ones count as 0


@dataclass
class Axis:
    minimum: float
    maximum: float
    is_logarithmic: bool = False
    ticks: list[float] = field(default_factory=list)

    def position(self, value: float) -> float:
        """0 at the minimum, 1 at the maximum."""
        if self.is_logarithmic:
            return math.log(value / self.minimum) / math.log(self.maximum / self.minimum)
        return (value - self.minimum) / (self.maximum - self.minimum)


def nice_number(value: float) -> float:
    """The smallest 1, 2 or 5 times a power of ten that is at least a positive value: Heckbert 1990,
    "Nice Numbers for Graph Labels", Graphics Gems."""
    power = 10.0 ** math.floor(math.log10(max(value, SMALLEST)))
    return next((multiple * power for multiple in (1, 2, 5)
                 if value <= multiple * power * (1 + TOLERANCE)), 10 * power)


def linear(maximum: float) -> Axis:
    """From 0; the last tick is not below the maximum."""
    step = nice_number((maximum if maximum > 0 else 1) / WANTED_TICKS)
    steps = max(math.ceil(maximum / step - TOLERANCE), 1)
    return Axis(0, steps * step, False, [i * step for i in range(steps + 1)])


def _logarithmic_ticks(minimum: float, maximum: float) -> list[float]:
    """As many multiples of each power of ten as stay apart; over many decades, not every power."""
    decades = math.log10(maximum) - math.log10(minimum)
    multiples = (1, 2, 5) if decades < 2.2 else (1, 3) if decades < 4 else (1,)
    powers = range(math.floor(math.log10(minimum)), math.floor(math.log10(maximum)) + 1,
                   max(math.ceil(decades / 14), 1))
    ticks = [multiple * 10.0 ** power for power in powers for multiple in multiples]
    return [tick for tick in ticks if minimum <= tick <= maximum]


def _logarithmic(least: float, most: float) -> Axis:
    """Leaves room at both ends, so that no mark is clipped."""
    room = (most / least) ** 0.06
    minimum, maximum = least / room, most * room
    return Axis(minimum, maximum, True, _logarithmic_ticks(minimum, maximum))


def is_drawable(value: float) -> bool:
    return math.isfinite(value) and 0 <= value < LARGEST


def fit(values: list[float]) -> Axis:
    """For drawable values; others are ignored. The axis is logarithmic if all are positive and span
    more than a decade. Otherwise it begins at 0, or slightly below if a value is 0, so that its
    mark is not on the edge."""
    values = [value if value > SMALLEST else 0 for value in values if is_drawable(value)]
    least, most = min(values, default=math.inf), max(values, default=0)
    if 0 < least and most > 10 * least:
        return _logarithmic(least, most)
    axis = linear(most * 1.04)
    if least == 0:
        axis.minimum = -0.05 * axis.maximum
    return axis


def label(tick: float) -> str:
    return f"{tick:.6g}" if abs(tick) < 1e6 else f"{tick:.0f}"
