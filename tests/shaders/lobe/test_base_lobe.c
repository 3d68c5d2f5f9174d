// shaders/lib/lobe/base_lobe.glsl against MPFR, and its double-precision twin.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/base_lobe.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/exact.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 1600, DISTRIBUTIONS = 4 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// A width as a scene may state it (beyond its range too), a parameter and a kappa_N in range.
static void make_arguments(void) {
    uint64_t random = 6;
    for (size_t i = 0; i < COUNT; i++) {
        uint32_t distribution = i % DISTRIBUTIONS;
        bool roughness = distribution <= LOBE_DISTRIBUTION_BECKMANN;
        double width = roughness ? geometric(1e-3, 1.2, i, COUNT) : geometric(1e-8, 1e7, i, COUNT);
        double parameter = roughness ? scenes_random_between(&random, 1.5e-3, 1)
                                     : geometric(1e-4, 1e6, (i * 7) % COUNT, COUNT);
        double normal_concentration = geometric(1e-4, 1e6, (i * 13) % COUNT, COUNT);
        arguments[i] =
            (harness_arguments){{(float)distribution, i < DISTRIBUTIONS ? 0 : (float)width,
                                 (float)parameter, i % 16 < 4 ? 0 : (float)normal_concentration},
                                {0},
                                {0}};
    }
}

// 1/kappa' = 1/kappa + 1/kappa_N, in the distribution's own parameter; R R_N for von Mises-Fisher.
static real exact_convolved(lobe_distribution distribution, real parameter, real normal) {
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return divide(multiply(normal, parameter), add(normal, parameter));
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return exact_concentration(multiply(exact_resultant(parameter), exact_resultant(normal)));
    return square_root(add(square(parameter), divide(real_from(2), normal)));
}

static void check_convolved(const harness_arguments *at, double actual) {
    release_reals();
    lobe_distribution distribution = (lobe_distribution)at->a[0];
    double parameter = at->a[2], normal = at->a[3];
    double twin = reference_convolved_parameter(distribution, parameter, normal);
    if (normal == 0) {
        assert_true(actual == at->a[2] && twin == parameter);
        return;
    }
    double expected =
        to_double(exact_convolved(distribution, real_from(parameter), real_from(normal)));
    // Closed forms of a few roundings; the inverse of R(kappa) is good to 8e-6, see
    // test_von_mises_fisher.
    double bound = distribution == LOBE_DISTRIBUTION_VMF ? 1e-5 : 8 * FLOAT_ROUNDING;
    check_relative("convolved_parameter", at, actual, expected, bound);
    check_relative("reference_convolved_parameter", at, twin, expected, 1e-11);
}

static void test_convolution(void **state) {
    make_arguments();
    harness_evaluate(state, "lobe/base_lobe.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_convolved(&arguments[i], results[i].value[3]);
    report_worst_error("convolved_parameter");
}

static void test_conversion(void **state) {
    make_arguments();
    harness_evaluate(state, "lobe/base_lobe.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a;
        lobe_distribution distribution = (lobe_distribution)a[0];
        check_relative("base_lobe_parameter", &arguments[i], results[i].value[0],
                       reference_base_lobe_parameter(distribution, a[1]), 4 * FLOAT_ROUNDING);
        // 2/alpha^2 - 2 cancels for the roughest.
        check_close("microfacet_parameter", &arguments[i], results[i].value[1],
                    reference_microfacet_parameter(distribution, a[1]),
                    8 * FLOAT_ROUNDING * (2 + reference_microfacet_parameter(distribution, a[1])));
        check_relative("base_lobe_concentration", &arguments[i], results[i].value[2],
                       reference_base_lobe_concentration(distribution, a[2]), 6 * FLOAT_ROUNDING);
    }
    report_worst_error("base_lobe_parameter, microfacet_parameter, base_lobe_concentration");
}

// Every width that a scene may hold gives a lobe that the other functions can take.
static void test_range(void **state) {
    static const float widths[] = {-1, 0, 1e-30f, 1e-3f, 0.5f, 1, 1e6f, 1e30f};
    enum { WIDTHS = sizeof widths / sizeof *widths, CALLS = WIDTHS * DISTRIBUTIONS };
    harness_arguments calls[CALLS];
    harness_result values[CALLS];
    for (int i = 0; i < CALLS; i++)
        calls[i] = (harness_arguments){
            {(float)(i % DISTRIBUTIONS), widths[i / DISTRIBUTIONS], 1, 0}, {0}, {0}};
    harness_evaluate(state, "lobe/base_lobe.comp", 0, calls, CALLS, values);
    for (int i = 0; i < CALLS; i++) {
        lobe_distribution distribution = (lobe_distribution)(i % DISTRIBUTIONS);
        double parameter = values[i].value[0];
        assert_true(parameter >= 0 && isfinite(values[i].value[1]));
        if (distribution <= LOBE_DISTRIBUTION_BECKMANN)
            assert_true(parameter >= 1.414e-3);
        else
            assert_true(parameter <= 1e6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_conversion),
        cmocka_unit_test(test_convolution),
        cmocka_unit_test(test_range),
    };
    return cmocka_run_group_tests_name("base_lobe", tests, harness_set_up, harness_tear_down);
}
