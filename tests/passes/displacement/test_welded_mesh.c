// Welded meshes: points, charts and edges are those that a search over all pairs finds.

#include "passes/displacement/welded_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "tests/engine/support/cmocka_all.h"
#include "tests/engine/support/counting_allocator.h"

static lobe_mesh box(void) {
    lobe_mesh mesh;
    assert_int_equal(scenes_shape_box((float[]){1, 2, 3}, 1, NULL, &mesh), LOBE_OK);
    return mesh;
}

static lobe_mesh sphere(void) {
    lobe_mesh mesh;
    assert_int_equal(scenes_shape_sphere(6, 8, 2, 1, NULL, &mesh), LOBE_OK);
    return mesh;
}

/// Few places and coordinates, so that many vertices are alike, and some unused.
static lobe_mesh jumble(void) {
    random_sequence sequence = scenes_random_start(5);
    lobe_mesh mesh;
    assert_int_equal(scenes_mesh_allocate(&mesh, "jumble", 60, 3 * 40, NULL), LOBE_OK);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        for (int k = 0; k < 3; k++)
            mesh.vertices[i].position[k] = (float)(int)scenes_random_between(&sequence, -1.99, 2);
        for (int k = 0; k < 2; k++)
            mesh.vertices[i].texture_coordinates[0][k] =
                (float)(int)scenes_random_between(&sequence, 0, 2);
        mesh.vertices[i].position[0] *= i % 2 ? 1.0f : -1.0f; // both zeroes
    }
    for (size_t i = 0; i < mesh.index_count; i++)
        mesh.indices[i] = (uint32_t)scenes_random_between(&sequence, 0, 50);
    return mesh;
}

static bool is_same_place(const lobe_scene_vertex *a, const lobe_scene_vertex *b) {
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] &&
           a->position[2] == b->position[2];
}

static bool is_same_chart(const lobe_scene_vertex *a, const lobe_scene_vertex *b) {
    for (int i = 0; i < 4; i++)
        if (a->texture_coordinates[i / 2][i % 2] != b->texture_coordinates[i / 2][i % 2])
            return false;
    return is_same_place(a, b);
}

/// Corners of the mesh that are the first of their kind.
static size_t count_kinds(const lobe_mesh *mesh,
                          bool (*same)(const lobe_scene_vertex *, const lobe_scene_vertex *)) {
    size_t count = 0;
    for (size_t i = 0; i < mesh->index_count; i++) {
        bool first = true;
        for (size_t j = 0; j < i; j++)
            first = first &&
                    !same(&mesh->vertices[mesh->indices[i]], &mesh->vertices[mesh->indices[j]]);
        count += first;
    }
    return count;
}

static void check_corner(const lobe_mesh *mesh, const welded_mesh *welded, size_t corner) {
    const lobe_scene_vertex *vertex = &mesh->vertices[mesh->indices[corner]];
    const uint32_t number = welded->triangles[corner / 3].charts[corner % 3];
    assert_in_range(number, 0, welded->chart_count - 1);
    const struct base_chart *chart = &welded->charts[number];
    assert_true(is_same_chart(vertex, &mesh->vertices[chart->vertex]));
    const struct base_point *point = &welded->points[chart->point];
    assert_in_range(number, point->first_chart, point->first_chart + point->chart_count - 1);
    size_t found = 0;
    for (uint32_t i = 0; i < point->corner_count; i++)
        found += welded->corners[point->first_corner + i] == corner;
    assert_int_equal(found, 1);
}

static uint32_t point_of(const welded_mesh *welded, size_t corner) {
    return welded->charts[welded->triangles[corner / 3].charts[corner % 3]].point;
}

static void check_edge(const welded_mesh *welded, size_t corner) {
    const size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const struct base_edge *edge = &welded->edges[welded->triangles[corner / 3].edges[corner % 3]];
    const uint32_t a = point_of(welded, corner), b = point_of(welded, next);
    assert_int_equal(edge->points[0], a < b ? a : b);
    assert_int_equal(edge->points[1], a < b ? b : a);
    uint32_t pair[] = {welded->triangles[corner / 3].charts[corner % 3],
                       welded->triangles[next / 3].charts[next % 3]};
    if (a > b)
        memcpy(pair, (uint32_t[]){pair[1], pair[0]}, sizeof pair);
    // Of an edge between two charts of one point, both directions may be there.
    size_t found = 0;
    for (uint32_t i = 0; i < edge->pair_count; i++)
        found += memcmp(welded->pairs[edge->first_pair + i], pair, sizeof pair) == 0;
    assert_int_equal(found, 1);
}

static void all_edges_differ(const welded_mesh *welded) {
    for (uint32_t i = 0; i < welded->edge_count; i++)
        for (uint32_t j = 0; j < i; j++)
            assert_memory_not_equal(welded->edges[i].points, welded->edges[j].points,
                                    sizeof welded->edges[i].points);
}

static void check(lobe_mesh mesh, size_t points, size_t edges) {
    welded_mesh welded;
    assert_true(passes_welded_mesh_create(&mesh, NULL, &welded));
    assert_int_equal(welded.point_count, count_kinds(&mesh, is_same_place));
    assert_int_equal(welded.chart_count, count_kinds(&mesh, is_same_chart));
    assert_int_equal(welded.triangle_count, mesh.index_count / 3);
    for (size_t i = 0; i < mesh.index_count; i++) {
        check_corner(&mesh, &welded, i);
        check_edge(&welded, i);
    }
    all_edges_differ(&welded);
    if (points > 0) {
        assert_int_equal(welded.point_count, points);
        assert_int_equal(welded.edge_count, edges);
    }
    passes_welded_mesh_free(&welded);
    scenes_mesh_free(&mesh);
}

static void points_and_edges_are_found(void **state) {
    (void)state;
    check(box(), 8, 12 + 6); // with the diagonals of its faces
    check(sphere(), 0, 0);
    check(jumble(), 0, 0);
}

static void what_moves_apart_is_not_welded(void **state) {
    (void)state;
    lobe_mesh mesh = box();
    lobe_joint_influence influences[24] = {0};
    lobe_deformation deformation = {.influences_per_vertex = 1, .influences = influences};
    assert_int_equal(mesh.vertex_count, 24);
    for (size_t i = 0; i < 24; i++)
        influences[i] = (lobe_joint_influence){.joint = i / 4 == 0, .weight = 1}; // one face
    mesh.deformation = &deformation;
    welded_mesh welded;
    assert_true(passes_welded_mesh_create(&mesh, NULL, &welded));
    assert_int_equal(welded.point_count, 8 + 4);
    passes_welded_mesh_free(&welded);
    mesh.deformation = NULL;
    scenes_mesh_free(&mesh);
}

static void memory_may_end(void **state) {
    (void)state;
    lobe_mesh mesh = box();
    bool done = false;
    size_t failing = 0;
    while (!done) {
        counting_allocator counting;
        welded_mesh welded;
        counting_allocator_start(&counting);
        counting.failing = ++failing;
        done = passes_welded_mesh_create(&mesh, &counting.allocator, &welded);
        passes_welded_mesh_free(&welded);
        assert_nothing_left(&counting);
    }
    assert_int_equal(failing, 12); // eight arrays and three tables
    scenes_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_and_edges_are_found),
        cmocka_unit_test(what_moves_apart_is_not_welded),
        cmocka_unit_test(memory_may_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
