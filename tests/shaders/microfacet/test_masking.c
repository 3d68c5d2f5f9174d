// shaders/lib/microfacet/masking.glsl against MPFR, and its double-precision twin.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 8000, DISTRIBUTIONS = 4 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// alpha from 1e-4 to 10 (base lobes convolved with rough normals exceed 1), or the exponent or
// kappa of the same width; cosines from grazing to normal incidence.
static void make_arguments(void) {
    uint64_t random = 11;
    for (size_t i = 0; i < COUNT; i++) {
        uint32_t distribution = i % DISTRIBUTIONS;
        double alpha = geometric(1e-4, 10, i, COUNT);
        bool slope = distribution <= LOBE_DISTRIBUTION_BECKMANN;
        double grazing = geometric(1e-6, 1, (i * 31) % COUNT, COUNT);
        double steep = 1 - geometric(1e-7, 1, (i * 31) % COUNT, COUNT);
        arguments[i].a[0] = (float)distribution;
        arguments[i].a[1] = (float)(slope ? alpha : 2 / (alpha * alpha));
        arguments[i].a[2] = i % 40 < 4 ? 1 : (float)fmax(i % 8 < 4 ? grazing : steep, 1e-6);
        arguments[i].a[3] = (float)scenes_random_between(&random, 1e-6, 1);
    }
}

// Width of the slopes that mask: Walter et al. 2007, section 5.2.
static real slope_width(const harness_arguments *at) {
    real two = real_from(2), parameter = real_from(at->a[1]);
    switch ((lobe_distribution)at->a[0]) {
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return square_root(divide(two, add(parameter, two)));
    case LOBE_DISTRIBUTION_VMF: // the same, with kappa = s + 1
        return square_root(divide(two, add(parameter, real_from(1))));
    default:
        return parameter;
    }
}

static real exact_lambda(const harness_arguments *at, double cosine) {
    real one = real_from(1), half = real_from(0.5);
    real cosine_squared = square(real_from(cosine));
    real slope_squared =
        multiply(square(slope_width(at)), divide(subtract(one, cosine_squared), cosine_squared));
    if (compare(slope_squared, real_from(0)) == 0)
        return slope_squared;
    if (at->a[0] == LOBE_DISTRIBUTION_GGX)
        return multiply(half, subtract(square_root(add(one, slope_squared)), one));
    real a = divide(one, square_root(slope_squared));
    real gauss =
        divide(exponential(subtract(real_from(0), square(a))), multiply(a, square_root(real_pi())));
    return multiply(half, subtract(gauss, complementary_error_function(a)));
}

static double tolerance_of(const harness_arguments *at, double lambda) {
    if (at->a[0] == LOBE_DISTRIBUTION_GGX)
        return 16 * FLOAT_ROUNDING * lambda + FLOAT_SMALLEST;
    // The fit's 7.7e-6 for a up to 6, where Lambda is below 1e-17, and the rounding of a^2 in
    // exp(-a^2), which is at most log(1/Lambda).
    double exponent = lambda > 0 ? fmax(-log(lambda), 0) : 0;
    return (9e-6 + 16 * exponent * FLOAT_ROUNDING) * lambda + 1e-17;
}

static void check_masking(const harness_arguments *at, const harness_result *result) {
    release_reals();
    double lambda = to_double(exact_lambda(at, at->a[2]));
    double other = to_double(exact_lambda(at, at->a[3]));
    check_close("smith_lambda", at, result->value[0], lambda, tolerance_of(at, lambda));
    check_relative("masking", at, result->value[1], 1 / (1 + lambda), 1e-5);
    check_relative("masking_shadowing", at, result->value[2], 1 / (1 + lambda + other), 1e-5);
    lobe_distribution distribution = (lobe_distribution)at->a[0];
    check_close("reference_smith_lambda", at,
                reference_smith_lambda(distribution, at->a[2], at->a[1]), lambda,
                1e-9 * lambda + 1e-13);
    check_close("reference_masking", at, reference_masking(distribution, at->a[2], at->a[1]),
                1 / (1 + lambda), 1e-9);
    check_close("reference_masking_shadowing", at,
                reference_masking_shadowing(distribution, at->a[2], at->a[3], at->a[1]),
                1 / (1 + lambda + other), 1e-9);
}

static void test_masking(void **state) {
    make_arguments();
    harness_evaluate(state, "microfacet/masking.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_masking(&arguments[i], &results[i]);
    report_worst_error("smith_lambda, masking, masking_shadowing");
}

static void test_tangent(void **state) {
    make_arguments();
    harness_evaluate(state, "microfacet/masking.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double cosine = fmax(arguments[i].a[2], 1e-6);
        double expected = (1 - cosine) * (1 + cosine) / (cosine * cosine);
        check_relative("tangent_squared", &arguments[i], results[i].value[3], expected,
                       8 * FLOAT_ROUNDING);
    }
    report_worst_error("tangent_squared");
}

// Nothing is seen from the horizon or from below it.
static void test_horizon(void **state) {
    static const float cosines[4] = {0, -1e-30f, -0.5f, -1};
    make_arguments();
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].a[2] = cosines[i / DISTRIBUTIONS % 4];
        arguments[i].a[3] = i % 32 < 16 ? 0.5f : -0.5f;
    }
    harness_evaluate(state, "microfacet/masking.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        assert_true(isfinite(results[i].value[0]));
        assert_true(results[i].value[1] == 0 && results[i].value[2] == 0);
    }
}

// Rounding may give a cosine a little above one.
static void test_beyond_normal_incidence(void **state) {
    make_arguments();
    for (size_t i = 0; i < COUNT; i++)
        arguments[i].a[2] = arguments[i].a[3] = 1.0000002f;
    harness_evaluate(state, "microfacet/masking.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(results[i].value[1] == 1 && results[i].value[2] == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_masking),
        cmocka_unit_test(test_tangent),
        cmocka_unit_test(test_horizon),
        cmocka_unit_test(test_beyond_normal_incidence),
    };
    return cmocka_run_group_tests_name("masking", tests, harness_set_up, harness_tear_down);
}
