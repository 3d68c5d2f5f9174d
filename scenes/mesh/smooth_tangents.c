#include "scenes/mesh/mesh.h"
#include "scenes/mesh/vector.h"

// The area of a triangle along its tangent. Lengyel 2001, "Computing Tangent Space Basis Vectors
// for an Arbitrary Mesh": solves edge_k = du_k T + dv_k B for T.
static vector3 weighted_tangent(const lobe_mesh *mesh, const uint32_t corner[3]) {
    const float *uv[3];
    vector3 p[3];
    for (int k = 0; k < 3; k++) {
        uv[k] = mesh->vertices[corner[k]].texture_coordinates[0];
        p[k] = vector3_load(mesh->vertices[corner[k]].position);
    }
    double du1 = (double)uv[1][0] - uv[0][0], dv1 = (double)uv[1][1] - uv[0][1];
    double du2 = (double)uv[2][0] - uv[0][0], dv2 = (double)uv[2][1] - uv[0][1];
    vector3 edge1 = vector3_subtract(p[1], p[0]), edge2 = vector3_subtract(p[2], p[0]);
    vector3 tangent = vector3_subtract(vector3_scale(edge1, dv2), vector3_scale(edge2, dv1));
    if (!vector3_normalise(&tangent, 0))
        return (vector3){0, 0, 0};
    double area = 0.5 * vector3_length(vector3_cross(edge1, edge2));
    return vector3_scale(tangent, du1 * dv2 > du2 * dv1 ? area : -area);
}

static void store_tangent(lobe_scene_vertex *vertex, vector3 sum) {
    vector3 normal = vector3_load(vertex->normal);
    vector3 along = vector3_scale(normal, vector3_dot(normal, sum));
    vector3 tangent = vector3_subtract(sum, along);
    if (vector3_normalise(&tangent, 1e-6 * vector3_length(sum)))
        vector3_store(tangent, vertex->tangent);
    else
        scenes_mesh_orthogonal(vertex->normal, vertex->tangent);
    vertex->tangent[3] = 1;
}

lobe_result scenes_mesh_smooth_tangents(lobe_mesh *mesh, const lobe_host *host) {
    vector3 *sums = lobe_allocate(lobe_host_allocator(host), mesh->vertex_count, sizeof *sums);
    if (!sums)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                              "mesh '%s': out of memory for tangents", mesh->name);
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        vector3 tangent = weighted_tangent(mesh, corner);
        for (int k = 0; k < 3; k++)
            sums[corner[k]] = vector3_add(sums[corner[k]], tangent);
    }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        store_tangent(&mesh->vertices[i], sums[i]);
    lobe_release(sums);
    return LOBE_OK;
}
