#ifndef SCENES_MESH_TANGENT_GROUPS_H
#define SCENES_MESH_TANGENT_GROUPS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "scenes/mesh/vector.h"

/// How a triangle's texture coordinates lie on it.
typedef struct tangent_triangle {
    vector3 tangent; ///< unit, along increasing u
    bool mirrored;   ///< coordinates run clockwise as seen on the front, image rows downwards
    bool undirected; ///< they span no area: there is no tangent, and a group of either hand may
                     ///< contain the triangle
} tangent_triangle;

/// Numbers the groups of corners that share a tangent, from 1: corners at the same vertex, of the
/// same hand, whose triangles are joined by edges at that vertex (Mikkelsen 2008, "Simulation of
/// Wrinkled Surfaces Revisited", section 3.3 and MikkTSpace). `vertices` and `across` are those of
/// scenes_mesh_pair_edges. `groups[k]` becomes the group of corner k, 0 where no triangle with a
/// tangent is connected to it. Undirected triangles get the hand of the first group that reaches
/// them.
void scenes_mesh_group_corners(const uint32_t *vertices, const uint32_t *across,
                               size_t corner_count, tangent_triangle *triangles, uint32_t *groups);

#endif
