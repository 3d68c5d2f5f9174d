// shaders/lib/map/coordinate_frame.glsl: from any two steps over a plane, the directions in which
// its texture coordinates grow.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "map/coordinate_frame.comp";

enum { COUNT = 1000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static double cross(const float *a, const float *b) {
    return (double)a[0] * b[1] - (double)a[1] * b[0];
}

/// c: how the place changes with u, and with v; b: two steps in u and v; a: the same in the plane.
static void make_arguments(void) {
    uint64_t random = 5;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        do {
            for (int k = 0; k < 4; k++) {
                at->b[k] = (float)scenes_random_between(&random, -1e-3, 1e-3);
                at->c[k] = (float)scenes_random_between(&random, -2, 2);
            }
        } while (fabs(cross(at->b, at->b + 2)) < 1e-7 || fabs(cross(at->c, at->c + 2)) < 0.1);
        for (int k = 0; k < 4; k++)
            at->a[k] = at->b[k / 2 * 2] * at->c[k % 2] + at->b[k / 2 * 2 + 1] * at->c[2 + k % 2];
    }
}

static void axes_are_those_of_the_coordinates(void **state) {
    make_arguments();
    harness_evaluate(state, shader, 0, arguments, COUNT, results);
    size_t mirrored = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *along_u = results[i].value, *along_v = along_u + 2;
        const double u = hypot(at->c[0], at->c[1]), v = hypot(at->c[2], at->c[3]);
        check_close("u along x", at, along_u[0], u, 1e-3);
        check_close("nothing of u along y", at, along_u[1], 0, 1e-3);
        check_close("length of v", at, hypot(along_v[0], along_v[1]), v, 1e-3);
        check_close("v against y", at, along_v[1], -fabs(cross(at->c, at->c + 2)) / u, 1e-3);
        mirrored += cross(at->c, at->c + 2) > 0;
    }
    assert_true(mirrored > COUNT / 4 && mirrored < 3 * COUNT / 4);
}

static void coordinates_without_area_change_nothing(void **state) {
    const harness_arguments none = {.a = {1, 0, 0, 1}, .b = {1, 2, 2, 4}, .c = {3, 4, 5, 6}};
    harness_evaluate(state, shader, 0, &none, 1, results);
    for (int k = 0; k < 4; k++)
        check_close("none", &none, results[0].value[k], none.c[k], 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_are_those_of_the_coordinates),
        cmocka_unit_test(coordinates_without_area_change_nothing),
    };
    return cmocka_run_group_tests_name("coordinate_frame", tests, harness_set_up,
                                       harness_tear_down);
}
