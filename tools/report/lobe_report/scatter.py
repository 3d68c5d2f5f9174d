"""A scatter plot of choices with two costs: a mark for each, and rings and a stepped line for the
Pareto front, whose marks are numbered from left to right."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from . import axes, style, svg
from .labels import Labels, shorten, text_width
from .pareto import front

WIDTH, HEIGHT = 560, 400
LEFT, RIGHT, TOP, BOTTOM, LEGEND_LINE = 62, 16, 6, 44, 17
MAIN_SIZE, SMALL_SIZE, KIND_SIZE, RING_SIZE = 10.4, 6.4, 8.4, 18
MAXIMUM_KINDS = 3
CURVE_REACH = 4
GREY = "#555555"


@dataclass
class Point:
    x: float
    y: float
    series: int  # index into the plot's
    origin: int | None  # index of the point it is a variation of
    about: str  # tooltip of the mark
    kind: int = 0  # of a variation: index into the plot's, below MAXIMUM_KINDS

    @property
    def is_drawable(self) -> bool:
        return axes.is_drawable(self.x) and axes.is_drawable(self.y)

    @property
    def size(self) -> float:
        if self.origin is None:
            return MAIN_SIZE
        return KIND_SIZE if self.kind else SMALL_SIZE


@dataclass
class Scatter:
    id: str  # unique in the page
    title: str
    x_title: str
    y_title: str
    series: list[str]
    points: list[Point]
    kinds: tuple[str, ...] = ()  # shown by the inside of a variation's mark; (): not shown
    curve: list[tuple[float, float]] = field(default_factory=list)  # to compare with


# Marks ----------------------------------------------------------------------------------------

def _marks(x: float, y: float, series: int, size: float, kind: int | None) -> list[Line2D]:
    """A mark; `kind` is None for a filled one."""
    colour, width = style.colour(series), size * style.shape_size(series)
    full = kind is None
    parts = [Line2D([x], [y], linestyle="none", marker=style.shape(series), markersize=width,
                    markerfacecolor=colour if full else "#fff",
                    markeredgecolor="#fff" if full else colour,
                    markeredgewidth=0.8 if full else 1.2)]
    if kind == 1:
        parts.append(Line2D([x], [y], linestyle="none", marker="o", markersize=0.4 * size,
                            markerfacecolor=colour, markeredgewidth=0))
    if kind == 2:
        parts.append(Line2D([x], [y], linestyle="none", marker="_", markersize=size,
                            markeredgecolor=colour, markeredgewidth=1.4))
    return parts


def _draw_mark(plot: Axes, point: Point, index: int):
    kind = None if point.origin is None else point.kind
    for part, line in enumerate(_marks(point.x, point.y, point.series, point.size, kind)):
        line.set(gid="overlay" if part else f"mark:{index}", clip_on=False,
                 zorder=4 if kind is None else 3)
        plot.add_line(line)


def _draw_variation_line(plot: Axes, point: Point, origin: Point):
    """Connects a filter's variations to its defaults."""
    plot.plot([point.x, origin.x], [point.y, origin.y], color=style.colour(point.series),
              linestyle=style.dashes(point.series), linewidth=0.8, alpha=0.65, zorder=2)


# Legend ---------------------------------------------------------------------------------------

def _legend_columns(names: list[str]) -> int:
    """As many as fit; matplotlib fills columns from the top."""
    widths = [text_width(name) + 29 for name in names]
    for columns in range(len(names), 1, -1):
        lines = -(-len(names) // columns)
        if sum(max(widths[i:i + lines]) for i in range(0, len(names), lines)) < WIDTH - LEFT:
            return columns
    return 1


def _draw_legend(figure, entries: list[tuple[str, tuple]], top: float) -> float:
    """Names with marks, below `top`; returns how far it reaches."""
    names = [shorten(name) for name, _ in entries]
    columns = _legend_columns(names)
    figure.legend([marks for _, marks in entries], names, ncol=columns, loc="upper left",
                  handlelength=1, bbox_to_anchor=(LEFT / WIDTH, 1 - top / HEIGHT))
    return top + LEGEND_LINE * -(-len(names) // columns)


def _draw_legends(figure, plot: Scatter) -> float:
    used = {point.series for point in plot.points}
    series = [(name, tuple(_marks(0, 0, i, MAIN_SIZE, None)))
              for i, name in enumerate(plot.series) if i in used]
    bottom = _draw_legend(figure, series, TOP)
    if plot.kinds:
        kinds = [(name, tuple(_marks(0, 0, 0, KIND_SIZE, kind)))
                 for kind, name in enumerate(plot.kinds)]
        bottom = _draw_legend(figure, kinds, bottom)
    return bottom


# Axes -----------------------------------------------------------------------------------------

def _set_axis(plot: Axes, name: str, axis: axes.Axis, title: str):
    plot.set(**{f"{name}label": title, f"{name}scale": "log" if axis.is_logarithmic else "linear"})
    plot.set(**{f"{name}lim": (axis.minimum, axis.maximum)})
    drawn = getattr(plot, f"{name}axis")
    drawn.set_major_locator(FixedLocator(axis.ticks))
    drawn.set_minor_locator(NullLocator())
    drawn.set_major_formatter(FuncFormatter(lambda tick, _: axes.label(tick)))


def _near_curve(plot: Scatter, drawable: list[Point]) -> list[tuple[float, float]]:
    """The part of the curve that is not far to the right of all points."""
    right = CURVE_REACH * max(point.x for point in drawable)
    return [(x, y) for x, y in plot.curve
            if axes.is_drawable(x) and axes.is_drawable(y) and x <= right]


def _make_axes(figure, plot: Scatter, drawable: list[Point]) -> Axes:
    curve = _near_curve(plot, drawable)
    top = _draw_legends(figure, plot) + 4
    made = figure.add_axes([LEFT / WIDTH, BOTTOM / HEIGHT, (WIDTH - LEFT - RIGHT) / WIDTH,
                            (HEIGHT - top - BOTTOM) / HEIGHT])
    _set_axis(made, "x", axes.fit([point.x for point in drawable] + [x for x, _ in curve]),
              plot.x_title)
    _set_axis(made, "y", axes.fit([point.y for point in drawable] + [y for _, y in curve]),
              plot.y_title)
    if curve:
        made.plot(*zip(*curve), color=GREY, linewidth=1.1, linestyle=":", marker=".", gid="curve",
                  markersize=4, zorder=2.4)
    return made


# Pareto front ---------------------------------------------------------------------------------

def _draw_front(plot: Axes, points: list[Point]):
    """Steps, because there is nothing between two choices: everything above and to the right is
    worse than some choice."""
    right, top = plot.get_xlim()[1], plot.get_ylim()[1]
    x, y = [], []
    for point in points:
        x += [point.x, point.x]
        y += [y[-1] if y else top, point.y]
    plot.plot([*x, right], [*y, y[-1]], color=GREY, linewidth=1.3, linestyle=(0, (4, 2.5)),
              gid="front", zorder=2.5)
    for point in points:
        plot.plot([point.x], [point.y], marker="o", markersize=RING_SIZE, markerfacecolor="none",
                  markeredgecolor=GREY, markeredgewidth=1.1, gid="ring", clip_on=False, zorder=2.6)


# Labels ---------------------------------------------------------------------------------------

def _draw_label(plot: Axes, labels: Labels, x: float, y: float, text: str):
    """(x, y) in pixels, y downwards."""
    box = labels.place(x, y, text_width(text))
    near = min(max(x, box[0]), box[2]), min(max(y, box[1]), box[3])
    if math.hypot(near[0] - x, near[1] - y) > 12:
        plot.figure.add_artist(Line2D([x, near[0]], [HEIGHT - y, HEIGHT - near[1]], transform=None,
                                      color="#888888", linewidth=0.7, zorder=3.5))
    plot.figure.text(box[0], HEIGHT - box[3] + 3, text, transform=None, gid="label", zorder=5)


def _draw_labels(plot: Axes, scatter: Scatter, shown: list[int], numbers: dict[int, int]):
    """Named points first: their labels need the most room."""
    box = plot.get_window_extent()
    labels = Labels((box.x0, HEIGHT - box.y1, box.x1, HEIGHT - box.y0))
    places = {}
    for index in shown:
        point = scatter.points[index]
        x, y = plot.transData.transform((point.x, point.y))
        places[index] = x, HEIGHT - y
        reach = (RING_SIZE if index in numbers else point.size) / 2
        labels.take((x - reach, HEIGHT - y - reach, x + reach, HEIGHT - y + reach))
    for index in shown:
        point = scatter.points[index]
        if point.origin is None:
            name = shorten(scatter.series[point.series])
            _draw_label(plot, labels, *places[index],
                        f"{numbers[index]} {name}" if index in numbers else name)
    for index in shown:
        if index in numbers and scatter.points[index].origin is not None:
            _draw_label(plot, labels, *places[index], str(numbers[index]))


# ----------------------------------------------------------------------------------------------

def draw(scatter: Scatter) -> tuple[Markup, list[int]]:
    """The plot, empty if there is no point to draw, and the numbered points."""
    points = scatter.points
    shown = [i for i, point in enumerate(points) if point.is_drawable]
    if not shown:
        return Markup(), []
    numbered = [shown[i] for i in front([(points[i].x, points[i].y) for i in shown])]
    figure = svg.make_figure(WIDTH, HEIGHT)
    plot = _make_axes(figure, scatter, [points[i] for i in shown])
    drawn = set(shown)
    for index in shown:
        origin = points[index].origin
        if origin in drawn:
            _draw_variation_line(plot, points[index], points[origin])
    _draw_front(plot, [points[i] for i in numbered])
    for index in shown:
        _draw_mark(plot, points[index], index)
    _draw_labels(plot, scatter, shown, {index: i + 1 for i, index in enumerate(numbered)})
    description = (f"{len(points)} points; across: {scatter.x_title}; up: {scatter.y_title}. The "
                   "list below names the points of the Pareto front.")
    return svg.inline(figure, scatter.id, scatter.title, description,
                      [point.about for point in points]), numbered
