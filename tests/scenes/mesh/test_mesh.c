// Properties computed from positions, triangles and texture coordinates.

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "scenes/mesh/mesh.h"

// A grid of 2 x 2 squares in the plane z = 0 that faces +z; u runs along x, v down along -y.
enum { SIDE = 3, GRID_VERTICES = SIDE * SIDE, GRID_INDICES = 24 };

static void make_grid(lobe_mesh *mesh) {
    assert_int_equal(scenes_mesh_allocate(mesh, "grid", GRID_VERTICES, GRID_INDICES, NULL),
                     LOBE_OK);
    for (uint32_t i = 0; i < GRID_VERTICES; i++) {
        lobe_scene_vertex *v = &mesh->vertices[i];
        v->position[0] = (float)(i % SIDE);
        v->position[1] = (float)(i / SIDE);
        v->texture_coordinates[0][0] = 0.5f * v->position[0];
        v->texture_coordinates[0][1] = 1 - 0.5f * v->position[1];
        v->normal[2] = 1;
    }
    size_t n = 0;
    for (uint32_t y = 0; y + 1 < SIDE; y++) {
        for (uint32_t x = 0; x + 1 < SIDE; x++) {
            uint32_t a = y * SIDE + x;
            const uint32_t square[] = {a, a + 1, a + SIDE, a + SIDE, a + 1, a + SIDE + 1};
            memcpy(mesh->indices + n, square, sizeof square);
            n += 6;
        }
    }
    mesh->has_texture_coordinates[0] = true;
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void assert_vector(const float v[3], float x, float y, float z) {
    if (!(fabsf(v[0] - x) < 1e-6f && fabsf(v[1] - y) < 1e-6f && fabsf(v[2] - z) < 1e-6f))
        fail_msg("(%g, %g, %g) is not (%g, %g, %g)", (double)v[0], (double)v[1], (double)v[2],
                 (double)x, (double)y, (double)z);
}

static void assert_frames_are_orthonormal(const lobe_mesh *mesh) {
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const lobe_scene_vertex *v = &mesh->vertices[i];
        assert_true(fabsf(dot(v->normal, v->normal) - 1) < 1e-6f);
        assert_true(fabsf(dot(v->tangent, v->tangent) - 1) < 1e-6f);
        assert_true(fabsf(dot(v->normal, v->tangent)) < 1e-6f);
        assert_true(v->tangent[3] == 1 || v->tangent[3] == -1);
    }
}

static void counts_are_checked(void **state) {
    (void)state;
    static const struct {
        size_t vertices, indices;
    } bad[] = {{0, 3}, {3, 0}, {3, 4}, {SIZE_MAX, 3}, {3, SIZE_MAX / 3 * 3}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        lobe_mesh mesh;
        assert_int_equal(scenes_mesh_allocate(&mesh, "bad", bad[i].vertices, bad[i].indices, NULL),
                         LOBE_ERROR_LIMIT);
        assert_null(mesh.vertices);
        scenes_mesh_free(&mesh);
    }
}

static void normals_are_weighted_by_area(void **state) {
    (void)state;
    // Areas 1 in the plane z = 0 and 2 in the plane x = 0 meet at the vertices 0 and 1.
    static const float positions[4][3] = {{0, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 0, 4}};
    static const uint32_t indices[] = {0, 2, 1, 0, 1, 3};
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "roof", 5, 6, NULL), LOBE_OK);
    for (int i = 0; i < 4; i++)
        memcpy(mesh.vertices[i].position, positions[i], sizeof positions[i]);
    memcpy(mesh.indices, indices, sizeof indices);
    assert_int_equal(scenes_mesh_compute_normals(&mesh, NULL), LOBE_OK);
    const float length = sqrtf(5);
    assert_vector(mesh.vertices[0].normal, 2 / length, 0, 1 / length);
    assert_vector(mesh.vertices[1].normal, 2 / length, 0, 1 / length);
    assert_vector(mesh.vertices[2].normal, 0, 0, 1);
    assert_vector(mesh.vertices[3].normal, 1, 0, 0);
    assert_vector(mesh.vertices[4].normal, 0, 1, 0); // in no triangle
    scenes_mesh_free(&mesh);
}

static void normals_that_cancel_become_up(void **state) {
    (void)state;
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "leaf", 3, 6, NULL), LOBE_OK);
    mesh.vertices[1].position[0] = 1;
    mesh.vertices[2].position[1] = 1;
    memcpy(mesh.indices, ((const uint32_t[]){0, 1, 2, 2, 1, 0}), 6 * sizeof(uint32_t));
    assert_int_equal(scenes_mesh_compute_normals(&mesh, NULL), LOBE_OK);
    assert_vector(mesh.vertices[0].normal, 0, 1, 0);
    scenes_mesh_free(&mesh);
}

static void only_bad_normals_are_repaired(void **state) {
    (void)state;
    lobe_mesh mesh;
    make_grid(&mesh);
    size_t repaired;
    memcpy(mesh.vertices[0].normal, (const float[]){0, 0, 0}, 12);
    memcpy(mesh.vertices[1].normal, (const float[]){3, 0, 4}, 12);
    memcpy(mesh.vertices[2].normal, (const float[]){0, INFINITY, 0}, 12);
    memcpy(mesh.vertices[3].normal, (const float[]){0, FLT_MAX, 0}, 12);
    assert_int_equal(scenes_mesh_repair_normals(&mesh, NULL, &repaired), LOBE_OK);
    assert_int_equal(repaired, 2);
    assert_vector(mesh.vertices[0].normal, 0, 0, 1);
    assert_vector(mesh.vertices[1].normal, 0.6f, 0, 0.8f);
    assert_vector(mesh.vertices[2].normal, 0, 0, 1);
    assert_vector(mesh.vertices[3].normal, 0, 1, 0);
    scenes_mesh_free(&mesh);
}

static void positions_at_the_limit_of_float_have_normals(void **state) {
    (void)state;
    for (float size = 1e-30f; size < FLT_MAX; size *= 1e34f) {
        lobe_mesh mesh;
        make_grid(&mesh);
        for (int i = 0; i < GRID_VERTICES; i++) {
            for (int axis = 0; axis < 3; axis++)
                mesh.vertices[i].position[axis] *= size;
        }
        assert_int_equal(scenes_mesh_drop_degenerate(&mesh), 0);
        assert_int_equal(scenes_mesh_compute_normals(&mesh, NULL), LOBE_OK);
        assert_int_equal(scenes_mesh_compute_tangents(&mesh, NULL, NULL), LOBE_OK);
        for (int i = 0; i < GRID_VERTICES; i++) {
            assert_vector(mesh.vertices[i].normal, 0, 0, 1);
            assert_vector(mesh.vertices[i].tangent, 1, 0, 0);
        }
        scenes_mesh_free(&mesh);
    }
}

static void tangents_run_along_u(void **state) {
    (void)state;
    lobe_mesh mesh;
    make_grid(&mesh);
    assert_int_equal(scenes_mesh_compute_tangents(&mesh, NULL, NULL), LOBE_OK);
    assert_int_equal(mesh.vertex_count, GRID_VERTICES);
    for (int i = 0; i < GRID_VERTICES; i++) {
        assert_vector(mesh.vertices[i].tangent, 1, 0, 0);
        // The bitangent, cross(z, x) = y, runs up the image.
        assert_true(mesh.vertices[i].tangent[3] == 1);
    }
    scenes_mesh_free(&mesh);
}

static void smooth_tangents_are_weighted_by_area(void **state) {
    (void)state;
    // Areas 1 with u along x and 2 with u along x - y meet at the vertices 0 and 1.
    static const float positions[4][2] = {{0, 0}, {0, 2}, {1, 0}, {-2, 0}};
    static const float coordinates[4][2] = {{0, 0}, {0, 1}, {1, 0}, {-2, -1}};
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "pair", 4, 6, NULL), LOBE_OK);
    for (int i = 0; i < 4; i++) {
        memcpy(mesh.vertices[i].position, positions[i], sizeof positions[i]);
        memcpy(mesh.vertices[i].texture_coordinates[0], coordinates[i], sizeof coordinates[i]);
        mesh.vertices[i].normal[2] = 1;
    }
    memcpy(mesh.indices, ((const uint32_t[]){0, 2, 1, 0, 1, 3}), 6 * sizeof(uint32_t));
    assert_int_equal(scenes_mesh_smooth_tangents(&mesh, NULL), LOBE_OK);
    assert_int_equal(mesh.vertex_count, 4);
    const float half = sqrtf(0.5f), x = 1 + 2 * half, y = -2 * half, length = sqrtf(x * x + y * y);
    assert_vector(mesh.vertices[0].tangent, x / length, y / length, 0);
    assert_vector(mesh.vertices[2].tangent, 1, 0, 0);
    assert_vector(mesh.vertices[3].tangent, half, -half, 0);
    scenes_mesh_free(&mesh);
}

static void tangents_follow_set_and_transform(void **state) {
    (void)state;
    lobe_mesh mesh;
    make_grid(&mesh);
    mesh.has_texture_coordinates[1] = true;
    for (int i = 0; i < GRID_VERTICES; i++) { // u along y, v along x: rotated, not mirrored
        mesh.vertices[i].texture_coordinates[1][0] = mesh.vertices[i].position[1];
        mesh.vertices[i].texture_coordinates[1][1] = mesh.vertices[i].position[0];
    }
    lobe_texture_use use = LOBE_TEXTURE_NONE;
    use.texture_coordinates = 1;
    assert_int_equal(scenes_mesh_compute_tangents(&mesh, &use, NULL), LOBE_OK);
    assert_vector(mesh.vertices[4].tangent, 0, 1, 0);
    assert_true(mesh.vertices[4].tangent[3] == 1);
    // The coordinates turned by a quarter, and the image mirrored.
    use.texture_coordinates = 0;
    memcpy(use.transform, ((const float[2][3]){{0, 1, 0}, {1, 0, 0}}), sizeof use.transform);
    assert_int_equal(scenes_mesh_compute_tangents(&mesh, &use, NULL), LOBE_OK);
    assert_vector(mesh.vertices[4].tangent, 0, -1, 0);
    assert_true(mesh.vertices[4].tangent[3] == -1);
    scenes_mesh_free(&mesh);
}

static void vertices_of_both_hands_are_split(void **state) {
    (void)state;
    lobe_mesh mesh;
    make_grid(&mesh);
    for (int i = 0; i < GRID_VERTICES; i++) // the right half mirrors the left
        mesh.vertices[i].texture_coordinates[0][0] = 1 - fabsf(mesh.vertices[i].position[0] - 1);
    assert_int_equal(scenes_mesh_compute_tangents(&mesh, NULL, NULL), LOBE_OK);
    assert_int_equal(mesh.vertex_count, GRID_VERTICES + SIDE);
    assert_frames_are_orthonormal(&mesh);
    for (size_t i = 0; i < mesh.index_count; i += 3) {
        const uint32_t *corner = mesh.indices + i;
        float centre = 0;
        for (int k = 0; k < 3; k++)
            centre += mesh.vertices[corner[k]].position[0] / 3;
        for (int k = 0; k < 3; k++) {
            const lobe_scene_vertex *v = &mesh.vertices[corner[k]];
            assert_vector(v->tangent, centre < 1 ? 1 : -1, 0, 0);
            assert_true(v->tangent[3] == (centre < 1 ? 1 : -1));
        }
    }
    scenes_mesh_free(&mesh);
}

static void degenerate_coordinates_give_any_frame(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        lobe_mesh mesh;
        make_grid(&mesh);
        mesh.has_texture_coordinates[0] = kind != 0;
        for (int i = 0; i < GRID_VERTICES; i++) {
            lobe_scene_vertex *v = &mesh.vertices[i];
            v->texture_coordinates[0][0] = kind == 1 ? 0.5f : v->position[0] + v->position[1];
            v->texture_coordinates[0][1] = v->texture_coordinates[0][0];
            const float normals[3][3] = {{1, 0, 0}, {0, 0.6f, 0.8f}, {0, 0, -1}};
            memcpy(v->normal, normals[i % 3], sizeof normals[0]);
        }
        assert_int_equal(scenes_mesh_compute_tangents(&mesh, NULL, NULL), LOBE_OK);
        assert_int_equal(mesh.vertex_count, GRID_VERTICES);
        assert_frames_are_orthonormal(&mesh);
        scenes_mesh_free(&mesh);
    }
}

static void degenerate_triangles_are_dropped(void **state) {
    (void)state;
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "mixed", 6, 15, NULL), LOBE_OK);
    static const float positions[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                          {2, 0, 0}, {0, 0, 0}, {0.5f, 1e-5f, 0}};
    for (int i = 0; i < 6; i++)
        memcpy(mesh.vertices[i].position, positions[i], sizeof positions[i]);
    // Good; a repeated index; on one line; a repeated position; thin but real.
    static const uint32_t indices[] = {0, 1, 2, 1, 1, 2, 0, 1, 3, 0, 4, 2, 0, 1, 5};
    memcpy(mesh.indices, indices, sizeof indices);
    assert_int_equal(scenes_mesh_drop_degenerate(&mesh), 3);
    assert_int_equal(mesh.index_count, 6);
    assert_memory_equal(mesh.indices, ((const uint32_t[]){0, 1, 2, 0, 1, 5}), 24);
    scenes_mesh_free(&mesh);
}

static void bounds_enclose_all_positions(void **state) {
    (void)state;
    lobe_mesh mesh;
    make_grid(&mesh);
    mesh.vertices[5].position[2] = -7;
    scenes_mesh_compute_bounds(&mesh);
    assert_vector(mesh.minimum, 0, 0, -7);
    assert_vector(mesh.maximum, 2, 2, 0);
    scenes_mesh_free(&mesh);
}

static void orthogonal_vectors_are_unit_everywhere(void **state) {
    (void)state;
    for (int i = 0; i < 1000; i++) {
        float z = 1 - (float)i / 499.5f, angle = 2.399963f * (float)i;
        float radius = sqrtf(fmaxf(0, 1 - z * z)), tangent[3];
        const float normal[3] = {radius * cosf(angle), radius * sinf(angle), z};
        scenes_mesh_orthogonal(normal, tangent);
        assert_true(fabsf(dot(tangent, tangent) - 1) < 1e-6f);
        assert_true(fabsf(dot(tangent, normal)) < 1e-6f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_are_checked),
        cmocka_unit_test(normals_are_weighted_by_area),
        cmocka_unit_test(normals_that_cancel_become_up),
        cmocka_unit_test(only_bad_normals_are_repaired),
        cmocka_unit_test(positions_at_the_limit_of_float_have_normals),
        cmocka_unit_test(tangents_run_along_u),
        cmocka_unit_test(smooth_tangents_are_weighted_by_area),
        cmocka_unit_test(tangents_follow_set_and_transform),
        cmocka_unit_test(vertices_of_both_hands_are_split),
        cmocka_unit_test(degenerate_coordinates_give_any_frame),
        cmocka_unit_test(degenerate_triangles_are_dropped),
        cmocka_unit_test(bounds_enclose_all_positions),
        cmocka_unit_test(orthogonal_vectors_are_unit_everywhere),
    };
    return cmocka_run_group_tests_name("meshes", tests, NULL, NULL);
}
