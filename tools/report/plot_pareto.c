#include "tools/report/plot_pareto.h"

#include <math.h>
#include <stdbool.h>

/// With smaller x; of equal x, smaller y; of equal costs, the one named first.
static bool before(const plot_cost *costs, size_t left, size_t right) {
    const plot_cost *a = &costs[left], *b = &costs[right];
    if (a->x != b->x)
        return a->x < b->x;
    return a->y != b->y ? a->y < b->y : left < right;
}

static void insert(const plot_cost *costs, size_t *sorted, size_t count, size_t index) {
    for (; count > 0 && before(costs, index, sorted[count - 1]); --count)
        sorted[count] = sorted[count - 1];
    sorted[count] = index;
}

size_t plot_pareto_front(const plot_cost *costs, size_t count, size_t *front) {
    size_t finite = 0, kept = 0;
    for (size_t i = 0; i < count; ++i) {
        if (isfinite(costs[i].x) && isfinite(costs[i].y))
            insert(costs, front, finite++, i);
    }
    // By rising x, a choice is on the front where it is better in y than all before it.
    for (size_t i = 0; i < finite; ++i) {
        if (kept == 0 || costs[front[i]].y < costs[front[kept - 1]].y)
            front[kept++] = front[i];
    }
    return kept;
}
