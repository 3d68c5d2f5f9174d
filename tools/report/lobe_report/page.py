"""The page: the data that templates show, and the templates."""

from __future__ import annotations

from datetime import datetime, timezone
from pathlib import Path

import jinja2

from . import bandwidth, gallery, measures, paper, plots, style
from .number_text import number, number_text
from .picture_stream import PictureStream
from .results import Results, Row, Scene
from .targets import Target

# A measure that the summary averages, and the filter that it is relative to.
SUMMARY = ((measures.error, "direct"), (measures.error, "lobes"), (measures.flicker, None),
           (measures.rebuilt, "direct"), (measures.retained, "direct"),
           (measures.texel_bytes, None))


def _summary(results: Results):
    """For each filter the number of scenes, and the means."""
    for name in results.filters:
        means = [measures.mean_ratio(results, measure, name, base) for measure, base in SUMMARY]
        yield measures.mean_ratio(results, measures.rebuilt, name, None).scenes, means


def _methods(results: Results, scene: Scene):
    """Filters by methods of integrating the environment: index and name of each filter, and its
    rows in which all other knobs are at their defaults."""
    found: dict[tuple[str, str], Row] = {}
    for row in results.rows_of(scene):
        if row.varied in ("", "env"):
            found.setdefault((row.filter, row.settings.get("env", "")), row)
    for index, name in enumerate(results.filters):
        rows = [found.get((name, method)) for method in plots.METHODS]
        if any(rows):
            yield index, name, rows


def _scene(results: Results, index: int, scene: Scene, pictures: PictureStream, width: int):
    """The data for a scene's template. Reads the stream even if the scene has no pictures."""
    shown = gallery.make(results, scene, pictures, width)
    if scene.skipped:
        return {"scene": scene}
    return {
        "scene": scene,
        "gallery": shown,
        "trades": [plots.draw_trade(results, scene, index, trade) for trade in plots.TRADES],
        "passes": plots.draw_passes(results, scene, index),
        "methods": list(_methods(results, scene)) if scene.environment else [],
        "rows": results.filters_of(scene),
        "variations": [(i, row) for i, name in enumerate(results.filters)
                       for row in results.rows_of(scene)
                       if row.filter == name and not row.is_default],
    }


def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).with_name("templates")),
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.globals.update(number=number, number_text=number_text, speed=bandwidth.speed,
                               divide=measures.divide, flicker=measures.flicker, NaN=float("nan"))
    return environment


def draw(results: Results, targets: list[Target], pictures: PictureStream, width: int) -> str:
    """`width`: wider pictures are downscaled."""
    scenes = [_scene(results, index, scene, pictures, width)
              for index, scene in enumerate(results.scenes)]
    time = datetime.fromtimestamp(results.time, timezone.utc)
    keys = [(style.colour(i), style.key_path(i, 9)) for i in range(len(results.filters))]
    return _environment().get_template("page.html").render(
        results=results, targets=targets, scenes=scenes, time=f"{time:%Y-%m-%d %H:%M UTC}",
        keys=keys, summary=list(_summary(results)), paper=paper.ROWS,
        bandwidths=bandwidth.of_results(results), methods=plots.METHODS)
