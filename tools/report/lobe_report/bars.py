"""Horizontal stacked bars, with a legend of their parts."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter

from . import axes, style, svg
from .labels import shorten, text_width
from .number_text import number_text

WIDTH, TOP, RIGHT, BAR, THICKNESS, AXIS, LINE = 560, 8, 58, 26, 18, 46, 17
EDGE = "#444444"


@dataclass
class Part:
    kind: int  # index into the plot's
    value: float


@dataclass
class Bar:
    name: str
    parts: list[Part]  # from left to right

    @property
    def total(self) -> float:
        return sum(part.value for part in self.parts)


@dataclass
class Bars:
    id: str  # unique in the page
    title: str
    x_title: str
    kinds: list[str]  # shown as 1, 2, 3 ... in the parts and the legend
    bars: list[Bar]


def _draw_part(plot: Axes, part: Part, row: int, left: float, tooltip: int):
    area, line, hatching = style.fill(part.kind)
    place = {"y": row, "width": part.value, "left": left, "height": THICKNESS / BAR}
    (filled,) = plot.barh(**place, color=area, edgecolor=line, linewidth=0, hatch=hatching)
    filled.set_gid(f"part:{tooltip}")
    (outline,) = plot.barh(**place, color="none", edgecolor=EDGE, linewidth=0.8)
    outline.set_gid("overlay")
    number = str(part.kind + 1)
    pixels = part.value / plot.get_xlim()[1] * plot.get_window_extent().width
    if pixels > text_width(number) + 3:
        plot.text(left + part.value / 2, row, number, ha="center", va="center_baseline",
                  gid="halo")


def _draw_bar(plot: Axes, bar: Bar, row: int, kinds: list[str], tooltips: list[str]):
    left = 0.0
    for part in bar.parts:
        tooltips.append(f"{kinds[part.kind]}: {number_text(part.value, 4)}")
        _draw_part(plot, part, row, left, len(tooltips) - 1)
        left += part.value
    plot.annotate(number_text(left, 4), (left, row), (5, 0), textcoords="offset points",
                  va="center_baseline", annotation_clip=False)


def _set_axes(plot: Axes, bars: Bars):
    axis = axes.linear(max(bar.total for bar in bars.bars))
    plot.set(xlim=(0, axis.maximum), ylim=(len(bars.bars) - 0.5, -0.5), xlabel=bars.x_title)
    plot.xaxis.set_major_locator(FixedLocator(axis.ticks))
    plot.xaxis.set_major_formatter(FuncFormatter(lambda tick, _: axes.label(tick)))
    plot.set_yticks(range(len(bars.bars)), [shorten(bar.name) for bar in bars.bars])
    plot.tick_params(axis="y", length=0, pad=8, labelsize=12, labelcolor="#000000")
    plot.grid(False, axis="y")
    plot.spines["left"].set_visible(False)


def _legend_columns(names: list[str]) -> int:
    return 2 if max(map(text_width, names)) + 42 < WIDTH / 2 else 1


def _draw_legend(figure, names: list[str], columns: int, height: float):
    entries = []
    for kind in range(len(names)):
        area, line, hatching = style.fill(kind)
        entries.append((Patch(facecolor=area, edgecolor=line, linewidth=0, hatch=hatching),
                        Patch(facecolor="none", edgecolor=EDGE, linewidth=0.8)))
    figure.legend(entries, names, ncol=columns, loc="lower left", handlelength=1.2,
                  handleheight=1, handletextpad=0.5, bbox_to_anchor=(8 / WIDTH, 4 / height))


def draw(bars: Bars) -> Markup:
    """Needs at least one bar with a part."""
    names = [f"{i + 1} {shorten(kind)}" for i, kind in enumerate(bars.kinds)]
    columns = _legend_columns(names)
    bottom = AXIS + LINE * -(-len(names) // columns) + 4
    height = TOP + BAR * len(bars.bars) + bottom
    left = min(max(text_width(shorten(bar.name)) for bar in bars.bars) + 14, WIDTH / 3)
    figure = svg.make_figure(WIDTH, height)
    plot = figure.add_axes([left / WIDTH, bottom / height, (WIDTH - RIGHT - left) / WIDTH,
                            BAR * len(bars.bars) / height])
    _set_axes(plot, bars)
    tooltips: list[str] = []
    for row, bar in enumerate(bars.bars):
        _draw_bar(plot, bar, row, bars.kinds, tooltips)
    _draw_legend(figure, names, columns, height)
    return svg.inline(figure, bars.id, bars.title,
                      "Stacked bars; the table of passes has the same numbers.", tooltips)
