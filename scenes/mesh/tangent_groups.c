#include "scenes/mesh/tangent_groups.h"

#include "scenes/mesh/adjacency.h"

typedef struct grouping {
    const uint32_t *across;
    tangent_triangle *triangles;
    uint32_t *groups;
} grouping;

static bool has_no_group(const grouping *grouping, uint32_t triangle) {
    const uint32_t *groups = grouping->groups + 3 * (size_t)triangle;
    return groups[0] == 0 && groups[1] == 0 && groups[2] == 0;
}

static bool join(grouping *grouping, uint32_t corner, uint32_t group, bool mirrored) {
    if (grouping->groups[corner] != 0)
        return false;
    tangent_triangle *triangle = &grouping->triangles[corner / 3];
    if (triangle->undirected && has_no_group(grouping, corner / 3))
        triangle->mirrored = mirrored;
    if (triangle->mirrored != mirrored)
        return false;
    grouping->groups[corner] = group;
    return true;
}

// The corner at the same vertex in the triangle across the edge that leaves it, or arrives there.
static uint32_t turn(const grouping *grouping, uint32_t corner, bool leaving) {
    uint32_t edge = grouping->across[leaving ? corner : previous_corner(corner)];
    return leaving && edge != NO_CORNER ? next_corner(edge) : edge;
}

static void grow(grouping *grouping, uint32_t corner, bool leaving) {
    uint32_t group = grouping->groups[corner];
    bool mirrored = grouping->triangles[corner / 3].mirrored;
    do
        corner = turn(grouping, corner, leaving);
    while (corner != NO_CORNER && join(grouping, corner, group, mirrored));
}

void scenes_mesh_group_corners(const uint32_t *vertices, const uint32_t *across,
                               size_t corner_count, tangent_triangle *triangles, uint32_t *groups) {
    grouping grouping = {across, triangles, groups};
    uint32_t count = 0;
    for (size_t k = 0; k < corner_count; k++)
        groups[k] = 0;
    for (uint32_t k = 0; k < corner_count; k++) {
        if (vertices[k] == NO_CORNER || triangles[k / 3].undirected || groups[k] != 0)
            continue;
        groups[k] = ++count;
        grow(&grouping, k, true);
        grow(&grouping, k, false);
    }
}
