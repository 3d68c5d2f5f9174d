// shaders/lib/light/spherical_harmonics.glsl against double precision.

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/light/spherical_harmonics.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/samples.h"

enum {
    COUNT = 1000,
    UNIT_NORMAL = 0,
    MEAN_NORMAL = 1,
    FROM_BELOW = 2,
    ALONG = 3,
    PANELS = 12,
    AZIMUTHS = 8
};
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static double coefficient(const harness_arguments *at, int i) {
    return (double)(i == 0 ? at->a[3] : i < 5 ? at->b[i - 1] : at->c[i - 5]);
}

static void coefficients_of(const harness_arguments *at, double coefficients[REFERENCE_HARMONICS]) {
    for (int i = 0; i < REFERENCE_HARMONICS; i++)
        coefficients[i] = coefficient(at, i);
}

// Of either sign, except the constant one, which is large enough to keep every sum positive.
static void random_coefficients(uint64_t *random, harness_arguments *at) {
    at->a[3] = 8;
    for (int i = 0; i < 8; i++)
        (i < 4 ? at->b : at->c)[i % 4] = (float)scenes_random_between(random, -1, 1);
}

static double sum_at(const harness_arguments *at, const double direction[3]) {
    double coefficients[REFERENCE_HARMONICS];
    coefficients_of(at, coefficients);
    return reference_harmonic_sum(coefficients, direction);
}

static void test_unit_normal(void **state) {
    uint64_t random = 81;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        random_coefficients(&random, &arguments[i]);
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", UNIT_NORMAL, arguments, COUNT,
                     results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a;
        double direction[3] = {a[0], a[1], a[2]};
        reference_normalise(direction);
        check_close("harmonic_irradiance_by_degree", &arguments[i], results[i].value[0],
                    sum_at(&arguments[i], direction), 2e-6);
    }
    report_worst_error("harmonic_irradiance_by_degree");
}

// Each harmonic on its own, on top of a constant.
static void test_basis(void **state) {
    uint64_t random = 82;
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i] = (harness_arguments){.a = {0, 0, 0, 4}};
        random_direction(&random, arguments[i].a);
        size_t harmonic = i % 8;
        (harmonic < 4 ? arguments[i].b : arguments[i].c)[harmonic % 4] = 1;
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", UNIT_NORMAL, arguments, COUNT,
                     results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a;
        double direction[3] = {a[0], a[1], a[2]};
        reference_normalise(direction);
        int degree = i % 8 < 3 ? 1 : 2, order = (int)(i % 8 + 1) - degree * (degree + 1);
        check_close("spherical_harmonics", &arguments[i], results[i].value[0],
                    4 * reference_spherical_harmonic(0, 0, direction) +
                        reference_spherical_harmonic(degree, order, direction),
                    1e-6);
    }
    report_worst_error("spherical_harmonics");
}

// A light and nothing else: negative behind it, which is cut off.
static void test_never_negative(void **state) {
    const double light[3] = {0, 0, 1};
    double coefficients[REFERENCE_HARMONICS] = {0};
    reference_add_irradiance(light, 1, coefficients);
    size_t negative = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double angle = M_PI * (double)i / (COUNT - 1);
        arguments[i] = (harness_arguments){
            .a = {(float)sin(angle), 0, (float)cos(angle), (float)coefficients[0]}};
        for (int j = 0; j < 8; j++)
            (j < 4 ? arguments[i].b : arguments[i].c)[j % 4] = (float)coefficients[1 + j];
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", UNIT_NORMAL, arguments, COUNT,
                     results);
    double least = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double angle = M_PI * (double)i / (COUNT - 1);
        double sum = sum_at(&arguments[i], (double[3]){sin(angle), 0, cos(angle)});
        least = fmin(least, sum);
        negative += sum < 0;
        check_close("harmonic_irradiance_by_degree", &arguments[i], results[i].value[0],
                    fmax(sum, 0), 1e-6);
    }
    assert_true(negative > COUNT / 10);
    // The bound stated in the shader.
    assert_true(fabs(least + 0.04) < 0.001);
}

/// Mean of the sum of harmonics over normals distributed as von Mises-Fisher, by brute force.
static double mean_over_normals(const harness_arguments *at, const float mean[3], double kappa) {
    static quadrature_node nodes[PANELS * QUADRATURE_ORDER];
    geometric_quadrature(fmin(0.3 / sqrt(kappa + 1e-9), 0.5), M_PI, PANELS, nodes);
    double sum = 0, axis[3] = {mean[0], mean[1], mean[2]};
    reference_normalise(axis);
    double across[3] = {-axis[1], axis[0], 0};
    if (fabs(axis[2]) > 0.9)
        memcpy(across, (double[3]){0, -axis[2], axis[1]}, sizeof across);
    reference_normalise(across);
    const double third[3] = {axis[1] * across[2] - axis[2] * across[1],
                             axis[2] * across[0] - axis[0] * across[2],
                             axis[0] * across[1] - axis[1] * across[0]};
    for (size_t i = 0; i < PANELS * QUADRATURE_ORDER; i++) {
        for (int j = 0; j < AZIMUTHS; j++) {
            double azimuth = 2 * M_PI * j / AZIMUTHS, normal[3];
            for (int k = 0; k < 3; k++)
                normal[k] = cos(nodes[i].x) * axis[k] +
                            sin(nodes[i].x) * (cos(azimuth) * across[k] + sin(azimuth) * third[k]);
            sum += nodes[i].weight * sin(nodes[i].x) * (2 * M_PI / AZIMUTHS) *
                   reference_von_mises_fisher(normal, axis, kappa) * sum_at(at, normal);
        }
    }
    return sum;
}

static void test_mean_normal(void **state) {
    enum { LENGTHS = 60 };
    uint64_t random = 83;
    for (size_t i = 0; i < LENGTHS; i++) {
        float *a = arguments[i].a;
        random_direction(&random, a);
        random_coefficients(&random, &arguments[i]);
        // From no direction at all, evenly to the last, then ever closer to one.
        double length = i < LENGTHS / 2 ? 2.0 * (double)i / LENGTHS
                                        : 1 - geometric(1e-5, 0.5, i - LENGTHS / 2, LENGTHS / 2);
        for (int j = 0; j < 3; j++)
            a[j] = (float)(length * (double)a[j]);
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", MEAN_NORMAL, arguments, LENGTHS,
                     results);
    for (size_t i = 0; i < LENGTHS; i++) {
        const float *a = arguments[i].a;
        double r = reference_length((double[3]){a[0], a[1], a[2]});
        double kappa = r > 0 ? reference_concentration_from_complement(1 - r) : 0;
        double expected = mean_over_normals(&arguments[i], r > 0 ? a : (float[3]){0, 0, 1}, kappa);
        check_close("harmonic_irradiance_of_mean_normal", &arguments[i], results[i].value[0],
                    expected, 2e-5);
    }
    report_worst_error("harmonic_irradiance_of_mean_normal");
}

// Normals that all agree are one normal.
static void test_exact_mean(void **state) {
    static harness_result exact[COUNT];
    uint64_t random = 84;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        random_coefficients(&random, &arguments[i]);
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", UNIT_NORMAL, arguments, COUNT, exact);
    harness_evaluate(state, "light/spherical_harmonics.comp", MEAN_NORMAL, arguments, COUNT,
                     results);
    for (size_t i = 0; i < COUNT; i++)
        check_close("harmonic_irradiance_of_mean_normal", &arguments[i], results[i].value[0],
                    exact[i].value[0], 2e-5);
}

/// The radiance whose irradiance has these coefficients: degrees are divided by Lambert's factors.
static harness_arguments radiance_of(const harness_arguments *at) {
    harness_arguments radiance = *at;
    radiance.a[3] /= (float)M_PI;
    for (int i = 1; i < 9; i++)
        (i < 5 ? radiance.b : radiance.c)[(i - 1) % 4] /= (float)(i < 4 ? 2 * M_PI / 3 : M_PI / 4);
    return radiance;
}

typedef double counted_cosine(double cosine, double above);

static double from_below(double cosine, double above) {
    return above < 0 ? fmax(cosine, 0) : 0;
}

static double along(double cosine, double above) {
    return above > 0 ? cosine : 0;
}

/// Integral of the radiance times a function of its cosines with a and with `up`, by brute force.
static double gathered(const harness_arguments *at, const double up[3], counted_cosine *counted) {
    enum { HEIGHTS = 200, TURNS = 200 };
    const harness_arguments radiance = radiance_of(at);
    double sum = 0;
    for (int i = 0; i < HEIGHTS * TURNS; i++) {
        const double height = 2 * (i / TURNS + 0.5) / HEIGHTS - 1, azimuth = 2 * M_PI * i / TURNS;
        const double level = sqrt(1 - height * height);
        const double w[3] = {level * cos(azimuth), level * sin(azimuth), height};
        double cosine = 0, above = 0;
        for (int k = 0; k < 3; k++) {
            cosine += (double)at->a[k] * w[k];
            above += up[k] * w[k];
        }
        sum += counted(cosine, above) * sum_at(&radiance, w);
    }
    return 4 * M_PI / (HEIGHTS * TURNS) * sum;
}

static void test_from_below(void **state) {
    enum { NORMALS = 30 };
    const double up[3] = {0.48, 0.64, 0.6};
    uint64_t random = 85;
    for (size_t i = 0; i < NORMALS; i++) {
        random_direction(&random, arguments[i].a);
        random_coefficients(&random, &arguments[i]);
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", FROM_BELOW, arguments, NORMALS,
                     results);
    for (size_t i = 0; i < NORMALS; i++)
        // Relative to the whole irradiance, about 2.3.
        check_close("harmonic_irradiance_from_below", &arguments[i],
                    2 + (double)results[i].value[0], 2 + gathered(&arguments[i], up, from_below),
                    2e-3);
    report_worst_error("harmonic_irradiance_from_below");
}

static void test_light_along(void **state) {
    enum { VECTORS = 30 };
    const double up[3] = {0.48, 0.64, 0.6};
    uint64_t random = 86;
    for (size_t i = 0; i < VECTORS; i++) {
        random_direction(&random, arguments[i].a);
        for (int j = 0; j < 3; j++)
            arguments[i].a[j] *= 1 - 0.02f * (float)i;
        random_coefficients(&random, &arguments[i]);
    }
    harness_evaluate(state, "light/spherical_harmonics.comp", ALONG, arguments, VECTORS, results);
    for (size_t i = 0; i < VECTORS; i++)
        // Of either sign, up to the whole irradiance, about 2.3.
        check_close("harmonic_light_along", &arguments[i], 5 + (double)results[i].value[0],
                    5 + gathered(&arguments[i], up, along), 2e-3);
    report_worst_error("harmonic_light_along");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_basis),          cmocka_unit_test(test_unit_normal),
        cmocka_unit_test(test_never_negative), cmocka_unit_test(test_mean_normal),
        cmocka_unit_test(test_exact_mean),     cmocka_unit_test(test_from_below),
        cmocka_unit_test(test_light_along),
    };
    return cmocka_run_group_tests_name("spherical_harmonics", tests, harness_set_up,
                                       harness_tear_down);
}
