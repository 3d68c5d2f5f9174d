#include "scenes/mesh/shape.h"

#include <string.h>

#include "scenes/mesh/circle.h"
#include "scenes/mesh/mesh.h"

static uint32_t *write_triangle(uint32_t *indices, uint32_t a, uint32_t b, uint32_t c) {
    indices[0] = a, indices[1] = b, indices[2] = c;
    return indices + 3;
}

uint32_t *scenes_shape_grid_indices(uint32_t rows, uint32_t columns, uint32_t *indices) {
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++) {
            uint32_t corner = row * (columns + 1) + column, below = corner + columns + 1;
            indices = write_triangle(indices, corner, below, below + 1);
            indices = write_triangle(indices, corner, below + 1, corner + 1);
        }
    return indices;
}

lobe_result scenes_shape_plane(float width, float depth, float tile, const lobe_host *host,
                               lobe_mesh *mesh) {
    lobe_result status = scenes_mesh_allocate(mesh, "plane", 4, 6, host);
    if (status)
        return status;
    mesh->has_texture_coordinates[0] = true;
    for (int i = 0; i < 4; i++) {
        lobe_scene_vertex *vertex = &mesh->vertices[i];
        vertex->position[0] = (i & 1 ? 0.5f : -0.5f) * width;
        vertex->position[2] = (i & 2 ? 0.5f : -0.5f) * depth;
        vertex->normal[1] = 1;
        vertex->tangent[0] = vertex->tangent[3] = 1;
        vertex->texture_coordinates[0][0] = vertex->position[0] / tile;
        vertex->texture_coordinates[0][1] = vertex->position[2] / tile;
    }
    scenes_shape_grid_indices(1, 1, mesh->indices);
    return LOBE_OK;
}

// A face looks along `axis`, forwards or backwards; `right` and `down` are as seen by a viewer in
// front of it with +Y up (for the upper and lower face: with -Z up).
static void place_face(const float size[3], float tile, int face, lobe_scene_vertex vertices[4]) {
    static const int8_t normals[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                         {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    static const int8_t rights[6][3] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0},
                                        {1, 0, 0},  {1, 0, 0}, {-1, 0, 0}};
    static const int8_t downs[6][3] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1},
                                       {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    for (int i = 0; i < 4; i++) {
        float right = i & 1 ? 0.5f : -0.5f, down = i & 2 ? 0.5f : -0.5f;
        lobe_scene_vertex *vertex = &vertices[i];
        for (int axis = 0; axis < 3; axis++) {
            float offset =
                0.5f * normals[face][axis] + right * rights[face][axis] + down * downs[face][axis];
            vertex->position[axis] = offset * size[axis];
            vertex->normal[axis] = normals[face][axis];
            vertex->tangent[axis] = rights[face][axis];
            vertex->texture_coordinates[0][0] += vertex->position[axis] * rights[face][axis] / tile;
            vertex->texture_coordinates[0][1] += vertex->position[axis] * downs[face][axis] / tile;
        }
        vertex->tangent[3] = 1;
    }
}

lobe_result scenes_shape_box(const float size[3], float tile, const lobe_host *host,
                             lobe_mesh *mesh) {
    lobe_result status = scenes_mesh_allocate(mesh, "box", 24, 36, host);
    if (status)
        return status;
    mesh->has_texture_coordinates[0] = true;
    uint32_t *indices = mesh->indices;
    for (uint32_t face = 0; face < 6; face++) {
        uint32_t first = face * 4;
        place_face(size, tile, (int)face, mesh->vertices + first);
        indices = write_triangle(indices, first, first + 2, first + 3);
        indices = write_triangle(indices, first, first + 3, first + 1);
    }
    return LOBE_OK;
}

static void place_on_sphere(double u, double v, lobe_scene_vertex *vertex) {
    double around[2], down[2];
    scenes_circle_point(u, around);
    scenes_circle_point(v / 2, down);
    vertex->normal[0] = (float)(down[1] * around[1]);
    vertex->normal[1] = (float)down[0];
    vertex->normal[2] = (float)(down[1] * around[0]);
    memcpy(vertex->position, vertex->normal, sizeof vertex->position);
    vertex->tangent[0] = (float)around[0];
    vertex->tangent[2] = (float)-around[1];
    vertex->tangent[3] = 1;
}

// A quadrilateral at a pole has one side of length 0, and thus one triangle without area.
static void connect_sphere(uint32_t rows, uint32_t columns, uint32_t *indices) {
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++) {
            uint32_t corner = row * (columns + 1) + column, below = corner + columns + 1;
            if (row + 1 < rows)
                indices = write_triangle(indices, corner, below, below + 1);
            if (row > 0)
                indices = write_triangle(indices, corner, below + 1, corner + 1);
        }
}

lobe_result scenes_shape_sphere(uint32_t rows, uint32_t columns, float tiles_u, float tiles_v,
                                const lobe_host *host, lobe_mesh *mesh) {
    size_t vertex_count = (size_t)(rows + 1) * (columns + 1);
    size_t index_count = (size_t)6 * (rows - 1) * columns;
    lobe_result status = scenes_mesh_allocate(mesh, "sphere", vertex_count, index_count, host);
    if (status)
        return status;
    mesh->has_texture_coordinates[0] = true;
    for (uint32_t row = 0, i = 0; row <= rows; row++)
        for (uint32_t column = 0; column <= columns; column++, i++) {
            double u = (double)column / columns, v = (double)row / rows;
            place_on_sphere(u, v, &mesh->vertices[i]);
            mesh->vertices[i].texture_coordinates[0][0] = (float)u * tiles_u;
            mesh->vertices[i].texture_coordinates[0][1] = (float)v * tiles_v;
        }
    connect_sphere(rows, columns, mesh->indices);
    return LOBE_OK;
}
