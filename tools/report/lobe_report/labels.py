"""Places labels beside points with as little overlap as possible, with each other and with what is
drawn. y grows downwards."""

from __future__ import annotations

import numpy
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

SIZE = 12
HEIGHT = 13.0  # of a line of text
LONGEST = 40  # characters

_DIRECTIONS = ((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (1, 1), (-1, -1), (-1, 1))
_DISTANCES = (9, 16, 26, 40, 58)
_FONT = FontProperties(size=SIZE)


def shorten(text: str) -> str:
    """Truncates the text to one line that fits in a plot."""
    text = " ".join(text.split())
    return text if len(text) <= LONGEST else text[:LONGEST - 1] + "…"


def text_width(text: str) -> float:
    return text_to_path.get_text_width_height_descent(text, _FONT, ismath=False)[0]


Box = tuple[float, float, float, float]  # left, top, right, bottom


def _common_area(box: Box, others: numpy.ndarray) -> numpy.ndarray:
    left, top, right, bottom = others.T
    width = numpy.minimum(box[2], right) - numpy.maximum(box[0], left)
    height = numpy.minimum(box[3], bottom) - numpy.maximum(box[1], top)
    return numpy.maximum(width, 0) * numpy.maximum(height, 0)


def _beside(x: float, y: float, direction: tuple[int, int], distance: float, width: float) -> Box:
    """A box that touches a circle around the point, in that direction."""
    dx, dy = direction
    reach = distance * 0.5 ** 0.5 if dx and dy else distance
    left = x + dx * reach - width * (1 - dx) / 2
    top = y + dy * reach - HEIGHT * (1 - dy) / 2
    return left, top, left + width, top + HEIGHT


class Labels:
    def __init__(self, bounds: Box):
        """Labels should stay within the bounds."""
        self._bounds = numpy.array([bounds])
        self._taken = numpy.empty((0, 4))
        self._costs = numpy.empty(0)  # of covering a unit of area of each

    def take(self, box: Box, cost: float = 1):
        """Labels placed from now on avoid the box."""
        self._taken = numpy.vstack([self._taken, box])
        self._costs = numpy.append(self._costs, cost)

    def _badness(self, box: Box) -> float:
        """The cost of what it covers; sticking out of the plot costs most."""
        outside = (box[2] - box[0]) * HEIGHT - _common_area(box, self._bounds)[0]
        return 10 * outside + float(self._costs @ _common_area(box, self._taken))

    def place(self, x: float, y: float, width: float) -> Box:
        """Finds a place for a point's label and reserves it."""
        # A label far from its point is nearly as bad as one that covers a little.
        choices = [(self._badness(box) + 1.2 * (distance - _DISTANCES[0]), box)
                   for distance in _DISTANCES
                   for box in (_beside(x, y, direction, distance, width)
                               for direction in _DIRECTIONS)]
        best = min(choices, key=lambda choice: choice[0])[1]
        # Overlapping texts are unreadable; a mark behind a text is still visible.
        self.take(best, 8)
        return best
