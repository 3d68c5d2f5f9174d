#include "tools/scenes/box_projection.h"

#include <stdint.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/vector.h"

enum { AXES = 6, SMOOTHING_ROUNDS = 12 };

// Axes of projection, with the directions of u and v: u to the right and v down as seen against the
// axis, cross(u, -v) = axis.
typedef struct projection_axis {
    vector3 axis, u, v;
} projection_axis;

static const projection_axis axes[AXES] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};

// A triangle may use the axis of its surroundings if its own normal is within 60 degrees of that
// axis: at 1 / cos(60 degrees), maps are stretched twofold.
static const double least_cosine = 0.5;

// Each vertex takes the mean of the directions around it. On rough surfaces, smoothing makes charts
// few and their borders short.
static bool smooth_directions(const lobe_allocator *allocator, const lobe_mesh *mesh,
                              vector3 *directions) {
    vector3 *sums = lobe_allocate(allocator, mesh->vertex_count, sizeof *sums);
    for (size_t i = 0; sums && i < mesh->vertex_count; i++)
        directions[i] = vector3_load(mesh->vertices[i].normal);
    for (int round = 0; sums && round < SMOOTHING_ROUNDS; round++) {
        for (size_t i = 0; i < mesh->vertex_count; i++)
            sums[i] = directions[i];
        for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
            const uint32_t *c = mesh->indices + i;
            vector3 sum =
                vector3_add(vector3_add(directions[c[0]], directions[c[1]]), directions[c[2]]);
            for (int k = 0; k < 3; k++)
                sums[c[k]] = vector3_add(sums[c[k]], sum);
        }
        for (size_t i = 0; i < mesh->vertex_count; i++)
            if (vector3_normalise(&sums[i], 0))
                directions[i] = sums[i];
    }
    lobe_release(sums);
    return sums != NULL;
}

static vector3 triangle_normal(const lobe_mesh *mesh, const uint32_t c[3]) {
    vector3 a = vector3_load(mesh->vertices[c[0]].position);
    vector3 ab = vector3_subtract(vector3_load(mesh->vertices[c[1]].position), a);
    vector3 ac = vector3_subtract(vector3_load(mesh->vertices[c[2]].position), a);
    vector3 normal = vector3_cross(ab, ac);
    vector3_normalise(&normal, 0);
    return normal;
}

static unsigned facing(vector3 direction) {
    unsigned best = 0;
    for (unsigned i = 1; i < AXES; i++)
        if (vector3_dot(direction, axes[i].axis) > vector3_dot(direction, axes[best].axis))
            best = i;
    return best;
}

static unsigned choose_axis(const lobe_mesh *mesh, const vector3 *directions, const uint32_t c[3]) {
    vector3 own = triangle_normal(mesh, c);
    unsigned around =
        facing(vector3_add(vector3_add(directions[c[0]], directions[c[1]]), directions[c[2]]));
    return vector3_dot(own, axes[around].axis) >= least_cosine ? around : facing(own);
}

// ---------------------------------------------------------------------------------------------
// Splitting: each old vertex becomes one for each axis of its triangles. The new vertices of an old
// one are consecutive, in the order of the axes.

typedef struct vertex_split {
    uint8_t *triangle_axes;
    uint8_t *used;   // for each old vertex, a bit for each axis
    uint32_t *first; // for each old vertex, its first new one
} vertex_split;

static uint32_t count_bits(unsigned bits) {
    return (uint32_t)__builtin_popcount(bits);
}

static void choose_axes(const lobe_mesh *mesh, const vector3 *directions, vertex_split *split) {
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        unsigned axis = choose_axis(mesh, directions, mesh->indices + i);
        split->triangle_axes[i / 3] = (uint8_t)axis;
        for (int k = 0; k < 3; k++)
            split->used[mesh->indices[i + k]] |= (uint8_t)(1u << axis);
    }
}

static void redirect(lobe_mesh *mesh, const vertex_split *split) {
    for (size_t i = 0; i < mesh->index_count; i++) {
        uint32_t old = mesh->indices[i];
        unsigned before = (1u << split->triangle_axes[i / 3]) - 1;
        mesh->indices[i] = split->first[old] + count_bits(split->used[old] & before);
    }
}

static void project(lobe_scene_vertex *vertex, const projection_axis *axis, double tile) {
    vector3 position = vector3_load(vertex->position);
    vertex->texture_coordinates[0][0] = (float)(vector3_dot(position, axis->u) / tile);
    vertex->texture_coordinates[0][1] = (float)(vector3_dot(position, axis->v) / tile);
}

// Replaces the vertices by the split ones, with texture coordinates.
static bool split_vertices(const lobe_allocator *allocator, lobe_mesh *mesh, vertex_split *split,
                           double tile) {
    size_t count = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        split->first[i] = (uint32_t)count;
        count += count_bits(split->used[i]);
    }
    lobe_scene_vertex *vertices = lobe_allocate(allocator, count, sizeof *vertices),
                      *next = vertices;
    if (!vertices || count > UINT32_MAX) {
        lobe_release(vertices);
        return false;
    }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (unsigned axis = 0; axis < AXES; axis++)
            if (split->used[i] & 1u << axis) {
                *next = mesh->vertices[i];
                project(next++, &axes[axis], tile);
            }
    lobe_release(mesh->vertices);
    mesh->vertices = vertices;
    mesh->vertex_count = count;
    return true;
}

static bool split_and_project(const lobe_allocator *allocator, lobe_mesh *mesh, double tile) {
    vector3 *directions = lobe_allocate(allocator, mesh->vertex_count, sizeof *directions);
    vertex_split split = {.triangle_axes = lobe_allocate(allocator, mesh->index_count / 3, 1),
                          .used = lobe_allocate(allocator, mesh->vertex_count, 1),
                          .first =
                              lobe_allocate(allocator, mesh->vertex_count, sizeof *split.first)};
    bool done = directions && split.triangle_axes && split.used && split.first &&
                smooth_directions(allocator, mesh, directions);
    if (done) {
        choose_axes(mesh, directions, &split);
        done = split_vertices(allocator, mesh, &split, tile);
    }
    if (done)
        redirect(mesh, &split);
    lobe_release(directions);
    lobe_release(split.triangle_axes);
    lobe_release(split.used);
    lobe_release(split.first);
    return done;
}

lobe_result box_projection_apply(lobe_mesh *mesh, double tile, const lobe_host *host) {
    if (!split_and_project(lobe_host_allocator(host), mesh, tile))
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                              "mesh '%s': out of memory for texture coordinates", mesh->name);
    mesh->has_texture_coordinates[0] = true;
    return scenes_mesh_compute_tangents(mesh, NULL, host);
}
