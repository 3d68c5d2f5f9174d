#include "scenes/mesh/adjacency.h"

#include <stdlib.h>

typedef struct edge {
    uint32_t low, high; // vertices
    uint32_t backward;  // 1: it runs from `high` to `low`
    uint32_t corner;
} edge;

static int compare(const void *a, const void *b) {
    const edge *first = a, *second = b;
    if (first->low != second->low)
        return first->low < second->low ? -1 : 1;
    if (first->high != second->high)
        return first->high < second->high ? -1 : 1;
    if (first->backward != second->backward)
        return first->backward < second->backward ? -1 : 1;
    return first->corner < second->corner ? -1 : first->corner > second->corner;
}

static size_t list_edges(const uint32_t *vertices, size_t corner_count, edge *edges) {
    size_t count = 0;
    for (uint32_t k = 0; k < corner_count; k++) {
        uint32_t from = vertices[k], to = vertices[next_corner(k)];
        if (from != NO_CORNER)
            edges[count++] = from < to ? (edge){from, to, 0, k} : (edge){to, from, 1, k};
    }
    return count;
}

// The end of the edges from `begin` on that join the same vertices, in one direction unless `both`.
static size_t end_of_run(const edge *edges, size_t count, size_t begin, bool both) {
    size_t end = begin;
    while (end < count && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high &&
           (both || edges[end].backward == edges[begin].backward))
        end++;
    return end;
}

static void pair(const edge *edges, size_t count, uint32_t *across) {
    for (size_t begin = 0, end; begin < count; begin = end) {
        end = end_of_run(edges, count, begin, true);
        size_t middle = end_of_run(edges, count, begin, false);
        for (size_t k = 0; begin + k < middle && middle + k < end; k++) {
            across[edges[begin + k].corner] = edges[middle + k].corner;
            across[edges[middle + k].corner] = edges[begin + k].corner;
        }
    }
}

bool scenes_mesh_pair_edges(const lobe_allocator *allocator, const uint32_t *vertices,
                            size_t corner_count, uint32_t *across) {
    edge *edges = lobe_allocate(allocator, corner_count, sizeof *edges);
    if (!edges)
        return false;
    for (size_t k = 0; k < corner_count; k++)
        across[k] = NO_CORNER;
    size_t count = list_edges(vertices, corner_count, edges);
    qsort(edges, count, sizeof *edges, compare);
    pair(edges, count, across);
    lobe_release(edges);
    return true;
}
