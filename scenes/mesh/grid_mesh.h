#ifndef SCENES_MESH_GRID_MESH_H
#define SCENES_MESH_GRID_MESH_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Curved surfaces as grids of quadrilaterals.

typedef struct grid_mesh {
    const char *name;
    uint32_t rows, columns; ///< quadrilaterals, 1 or more of each
    bool closed;            ///< the last column of vertices lies on the first
    /// Sets the position and the first texture coordinates of a vertex; u = column / columns from
    /// the left and v = row / rows from the top, as seen on the front.
    void (*place)(const void *shape, double u, double v, lobe_scene_vertex *vertex);
    const void *shape; ///< argument of `place`
} grid_mesh;

/// Makes a mesh with smooth normals and tangents; `mesh` is overwritten. Errors: as
/// scenes_mesh_allocate.
lobe_result scenes_grid_mesh_make(const grid_mesh *grid, const lobe_host *host, lobe_mesh *mesh);

#endif
