// shaders/lib/microfacet/normal_distribution.glsl against MPFR, and its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/exact.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/normal_distribution.comp";
enum { DISTRIBUTION, PROJECTED_AREA };

enum { COUNT = 8000, DISTRIBUTIONS = 4 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// alpha from 1e-4 to 1, and the exponent or kappa of a lobe as wide.
static float parameter_at(uint32_t distribution, double alpha) {
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return (float)fmax(2 / (alpha * alpha) - 2, 0);
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return (float)(2 / (alpha * alpha) - (alpha == 1 ? 2 : 0));
    return (float)alpha;
}

static void make_arguments(double greatest_angle) {
    uint64_t random = 10;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        uint32_t distribution = i % DISTRIBUTIONS;
        double alpha = i < 40 ? 1 : geometric(1e-4, 1, i, COUNT);
        const double angles[10] = {0,         0.01 * alpha, 0.3 * alpha, alpha, 2 * alpha,
                                   3 * alpha, 0.3,          0.9,         1.5,   1.57};
        double angle = fmin(angles[i / DISTRIBUTIONS % 10], greatest_angle);
        at->c[0] = (float)distribution;
        at->c[1] = parameter_at(distribution, alpha);
        random_direction(&random, at->a);
        direction_at(at->a, angle, scenes_random_between(&random, 0, 6), at->b);
    }
}

// 1 / (pi alpha^2 cos^4 (1 + tan^2/alpha^2)^2), and exp(-tan^2/alpha^2) / (pi alpha^2 cos^4).
static real exact_of_slope(lobe_distribution distribution, real cosine, real alpha) {
    real one = real_from(1), cosine_squared = square(cosine);
    real tangent_squared = divide(subtract(one, cosine_squared), cosine_squared);
    real slope_squared = divide(tangent_squared, square(alpha));
    real factor = distribution == LOBE_DISTRIBUTION_GGX
                      ? divide(one, square(add(one, slope_squared)))
                      : exponential(subtract(real_from(0), slope_squared));
    return divide(factor, multiply(real_pi(), square(multiply(alpha, cosine_squared))));
}

static real exact_blinn_phong(real cosine, real exponent) {
    real scale = divide(add(exponent, real_from(2)), multiply(real_from(2), real_pi()));
    return multiply(scale, power(cosine, exponent));
}

// N = (1 - (1 - exp(-kappa))/kappa) / (1 - exp(-2 kappa)), from the definition.
static real exact_projected_area(real kappa) {
    if (compare(kappa, real_from(0)) == 0)
        return real_from(0.25);
    real minus_kappa = subtract(real_from(0), kappa);
    real upper = add(real_from(1), divide(exponential_minus_one(minus_kappa), kappa));
    real lower = exponential_minus_one(multiply(real_from(2), minus_kappa));
    return divide(upper, subtract(real_from(0), lower));
}

static real exact_distribution(const harness_arguments *at, real cosine) {
    real parameter = real_from(at->c[1]);
    switch ((lobe_distribution)at->c[0]) {
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return exact_blinn_phong(cosine, parameter);
    case LOBE_DISTRIBUTION_VMF:
        return divide(exact_von_mises_fisher(at->b, at->a, at->c[1]),
                      exact_projected_area(parameter));
    default:
        return exact_of_slope((lobe_distribution)at->c[0], cosine, parameter);
    }
}

// How far the value falls below the peak, as an exponent: what multiplies a relative error of the
// angle.
static double exponent_of(const harness_arguments *at, double cosine) {
    double parameter = at->c[1];
    switch ((lobe_distribution)at->c[0]) {
    case LOBE_DISTRIBUTION_GGX:
        return 4;
    case LOBE_DISTRIBUTION_BECKMANN:
        return (1 / (cosine * cosine) - 1) / (parameter * parameter);
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return parameter * fabs(log(cosine));
    default:
        return parameter * (1 - cosine);
    }
}

static double twin_of(const harness_arguments *at) {
    double normal[3], half_vector[3];
    for (int i = 0; i < 3; i++) {
        normal[i] = at->a[i];
        half_vector[i] = at->b[i];
    }
    return reference_normal_distribution((lobe_distribution)at->c[0], normal, half_vector,
                                         at->c[1]);
}

static void check_distribution(const harness_arguments *at, const harness_result *result) {
    release_reals();
    real cosine = dot(unit_vector_from(at->a), unit_vector_from(at->b));
    double expected = to_double(exact_distribution(at, cosine));
    double c = to_double(cosine), x = exponent_of(at, c);
    // An angle through |n - h|^2 is off by 1.2e-6 or so relative (see test_angle), plus, for a
    // narrow lobe, the square of the difference of the floats' lengths against alpha^2; near the
    // horizon the cosine itself is off by 2^-23 / cos, and counts up to four times.
    double lengths = at->c[0] <= LOBE_DISTRIBUTION_BECKMANN ? 4e-14 / (at->c[1] * at->c[1]) : 0;
    double bound = (12 + 14 * x + (4 + 2 * x) / c) * FLOAT_ROUNDING + 2 * lengths;
    // exp() flushes to zero below 2^-126, and is multiplied by the peak over cos^4.
    double alpha = at->c[1];
    double peak = at->c[0] <= LOBE_DISTRIBUTION_BECKMANN ? 1 / (alpha * alpha) : at->c[1] + 1;
    double flushed = FLOAT_SMALLEST * peak / fmax(pow(c, 4), 1e-24);
    check_close("normal_distribution", at, result->value[0], expected, bound * expected + flushed);
    // The twin differs by what the floats' lengths do.
    check_close("reference_normal_distribution", at, twin_of(at), expected,
                ((1 + x) * 1e-6 / c + 2 * lengths) * expected + 1e-300);
}

static void test_distribution(void **state) {
    make_arguments(1.57);
    harness_evaluate(state, shader, DISTRIBUTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_distribution(&arguments[i], &results[i]);
    report_worst_error("normal_distribution");
}

static void test_horizon(void **state) {
    make_arguments(3);
    for (size_t i = 0; i < COUNT; i++) {
        // On the horizon, to within rounding, and below it.
        arguments[i].a[0] = arguments[i].a[1] = 0;
        arguments[i].a[2] = 1;
        const float heights[4] = {0, 1e-30f, 1e-7f, -0.6f};
        arguments[i].b[2] = heights[i / DISTRIBUTIONS % 4];
        arguments[i].b[0] = 0;
        arguments[i].b[1] = sqrtf(1 - arguments[i].b[2] * arguments[i].b[2]);
    }
    harness_evaluate(state, shader, DISTRIBUTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        assert_true(isfinite(results[i].value[0]) && results[i].value[0] >= 0);
        if (arguments[i].b[2] <= 0)
            assert_true(results[i].value[0] == 0);
    }
}

static void test_projected_area(void **state) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] =
            (harness_arguments){{0}, {0}, {0, i == 0 ? 0 : (float)geometric(1e-8, 1e6, i, COUNT)}};
    harness_evaluate(state, shader, PROJECTED_AREA, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        double kappa = arguments[i].c[1];
        double expected = to_double(exact_projected_area(real_from(kappa)));
        check_relative("von_mises_fisher_projected_area", &arguments[i], results[i].value[0],
                       expected, 8 * FLOAT_ROUNDING);
        check_relative("reference_von_mises_fisher_projected_area", &arguments[i],
                       reference_von_mises_fisher_projected_area(kappa), expected, 1e-14);
    }
    report_worst_error("von_mises_fisher_projected_area");
}

// Of D(h) cos over the hemisphere about the pole, in theta.
static double projected_area(void **state, uint32_t distribution, double alpha) {
    enum { PANELS = 48, NODES = PANELS * QUADRATURE_ORDER };
    static const float pole[3] = {0, 0, 1};
    quadrature_node nodes[NODES];
    geometric_quadrature(0.1 * alpha, M_PI / 2, PANELS, nodes);
    for (size_t i = 0; i < NODES; i++) {
        arguments[i] = (harness_arguments){
            {0, 0, 1}, {0}, {(float)distribution, parameter_at(distribution, alpha)}};
        direction_at(pole, nodes[i].x, 1, arguments[i].b);
    }
    harness_evaluate(state, shader, DISTRIBUTION, arguments, NODES, results);
    double area = 0;
    for (size_t i = 0; i < NODES; i++)
        area +=
            2 * M_PI * nodes[i].weight * sin(nodes[i].x) * cos(nodes[i].x) * results[i].value[0];
    return area;
}

static void test_projected_area_is_one(void **state) {
    static const double alphas[] = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.4, 0.7, 1};
    for (uint32_t distribution = 0; distribution < DISTRIBUTIONS; distribution++) {
        for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
            double area = projected_area(state, distribution, alphas[i]);
            check_close("integral of D cos", &arguments[0], area, 1, 4e-6);
        }
    }
    report_worst_error("integral of D cos");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distribution),
        cmocka_unit_test(test_horizon),
        cmocka_unit_test(test_projected_area),
        cmocka_unit_test(test_projected_area_is_one),
    };
    return cmocka_run_group_tests_name("normal_distribution", tests, harness_set_up,
                                       harness_tear_down);
}
