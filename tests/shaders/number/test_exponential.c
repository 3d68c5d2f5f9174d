// shaders/lib/number/exponential.glsl against MPFR.

#include <math.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { HALF_COUNT = 1000, COUNT = 2 * HALF_COUNT + 1 };

static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// exp(x) is computed as 2^(x log2 e): the product's rounding counts x-fold, and Vulkan 1.3
// (precision of GLSL.std.450 instructions) gives exp itself 3 + 2|x| units in the last place.
static double exponential_bound(double x) {
    return (8 + 5 * fabs(x)) * FLOAT_ROUNDING;
}

static void test_expm1(void **state) {
    for (size_t i = 0; i < HALF_COUNT; i++) {
        double size = geometric(1e-30, 87, i, HALF_COUNT);
        arguments[2 * i].a[0] = (float)size;
        arguments[2 * i + 1].a[0] = (float)-size;
    }
    arguments[COUNT - 1].a[0] = 0;
    harness_evaluate(state, "number/exponential.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double x = arguments[i].a[0];
        release_reals();
        double expected = to_double(exponential_minus_one(real_from(x)));
        check_relative("expm1", &arguments[i], results[i].value[0], expected, exponential_bound(x));
    }
    report_worst_error("expm1");
}

static void test_log1p(void **state) {
    for (size_t i = 0; i < HALF_COUNT; i++) {
        arguments[2 * i].a[1] = (float)geometric(1e-30, 1e6, i, HALF_COUNT);
        arguments[2 * i + 1].a[1] = (float)-geometric(1e-30, 1 - 1e-4, i, HALF_COUNT);
    }
    arguments[COUNT - 1].a[1] = 0;
    harness_evaluate(state, "number/exponential.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double x = arguments[i].a[1];
        release_reals();
        double expected = to_double(logarithm_of_one_plus(real_from(x)));
        // Far from zero 1 + x is rounded first, to within a relative error that the logarithm
        // turns into an absolute one; Vulkan gives log 3 units in the last place there.
        double rounded = x >= -0.5 && x <= 1 ? 0 : FLOAT_ROUNDING;
        check_close("log1p", &arguments[i], results[i].value[1], expected,
                    8 * FLOAT_ROUNDING * fabs(expected) + rounded + FLOAT_SMALLEST);
    }
    report_worst_error("log1p");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_expm1),
        cmocka_unit_test(test_log1p),
    };
    return cmocka_run_group_tests_name("exponential", tests, harness_set_up, harness_tear_down);
}
