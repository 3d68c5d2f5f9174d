#ifndef PASSES_DISPLACEMENT_WELDED_MESH_H
#define PASSES_DISPLACEMENT_WELDED_MESH_H

#include <lobe/scene.h>

#include "shaders/interface/displacement/displacement.h"

/// A mesh whose vertices are welded, so that it is displaced without cracks: see
/// shaders/interface/displacement/displacement.h. Vertices are at one point if their positions are
/// equal and joints and morph targets move them alike.
typedef struct welded_mesh {
    struct base_triangle *triangles;
    struct base_edge *edges;
    struct base_chart *charts; ///< point by point
    struct base_point *points; ///< in the order of their first vertices
    uint32_t (*pairs)[2];      ///< charts at both ends of an edge, edge by edge
    uint32_t *corners;         ///< of the mesh, point by point, in order
    uint32_t triangle_count, edge_count, chart_count, point_count, pair_count;
} welded_mesh;

/// Of a point no more than so many charts are used, and of an edge no more than so many pairs: the
/// first ones. Only meshes whose triangles meet in places by the dozen have more.
enum { WELDED_MOST_CHARTS = 64 };

/// The mesh must have been checked. False if memory ends; nothing is left then.
bool passes_welded_mesh_create(const lobe_mesh *mesh, const lobe_allocator *allocator,
                               welded_mesh *welded);
void passes_welded_mesh_free(welded_mesh *welded);

#endif
