// shaders/lib/map/displaced_slope.glsl against normals of surfaces in double precision.

#include <math.h>
#include <stdint.h>

#include "shaders/interface/waves.h"
#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 2000 };

static harness_arguments arguments[COUNT];
static harness_result results[COUNT], first[COUNT], second[COUNT];

static void fill(double bend) {
    uint64_t random = 7;
    for (size_t i = 0; i < COUNT; i++) {
        for (int k = 0; k < 4; k++)
            arguments[i].a[k] =
                (float)scenes_random_between(&random, k < 2 ? -0.2 : -bend, k < 2 ? 0.2 : bend);
        arguments[i].b[0] = (float)scenes_random_between(&random, -bend / 2, bend / 2);
    }
}

/// The cross product of the tangents (1 + dD_x/dx, dD_y/dx, dh/dx) and that along y.
static void normal_of(const harness_arguments *a, double n[3]) {
    const double x[3] = {1 + (double)a->a[2], a->b[0], a->a[0]},
                 y[3] = {a->b[0], 1 + (double)a->a[3], a->a[1]};
    for (int i = 0; i < 3; i++)
        n[i] = x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3];
}

static void slopes_are_those_of_the_normal(void **state) {
    fill(0.4);
    harness_evaluate(state, "map/displaced_slope.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double n[3];
        normal_of(&arguments[i], n);
        check_close("area", &arguments[i], results[i].value[0], n[2], 1e-6);
        check_close("slope", &arguments[i], results[i].value[1], -n[0] / n[2], 4e-6);
        check_close("slope", &arguments[i], results[i].value[2], -n[1] / n[2], 4e-6);
    }
    report_worst_error("slope");
}

// Where the surface folds, it has no area; water is never steeper than it can be.
static void folds_and_breakers_are_bounded(void **state) {
    fill(3);
    harness_evaluate(state, "map/displaced_slope.comp", 0, arguments, COUNT, results);
    size_t folded = 0, breaking = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double n[3];
        normal_of(&arguments[i], n);
        const double steep = hypot(results[i].value[1], results[i].value[2]);
        assert_true(results[i].value[0] >= 0 && steep <= WAVE_SLOPE_MAXIMUM * 1.000001);
        assert_true(n[2] > -1e-5 || results[i].value[0] == 0);
        folded += n[2] < 0;
        breaking += n[2] > 0 && hypot(n[0], n[1]) / n[2] > WAVE_SLOPE_MAXIMUM;
    }
    assert_true(folded > COUNT / 10 && breaking > 10);
}

static void moments_are_weighted_with_the_area(void **state) {
    fill(0.8);
    harness_evaluate(state, "map/displaced_slope.comp", 0, arguments, COUNT, results);
    harness_evaluate(state, "map/displaced_slope.comp", 1, arguments, COUNT, first);
    harness_evaluate(state, "map/displaced_slope.comp", 2, arguments, COUNT, second);
    for (size_t i = 0; i < COUNT; i++) {
        const double area = results[i].value[0], x = results[i].value[1], y = results[i].value[2];
        const double exact[6] = {area,         area * x,     area * y,
                                 area * x * x, area * y * y, area * x * y};
        for (int k = 0; k < 3; k++) {
            check_close("first moments", &arguments[i], first[i].value[k], exact[k], 1e-6);
            check_close("second moments", &arguments[i], second[i].value[k], exact[k + 3], 1e-6);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_are_those_of_the_normal),
        cmocka_unit_test(folds_and_breakers_are_bounded),
        cmocka_unit_test(moments_are_weighted_with_the_area),
    };
    return cmocka_run_group_tests_name("displaced_slope", tests, harness_set_up, harness_tear_down);
}
