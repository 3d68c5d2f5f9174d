#ifndef SCENES_MESH_ADJACENCY_H
#define SCENES_MESH_ADJACENCY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>

/// Corners of a mesh, numbered like its indices: three for each triangle. Edge k runs from corner k
/// to the next corner of its triangle.

#define NO_CORNER UINT32_MAX

static inline uint32_t next_corner(uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static inline uint32_t previous_corner(uint32_t corner) {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// `across[k]` becomes the edge of another triangle that joins the same two vertices in the
/// opposite direction, or NO_CORNER. Where several triangles meet at an edge, the first of each
/// direction are paired, then the second ones, and so on. A triangle whose three vertices are
/// NO_CORNER has no edges. False if memory ends.
bool scenes_mesh_pair_edges(const lobe_allocator *allocator, const uint32_t *vertices,
                            size_t corner_count, uint32_t *across);

#endif
