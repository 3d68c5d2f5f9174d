#ifndef SCENES_MESH_SHAPE_H
#define SCENES_MESH_SHAPE_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Simple meshes, with exact normals and tangents and one set of texture coordinates. `mesh` is
/// overwritten. Errors: LOBE_ERROR_OUT_OF_MEMORY.

/// A horizontal rectangle around the origin that faces up (+Y). u runs along +X, v along +Z, both 0
/// in the middle; one unit is `tile` metres.
lobe_result scenes_shape_plane(float width, float depth, float tile, const lobe_host *host,
                               lobe_mesh *mesh);

/// A unit sphere around the origin: `columns` quadrilaterals around the Y axis, `rows` from pole to
/// pole. u runs from 0 to `tiles_u` around the axis, v from 0 at +Y to `tiles_v` at -Y.
lobe_result scenes_shape_sphere(uint32_t rows, uint32_t columns, float tiles_u, float tiles_v,
                                const lobe_host *host, lobe_mesh *mesh);

/// A box around the origin, `size` metres wide, high and deep. On each face u runs to the right and
/// v downwards as seen from outside, 0 in the middle; one unit is `tile` metres.
lobe_result scenes_shape_box(const float size[3], float tile, const lobe_host *host,
                             lobe_mesh *mesh);

/// Writes the two triangles of each cell of a grid of (rows + 1) x (columns + 1) vertices, stored
/// row by row; rows run downwards as seen from the front. Returns the end of the written indices.
uint32_t *scenes_shape_grid_indices(uint32_t rows, uint32_t columns, uint32_t *indices);

#endif
