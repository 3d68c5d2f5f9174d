
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/vector.h"

// The cross product of two edges is twice the area times the normal: summing it weights by area.
static vector3 *sum_triangle_normals(const lobe_mesh *mesh, const lobe_host *host) {
    vector3 *sums = lobe_allocate(lobe_host_allocator(host), mesh->vertex_count, sizeof *sums);
    if (!sums)
        return NULL;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        vector3 a = vector3_load(mesh->vertices[corner[0]].position);
        vector3 b = vector3_load(mesh->vertices[corner[1]].position);
        vector3 c = vector3_load(mesh->vertices[corner[2]].position);
        vector3 normal = vector3_cross(vector3_subtract(b, a), vector3_subtract(c, a));
        for (int k = 0; k < 3; k++)
            sums[corner[k]] = vector3_add(sums[corner[k]], normal);
    }
    return sums;
}

static void store_normal(lobe_scene_vertex *vertex, vector3 sum) {
    if (!vector3_normalise(&sum, 0))
        sum = (vector3){0, 1, 0};
    vector3_store(sum, vertex->normal);
}

static lobe_result out_of_memory(const lobe_mesh *mesh, const lobe_host *host) {
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "mesh '%s': out of memory for normals",
                          mesh->name);
}

lobe_result scenes_mesh_compute_normals(lobe_mesh *mesh, const lobe_host *host) {
    vector3 *sums = sum_triangle_normals(mesh, host);
    if (!sums)
        return out_of_memory(mesh, host);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        store_normal(&mesh->vertices[i], sums[i]);
    lobe_release(sums);
    return LOBE_OK;
}

lobe_result scenes_mesh_repair_normals(lobe_mesh *mesh, const lobe_host *host, size_t *repaired) {
    vector3 *sums = NULL;
    *repaired = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        vector3 normal = vector3_load(mesh->vertices[i].normal);
        if (vector3_normalise(&normal, 1e-6)) {
            vector3_store(normal, mesh->vertices[i].normal);
            continue;
        }
        if (!sums)
            sums = sum_triangle_normals(mesh, host);
        if (!sums)
            return out_of_memory(mesh, host);
        store_normal(&mesh->vertices[i], sums[i]);
        ++*repaired;
    }
    lobe_release(sums);
    return LOBE_OK;
}
