#include "scenes/mesh/grid_mesh.h"

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/mesh/vector.h"

static void place_vertices(const grid_mesh *grid, lobe_mesh *mesh) {
    lobe_scene_vertex *vertex = mesh->vertices;
    for (uint32_t row = 0; row <= grid->rows; row++)
        for (uint32_t column = 0; column <= grid->columns; column++, vertex++)
            grid->place(grid->shape, (double)column / grid->columns, (double)row / grid->rows,
                        vertex);
}

// Vertices that differ in texture coordinates alone share a normal, to hide the seam.
static void close_normals(const grid_mesh *grid, lobe_mesh *mesh) {
    for (uint32_t row = 0; row <= grid->rows; row++) {
        lobe_scene_vertex *first = mesh->vertices + (size_t)row * (grid->columns + 1);
        lobe_scene_vertex *last = first + grid->columns;
        vector3 sum = vector3_add(vector3_load(first->normal), vector3_load(last->normal));
        vector3_normalise(&sum, 0);
        vector3_store(sum, first->normal);
        vector3_store(sum, last->normal);
    }
}

lobe_result scenes_grid_mesh_make(const grid_mesh *grid, const lobe_host *host, lobe_mesh *mesh) {
    lobe_result status =
        scenes_mesh_allocate(mesh, grid->name, (size_t)(grid->rows + 1) * (grid->columns + 1),
                             (size_t)grid->rows * grid->columns * 6, host);
    if (status)
        return status;
    mesh->has_texture_coordinates[0] = true;
    place_vertices(grid, mesh);
    scenes_shape_grid_indices(grid->rows, grid->columns, mesh->indices);
    status = scenes_mesh_compute_normals(mesh, host);
    if (!status && grid->closed)
        close_normals(grid, mesh);
    if (!status)
        status = scenes_mesh_smooth_tangents(mesh, host);
    if (status)
        scenes_mesh_free(mesh);
    return status;
}
