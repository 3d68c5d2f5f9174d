#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/mesh/vector.h"
#include "tests/scenes/scene/scene_check.h"
#include "tools/scenes/box_projection.h"

static const double tile = 0.25;

// A sphere with a diameter of two metres, whose surface is uneven by `roughness`.
static lobe_mesh make_sphere(double roughness) {
    lobe_mesh mesh;
    random_sequence sequence = scenes_random_start(3);
    assert_int_equal(scenes_shape_sphere(48, 96, 1, 1, NULL, &mesh), LOBE_OK);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        double scale = 1 + scenes_random_between(&sequence, -roughness, roughness);
        for (int axis = 0; axis < 3; axis++)
            mesh.vertices[i].position[axis] = (float)(mesh.vertices[i].position[axis] * scale);
        memset(mesh.vertices[i].tangent, 0, sizeof mesh.vertices[i].tangent);
        memset(mesh.vertices[i].texture_coordinates, 0,
               sizeof mesh.vertices[i].texture_coordinates);
    }
    mesh.has_texture_coordinates[0] = false;
    if (roughness > 0)
        assert_int_equal(scenes_mesh_compute_normals(&mesh, NULL), LOBE_OK);
    return mesh;
}

// The length of an edge in metres, relative to its length on the map that covers it.
static double edge_ratio(const lobe_scene_vertex *a, const lobe_scene_vertex *b) {
    vector3 edge = vector3_subtract(vector3_load(b->position), vector3_load(a->position));
    double u = b->texture_coordinates[0][0] - a->texture_coordinates[0][0];
    double v = b->texture_coordinates[0][1] - a->texture_coordinates[0][1];
    return vector3_length(edge) / (tile * sqrt(u * u + v * v));
}

static double coordinate_area(const lobe_mesh *mesh, const uint32_t *c) {
    double e[2][2];
    for (int k = 0; k < 2; k++)
        for (int axis = 0; axis < 2; axis++)
            e[k][axis] = mesh->vertices[c[k + 1]].texture_coordinates[0][axis] -
                         mesh->vertices[c[0]].texture_coordinates[0][axis];
    return tile * tile * (e[0][0] * e[1][1] - e[0][1] * e[1][0]) / 2;
}

static double surface_area(const lobe_mesh *mesh, const uint32_t *c) {
    vector3 a = vector3_load(mesh->vertices[c[0]].position);
    vector3 ab = vector3_subtract(vector3_load(mesh->vertices[c[1]].position), a);
    vector3 ac = vector3_subtract(vector3_load(mesh->vertices[c[2]].position), a);
    return vector3_length(vector3_cross(ab, ac)) / 2;
}

static void maps_are_stretched_twofold_at_most_and_never_mirrored(void **state) {
    (void)state;
    for (int rough = 0; rough < 2; rough++) {
        lobe_mesh mesh = make_sphere(rough ? 0.01 : 0);
        assert_int_equal(box_projection_apply(&mesh, tile, NULL), LOBE_OK);
        assert_true(mesh.has_texture_coordinates[0] && !mesh.has_texture_coordinates[1]);
        double surface = 0, map = 0;
        for (size_t i = 0; i < mesh.index_count; i += 3) {
            const uint32_t *c = mesh.indices + i;
            double on_map = -coordinate_area(&mesh, c), on_surface = surface_area(&mesh, c);
            assert_true(on_map > 0.49 * on_surface && on_map < 1.001 * on_surface);
            surface += on_surface, map += on_map;
            for (int k = 0; k < 3; k++) {
                double ratio = edge_ratio(&mesh.vertices[c[k]], &mesh.vertices[c[(k + 1) % 3]]);
                assert_true(ratio > 0.999 && ratio < 2.05);
            }
        }
        assert_true(map > 0.75 * surface);
        scenes_mesh_free(&mesh);
    }
}

static void the_mesh_stays_sound(void **state) {
    (void)state;
    lobe_mesh mesh = make_sphere(0), before = make_sphere(0);
    assert_int_equal(box_projection_apply(&mesh, tile, NULL), LOBE_OK);
    scenes_mesh_compute_bounds(&mesh);
    scene_check_mesh(&mesh);
    // The same triangles, in the same order, with the same corners.
    assert_int_equal(mesh.index_count, before.index_count);
    for (size_t i = 0; i < mesh.index_count; i++) {
        const lobe_scene_vertex *a = &mesh.vertices[mesh.indices[i]];
        const lobe_scene_vertex *b = &before.vertices[before.indices[i]];
        assert_memory_equal(a->position, b->position, sizeof a->position);
        assert_memory_equal(a->normal, b->normal, sizeof a->normal);
    }
    scenes_mesh_free(&mesh);
    scenes_mesh_free(&before);
}

// Seams cost vertices: on a sphere of 48 x 96 quadrilaterals, the twelve edges of the box are some
// 350 vertices long. Rough surfaces must not be cut into many pieces.
static void seams_are_few(void **state) {
    (void)state;
    for (int rough = 0; rough < 2; rough++) {
        lobe_mesh mesh = make_sphere(rough ? 0.005 : 0);
        size_t before = mesh.vertex_count;
        assert_int_equal(box_projection_apply(&mesh, tile, NULL), LOBE_OK);
        assert_in_range(mesh.vertex_count, before + 100, before + (rough ? 900 : 600));
        scenes_mesh_free(&mesh);
    }
}

// A plane that faces an axis is mapped without stretch, upright, with one tile per unit.
static void a_wall_is_mapped_as_it_is(void **state) {
    (void)state;
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "wall", 4, 6, NULL), LOBE_OK);
    for (int i = 0; i < 4; i++) {
        mesh.vertices[i].position[0] = i & 1 ? 1.f : 0;
        mesh.vertices[i].position[1] = i & 2 ? 0 : 1.f;
    }
    scenes_shape_grid_indices(1, 1, mesh.indices);
    assert_int_equal(scenes_mesh_compute_normals(&mesh, NULL), LOBE_OK);
    assert_int_equal(box_projection_apply(&mesh, tile, NULL), LOBE_OK);
    assert_int_equal(mesh.vertex_count, 4);
    for (int i = 0; i < 4; i++) {
        const lobe_scene_vertex *vertex = &mesh.vertices[i];
        assert_true(vertex->texture_coordinates[0][0] == 4 * vertex->position[0]);
        assert_true(vertex->texture_coordinates[0][1] == -4 * vertex->position[1]);
        assert_true(vertex->tangent[0] == 1 && vertex->tangent[3] == 1);
    }
    scenes_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_are_stretched_twofold_at_most_and_never_mirrored),
        cmocka_unit_test(the_mesh_stays_sound),
        cmocka_unit_test(seams_are_few),
        cmocka_unit_test(a_wall_is_mapped_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
