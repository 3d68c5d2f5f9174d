"""Table 1 of Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", next to the same ratios here."""

from __future__ import annotations

from dataclasses import dataclass

from . import measures
from .results import Results

# The filters here that correspond to the table's columns.
FILTERS = ("direct", "mipmap", "lean", "reference", "lobes")


@dataclass
class PaperRow:
    theirs: str
    ours: str  # the scene that takes its place here
    milliseconds: tuple[float, ...]  # of FILTERS, on their machine

    def pairs(self, results: Results) -> list[tuple[float, float]]:
        """The printed and the measured values: direct in milliseconds, all others relative to
        it."""
        rebuilt = measures.rebuilt
        direct = self.milliseconds[0]
        first = (direct, measures.of_default(results, rebuilt, self.ours, "direct"))
        return [first, *((printed / direct,
                          measures.ratio(results, rebuilt, self.ours, name, "direct"))
                         for name, printed in zip(FILTERS[1:], self.milliseconds[1:]))]

    def moments(self, results: Results) -> float:
        return measures.ratio(results, measures.rebuilt, self.ours, "moments", "direct")


ROWS = (
    PaperRow("Pillow", "pillow", (0.6, 0.6, 0.9, 59, 2.0)),
    PaperRow("Tablecloth", "tablecloth", (0.4, 0.4, 0.7, 50, 1.6)),
    PaperRow("Bunny", "bunny", (0.5, 0.5, 0.8, 51, 1.8)),
    PaperRow("Dragon", "dragon", (0.5, 0.6, 0.8, 54, 1.7)),
    PaperRow("Sponza", "hall", (1.6, 1.6, 1.9, 97, 2.5)),
)
