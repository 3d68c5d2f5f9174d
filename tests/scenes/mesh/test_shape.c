#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/mesh/vector.h"
#include "tests/scenes/scene/scene_check.h"

static void plane_faces_up_and_tiles(void **state) {
    (void)state;
    lobe_mesh mesh;
    assert_int_equal(scenes_shape_plane(6, 10, 2, NULL, &mesh), LOBE_OK);
    scenes_mesh_compute_bounds(&mesh);
    scene_check_mesh(&mesh);
    assert_int_equal(mesh.index_count, 6);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        const lobe_scene_vertex *vertex = &mesh.vertices[i];
        assert_true(fabsf(vertex->position[0]) == 3 && fabsf(vertex->position[2]) == 5);
        assert_true(vertex->position[1] == 0 && vertex->normal[1] == 1);
        assert_true(vertex->texture_coordinates[0][0] == vertex->position[0] / 2);
        assert_true(vertex->texture_coordinates[0][1] == vertex->position[2] / 2);
    }
    scenes_mesh_free(&mesh);
}

static void sphere_is_round_and_closed(void **state) {
    (void)state;
    enum { ROWS = 16, COLUMNS = 24 };
    lobe_mesh mesh;
    assert_int_equal(scenes_shape_sphere(ROWS, COLUMNS, 4, 2, NULL, &mesh), LOBE_OK);
    scenes_mesh_compute_bounds(&mesh);
    scene_check_mesh(&mesh);
    assert_int_equal(mesh.index_count, 6 * (ROWS - 1) * COLUMNS);
    double volume = 0;
    for (size_t i = 0; i < mesh.index_count; i += 3) {
        const float *a = mesh.vertices[mesh.indices[i]].position;
        const float *b = mesh.vertices[mesh.indices[i + 1]].position;
        const float *c = mesh.vertices[mesh.indices[i + 2]].position;
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) /
                  6.0;
    }
    // A little less than the sphere's; a hole or a reversed triangle would differ far more.
    assert_true(volume < 4.18879 && volume > 4.18879 * 0.97);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        assert_memory_equal(mesh.vertices[i].position, mesh.vertices[i].normal, 12);
        assert_true(mesh.vertices[i].texture_coordinates[0][0] <= 4);
        assert_true(mesh.vertices[i].texture_coordinates[0][1] <= 2);
    }
    scenes_mesh_free(&mesh);
}

static void box_is_closed_and_maps_each_face_upright(void **state) {
    (void)state;
    static const float size[3] = {2, 3, 5};
    lobe_mesh mesh;
    assert_int_equal(scenes_shape_box(size, 0.5f, NULL, &mesh), LOBE_OK);
    scenes_mesh_compute_bounds(&mesh);
    scene_check_mesh(&mesh);
    double surface = 0, flux = 0, coordinates = 0;
    for (size_t i = 0; i < mesh.index_count; i += 3) {
        const lobe_scene_vertex *a = &mesh.vertices[mesh.indices[i]];
        const lobe_scene_vertex *b = &mesh.vertices[mesh.indices[i + 1]];
        const lobe_scene_vertex *c = &mesh.vertices[mesh.indices[i + 2]];
        vector3 p = vector3_load(a->position);
        vector3 normal = vector3_cross(vector3_subtract(vector3_load(b->position), p),
                                       vector3_subtract(vector3_load(c->position), p));
        surface += vector3_length(normal) / 2;
        flux += vector3_dot(normal, p) / 6;
        const float *u = a->texture_coordinates[0], *v = b->texture_coordinates[0];
        const float *w = c->texture_coordinates[0];
        coordinates += fabs((v[0] - u[0]) * (w[1] - u[1]) - (w[0] - u[0]) * (v[1] - u[1])) / 2;
    }
    assert_true(fabs(surface - 62) < 1e-5 && fabs(flux - 30) < 1e-5);
    assert_true(fabs(coordinates - 62 / 0.25) < 1e-4);
    // On upright faces, v runs downwards.
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        const lobe_scene_vertex *vertex = &mesh.vertices[i];
        if (vertex->normal[1] == 0)
            assert_true(vertex->texture_coordinates[0][1] == -vertex->position[1] / 0.5f);
    }
    scenes_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_faces_up_and_tiles),
        cmocka_unit_test(sphere_is_round_and_closed),
        cmocka_unit_test(box_is_closed_and_maps_each_face_upright),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
