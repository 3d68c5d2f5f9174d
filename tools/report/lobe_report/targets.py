"""Reads limits of ratios between filters from a file, and tests results against them. The file is a
list of objects with the members of Target; tools/targets writes one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from . import measures
from .errors import ReportError
from .number_text import number_text
from .results import Results, parse_json

MEASURES = {"error": measures.error, "flicker": measures.flicker, "rebuilt": measures.rebuilt,
            "retained": measures.retained, "bytes": measures.texel_bytes}


@dataclass
class Target:
    name: str
    measure: str
    scene: str | None  # None: the means over all scenes that have both filters
    filter: str
    base: str
    limit: float
    at_least: bool  # else at most

    def value(self, results: Results) -> float:
        measure = MEASURES[self.measure]
        if self.scene is None:
            return measures.ratio_of_means(results, measure, self.filter, self.base)
        return measures.ratio(results, measure, self.scene, self.filter, self.base)

    def means(self, results: Results) -> measures.Mean:
        return measures.mean_ratio(results, MEASURES[self.measure], self.filter, self.base)

    def is_met(self, value: float) -> bool:
        return value >= self.limit if self.at_least else value <= self.limit

    def missed_by(self, value: float) -> str:
        """Percent."""
        excess = measures.divide(self.limit, value) if self.at_least else value / self.limit
        return number_text(100 * (excess - 1), 2)

    def absence(self, results: Results) -> str:
        """The reason why there is no value."""
        for name in (self.filter, self.base):
            if name not in results.filters:
                return f"the filter {name} is not in the results"
        if self.scene is None:
            return "no scene was measured with both filters"
        return f"the scene {self.scene} was not measured with both filters"


def _is_target(entry) -> bool:
    texts = ("name", "measure", "filter", "base")
    return (isinstance(entry, dict) and all(isinstance(entry.get(key), str) for key in texts)
            and entry["measure"] in MEASURES
            and isinstance(entry.get("scene"), (str, type(None)))
            and isinstance(entry.get("limit"), (int, float))
            and math.isfinite(entry["limit"]) and entry["limit"] > 0
            and isinstance(entry.get("at_least"), bool))


def read(path: Path) -> list[Target]:
    entries = parse_json(path)
    if not isinstance(entries, list):
        raise ReportError(f"{path}: not a list of targets")
    for index, entry in enumerate(entries):
        if not _is_target(entry):
            raise ReportError(f"{path}: [{index}]: not a target")
    return [Target(**{key: entry.get(key) for key in Target.__dataclass_fields__})
            for entry in entries]
