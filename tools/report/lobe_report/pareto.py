"""The Pareto front of choices with two costs."""

from __future__ import annotations

import math


def front(costs: list[tuple[float, float]]) -> list[int]:
    """Indices of the choices than which no other is better in one cost and at least as good in the
    other, with rising first and falling second cost; of equal choices only the first. Costs that
    are not finite are ignored."""
    finite = [i for i, cost in enumerate(costs) if all(map(math.isfinite, cost))]
    kept: list[int] = []
    for index in sorted(finite, key=lambda i: costs[i]):
        if not kept or costs[index][1] < costs[kept[-1]][1]:
            kept.append(index)
    return kept
