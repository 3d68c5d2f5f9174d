#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "scenes/builtin/hall/lathe.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/vector.h"
#include "tests/scenes/scene/scene_check.h"

enum { COLUMNS = 40, CUTS = 8 };

static lobe_mesh turn(const double (*outline)[2], size_t count) {
    const lathe_shape shape = {.name = "turned",
                               .outline = outline,
                               .count = count,
                               .cuts = CUTS,
                               .columns = COLUMNS,
                               .tile = 0.5,
                               .tiles_around = 3};
    lobe_mesh mesh;
    assert_int_equal(scenes_lathe_make(&shape, NULL, &mesh), LOBE_OK);
    scenes_mesh_compute_bounds(&mesh);
    scene_check_mesh(&mesh);
    assert_int_equal(mesh.index_count, (count - 1) * CUTS * COLUMNS * 6);
    return mesh;
}

static double radius_of(const lobe_scene_vertex *vertex) {
    return sqrt((double)vertex->position[0] * vertex->position[0] +
                (double)vertex->position[2] * vertex->position[2]);
}

static void a_straight_outline_makes_a_cone(void **state) {
    (void)state;
    // Long and short stretches of a straight outline.
    static const double outline[][2] = {{1, 2}, {1.5, 1}, {1.6, 0.8}, {2, 0}};
    lobe_mesh mesh = turn(outline, 4);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        const lobe_scene_vertex *vertex = &mesh.vertices[i];
        assert_true(fabs(radius_of(vertex) + vertex->position[1] / 2 - 2) < 1e-6);
        // Outwards, and up because the cone narrows.
        assert_true(fabs(vertex->normal[1] - sqrt(0.2)) < 1e-3);
        // v is the length of the outline from the top.
        double length = (2 - vertex->position[1]) * sqrt(1.25);
        assert_true(fabs(vertex->texture_coordinates[0][1] - length / 0.5) < 1e-5);
    }
    scenes_mesh_free(&mesh);
}

static void the_curve_is_smooth_and_stays_between_its_points(void **state) {
    (void)state;
    static const double outline[][2] = {{1, 2}, {1.1, 1.9}, {1.1, 0.1}, {1.3, 0}};
    lobe_mesh mesh = turn(outline, 4);
    for (size_t row = 0; row < 3 * CUTS; row++) {
        const lobe_scene_vertex *above = &mesh.vertices[row * (COLUMNS + 1)];
        const lobe_scene_vertex *below = above + COLUMNS + 1;
        assert_true(above->position[1] > below->position[1]);
        assert_true(row % CUTS != 0 || radius_of(above) == outline[row / CUTS][0] ||
                    fabs(radius_of(above) - outline[row / CUTS][0]) < 1e-6);
        assert_true(radius_of(above) > 0.999 && radius_of(above) < 1.301);
    }
    scenes_mesh_free(&mesh);
}

static void its_seam_is_not_seen(void **state) {
    (void)state;
    static const double outline[][2] = {{0.5, 1}, {0.8, 0.6}, {0.4, 0}};
    lobe_mesh mesh = turn(outline, 3);
    for (size_t row = 0; row <= 2 * CUTS; row++) {
        const lobe_scene_vertex *first = &mesh.vertices[row * (COLUMNS + 1)];
        const lobe_scene_vertex *last = first + COLUMNS;
        assert_memory_equal(first->position, last->position, sizeof first->position);
        assert_memory_equal(first->normal, last->normal, sizeof first->normal);
        assert_true(fabsf(first->normal[0]) < 0.02f && first->normal[2] > 0);
        assert_true(first->texture_coordinates[0][0] == 0);
        assert_true(last->texture_coordinates[0][0] == 3);
    }
    scenes_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_straight_outline_makes_a_cone),
        cmocka_unit_test(the_curve_is_smooth_and_stays_between_its_points),
        cmocka_unit_test(its_seam_is_not_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
