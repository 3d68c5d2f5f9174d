// shaders/lib/displacement/second_facets.glsl: a mirror sends light on as mirrors do, and what is a
// polynomial is found again.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 100, FIT = 0, SECONDS = 1 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Directions all over, and normals within 80 degrees of the pole.
static void choose_directions(uint64_t random) {
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        do
            random_direction(&random, arguments[i].b);
        while (arguments[i].b[2] < 0.17F);
    }
}

static void mirrors_reflect(void **state) {
    choose_directions(41);
    harness_evaluate(state, "displacement/second_facets.comp", SECONDS, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const double light[3] = {at->a[0], at->a[1], at->a[2]},
                     normal[3] = {at->b[0], at->b[1], at->b[2]};
        const double cosine = reference_dot(light, normal), area = fmax(-cosine, 0);
        check_close("area", at, results[i].value[3], area, 1e-3);
        for (int j = 0; j < 3; j++)
            check_close("direction", at, results[i].value[j],
                        area * (light[j] - 2 * cosine * normal[j]), 2e-3);
    }
    report_worst_error("seconds_of_direction");
}

static void polynomials_are_fitted(void **state) {
    choose_directions(42);
    harness_evaluate(state, "displacement/second_facets.comp", FIT, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const double light[3] = {at->a[0], at->a[1], at->a[2]},
                     normal[3] = {at->b[0], at->b[1], at->b[2]};
        // Facets send no light below themselves.
        for (int j = 0; j < 3 && reference_dot(light, normal) > 0; j++)
            check_close("rest", at, results[i].value[j], 0, 0.02);
    }
    report_worst_error("fit_second");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrors_reflect),
        cmocka_unit_test(polynomials_are_fitted),
    };
    return cmocka_run_group_tests_name("second_facets", tests, harness_set_up, harness_tear_down);
}
