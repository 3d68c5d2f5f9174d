// Tangents of every corner against those of Mikkelsen's own code, from mikktspace.txt, which
// mikktspace.js made.

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scenes/mesh/mesh.h"

enum { LARGEST = 256 };

typedef struct fixture {
    char name[64];
    lobe_mesh mesh;
    float tangents[LARGEST][4]; // of each corner; w = 0: none
    size_t defined;
} fixture;

static void read_floats(FILE *file, float *values, int count) {
    for (int i = 0; i < count; i++)
        assert_int_equal(fscanf(file, "%f", &values[i]), 1);
}

static bool read_fixture(FILE *file, fixture *fixture) {
    unsigned vertices, corners;
    if (fscanf(file, " mesh %63s %u %u", fixture->name, &vertices, &corners) != 3)
        return false;
    lobe_mesh *mesh = &fixture->mesh;
    assert_in_range(corners, 3, LARGEST);
    assert_int_equal(scenes_mesh_allocate(mesh, fixture->name, vertices, corners, NULL), LOBE_OK);
    mesh->has_texture_coordinates[0] = true;
    for (unsigned i = 0; i < vertices; i++) {
        read_floats(file, mesh->vertices[i].position, 3);
        read_floats(file, mesh->vertices[i].normal, 3);
        read_floats(file, mesh->vertices[i].texture_coordinates[0], 2);
    }
    fixture->defined = 0;
    for (unsigned k = 0; k < corners; k++) {
        assert_int_equal(fscanf(file, "%u", &mesh->indices[k]), 1);
        read_floats(file, fixture->tangents[k], 4);
        fixture->defined += fixture->tangents[k][3] != 0;
    }
    return true;
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void assert_corner(const fixture *fixture, size_t corner) {
    const lobe_scene_vertex *vertex = &fixture->mesh.vertices[fixture->mesh.indices[corner]];
    const float *expected = fixture->tangents[corner], *found = vertex->tangent;
    assert_true(fabsf(dot(found, found) - 1) < 1e-4f);
    assert_true(fabsf(dot(found, vertex->normal)) < 1e-4f);
    assert_true(found[3] == 1 || found[3] == -1);
    float away[3];
    for (int i = 0; i < 3; i++)
        away[i] = found[i] - expected[i];
    if (expected[3] != 0 && !(dot(away, away) < 1e-3f * 1e-3f && found[3] == expected[3]))
        fail_msg("%s, corner %zu: (%g, %g, %g, %g) is not (%g, %g, %g, %g)", fixture->name, corner,
                 (double)found[0], (double)found[1], (double)found[2], (double)found[3],
                 (double)expected[0], (double)expected[1], (double)expected[2],
                 (double)expected[3]);
}

// Splitting changes which vertex a corner has, but nothing of it but the tangent.
static void assert_same_corner(const lobe_scene_vertex *before, const lobe_scene_vertex *after) {
    assert_memory_equal(before->position, after->position, sizeof before->position);
    assert_memory_equal(before->normal, after->normal, sizeof before->normal);
    assert_memory_equal(before->texture_coordinates, after->texture_coordinates,
                        sizeof before->texture_coordinates);
}

static void compute_and_compare(fixture *fixture) {
    lobe_mesh *mesh = &fixture->mesh;
    lobe_scene_vertex before[LARGEST];
    for (size_t k = 0; k < mesh->index_count; k++)
        before[k] = mesh->vertices[mesh->indices[k]];
    assert_int_equal(scenes_mesh_compute_tangents(mesh, NULL, NULL), LOBE_OK);
    for (size_t k = 0; k < mesh->index_count; k++) {
        assert_in_range(mesh->indices[k], 0, mesh->vertex_count - 1);
        assert_same_corner(&before[k], &mesh->vertices[mesh->indices[k]]);
        assert_corner(fixture, k);
    }
}

static void tangents_are_those_of_mikktspace(void **state) {
    (void)state;
    FILE *file = fopen(LOBE_TEST_MESHES "/mikktspace.txt", "r");
    assert_non_null(file);
    fixture fixture;
    size_t meshes = 0, defined = 0;
    for (; read_fixture(file, &fixture); meshes++) {
        compute_and_compare(&fixture);
        defined += fixture.defined;
        scenes_mesh_free(&fixture.mesh);
    }
    fclose(file);
    assert_int_equal(meshes, 16);
    assert_int_equal(defined, 1094);
}

// All corners of a fan meet at one vertex: neither the walk around it nor the pairing of its edges
// may take a time that grows with its square.
static void many_triangles_at_one_vertex_are_quick(void **state) {
    (void)state;
    enum { BLADES = 400000 };
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "fan", BLADES + 2, 3 * BLADES, NULL), LOBE_OK);
    mesh.has_texture_coordinates[0] = true;
    for (size_t i = 0; i < BLADES + 2; i++) {
        lobe_scene_vertex *vertex = &mesh.vertices[i];
        double angle = 6 * (double)i / BLADES;
        vertex->position[0] = i == 0 ? 0 : (float)cos(angle);
        vertex->position[1] = i == 0 ? 0 : (float)sin(angle);
        vertex->normal[2] = 1;
        vertex->texture_coordinates[0][0] = vertex->position[0];
        vertex->texture_coordinates[0][1] = -vertex->position[1];
    }
    for (uint32_t i = 0; i < 3 * BLADES; i++)
        mesh.indices[i] = i % 3 == 0 ? 0 : i / 3 + i % 3;
    assert_int_equal(scenes_mesh_compute_tangents(&mesh, NULL, NULL), LOBE_OK);
    assert_int_equal(mesh.vertex_count, BLADES + 2);
    assert_true(fabsf(mesh.vertices[0].tangent[0] - 1) < 1e-5f);
    assert_true(mesh.vertices[0].tangent[3] == 1);
    scenes_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_are_those_of_mikktspace),
        cmocka_unit_test(many_triangles_at_one_vertex_are_quick),
    };
    return cmocka_run_group_tests_name("tangents", tests, NULL, NULL);
}
