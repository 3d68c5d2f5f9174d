"""The plots of a scene: error against cost, and the times of passes."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

from . import axes, bars, measures, scatter, supersampling
from .results import Results, Row, Scene

# Methods of integrating an environment that a sweep measures: values of the knob `env`.
METHODS = ("prefiltered", "mip", "sampled")


@dataclass
class Trade:
    """A plot of error against one cost."""
    id: str
    title: str
    x_title: str
    unit: str
    cost: measures.Measure
    is_time: bool = True


TRADES = (
    Trade("rebuilt", "Time and error, maps rebuilt", "milliseconds per frame, maps rebuilt", "ms",
          measures.rebuilt),
    Trade("retained", "Time and error, maps retained", "milliseconds per frame, maps retained",
          "ms", measures.retained),
    Trade("memory", "Memory and error", "bytes of filtered maps per texel", "bytes per texel",
          measures.texel_bytes, False),
)


@dataclass
class DrawnTrade:
    trade: Trade
    plot: Markup  # empty if nothing was measured
    front: list[tuple[str, float, float]]  # name, cost, error
    far: list[tuple[str, float, float]]  # what the plot omits


def _name(row: Row) -> str:
    return row.filter if row.is_default else f"{row.filter}, {row.varied} {row.varied_value}"


def _method(row: Row) -> int:
    value = row.settings.get("env")
    return METHODS.index(value) if value in METHODS else 0


def _points(results: Results, rows: list[Row], cost: measures.Measure) -> list[scatter.Point]:
    mains = {row.filter: i for i, row in reversed(list(enumerate(rows))) if row.is_default}
    points = []
    for index, row in enumerate(rows):
        origin = mains.get(row.filter, index)
        points.append(scatter.Point(cost(row), measures.error(row),
                                    results.filters.index(row.filter),
                                    None if origin == index else origin, _name(row), _method(row)))
    return points


def draw_trade(results: Results, scene: Scene, index: int, trade: Trade) -> DrawnTrade:
    rows = [row for row in results.rows_of(scene) if not row.is_far]
    points = _points(results, rows, trade.cost)
    plot, front = scatter.draw(scatter.Scatter(
        f"scene-{index}-{trade.id}", trade.title, trade.x_title, "error, relative L2",
        results.filters, points, METHODS if scene.environment else (),
        supersampling.curve(results, scene) if trade.is_time else []))
    far = [(row.filter, trade.cost(row), measures.error(row))
           for _, row in results.filters_of(scene) if row.is_far]
    return DrawnTrade(trade, plot, [(points[i].about, points[i].x, points[i].y) for i in front],
                      far)


def draw_passes(results: Results, scene: Scene, index: int) -> Markup:
    """Empty if no passes were timed."""
    rows = [row for _, row in results.filters_of(scene) if row.passes and not row.is_far]
    kinds = list(dict.fromkeys(item.name for row in rows for item in row.passes))
    drawn = [bars.Bar(row.filter, [
        bars.Part(kinds.index(item.name),
                  item.milliseconds if axes.is_drawable(item.milliseconds) else 0.0)
        for item in row.passes]) for row in rows]
    if not drawn:
        return Markup()
    return bars.draw(bars.Bars(f"scene-{index}-passes", "Passes",
                               "milliseconds of device time, maps rebuilt", kinds, drawn))
