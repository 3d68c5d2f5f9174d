#include "tools/scenes/polygon_mesh.h"

#include <string.h>

#include "scenes/mesh/mesh.h"

// The array stores no capacity: it is the power of two not below its count.
static bool grow(const polygon_mesh *polygons, void **array, size_t count, size_t element_size) {
    if ((count & (count - 1)) != 0)
        return true;
    void *larger =
        lobe_reallocate(polygons->allocator, *array, count ? 2 * count : 1, element_size);
    if (larger)
        *array = larger;
    return larger != NULL;
}

bool polygon_mesh_add_position(polygon_mesh *polygons, const double position[3]) {
    if (!grow(polygons, (void **)&polygons->positions, polygons->position_count,
              sizeof *polygons->positions))
        return false;
    float *added = polygons->positions[polygons->position_count++];
    for (int axis = 0; axis < 3; axis++)
        added[axis] = (float)position[axis];
    return true;
}

bool polygon_mesh_add_triangle(polygon_mesh *polygons, uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t corners[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        if (!grow(polygons, (void **)&polygons->indices, polygons->index_count,
                  sizeof *polygons->indices))
            return false;
        polygons->indices[polygons->index_count++] = corners[k];
    }
    return true;
}

static lobe_result check(const polygon_mesh *polygons, const char *name, const lobe_host *host) {
    if (polygons->position_count == 0 || polygons->index_count == 0)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: no triangles", name);
    for (size_t i = 0; i < polygons->index_count; i++)
        if (polygons->indices[i] >= polygons->position_count)
            return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                                  "%s: triangle %zu has vertex %u, there are %zu", name, i / 3,
                                  polygons->indices[i], polygons->position_count);
    return LOBE_OK;
}

lobe_result polygon_mesh_finish(const polygon_mesh *polygons, const char *name,
                                const lobe_host *host, lobe_mesh *mesh) {
    *mesh = (lobe_mesh){0};
    lobe_result status = check(polygons, name, host);
    if (!status)
        status =
            scenes_mesh_allocate(mesh, name, polygons->position_count, polygons->index_count, host);
    if (status)
        return status;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        memcpy(mesh->vertices[i].position, polygons->positions[i], sizeof *polygons->positions);
    memcpy(mesh->indices, polygons->indices, mesh->index_count * sizeof *mesh->indices);
    scenes_mesh_drop_degenerate(mesh);
    if (mesh->index_count == 0)
        status = lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: no triangle has an area", name);
    if (!status)
        status = scenes_mesh_compute_normals(mesh, host);
    if (status)
        scenes_mesh_free(mesh);
    return status;
}

void polygon_mesh_free(polygon_mesh *polygons) {
    lobe_release(polygons->positions);
    lobe_release(polygons->indices);
    *polygons = (polygon_mesh){.allocator = polygons->allocator};
}
