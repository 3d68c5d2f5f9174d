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
enum { LOBE, TAIL_WEIGHT, TAIL_SPREAD };

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

/// The bell has the peak of the lobe, except for GGX with alpha^2 above 0.9.
static void check_lobe(lobe_material_model model, lobe_distribution distribution,
                       const harness_arguments *at, const float *value) {
    double parameter = at->a[0];
    double variance = reference_plane_variance(distribution, parameter);
    bool ggx = distribution == LOBE_DISTRIBUTION_GGX;
    double lost = ggx ? 1 / fmax(1 - parameter * parameter, 0.1) : 1;
    check_relative("plane_variance", at, value[0], variance, 8 * lost * FLOAT_ROUNDING);
    check_relative("plane_mass", at, value[1], reference_plane_mass(model, distribution, parameter),
                   64 * lost * FLOAT_ROUNDING);
    if (ggx && parameter * parameter > REFERENCE_GGX_SQUARE_MAXIMUM)
        return;
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

/// Sum of Gaussians at x, in units of alpha, as a part of what the exact bell has at 0.
static double tail(const float weight[3], const float spread[3], double x) {
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (double)weight[i] / (double)spread[i] * exp(-x * x / (double)spread[i]);
    return sum;
}

/// Against the distribution itself, alpha = 0.05: to 6 alpha within 6 % of it, or of a hundredth
/// of its peak; and what mass is left out is what the comment there says.
static void test_tail(void **state) {
    harness_result weight, spread;
    harness_evaluate(state, shader, TAIL_WEIGHT, arguments, 1, &weight);
    harness_evaluate(state, shader, TAIL_SPREAD, arguments, 1, &spread);
    static const double pole[3] = {0, 0, 1}, alpha = 0.05;
    double peak = reference_normal_distribution(LOBE_DISTRIBUTION_GGX, pole, pole, alpha);
    double worst = 0, squared = 0, size = 0;
    for (int i = 0; i <= 600; i++) {
        double x = i / 100.0, angle = 2 * asin(0.5 * x * alpha);
        const double direction[3] = {sin(angle), 0, cos(angle)};
        double exact =
            reference_normal_distribution(LOBE_DISTRIBUTION_GGX, pole, direction, alpha) / peak;
        double error = tail(weight.value, spread.value, x) - exact;
        worst = fmax(worst, fabs(error) / fmax(exact, 0.01));
        squared += x * error * error;
        size += x * exact * exact;
    }
    double mass = (double)weight.value[0] + (double)weight.value[1] + (double)weight.value[2];
    print_message("# tail: off by %.3g at worst, %.3g over the plane (relative L2), mass %.4g\n",
                  worst, sqrt(squared / size), mass);
    assert_true(worst < 0.06 && sqrt(squared / size) < 0.02);
    assert_true(fabs(mass - 0.975) < 0.001);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_microfacets),
        cmocka_unit_test(test_half_vector_lobes),
        cmocka_unit_test(test_tail),
    };
    return cmocka_run_group_tests_name("plane_lobe", tests, harness_set_up, harness_tear_down);
}
