// shaders/lib/number/finite.glsl.

#include <math.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/harness.h"

enum { COUNT = 12 };

static void test_finite(void **state) {
    static const float values[COUNT] = {0,        -0.0f,     1,   -1,   1e-45f, 3.4028234e38f,
                                        INFINITY, -INFINITY, NAN, -NAN, 1e-38f, -3.4028234e38f};
    harness_arguments arguments[COUNT];
    harness_result results[COUNT];
    for (int i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){{values[i], 0, 0, 5}, {0}, {0}};
    harness_evaluate(state, "number/finite.comp", 0, arguments, COUNT, results);
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(results[i].value[0], isfinite(values[i]) ? 1 : 0);
        // Devices may flush numbers below 1e-37.
        const float expected = isfinite(values[i]) ? values[i] : 0;
        assert_true(fabsf(results[i].value[2] - expected) <= 1e-37f);
        assert_true(results[i].value[3] == 5);
    }
}

static void test_finite_vector(void **state) {
    const harness_arguments arguments[4] = {{{1, 2, 3}, {0}, {0}},
                                            {{NAN, 2, 3}, {0}, {0}},
                                            {{1, INFINITY, 3}, {0}, {0}},
                                            {{1, 2, -INFINITY}, {0}, {0}}};
    harness_result results[4];
    harness_evaluate(state, "number/finite.comp", 0, arguments, 4, results);
    for (int i = 0; i < 4; i++)
        assert_int_equal(results[i].value[1], i == 0 ? 1 : 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_finite),
        cmocka_unit_test(test_finite_vector),
    };
    return cmocka_run_group_tests_name("finite", tests, harness_set_up, harness_tear_down);
}
