// shaders/lib/lobe/plane_lobe.glsl against the base lobes themselves, in double precision.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/lobe/plane_lobe.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/plane_lobe.comp";
enum { LOBE, TAIL_WEIGHT, TAIL_SPREAD, MASS_OF_VARIANCE };

enum { COUNT = 2000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Alpha from the sharpest to 1, or concentrations from 0 to 1e6.
static void make_arguments(lobe_material_model model, lobe_distribution distribution) {
    bool alpha =
        distribution == LOBE_DISTRIBUTION_GGX || distribution == LOBE_DISTRIBUTION_BECKMANN;
    for (size_t i = 0; i < COUNT; i++) {
        double low = alpha ? sqrt(2e-6) : 1e-6, high = alpha ? 1 : 1e6;
        double parameter = geometric(low, high, i, COUNT);
        arguments[i].a[0] = i == 0 && !alpha ? 0 : (float)fmin(parameter, high);
        arguments[i].b[0] = (float)model;
        arguments[i].b[1] = (float)distribution;
    }
}

/// The bell has the peak of the lobe.
static void check_lobe(lobe_material_model model, lobe_distribution distribution,
                       const harness_arguments *at, const float *value) {
    double parameter = at->a[0];
    double variance = reference_plane_variance(distribution, parameter);
    bool ggx = distribution == LOBE_DISTRIBUTION_GGX;
    double lost = ggx ? 1 / fmax(1 - parameter * parameter, 0.1) : 1;
    check_relative("plane_variance", at, value[0], variance, 8 * lost * FLOAT_ROUNDING);
    check_relative("plane_mass", at, value[1], reference_plane_mass(model, distribution, parameter),
                   64 * lost * FLOAT_ROUNDING);
    static const double pole[3] = {0, 0, 1};
    double peak = model == LOBE_MATERIAL_MICROFACET
                      ? reference_normal_distribution(distribution, pole, pole, parameter)
                      : reference_half_vector_lobe(distribution, pole, pole, parameter);
    check_relative("peak", at, (double)value[1] / (2 * M_PI * (double)value[0]), peak, 3e-5);
    if (variance < 1)
        check_relative("parameter_of_plane_variance", at, value[2], parameter,
                       distribution == LOBE_DISTRIBUTION_BLINN_PHONG
                           ? 4 * FLOAT_ROUNDING * (1 + 1 / parameter)
                           : 8 * lost * FLOAT_ROUNDING);
    else
        assert_true(isfinite(value[2]) && value[2] >= 0);
}

static void check_distribution(void **state, lobe_material_model model,
                               lobe_distribution distribution) {
    make_arguments(model, distribution);
    harness_evaluate(state, shader, LOBE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_lobe(model, distribution, &arguments[i], results[i].value);
    report_worst_error("plane_variance, plane_mass, parameter_of_plane_variance");
}

static void test_microfacets(void **state) {
    for (int distribution = 0; distribution < 4; distribution++)
        check_distribution(state, LOBE_MATERIAL_MICROFACET, (lobe_distribution)distribution);
}

static void test_half_vector_lobes(void **state) {
    check_distribution(state, LOBE_MATERIAL_HALF_VECTOR_LOBES, LOBE_DISTRIBUTION_BLINN_PHONG);
    check_distribution(state, LOBE_MATERIAL_HALF_VECTOR_LOBES, LOBE_DISTRIBUTION_VMF);
}

/// Maps hold variances in few bits, which round the smallest to 0.
static void test_no_variance(void **state) {
    harness_arguments at[4] = {0};
    harness_result mass[4];
    for (int distribution = 0; distribution < 4; distribution++) {
        at[distribution].b[0] = LOBE_MATERIAL_MICROFACET;
        at[distribution].b[1] = (float)distribution;
    }
    harness_evaluate(state, shader, MASS_OF_VARIANCE, at, 4, mass);
    for (int distribution = 0; distribution < 4; distribution++)
        check_relative("plane_mass", &at[distribution], mass[distribution].value[0], 1, 1e-5);
}

/// Sum of Gaussians at x, in units of alpha, as a part of what the exact bell has at 0.
static double tail(const float weight[4], const float spread[4], double x) {
    double sum = 0;
    for (int i = 0; i < 4; i++)
        sum += (double)weight[i] / (double)spread[i] * exp(-x * x / (double)spread[i]);
    return sum;
}

/// The mean of distributions whose log alpha is normal about that of `alpha`, in steps of it.
static double mean_distribution(double alpha, double varies, const double direction[3]) {
    static const double pole[3] = {0, 0, 1};
    if (varies == 0)
        return reference_normal_distribution(LOBE_DISTRIBUTION_GGX, pole, direction, alpha);
    double sum = 0, weights = 0;
    for (int i = -60; i <= 60; i++) {
        double step = i / 15.0, weight = exp(-0.5 * step * step);
        sum += weight * reference_normal_distribution(LOBE_DISTRIBUTION_GGX, pole, direction,
                                                      alpha * exp(step * sqrt(varies)));
        weights += weight;
    }
    return sum / weights;
}

/// Against the distribution itself, alpha = 0.02, or a mean of several: relative L2 over the plane,
/// weighted by the plane's area over the distribution, and the largest relative error to 8 alpha.
/// No mass is lost.
static void check_tail(void **state, double varies, double largest, double mean) {
    harness_arguments at = {.a = {(float)varies}};
    harness_result weight, spread;
    harness_evaluate(state, shader, TAIL_WEIGHT, &at, 1, &weight);
    harness_evaluate(state, shader, TAIL_SPREAD, &at, 1, &spread);
    static const double pole[3] = {0, 0, 1}, alpha = 0.02;
    double peak = reference_normal_distribution(LOBE_DISTRIBUTION_GGX, pole, pole, alpha);
    double worst = 0, squared = 0, size = 0, mass = 0, exact_weights[4], exact_spreads[4];
    for (int i = 0; i <= 800; i++) {
        double x = i / 100.0, angle = 2 * asin(0.5 * x * alpha);
        const double direction[3] = {sin(angle), 0, cos(angle)};
        double exact = mean_distribution(alpha, varies, direction) / peak;
        double error = tail(weight.value, spread.value, x) - exact;
        worst = fmax(worst, fabs(error) / exact);
        squared += x * error * error / exact;
        size += x * exact;
    }
    reference_plane_tail(varies, exact_weights, exact_spreads);
    for (int i = 0; i < 4; i++) {
        check_relative("tail_weight", &at, weight.value[i], exact_weights[i], 1e-4);
        check_relative("tail_spread", &at, spread.value[i], exact_spreads[i], 1e-5);
        mass += (double)weight.value[i];
    }
    print_message("# tail, %.2f: off by %.3g at worst, %.3g over the plane (relative L2)\n", varies,
                  worst, sqrt(squared / size));
    assert_true(worst < largest && sqrt(squared / size) < mean);
    assert_true(fabs(mass - 1) < 1e-6);
}

static void test_tail(void **state) {
    check_tail(state, 0, 0.2, 0.02);
    check_tail(state, 0.04, 0.2, 0.03);
    check_tail(state, 0.2, 0.25, 0.06);
    check_tail(state, 0.4, 0.35, 0.09);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_microfacets),
        cmocka_unit_test(test_half_vector_lobes),
        cmocka_unit_test(test_no_variance),
        cmocka_unit_test(test_tail),
    };
    return cmocka_run_group_tests_name("plane_lobe", tests, harness_set_up, harness_tear_down);
}
