#ifndef SCENES_BUILTIN_HALL_LATHE_H
#define SCENES_BUILTIN_HALL_LATHE_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Turned shapes: columns, rings, vases.

/// The outline is a smooth curve through `count` points, from the top downwards: distance from the
/// Y axis (above 0) and height, in metres. Each stretch between two points is divided into `cuts`;
/// two points close together make an edge.
typedef struct lathe_shape {
    const char *name;
    const double (*outline)[2];
    size_t count;
    uint32_t cuts, columns; ///< quadrilaterals per stretch, and around the axis
    double tile;            ///< metres of outline per unit of v
    double tiles_around;    ///< units of u around the axis
} lathe_shape;

/// `mesh` is overwritten. Errors: as scenes_mesh_allocate.
lobe_result scenes_lathe_make(const lathe_shape *shape, const lobe_host *host, lobe_mesh *mesh);

#endif
