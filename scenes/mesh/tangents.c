#include <stdint.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/vector.h"

// The handednesses that the triangles of a vertex require.
enum { RIGHT_HANDED = 1, LEFT_HANDED = 2, BOTH_HANDED = 3 };

// One triangle's contribution to the tangents of its corners.
typedef struct triangle_frame {
    vector3 tangent; // length: the area
    vector3 normal;
    bool mirrored; // coordinates run clockwise as seen on the front, image rows downwards
} triangle_frame;

static void transformed_coordinates(const lobe_scene_vertex *vertex, const lobe_texture_use *use,
                                    double uv[2]) {
    const float *set = vertex->texture_coordinates[use->texture_coordinates];
    for (int row = 0; row < 2; row++) {
        const float *m = use->transform[row];
        uv[row] = (double)m[0] * set[0] + (double)m[1] * set[1] + m[2];
    }
}

// Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh": solves
// edge_k = du_k T + dv_k B for T. False where the coordinates span no area.
static bool measure_triangle(const lobe_mesh *mesh, const uint32_t corner[3],
                             const lobe_texture_use *use, triangle_frame *frame) {
    double uv[3][2];
    vector3 p[3];
    for (int k = 0; k < 3; k++) {
        transformed_coordinates(&mesh->vertices[corner[k]], use, uv[k]);
        p[k] = vector3_load(mesh->vertices[corner[k]].position);
    }
    double du1 = uv[1][0] - uv[0][0], dv1 = uv[1][1] - uv[0][1];
    double du2 = uv[2][0] - uv[0][0], dv2 = uv[2][1] - uv[0][1];
    double determinant = du1 * dv2 - du2 * dv1;
    double extent = du1 * du1 + dv1 * dv1 + du2 * du2 + dv2 * dv2;
    // Below this, the direction is rounding noise of single-precision coordinates.
    if (!(fabs(determinant) > 1e-10 * extent))
        return false;
    vector3 edge1 = vector3_subtract(p[1], p[0]), edge2 = vector3_subtract(p[2], p[0]);
    frame->normal = vector3_cross(edge1, edge2);
    frame->mirrored = determinant > 0;
    frame->tangent = vector3_subtract(vector3_scale(edge1, dv2), vector3_scale(edge2, dv1));
    if (!vector3_normalise(&frame->tangent, 0))
        return false;
    double area = 0.5 * vector3_length(frame->normal);
    frame->tangent = vector3_scale(frame->tangent, determinant > 0 ? area : -area);
    return true;
}

// The bitangent runs up the image, against v: for an image that is not mirrored it is cross(normal,
// tangent). A normal that points away from the front reverses this.
static unsigned corner_handedness(const lobe_scene_vertex *vertex, const triangle_frame *frame) {
    bool away = vector3_dot(frame->normal, vector3_load(vertex->normal)) < 0;
    return frame->mirrored != away ? LEFT_HANDED : RIGHT_HANDED;
}

static void collect_handedness(const lobe_mesh *mesh, const lobe_texture_use *use,
                               unsigned char *handedness) {
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        triangle_frame frame;
        if (!measure_triangle(mesh, corner, use, &frame))
            continue;
        for (int k = 0; k < 3; k++)
            handedness[corner[k]] |= corner_handedness(&mesh->vertices[corner[k]], &frame);
    }
}

// Copies each vertex that needs both handednesses; `copies` receives the indices of the copies.
static bool append_copies(lobe_mesh *mesh, const unsigned char *handedness, uint32_t *copies) {
    size_t count = mesh->vertex_count;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        copies[i] = handedness[i] == BOTH_HANDED ? (uint32_t)count++ : (uint32_t)i;
    if (count > UINT32_MAX)
        return false;
    lobe_scene_vertex *vertices = lobe_reallocate(NULL, mesh->vertices, count, sizeof *vertices);
    if (!vertices)
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        vertices[copies[i]] = vertices[i];
    mesh->vertices = vertices;
    mesh->vertex_count = count;
    return true;
}

static void redirect_left_handed(lobe_mesh *mesh, const lobe_texture_use *use,
                                 const unsigned char *handedness, const uint32_t *copies) {
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        uint32_t *corner = mesh->indices + i;
        triangle_frame frame;
        if (!measure_triangle(mesh, corner, use, &frame))
            continue;
        for (int k = 0; k < 3; k++) {
            uint32_t v = corner[k];
            if (handedness[v] == BOTH_HANDED &&
                corner_handedness(&mesh->vertices[v], &frame) == LEFT_HANDED)
                corner[k] = copies[v];
        }
    }
}

static bool split_by_handedness(const lobe_allocator *allocator, lobe_mesh *mesh,
                                const lobe_texture_use *use) {
    unsigned char *handedness = lobe_allocate(allocator, mesh->vertex_count, 1);
    uint32_t *copies = lobe_allocate(allocator, mesh->vertex_count, sizeof *copies);
    bool done = handedness && copies;
    if (done)
        collect_handedness(mesh, use, handedness);
    done = done && append_copies(mesh, handedness, copies);
    if (done)
        redirect_left_handed(mesh, use, handedness, copies);
    lobe_release(handedness);
    lobe_release(copies);
    return done;
}

static void sum_tangents(lobe_mesh *mesh, const lobe_texture_use *use, vector3 *sums) {
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        triangle_frame frame;
        if (!measure_triangle(mesh, corner, use, &frame))
            continue;
        for (int k = 0; k < 3; k++) {
            lobe_scene_vertex *vertex = &mesh->vertices[corner[k]];
            sums[corner[k]] = vector3_add(sums[corner[k]], frame.tangent);
            vertex->tangent[3] = corner_handedness(vertex, &frame) == LEFT_HANDED ? -1 : 1;
        }
    }
}

static void store_tangent(lobe_scene_vertex *vertex, vector3 sum) {
    vector3 normal = vector3_load(vertex->normal);
    vector3 along = vector3_scale(normal, vector3_dot(normal, sum));
    vector3 tangent = vector3_subtract(sum, along);
    if (vector3_normalise(&tangent, 1e-6 * vector3_length(sum)))
        vector3_store(tangent, vertex->tangent);
    else
        scenes_mesh_orthogonal(vertex->normal, vertex->tangent);
}

lobe_result scenes_mesh_compute_tangents(lobe_mesh *mesh, const lobe_texture_use *use,
                                         const lobe_host *host) {
    const lobe_allocator *allocator = lobe_host_allocator(host);
    const lobe_texture_use none = LOBE_TEXTURE_NONE;
    use = use ? use : &none;
    bool mapped =
        use->texture_coordinates < 2 && mesh->has_texture_coordinates[use->texture_coordinates];
    vector3 *sums = NULL;
    bool allocated = !mapped || split_by_handedness(allocator, mesh, use);
    if (allocated)
        sums = lobe_allocate(allocator, mesh->vertex_count, sizeof *sums);
    if (!sums)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                              "mesh '%s': out of memory for tangents", mesh->name);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].tangent[3] = 1;
    if (mapped)
        sum_tangents(mesh, use, sums);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        store_tangent(&mesh->vertices[i], sums[i]);
    lobe_release(sums);
    return LOBE_OK;
}

void scenes_mesh_orthogonal(const float normal[3], float tangent[3]) {
    vector3 n = vector3_load(normal);
    // The axis farthest from the normal, so that the cross product stays long.
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    vector3 axis = {x <= y && x <= z, y < x && y <= z, z < x && z < y};
    vector3 t = vector3_cross(axis, n);
    if (!vector3_normalise(&t, 0))
        t = (vector3){1, 0, 0};
    vector3_store(t, tangent);
}
