// shaders/lib/lobe/dispersion.glsl against its double-precision twin.

#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/dispersion.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 2000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void test_dispersion(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].a[0] = i < 10 ? 0 : (float)geometric(1e-7, 1, i, COUNT);
        arguments[i].a[1] =
            i % 10 == 0 ? arguments[i].a[0] : (float)geometric(1e-7, 1, (i * 7) % COUNT, COUNT);
    }
    harness_evaluate(state, "lobe/dispersion.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a;
        double expected = reference_dispersion(a[0], a[1]);
        // The difference is exact where it is small; the sharpest lobe's 1e-6 is rounded.
        check_close("dispersion", &arguments[i], results[i].value[0], expected,
                    6 * FLOAT_ROUNDING * (1 + expected));
    }
    report_worst_error("dispersion");
}

static void test_dispersion_of_known_cases(void **state) {
    // All the same; twice as broad as its parts; a uniform lobe from parts of R = 0.9.
    static const harness_arguments cases[] = {
        {{0.25f, 0.25f}, {0}, {0}}, {{0.01f, 0.02f}, {0}, {0}}, {{0.1f, 1}, {0}, {0}}};
    static const double expected[] = {0, 1, 9};
    harness_result values[3];
    harness_evaluate(state, "lobe/dispersion.comp", 0, cases, 3, values);
    for (int i = 0; i < 3; i++)
        check_close("dispersion", &cases[i], values[i].value[0], expected[i], 1e-6);
}

static void test_transition(void **state) {
    uint64_t random = 18;
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].b[0] = (float)scenes_random_between(&random, -0.5, 1.5);
        arguments[i].b[1] = (float)random_number(&random);
        arguments[i].b[2] = i % 4 ? (float)geometric(1e-3, 1, i, COUNT) : 0;
    }
    // On the threshold, with a hard step and with a soft one.
    arguments[0] = (harness_arguments){{0}, {0.5f, 0.5f, 0}, {0}};
    arguments[1] = (harness_arguments){{0}, {0.5f, 0.5f, 0.25f}, {0}};
    harness_evaluate(state, "lobe/dispersion.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *b = arguments[i].b;
        // Rounding of the difference, magnified by a slope of 3/4 over the half width.
        double tolerance = 4 * FLOAT_ROUNDING * (1 + (b[2] > 0 ? 1 / b[2] : 0));
        check_close("transition", &arguments[i], results[i].value[1],
                    reference_transition(b[0], b[1], b[2]), tolerance);
    }
    assert_true(results[0].value[1] == 1 && results[1].value[1] == 0.5f);
    report_worst_error("transition");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dispersion),
        cmocka_unit_test(test_dispersion_of_known_cases),
        cmocka_unit_test(test_transition),
    };
    return cmocka_run_group_tests_name("dispersion", tests, harness_set_up, harness_tear_down);
}
