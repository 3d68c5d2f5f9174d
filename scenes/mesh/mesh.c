#include "scenes/mesh/mesh.h"

#include <math.h>
#include <string.h>

#include "scenes/mesh/deformation.h"
#include "scenes/mesh/vector.h"

#define MESH_MAXIMUM_COUNT ((size_t)1 << 31)

static lobe_result allocate_arrays(const lobe_allocator *allocator, lobe_mesh *mesh,
                                   const char *name) {
    mesh->name = lobe_copy_text(allocator, name);
    mesh->vertices = lobe_allocate(allocator, mesh->vertex_count, sizeof *mesh->vertices);
    mesh->indices = lobe_allocate(allocator, mesh->index_count, sizeof *mesh->indices);
    if (!mesh->name || !mesh->vertices || !mesh->indices)
        return LOBE_ERROR_OUT_OF_MEMORY;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int channel = 0; channel < 4; channel++)
            mesh->vertices[i].colour[channel] = 1;
    }
    return LOBE_OK;
}

lobe_result scenes_mesh_allocate(lobe_mesh *mesh, const char *name, size_t vertex_count,
                                 size_t index_count, const lobe_host *host) {
    *mesh = (lobe_mesh){.vertex_count = vertex_count, .index_count = index_count};
    if (vertex_count == 0 || vertex_count > MESH_MAXIMUM_COUNT || index_count == 0 ||
        index_count > MESH_MAXIMUM_COUNT || index_count % 3 != 0) {
        *mesh = (lobe_mesh){0};
        return lobe_host_fail(host, LOBE_ERROR_LIMIT,
                              "mesh '%s': %zu vertices and %zu indices are not possible", name,
                              vertex_count, index_count);
    }
    lobe_result result = allocate_arrays(lobe_host_allocator(host), mesh, name);
    if (result == LOBE_OK)
        return LOBE_OK;
    scenes_mesh_free(mesh);
    return lobe_host_fail(host, result, "mesh '%s': out of memory for %zu vertices", name,
                          vertex_count);
}

void scenes_mesh_free(lobe_mesh *mesh) {
    lobe_release(mesh->name);
    lobe_release(mesh->vertices);
    lobe_release(mesh->indices);
    scenes_deformation_free(&mesh->deformation);
    *mesh = (lobe_mesh){0};
}

static bool is_degenerate(const lobe_mesh *mesh, const uint32_t corner[3]) {
    vector3 a = vector3_load(mesh->vertices[corner[0]].position);
    vector3 ab = vector3_subtract(vector3_load(mesh->vertices[corner[1]].position), a);
    vector3 ac = vector3_subtract(vector3_load(mesh->vertices[corner[2]].position), a);
    vector3 bc = vector3_subtract(ac, ab);
    double longest = fmax(vector3_dot(ab, ab), fmax(vector3_dot(ac, ac), vector3_dot(bc, bc)));
    // A height below 1e-9 of the longest side is rounding of the coordinates, not a surface.
    return !(vector3_length(vector3_cross(ab, ac)) > 1e-9 * longest);
}

size_t scenes_mesh_drop_degenerate(lobe_mesh *mesh) {
    size_t kept = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        if (is_degenerate(mesh, mesh->indices + i))
            continue;
        memmove(mesh->indices + kept, mesh->indices + i, 3 * sizeof *mesh->indices);
        kept += 3;
    }
    size_t dropped = (mesh->index_count - kept) / 3;
    mesh->index_count = kept;
    return dropped;
}

void scenes_mesh_compute_bounds(lobe_mesh *mesh) {
    for (int axis = 0; axis < 3; axis++) {
        mesh->minimum[axis] = mesh->maximum[axis] =
            mesh->vertex_count > 0 ? mesh->vertices[0].position[axis] : 0;
        for (size_t i = 1; i < mesh->vertex_count; i++) {
            float p = mesh->vertices[i].position[axis];
            mesh->minimum[axis] = fminf(mesh->minimum[axis], p);
            mesh->maximum[axis] = fmaxf(mesh->maximum[axis], p);
        }
    }
}
