// shaders/lib/number/power_of_cosine.glsl against MPFR.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void make_arguments(void) {
    uint64_t random = 7;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        at->c[0] = i < 10 ? 0 : (float)geometric(1e-6, 1e6, i / 10, COUNT / 10);
        double width = fmin(1 / sqrt(at->c[0] + 1), 0.5);
        const double angles[10] = {0,   1e-3 * width, 0.1 * width, width, 3 * width,
                                   0.5, 1.0,          1.5,         1.56,  1.5707};
        random_direction(&random, at->b);
        direction_at(at->b, angles[i % 10], scenes_random_between(&random, 0, 6), at->a);
    }
}

static void check_power(const harness_arguments *at, double actual) {
    release_reals();
    real cosine = dot(unit_vector_from(at->a), unit_vector_from(at->b));
    double exponent = at->c[0], c = to_double(cosine);
    double expected = to_double(power(cosine, real_from(exponent)));
    // x = s log c is a product with rounded factors, and exp(x) is 2^(x log2 e), 3 + 2|x| units in
    // the last place (Vulkan 1.3). A small cosine is what the three products of <a,b> leave: its
    // logarithm is off by their roundings over it.
    double x = exponent * fabs(log(c));
    double cancelled = c > 0.5 ? 0 : 4 * exponent / c;
    check_relative("power_of_cosine", at, actual, expected,
                   (10 + 10 * x + cancelled) * FLOAT_ROUNDING);
}

static void test_power(void **state) {
    make_arguments();
    harness_evaluate(state, "number/power_of_cosine.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_power(&arguments[i], results[i].value[0]);
    report_worst_error("power_of_cosine");
}

static void test_horizon(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        float exponent = (float)geometric(1e-6, 1e6, i, COUNT);
        arguments[i] = (harness_arguments){
            {0.6f, 0, 0.8f}, {-0.8f, 0, i % 2 ? 0.6f : -0.6f}, {i < 2 ? 0 : exponent}};
    }
    harness_evaluate(state, "number/power_of_cosine.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(i % 2 ? results[i].value[0] >= 0 && results[i].value[0] <= 1
                          : results[i].value[0] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_power),
        cmocka_unit_test(test_horizon),
    };
    return cmocka_run_group_tests_name("power_of_cosine", tests, harness_set_up, harness_tear_down);
}
