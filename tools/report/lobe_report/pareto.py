"""The Pareto front of choices with two costs."""

from __future__ import annotations

import math


def front(costs: list[tuple[float, float]]) -> list[int]:
    """Indices of the choices that no other dominates (better in one cost and at least as good in
    the other), in order of rising first cost; of equal choices only the first. Choices with costs
    that are not finite are ignored."""
    finite = [i for i, cost in enumerate(costs) if all(map(math.isfinite, cost))]
    kept: list[int] = []
    for index in sorted(finite, key=lambda i: costs[i]):
        if not kept or costs[index][1] < costs[kept[-1]][1]:
            kept.append(index)
    return kept
