// shaders/lib/lobe/normal_variance.glsl against its double-precision twin, and against what it
// approximates: Toksvig's formula, and the product of mean resultant lengths.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/normal_variance.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 1600, DISTRIBUTIONS = 4 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static bool has_alpha(const harness_arguments *at) {
    return (lobe_distribution)at->a[0] == LOBE_DISTRIBUTION_GGX ||
           (lobe_distribution)at->a[0] == LOBE_DISTRIBUTION_BECKMANN;
}

static void evaluate(void **state) {
    uint64_t random = 31;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        at->a[0] = (float)(i % DISTRIBUTIONS);
        at->a[1] = has_alpha(at) ? (float)geometric(1.5e-3, 1, i, COUNT)
                                 : (float)geometric(1e-2, 1e6, i, COUNT);
        at->a[2] = i % 16 < 4 ? 0 : (float)geometric(1e-9, 10, (i * 7) % COUNT, COUNT);
        at->a[3] = (float)geometric(1e-6, 1, (i * 13) % COUNT, COUNT);
        for (int j = 0; j < 3; j++)
            at->b[j] = (float)scenes_random_between(&random, 0, 0.1);
        at->b[3] = (float)geometric(1e-3, 1, (i * 11) % COUNT, COUNT);
    }
    harness_evaluate(state, "lobe/normal_variance.comp", 0, arguments, COUNT, results);
}

static void test_functions(void **state) {
    evaluate(state);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *value = results[i].value;
        double variance = at->a[2], complement = at->a[3], length = at->b[3];
        check_relative("widened_parameter", at, value[0],
                       reference_widened_parameter((lobe_distribution)at->a[0], at->a[1], variance),
                       8 * FLOAT_ROUNDING);
        check_relative("widened_complement", at, value[1],
                       complement + variance - variance * complement, 4 * FLOAT_ROUNDING);
        check_relative("isotropic_variance", at, value[2],
                       0.5 * ((double)at->b[0] + (double)at->b[1]), 4 * FLOAT_ROUNDING);
        check_relative("variance_of_mean_normal", at, value[3],
                       reference_variance_of_mean_normal(length), 6 * FLOAT_ROUNDING);
    }
    report_worst_error("normal_variance");
}

/// To the last bit, and so does a variance that is lost beside the lobe's own.
static void test_no_variance_changes_nothing(void **state) {
    evaluate(state);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double own = has_alpha(at) ? 0.5 * (double)at->a[1] * (double)at->a[1] : 1 / at->a[1];
        if ((double)at->a[2] < 0.1 * FLOAT_ROUNDING * own)
            assert_true(results[i].value[0] == at->a[1]);
        if (at->a[2] == 0)
            assert_true(results[i].value[1] == at->a[3]);
    }
}

/// Toksvig 2005, Eqs. 1 and 2: s' = |n| s / (|n| + s (1 - |n|)), through variances.
static void test_formula_of_toksvig(void **state) {
    enum { CALLS = 100 };
    static harness_arguments calls[CALLS];
    static harness_result variances[CALLS], widened[CALLS];
    for (size_t i = 0; i < CALLS; i++)
        calls[i].b[3] = (float)geometric(1e-2, 1, i, CALLS);
    harness_evaluate(state, "lobe/normal_variance.comp", 0, calls, CALLS, variances);
    for (size_t i = 0; i < CALLS; i++) {
        calls[i].a[0] = LOBE_DISTRIBUTION_BLINN_PHONG;
        calls[i].a[1] = (float)geometric(1, 1e4, (i * 7) % CALLS, CALLS);
        calls[i].a[2] = variances[i].value[3];
    }
    harness_evaluate(state, "lobe/normal_variance.comp", 0, calls, CALLS, widened);
    for (size_t i = 0; i < CALLS; i++) {
        double s = calls[i].a[1], length = calls[i].b[3];
        check_relative("Toksvig's exponent", &calls[i], widened[i].value[0],
                       length * s / (length + s * (1 - length)), 16 * FLOAT_ROUNDING);
    }
}

/// Up to the variance that a pixel's curvature may have, the reciprocal sum is within 11 % of the
/// product of mean resultant lengths, where lobes are all but uniform; the complement has the
/// product itself.
static void test_widening_is_a_convolution(void **state) {
    enum { CALLS = 400 };
    static harness_arguments calls[CALLS];
    static harness_result widened[CALLS];
    for (size_t i = 0; i < CALLS; i++) {
        double kappa = geometric(1e-2, 1e5, i, CALLS);
        calls[i].a[0] = LOBE_DISTRIBUTION_VMF;
        calls[i].a[1] = (float)kappa;
        calls[i].a[2] = (float)geometric(1e-6, 0.1, (i * 7) % CALLS, CALLS);
        calls[i].a[3] = (float)reference_mean_resultant_complement(kappa);
    }
    harness_evaluate(state, "lobe/normal_variance.comp", 0, calls, CALLS, widened);
    for (size_t i = 0; i < CALLS; i++) {
        double variance = calls[i].a[2], s = calls[i].a[3];
        double product = s + variance * (1 - s);
        double kappa = reference_concentration_from_complement(product);
        check_relative("reciprocal sum", &calls[i], widened[i].value[0], kappa, 0.11);
        check_relative("product", &calls[i], widened[i].value[1], product, 1e-6);
    }
    report_worst_error("reciprocal sum");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_functions),
        cmocka_unit_test(test_no_variance_changes_nothing),
        cmocka_unit_test(test_formula_of_toksvig),
        cmocka_unit_test(test_widening_is_a_convolution),
    };
    return cmocka_run_group_tests_name("normal_variance", tests, harness_set_up, harness_tear_down);
}
