// Tangents of morph targets: sums of them point where those of the deformed mesh do.

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include <lobe/allocator.h>

#include "scenes/mesh/deformation.h"
#include "scenes/mesh/mesh.h"

enum { SIDE = 7, CELLS = (SIDE - 1) * (SIDE - 1), TARGETS = 5 };

typedef enum square { SMOOTH, FLAT, MIRRORED } square;

static const lobe_texture_use use = LOBE_TEXTURE_NONE;

/// What each target adds to a point: a shear along the other axis, a vortex that leaves the border
/// alone, waves out of the plane, a turn, and a collapse to a point.
static void displace(int target, const float p[3], float delta[3]) {
    const double x = p[0], z = p[2], inside = (1 - x * x) * (1 - z * z), angle = 1.5 * inside;
    const double moved[TARGETS][3] = {
        {0, 0, x},
        {x * cos(angle) - z * sin(angle) - x, 0, x * sin(angle) + z * cos(angle) - z},
        {0, 0.3 * sin(3 * x) * cos(2 * z), 0},
        {x * cos(1) - z * sin(1) - x, 0, x * sin(1) + z * cos(1) - z},
        {-x, 0, -z}};
    for (int i = 0; i < 3; i++)
        delta[i] = (float)moved[target][i];
}

static void place_vertex(square kind, lobe_scene_vertex *vertex, uint32_t column, uint32_t row) {
    const uint32_t middle = SIDE / 2;
    const bool mirrored = kind == MIRRORED && column < middle;
    vertex->texture_coordinates[0][0] = (float)(mirrored ? 2 * middle - column : column) / 2;
    vertex->texture_coordinates[0][1] = (float)row / 2;
    vertex->position[0] = 2.0f * (float)column / (SIDE - 1) - 1;
    vertex->position[2] = 2.0f * (float)row / (SIDE - 1) - 1;
    vertex->normal[1] = 1;
}

/// A square in the plane of x and z. FLAT: of triangles that share no vertices. MIRRORED: the left
/// half has the coordinates of the right one; vertices between them are split.
static void create_square(square kind, lobe_mesh *mesh) {
    static const uint32_t corners[6][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 0}, {0, 1}, {1, 1}};
    const size_t count = kind == FLAT ? 6 * CELLS : SIDE * SIDE;
    assert_int_equal(scenes_mesh_allocate(mesh, "square", count, 6 * CELLS, NULL), LOBE_OK);
    mesh->has_texture_coordinates[0] = true;
    for (uint32_t i = 0; i < 6 * CELLS; i++) {
        const uint32_t column = i / 6 % (SIDE - 1) + corners[i % 6][0];
        const uint32_t row = i / 6 / (SIDE - 1) + corners[i % 6][1];
        mesh->indices[i] = kind == FLAT ? i : row * SIDE + column;
        place_vertex(kind, &mesh->vertices[mesh->indices[i]], column, row);
    }
    assert_int_equal(scenes_mesh_compute_tangents(mesh, &use, NULL), LOBE_OK);
    assert_int_equal(mesh->vertex_count, count + (kind == MIRRORED ? SIDE : 0));
}

/// Deltas of positions alone, where there are any.
static void add_targets(square kind, lobe_mesh *mesh) {
    lobe_deformation *d = mesh->deformation = lobe_allocate(NULL, 1, sizeof *d);
    const size_t most = mesh->vertex_count * TARGETS;
    d->target_count = TARGETS;
    d->first_deltas = lobe_allocate(NULL, mesh->vertex_count + 1, sizeof *d->first_deltas);
    d->deltas = lobe_allocate(NULL, most, sizeof *d->deltas);
    d->weights = lobe_allocate(NULL, TARGETS, sizeof *d->weights);
    d->flat = kind == FLAT;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < TARGETS; k++) {
            lobe_morph_delta delta = {.target = (uint32_t)k};
            displace(k, mesh->vertices[i].position, delta.position);
            const float *p = delta.position;
            if (p[0] != 0 || p[1] != 0 || p[2] != 0)
                d->deltas[d->delta_count++] = delta;
        }
        d->first_deltas[i + 1] = (uint32_t)d->delta_count;
    }
}

/// The sum of vertex and deltas, as the device makes it.
static void pose_vertex(const lobe_mesh *mesh, size_t i, const float weights[TARGETS],
                        float position[3], float tangent[3]) {
    const lobe_deformation *d = mesh->deformation;
    memcpy(position, mesh->vertices[i].position, 3 * sizeof *position);
    memcpy(tangent, mesh->vertices[i].tangent, 3 * sizeof *tangent);
    for (uint32_t k = d->first_deltas[i]; k < d->first_deltas[i + 1]; k++)
        for (int axis = 0; axis < 3; axis++) {
            position[axis] += weights[d->deltas[k].target] * d->deltas[k].position[axis];
            tangent[axis] += weights[d->deltas[k].target] * d->deltas[k].tangent[axis];
        }
}

static double angle_between(const float tangent[3], const lobe_scene_vertex *vertex) {
    double length = 0, along = 0, up = 0;
    for (int i = 0; i < 3; i++)
        up += tangent[i] * vertex->normal[i];
    for (int i = 0; i < 3; i++) {
        const double laid = tangent[i] - up * vertex->normal[i];
        length += laid * laid;
        along += laid * vertex->tangent[i];
    }
    return acos(fmin(along / sqrt(length), 1));
}

/// The largest angle to the tangents of the mesh that is deformed.
static double largest_error(square kind, const lobe_mesh *mesh, const float weights[TARGETS]) {
    lobe_mesh deformed;
    float(*tangents)[3] = lobe_allocate(NULL, mesh->vertex_count, sizeof *tangents);
    double largest = 0;
    create_square(kind, &deformed);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        pose_vertex(mesh, i, weights, deformed.vertices[i].position, tangents[i]);
    if (mesh->deformation->flat)
        assert_int_equal(scenes_mesh_compute_normals(&deformed, NULL), LOBE_OK);
    assert_int_equal(scenes_mesh_compute_tangents(&deformed, &use, NULL), LOBE_OK);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        largest = fmax(largest, angle_between(tangents[i], &deformed.vertices[i]));
    lobe_release(tangents);
    scenes_mesh_free(&deformed);
    return largest;
}

static void assert_errors(square kind, double parts_of_vortex) {
    lobe_mesh mesh;
    create_square(kind, &mesh);
    add_targets(kind, &mesh);
    const size_t before = mesh.deformation->delta_count;
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){0, 1}) > 1);
    assert_int_equal(scenes_mesh_compute_target_tangents(&mesh, &use, 3, NULL), LOBE_ERROR_LIMIT);
    assert_int_equal(mesh.deformation->delta_count, before);
    assert_int_equal(scenes_mesh_compute_target_tangents(&mesh, &use, SIZE_MAX, NULL), LOBE_OK);
    // The vortex turns vertices of the border that it does not move.
    assert_true(mesh.deformation->delta_count > before);
    for (int k = 0; k < TARGETS; k++) {
        float weights[TARGETS] = {0};
        weights[k] = 1;
        assert_true(largest_error(kind, &mesh, weights) < 1e-3);
    }
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){0}) < 1e-3);
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){0.4f}) < 1e-3);
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){2, 0, 0.5f}) < 0.05);
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){0, 0.5f}) < parts_of_vortex);
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){0, 0, 0, 0.5f}) < 1e-3);
    assert_true(largest_error(kind, &mesh, (float[TARGETS]){0.4f, 0, 0, 0, 0.9f}) < 1e-3);
    scenes_mesh_free(&mesh);
}

static void tangents_are_those_of_the_deformed_mesh(void **state) {
    (void)state;
    assert_errors(SMOOTH, 0.15);
}

/// Of which none is averaged with others that happen to lie in its plane.
static void flat_triangles_have_their_own(void **state) {
    (void)state;
    assert_errors(FLAT, 0.6);
}

/// Those of the two sides point opposite ways where these meet, and do not cancel.
static void mirrored_coordinates_have_their_own(void **state) {
    (void)state;
    assert_errors(MIRRORED, 0.15);
}

/// Where the file's own are not used, those of its targets are not either.
static void tangents_of_the_file_are_dropped(void **state) {
    (void)state;
    lobe_mesh mesh;
    create_square(SMOOTH, &mesh);
    add_targets(SMOOTH, &mesh);
    for (size_t i = 0; i < mesh.deformation->delta_count; i++)
        mesh.deformation->deltas[i] = (lobe_morph_delta){.tangent = {5, 5, 5}};
    assert_int_equal(scenes_mesh_compute_target_tangents(&mesh, &use, SIZE_MAX, NULL), LOBE_OK);
    for (size_t i = 0; i < mesh.deformation->delta_count; i++)
        for (int axis = 0; axis < 3; axis++)
            assert_float_equal(mesh.deformation->deltas[i].tangent[axis], 0, 0);
    scenes_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_are_those_of_the_deformed_mesh),
        cmocka_unit_test(flat_triangles_have_their_own),
        cmocka_unit_test(mirrored_coordinates_have_their_own),
        cmocka_unit_test(tangents_of_the_file_are_dropped),
    };
    return cmocka_run_group_tests_name("target tangents", tests, NULL, NULL);
}
