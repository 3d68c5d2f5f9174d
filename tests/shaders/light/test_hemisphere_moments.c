// shaders/lib/light/hemisphere_moments.glsl and octahedron.glsl against double precision.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 2000, ROUND_TRIP = 0, FORMS = 1 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Also on the octahedron's edges.
static void directions_come_back(void **state) {
    uint64_t random = 11;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        if (i % 8 < 3)
            arguments[i].a[i % 8] = 0;
    }
    harness_evaluate(state, "light/hemisphere_moments.comp", ROUND_TRIP, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a;
        double length = sqrt((double)a[0] * (double)a[0] + (double)a[1] * (double)a[1] +
                             (double)a[2] * (double)a[2]);
        for (int k = 0; k < 3; k++)
            check_close("octahedron_direction", &arguments[i], results[i].value[k],
                        (double)a[k] / length, 1e-6);
    }
    report_worst_error("octahedron_direction");
}

static double product(const float a[4], const float b[4]) {
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

static void coefficients_are_those_of_the_forms(void **state) {
    uint64_t random = 12;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        arguments[i].a[3] = (float)scenes_random_between(&random, -1, 1);
        for (int k = 0; k < 3; k++) {
            arguments[i].b[k] = (float)scenes_random_between(&random, -1, 1);
            arguments[i].c[k] = (float)scenes_random_between(&random, -1, 1);
        }
    }
    harness_evaluate(state, "light/hemisphere_moments.comp", FORMS, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double square = product(at->c, at->a);
        double form = (double)at->a[3] * product(at->a, at->a) + square * square;
        check_close("cubic_form", at, results[i].value[0], product(at->b, at->a) * form, 4e-6);
        check_close("quadratic_form", at, results[i].value[1], form, 4e-6);
    }
    report_worst_error("cubic_form, quadratic_form");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_come_back),
        cmocka_unit_test(coefficients_are_those_of_the_forms),
    };
    return cmocka_run_group_tests(tests, harness_set_up, harness_tear_down);
}
