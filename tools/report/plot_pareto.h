#ifndef TOOLS_REPORT_PLOT_PARETO_H
#define TOOLS_REPORT_PLOT_PARETO_H

#include <stddef.h>

/// A choice with two costs, both the better the smaller.
typedef struct plot_cost {
    double x, y;
} plot_cost;

/// The Pareto front: choices than which no other is better in one cost and at least as good in the
/// other. Writes their indices to `front` (room for `count`) with rising x and falling y; of equal
/// choices the first alone. Returns how many. Costs that are not finite are passed over.
size_t plot_pareto_front(const plot_cost *costs, size_t count, size_t *front);

#endif
