// shaders/lib/microfacet/slope_distribution.glsl and tilted_slopes.glsl against MPFR, and their
// double-precision twin.

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "shaders/interface/slope_moments.h"
#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/microfacet/slope_distribution.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/slope_distribution.comp";
enum { DISTRIBUTION, ROOT, STANDARDISED, COVARIANCE, TILTED, FLAT, TILTED_AND_BACK, NORMAL };

enum { COUNT = 8000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static reference_slopes slopes_of(const harness_arguments *at) {
    return (reference_slopes){{at->b[0], at->b[1]}, {at->c[0], at->c[1], at->c[2]}};
}

/// Means up to 3, standard deviations from 1e-2 to 3, correlations up to 0.95; normals within four
/// standard deviations.
static void make_arguments(void) {
    uint64_t random = 71;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double length = i % 5 ? scenes_random_between(&random, 0, 3) : 0;
        double azimuth = scenes_random_between(&random, 0, 2 * M_PI);
        double sigma[2] = {geometric(1e-2, 3, i, COUNT),
                           geometric(1e-2, 3, (i * 31) % COUNT, COUNT)};
        double correlation = i % 3 ? scenes_random_between(&random, -0.95, 0.95) : 0;
        at->b[0] = (float)(length * cos(azimuth));
        at->b[1] = (float)(length * sin(azimuth));
        at->c[0] = (float)(sigma[0] * sigma[0]);
        at->c[1] = (float)(sigma[1] * sigma[1]);
        at->c[2] = (float)(correlation * sigma[0] * sigma[1]);
        double slope[2], normal[3];
        for (int j = 0; j < 2; j++)
            slope[j] = at->b[j] + scenes_random_between(&random, -3, 3) * sigma[j];
        reference_normal_of_slope(slope, normal);
        for (int j = 0; j < 3; j++)
            at->a[j] = (float)normal[j];
    }
}

/// Dupuy et al., 2013, Eqs. 8 and 10, with the normal's length as it is. `form`: the exponent.
static real exact_distribution(const harness_arguments *at, double *form) {
    real x = subtract(divide(real_from(-at->a[0]), real_from(at->a[2])), real_from(at->b[0]));
    real y = subtract(divide(real_from(-at->a[1]), real_from(at->a[2])), real_from(at->b[1]));
    real xx = real_from(at->c[0]), yy = real_from(at->c[1]), xy = real_from(at->c[2]);
    real determinant = subtract(multiply(xx, yy), square(xy));
    real sum = add(multiply(yy, square(x)), multiply(xx, square(y)));
    sum = subtract(sum, multiply(real_from(2), multiply(xy, multiply(x, y))));
    sum = divide(sum, determinant);
    *form = to_double(sum);
    real value = exponential(multiply(real_from(-0.5), sum));
    value = divide(value, multiply(multiply(real_from(2), real_pi()), square_root(determinant)));
    return divide(value, square(square(real_from(at->a[2]))));
}

static void check_distribution(const harness_arguments *at, const harness_result *result) {
    release_reals();
    double form;
    double expected = to_double(exact_distribution(at, &form));
    // What is lost: in the factor, by correlation; in slopes less means, against the width.
    double correlation = at->c[2] * at->c[2] / ((double)at->c[0] * at->c[1]);
    double width = sqrt(fmin(at->c[0], at->c[1]) * (1 - correlation));
    double length =
        fabs(at->a[0] / at->a[2]) + fabs(at->a[1] / at->a[2]) + fabs(at->b[0]) + fabs(at->b[1]);
    double bound = (16 + 8 * form) / (1 - correlation) + 8 * sqrt(form) * length / width;
    bound = bound * FLOAT_ROUNDING * expected + FLOAT_SMALLEST / fmin(pow(at->a[2], 4), 1e-3);
    check_close("distribution_of_slopes", at, result->value[0], expected, bound);
    check_close("lobe_of_slopes", at, result->value[1], expected * at->a[2], bound);
    reference_slopes slopes = slopes_of(at);
    double normal[3] = {at->a[0], at->a[1], at->a[2]}, slope[2];
    check_close("reference_distribution_of_slopes", at,
                reference_distribution_of_slopes(&slopes, normal), expected,
                1e-9 * (1 + form) * expected);
    reference_slope_of_normal(normal, slope);
    for (int i = 0; i < 2; i++)
        check_close("slope_of_normal", at, result->value[2 + i], slope[i],
                    8 * FLOAT_ROUNDING * fabs(slope[i]) + FLOAT_SMALLEST);
}

static void test_distribution(void **state) {
    make_arguments();
    harness_evaluate(state, shader, DISTRIBUTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_distribution(&arguments[i], &results[i]);
    report_worst_error("distribution_of_slopes");
}

/// Centred and isotropic, it is the Beckmann distribution of alpha^2 = 2 sigma^2.
static void test_beckmann(void **state) {
    make_arguments();
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].b[0] = arguments[i].b[1] = arguments[i].c[2] = 0;
        arguments[i].c[1] = arguments[i].c[0];
    }
    harness_evaluate(state, shader, DISTRIBUTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double normal[3] = {arguments[i].a[0], arguments[i].a[1], arguments[i].a[2]};
        double square = 2 * (double)arguments[i].c[0];
        double form = (1 / (normal[2] * normal[2]) - 1) / square;
        double expected = reference_normal_distribution(LOBE_DISTRIBUTION_BECKMANN,
                                                        (double[]){0, 0, 1}, normal, sqrt(square));
        check_close("Beckmann", &arguments[i], results[i].value[0], expected,
                    (2e-6 + 4e-6 * form / (normal[2] * normal[2])) * expected + 1e-30);
    }
}

/// Directions at the horizon and below it: slopes of the greatest length, and no normals there.
static void test_horizon(void **state) {
    static const float normals[6][3] = {{0.6f, 0, -0.8f},    {-1, 0, 0},    {0, 0, -1},
                                        {0.8f, 0.6f, 1e-7f}, {0, 0, 1e-9f}, {0, 1, 1e-30f}};
    make_arguments();
    for (size_t i = 0; i < COUNT; i++)
        memcpy(arguments[i].a, normals[i % 6], sizeof normals[0]);
    harness_evaluate(state, shader, DISTRIBUTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *normal = normals[i % 6], *value = results[i].value;
        double length = hypot(value[2], value[3]);
        double expected = normal[0] != 0 || normal[1] != 0 ? SLOPE_MAXIMUM : 0;
        check_close("slope at the horizon", &arguments[i], length, expected, 1e-5);
        assert_true(value[2] * normal[0] <= 0 && value[3] * normal[1] <= 0);
        assert_true(isfinite(value[0]) && isfinite(value[1]) && value[0] >= 0);
        if (normal[2] <= 0)
            assert_true(value[0] == 0 && value[1] == 0);
    }
}

/// The factor times its transpose is the covariance, and a sum of squares its form.
static void test_root(void **state) {
    make_arguments();
    harness_evaluate(state, shader, ROOT, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *root = results[i].value;
        double scale = sqrt((double)at->c[0] * at->c[1]);
        check_relative("root xx", at, root[0] * (double)root[0], at->c[0], 8 * FLOAT_ROUNDING);
        check_close("root xy", at, root[0] * (double)root[2], at->c[2], 8 * FLOAT_ROUNDING * scale);
        check_close("root yy", at, root[1] * (double)root[1] + root[2] * (double)root[2], at->c[1],
                    8 * FLOAT_ROUNDING * at->c[1]);
        double x = at->a[0], y = at->a[1];
        check_close("slope_variance_along", at, results[i].value[3],
                    at->c[0] * x * x + at->c[1] * y * y + 2 * at->c[2] * x * y,
                    16 * FLOAT_ROUNDING * (at->c[0] * x * x + at->c[1] * y * y));
    }
    report_worst_error("slope_distribution_of");
}

/// Flat maps, lines, covariances that no slopes have: the factor stays finite and above zero.
static void test_degenerate_root(void **state) {
    static const float covariances[6][3] = {{0, 0, 0},      {0, 0, 1e-9f},         {1, 0, 1e-7f},
                                            {0, 1, -1e-7f}, {0.25f, 0.25f, 0.25f}, {1, 1, -1.5f}};
    make_arguments();
    for (size_t i = 0; i < COUNT; i++)
        memcpy(arguments[i].c, covariances[i % 6], sizeof covariances[0]);
    harness_evaluate(state, shader, ROOT, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *root = results[i].value;
        assert_true(root[0] > 0 && root[1] > 0 && isfinite(root[0]) && isfinite(root[1]));
        assert_true(fabsf(root[2]) <= 1.001f * sqrtf(fmaxf(covariances[i % 6][1], 1e-12f)));
        double yy = root[1] * (double)root[1] + root[2] * (double)root[2];
        check_close("yy", &arguments[i], yy, covariances[i % 6][1], 2e-6);
    }
    harness_evaluate(state, shader, DISTRIBUTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(isfinite(results[i].value[0]));
}

static void test_standardised(void **state) {
    make_arguments();
    harness_evaluate(state, shader, STANDARDISED, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *value = results[i].value;
        double correlation = at->c[2] * at->c[2] / ((double)at->c[0] * at->c[1]);
        double x = (double)at->a[0] - at->b[0], y = (double)at->a[1] - at->b[1];
        double form = (at->c[1] * x * x - 2 * at->c[2] * x * y + at->c[0] * y * y) /
                      (at->c[0] * (double)at->c[1] * (1 - correlation));
        double squared = value[2] * (double)value[2] + value[3] * (double)value[3];
        double width = sqrt(fmin(at->c[0], at->c[1]) * (1 - correlation));
        check_close("standardised_slope", at, squared, form,
                    (32 * form / (1 - correlation) + 32 * sqrt(form) / width) * FLOAT_ROUNDING);
        for (int j = 0; j < 2; j++)
            check_close("slope_at", at, value[j], at->a[j],
                        8 * FLOAT_ROUNDING *
                            (1 + hypot(x, y) + sqrt(at->c[j] * squared) / (1 - correlation)));
    }
    report_worst_error("standardised_slope");
}

/// Second moments less squared means; never below zero.
static void test_covariance(void **state) {
    make_arguments();
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        memcpy(at->a, at->b, sizeof at->a);
        double xx = at->c[0], yy = at->c[1], xy = at->c[2];
        // Every other one has rounding alone for its variance.
        double part = i % 2 ? 1 : 0;
        at->c[0] = (float)(part * xx + (double)at->a[0] * at->a[0]);
        at->c[1] = (float)(part * yy + (double)at->a[1] * at->a[1]);
        at->c[2] = (float)(part * xy + (double)at->a[0] * at->a[1]);
    }
    harness_evaluate(state, shader, COVARIANCE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *value = results[i].value;
        for (int j = 0; j < 3; j++) {
            double product = (double)at->a[j % 2] * at->a[j == 2 ? 1 : j % 2];
            if (j == 2)
                product = (double)at->a[0] * at->a[1];
            double expected = at->c[j] - product;
            check_close("covariance_of_moments", at, value[j], j < 2 ? fmax(expected, 0) : expected,
                        4 * FLOAT_ROUNDING * (fabs(at->c[j]) + fabs(product)));
        }
        assert_true(value[0] >= 0 && value[1] >= 0);
    }
}

static void test_tilt(void **state) {
    make_arguments();
    for (size_t i = 0; i < COUNT; i++)
        arguments[i].a[0] = fabsf(arguments[i].a[0]) + 1e-6f;
    harness_evaluate(state, shader, TILTED, arguments, COUNT, results);
    double expected[3];
    for (size_t i = 0; i < COUNT; i++) {
        const double tilt[2] = {arguments[i].b[0], arguments[i].b[1]};
        reference_tilted_covariance(tilt, slopes_of(&arguments[i]).covariance, expected);
        double scale = fmax(arguments[i].c[0], arguments[i].c[1]);
        for (int j = 0; j < 3; j++)
            check_close("tilted covariance", &arguments[i], results[i].value[j], expected[j],
                        64 * FLOAT_ROUNDING * scale);
    }
    harness_evaluate(state, shader, FLAT, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const double tilt[2] = {arguments[i].b[0], arguments[i].b[1]};
        reference_flat_covariance(tilt, arguments[i].a[0], expected);
        for (int j = 0; j < 3; j++)
            check_close("flat covariance", &arguments[i], results[i].value[j], expected[j],
                        1e-6 * fmax(expected[0], expected[1]));
    }
    harness_evaluate(state, shader, TILTED_AND_BACK, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        for (int j = 0; j < 2; j++)
            check_close("tilted and back", &arguments[i], results[i].value[j], arguments[i].a[j],
                        64 * FLOAT_ROUNDING);
}

/// What the first order stands for: slopes over the tilted plane of normals near its own.
static void test_tilt_of_normals(void **state) {
    (void)state;
    static const double tilts[3][2] = {{0, 0}, {0.5, -0.25}, {-2, 1}};
    const double step = 1e-5;
    for (int i = 0; i < 3; i++) {
        const double *m = tilts[i], square = 1 + m[0] * m[0] + m[1] * m[1];
        double covariance[3], unit[3] = {0}, tilted[3];
        // A line of slopes along x, as unit vectors; the angle between two of them.
        unit[0] = 1;
        reference_tilted_covariance(m, unit, tilted);
        double a[3], b[3], product = 0;
        reference_normal_of_slope(m, a);
        reference_normal_of_slope((double[]){m[0] + step, m[1]}, b);
        for (int j = 0; j < 3; j++)
            product += (a[j] - b[j]) * (a[j] - b[j]);
        assert_true(fabs(product / (step * step) - (tilted[0] + tilted[1])) < 1e-4);
        // Back and forth.
        reference_flat_covariance(m, 1, covariance);
        reference_tilted_covariance(m, covariance, tilted);
        assert_true(fabs(tilted[0] - 1) < 1e-12 && fabs(tilted[1] - 1) < 1e-12);
        assert_true(fabs(tilted[2]) < 1e-12 && covariance[0] >= square * 0.999);
    }
}

static void test_normal(void **state) {
    make_arguments();
    harness_evaluate(state, shader, NORMAL, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double expected[3];
        reference_normal_of_slope((double[]){arguments[i].a[0], arguments[i].a[1]}, expected);
        for (int j = 0; j < 3; j++)
            check_close("normal_of_slope", &arguments[i], results[i].value[j], expected[j],
                        8 * FLOAT_ROUNDING);
    }
}

enum { PANELS = 6, RINGS = PANELS * QUADRATURE_ORDER, AZIMUTHS = 96 };

/// Integrals over the hemisphere, in coordinates of the slopes' own Gaussian: each normal stands
/// for d(normal) = n_z^3 d(slope). Of the distribution times n_z, and of the lobe: both are one.
static void check_areas(void **state, const reference_slopes *slopes) {
    quadrature_node radii[RINGS];
    geometric_quadrature(0.5, 7, PANELS, radii);
    double root_x = sqrt(slopes->covariance[0]), shear = slopes->covariance[2] / root_x;
    double root_y = sqrt(slopes->covariance[1] - shear * shear), projected = 0, area = 0;
    for (int i = 0; i < RINGS * AZIMUTHS; i++) {
        double azimuth = 2 * M_PI * (i % AZIMUTHS) / AZIMUTHS, radius = radii[i / AZIMUTHS].x;
        double x = radius * cos(azimuth), y = radius * sin(azimuth), normal[3];
        const double slope[2] = {slopes->mean[0] + root_x * x,
                                 slopes->mean[1] + shear * x + root_y * y};
        reference_normal_of_slope(slope, normal);
        for (int j = 0; j < 3; j++) {
            arguments[i].a[j] = (float)normal[j];
            arguments[i].c[j] = (float)slopes->covariance[j];
        }
        arguments[i].b[0] = (float)slopes->mean[0];
        arguments[i].b[1] = (float)slopes->mean[1];
    }
    harness_evaluate(state, shader, DISTRIBUTION, arguments, (size_t)RINGS * AZIMUTHS, results);
    for (int i = 0; i < RINGS * AZIMUTHS; i++) {
        const quadrature_node *ring = &radii[i / AZIMUTHS];
        double cosine = arguments[i].a[2], solid = pow(cosine, 3) * root_x * root_y;
        solid *= ring->weight * ring->x * 2 * M_PI / AZIMUTHS;
        projected += solid * cosine * results[i].value[0];
        area += solid * results[i].value[1];
    }
    if (!(fabs(projected - 1) < 1e-4 && fabs(area - 1) < 1e-4))
        fail_msg("projected area %.6g, area %.6g", projected, area);
}

static void test_areas(void **state) {
    static_assert(RINGS * AZIMUTHS <= COUNT, "all normals fit");
    check_areas(state, &(reference_slopes){{0, 0}, {0.02, 0.02, 0}});
    check_areas(state, &(reference_slopes){{1.5, -0.5}, {0.3, 0.05, 0.1}});
    check_areas(state, &(reference_slopes){{-0.2, 0.8}, {2, 1, -1.3}});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distribution),    cmocka_unit_test(test_beckmann),
        cmocka_unit_test(test_horizon),         cmocka_unit_test(test_root),
        cmocka_unit_test(test_degenerate_root), cmocka_unit_test(test_standardised),
        cmocka_unit_test(test_covariance),      cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_tilt_of_normals), cmocka_unit_test(test_normal),
        cmocka_unit_test(test_areas),
    };
    return cmocka_run_group_tests_name("slope_distribution", tests, harness_set_up,
                                       harness_tear_down);
}
