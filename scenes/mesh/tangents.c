// Mikkelsen's tangent space, which glTF 2.0 asks for (section 3.7.2.1) and which most programs that
// bake normal maps use. Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", chapter 3, and
// mikktspace.com: corners are grouped (tangent_groups.h); each group's tangent is the mean of its
// triangles' tangents, each laid into the plane of the vertex's normal and weighted by the angle of
// the corner in that plane.

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "scenes/mesh/adjacency.h"
#include "scenes/mesh/deformation.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/tangent_groups.h"
#include "scenes/mesh/tangents.h"
#include "scenes/mesh/vector.h"
#include "scenes/mesh/weld.h"

typedef struct tangent_work {
    lobe_mesh *mesh;
    const lobe_texture_use *use;
    tangent_triangle *triangles;
    uint32_t *vertices, *across, *groups; // of each corner
    vector3 *sums;                        // of each group
    uint32_t copy_count;
    uint32_t *vertex_groups; // of each vertex, then of each copy; 0: none
    uint32_t *origins;       // of each copy
    uint32_t *latest;        // of each group, its last copy plus one
} tangent_work;

static vector3 position_at(const tangent_work *work, uint32_t corner) {
    return vector3_load(work->mesh->vertices[work->mesh->indices[corner]].position);
}

// ---------------------------------------------------------------------------------------------
// Triangles

static void load_coordinates(const lobe_mesh *mesh, const lobe_texture_use *use, uint32_t corner,
                             float uv[2]) {
    const float *set =
        mesh->vertices[mesh->indices[corner]].texture_coordinates[use->texture_coordinates];
    for (int row = 0; row < 2; row++) {
        const float *m = use->transform[row];
        uv[row] = (float)((double)m[0] * set[0] + (double)m[1] * set[1] + m[2]);
    }
}

// Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh": solves
// edge_k = du_k T + dv_k B.
triangle_mapping scenes_mesh_map_triangle(const lobe_mesh *mesh, const lobe_texture_use *use,
                                          uint32_t first) {
    vector3 p[3];
    float uv[3][2];
    for (uint32_t k = 0; k < 3; k++) {
        p[k] = vector3_load(mesh->vertices[mesh->indices[first + k]].position);
        load_coordinates(mesh, use, first + k, uv[k]);
    }
    float du1 = uv[1][0] - uv[0][0], dv1 = uv[1][1] - uv[0][1];
    float du2 = uv[2][0] - uv[0][0], dv2 = uv[2][1] - uv[0][1];
    vector3 edge1 = vector3_subtract(p[1], p[0]), edge2 = vector3_subtract(p[2], p[0]);
    return (triangle_mapping){
        .along = vector3_subtract(vector3_scale(edge1, dv2), vector3_scale(edge2, dv1)),
        .down = vector3_subtract(vector3_scale(edge2, du1), vector3_scale(edge1, du2)),
        .area = du1 * dv2 - dv1 * du2};
}

// Whether coordinates have an area is decided in single precision, as Mikkelsen's implementation
// does.
static void measure_triangle(const tangent_work *work, uint32_t first, tangent_triangle *triangle) {
    triangle_mapping mapping = scenes_mesh_map_triangle(work->mesh, work->use, first);
    triangle->mirrored = mapping.area > 0;
    triangle->undirected =
        !(fabsf(mapping.area) > FLT_MIN && vector3_normalise(&mapping.along, 0) &&
          vector3_length(mapping.down) > 0);
    triangle->tangent = mapping.area > 0 ? mapping.along : vector3_scale(mapping.along, -1);
}

static bool same_position(vector3 a, vector3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool is_collapsed(const tangent_work *work, uint32_t first) {
    vector3 a = position_at(work, first), b = position_at(work, first + 1),
            c = position_at(work, first + 2);
    return same_position(a, b) || same_position(b, c) || same_position(c, a);
}

// Replaces the welded vertices, one for each vertex, by those of the corners.
static void measure_triangles(tangent_work *work, const uint32_t *welded) {
    for (uint32_t first = 0; first + 2 < work->mesh->index_count; first += 3) {
        bool collapsed = is_collapsed(work, first);
        for (uint32_t k = first; k < first + 3; k++)
            work->vertices[k] = collapsed ? NO_CORNER : welded[work->mesh->indices[k]];
        measure_triangle(work, first, &work->triangles[first / 3]);
    }
}

// ---------------------------------------------------------------------------------------------
// Sums over groups

// The unit vector along the part of `v` in the plane of the unit vector `normal`; zero if that part
// is rounding.
static vector3 lay_flat(vector3 v, vector3 normal) {
    vector3 flat = vector3_subtract(v, vector3_scale(normal, vector3_dot(normal, v)));
    return vector3_normalise(&flat, 1e-7 * vector3_length(v)) ? flat : (vector3){0, 0, 0};
}

static double corner_angle(const tangent_work *work, uint32_t corner, vector3 normal) {
    vector3 here = position_at(work, corner);
    vector3 next = vector3_subtract(position_at(work, next_corner(corner)), here);
    vector3 previous = vector3_subtract(position_at(work, previous_corner(corner)), here);
    double cosine = vector3_dot(lay_flat(next, normal), lay_flat(previous, normal));
    return acos(fmin(fmax(cosine, -1), 1));
}

static void sum_tangents(tangent_work *work) {
    for (uint32_t k = 0; k < work->mesh->index_count; k++) {
        const tangent_triangle *triangle = &work->triangles[k / 3];
        if (work->groups[k] == 0 || triangle->undirected)
            continue;
        vector3 normal = vector3_load(work->mesh->vertices[work->mesh->indices[k]].normal);
        vector3 tangent =
            vector3_scale(lay_flat(triangle->tangent, normal), corner_angle(work, k, normal));
        vector3 *sum = &work->sums[work->groups[k]];
        *sum = vector3_add(*sum, tangent);
    }
}

// ---------------------------------------------------------------------------------------------
// Vertices

// A vertex belongs to the first group that uses it; other groups get copies of it. A group whose
// corners alternate between equal vertices may get several copies of one.
static uint32_t copy_for(tangent_work *work, uint32_t group, uint32_t origin) {
    uint32_t latest = work->latest[group];
    if (latest == 0 || work->origins[latest - 1] != origin) {
        work->origins[work->copy_count] = origin;
        work->vertex_groups[work->mesh->vertex_count + work->copy_count] = group;
        latest = work->latest[group] = ++work->copy_count;
    }
    return (uint32_t)work->mesh->vertex_count + latest - 1;
}

// Replaces the corners' welded vertices by those that the mesh will have.
static void choose_vertices(tangent_work *work) {
    for (size_t k = 0; k < work->mesh->index_count; k++) {
        uint32_t vertex = work->mesh->indices[k], group = work->groups[k];
        if (work->vertex_groups[vertex] == 0)
            work->vertex_groups[vertex] = group;
        bool other = group != 0 && work->vertex_groups[vertex] != group;
        work->vertices[k] = other ? copy_for(work, group, vertex) : vertex;
    }
}

static bool append_copies(tangent_work *work) {
    lobe_mesh *mesh = work->mesh;
    size_t count = mesh->vertex_count + work->copy_count;
    if (work->copy_count == 0)
        return true;
    if (count > UINT32_MAX ||
        !scenes_deformation_copy_vertices(mesh, work->origins, work->copy_count))
        return false;
    lobe_scene_vertex *vertices = lobe_reallocate(NULL, mesh->vertices, count, sizeof *vertices);
    if (!vertices)
        return false;
    for (uint32_t i = 0; i < work->copy_count; i++)
        vertices[mesh->vertex_count + i] = vertices[work->origins[i]];
    memcpy(mesh->indices, work->vertices, mesh->index_count * sizeof *mesh->indices);
    mesh->vertices = vertices;
    mesh->vertex_count = count;
    return true;
}

static void store_tangent(lobe_scene_vertex *vertex, vector3 sum) {
    vertex->tangent[3] = 1;
    if (vector3_normalise(&sum, 0))
        vector3_store(sum, vertex->tangent);
    else
        scenes_mesh_orthogonal(vertex->normal, vertex->tangent);
}

// The bitangent runs up the image, against v: for an image that is not mirrored it is cross(normal,
// tangent).
static void store_tangents(const tangent_work *work) {
    lobe_mesh *mesh = work->mesh;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        store_tangent(&mesh->vertices[i], work->sums[work->vertex_groups[i]]);
    for (size_t k = 0; k < mesh->index_count; k++)
        if (work->groups[k] != 0 && work->triangles[k / 3].mirrored)
            mesh->vertices[mesh->indices[k]].tangent[3] = -1;
}

// ---------------------------------------------------------------------------------------------

static bool allocate(const lobe_allocator *allocator, tangent_work *work) {
    size_t corners = work->mesh->index_count, vertices = work->mesh->vertex_count;
    work->triangles = lobe_allocate(allocator, corners / 3, sizeof *work->triangles);
    work->vertices = lobe_allocate(allocator, corners, sizeof *work->vertices);
    work->across = lobe_allocate(allocator, corners, sizeof *work->across);
    work->groups = lobe_allocate(allocator, corners, sizeof *work->groups);
    work->sums = lobe_allocate(allocator, corners + 1, sizeof *work->sums);
    work->vertex_groups = lobe_allocate(allocator, vertices + corners, sizeof *work->vertex_groups);
    work->origins = lobe_allocate(allocator, corners, sizeof *work->origins);
    work->latest = lobe_allocate(allocator, corners + 1, sizeof *work->latest);
    return work->triangles && work->vertices && work->across && work->groups && work->sums &&
           work->vertex_groups && work->origins && work->latest;
}

static void release(tangent_work *work) {
    void *const all[] = {work->triangles, work->vertices, work->across, work->groups,
                         work->sums,      work->origins,  work->latest, work->vertex_groups};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        lobe_release(all[i]);
}

static bool weld_corners(const lobe_allocator *allocator, tangent_work *work) {
    uint32_t *welded = lobe_allocate(allocator, work->mesh->vertex_count, sizeof *welded);
    bool done = welded && scenes_mesh_weld(allocator, work->mesh, work->use->texture_coordinates,
                                           false, welded);
    if (done)
        measure_triangles(work, welded);
    lobe_release(welded);
    return done;
}

static bool compute_mapped(const lobe_allocator *allocator, tangent_work *work) {
    size_t corners = work->mesh->index_count;
    if (!allocate(allocator, work) || !weld_corners(allocator, work) ||
        !scenes_mesh_pair_edges(allocator, work->vertices, corners, work->across))
        return false;
    scenes_mesh_group_corners(work->vertices, work->across, corners, work->triangles, work->groups);
    sum_tangents(work);
    choose_vertices(work);
    if (!append_copies(work))
        return false;
    store_tangents(work);
    return true;
}

lobe_result scenes_mesh_compute_tangents(lobe_mesh *mesh, const lobe_texture_use *use,
                                         const lobe_host *host) {
    const lobe_texture_use none = LOBE_TEXTURE_NONE;
    tangent_work work = {.mesh = mesh, .use = use ? use : &none};
    uint32_t set = work.use->texture_coordinates;
    bool mapped = set < 2 && mesh->has_texture_coordinates[set];
    for (size_t i = 0; !mapped && i < mesh->vertex_count; i++)
        store_tangent(&mesh->vertices[i], (vector3){0, 0, 0});
    bool done = !mapped || compute_mapped(lobe_host_allocator(host), &work);
    release(&work);
    return done ? LOBE_OK
                : lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                                 "mesh '%s': out of memory for tangents", mesh->name);
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
