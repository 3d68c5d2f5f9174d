// shaders/lib/microfacet/facet_pair.glsl against its double-precision twin, which
// tests/reference/microfacet/test_facet_pair.c compares with random walks, and what microfacets
// exchange against the integral over all that they reflect.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/facet_pair.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/microfacet/slope_distribution.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/facet_pair.comp";
enum { SHARES, MICROFACETS, GAIN };

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Slopes from 1e-3 to 8 and directions from above the surface.
static void make_arguments(uint64_t random) {
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double steepness = geometric(1e-3, 8, i, COUNT);
        double azimuth = scenes_random_between(&random, 0, 2 * M_PI);
        random_direction(&random, at->a);
        at->a[2] = fmaxf(fabsf(at->a[2]), 1e-3f);
        at->b[0] = (float)(steepness * cos(azimuth));
        at->b[1] = (float)(steepness * sin(azimuth));
    }
}

static void widen(const float from[], double *to, int count) {
    for (int i = 0; i < count; i++)
        to[i] = from[i];
}

static void check_shares(const harness_arguments *at, const harness_result *result) {
    double slope[2], direction[3], shares[2];
    widen(at->b, slope, 2);
    widen(at->a, direction, 3);
    reference_facet_shares(slope, direction, shares);
    // Heights are differences of up to |s| + 1, over at least the direction's height.
    const double rounding = 8 * FLOAT_ROUNDING * (1 + hypot(slope[0], slope[1])) / direction[2];
    check_close("facet_pair_shares", at, result->value[0], shares[MAPPED_FACET], rounding);
    check_close("facet_pair_shares", at, result->value[1], shares[UPRIGHT_FACET], rounding);
    check_close("facet_pair_masking", at, result->value[2],
                reference_facet_masking(slope, direction), rounding);
    check_relative("facet_pair_exchange", at, result->value[3], reference_facet_exchange(slope),
                   1e-6);
}

static void test_shares(void **state) {
    make_arguments(91);
    harness_evaluate(state, shader, SHARES, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_shares(&arguments[i], &results[i]);
    report_worst_error("facet_pair_shares, _masking, _exchange");
}

/// Directions from below the surface leave only by the other facet.
static void test_light_from_below_is_masked(void **state) {
    make_arguments(92);
    for (size_t i = 0; i < COUNT; i++)
        arguments[i].a[2] *= -1;
    harness_evaluate(state, shader, SHARES, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(results[i].value[2] == 0);
}

static void test_gain(void **state) {
    make_arguments(93);
    for (size_t i = 0; i < COUNT; i++) {
        const double slope[2] = {arguments[i].b[0], arguments[i].b[1]};
        arguments[i].c[0] = (float)(i % 11) / 10;
        arguments[i].c[1] = (float)(reference_facet_exchange(slope) * (double)arguments[i].c[0]);
    }
    harness_evaluate(state, shader, GAIN, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const double slope[2] = {at->b[0], at->b[1]};
        check_relative("facet_pair_gain", at, results[i].value[0],
                       reference_facet_gain(slope, at->c[0], at->c[1]), 2e-5);
    }
    report_worst_error("facet_pair_gain");
}

// ---------------------------------------------------------------------------------------------
// Microfacets

/// Two directions at right angles to a normal and to each other.
static void complete_frame(double frame[3][3]) {
    const double *normal = frame[2];
    const double across[3] = {normal[1], -normal[0], 0};
    for (int i = 0; i < 3; i++)
        frame[0][i] = across[i];
    reference_normalise(frame[0]);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        frame[1][i] = normal[j] * frame[0][k] - normal[k] * frame[0][j];
    }
}

/// By half vectors of equal parts of GGX (Walter et al. 2007, Eqs. 35 and 36): a part reflects
/// G2 <o, h> / (<n, o> <n, h>), and this sends what it reflects to the upright facet.
static double exact_exchange(const double slope[2], const double outgoing[3], double alpha) {
    enum { ROWS = 64, COLUMNS = 64 };
    double frame[3][3], sum = 0, weights = 1e-12;
    reference_normal_of_slope(slope, frame[2]);
    complete_frame(frame);
    const double cosine = reference_dot(frame[2], outgoing);
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        double u = (i / COLUMNS + 0.5) / ROWS, azimuth = 2 * M_PI * (i % COLUMNS + 0.5) / COLUMNS;
        double tangent = alpha * sqrt(u / (1 - u)), height = 1 / sqrt(1 + tangent * tangent);
        double half_vector[3], incoming[3];
        for (int j = 0; j < 3; j++)
            half_vector[j] =
                height *
                (tangent * (cos(azimuth) * frame[0][j] + sin(azimuth) * frame[1][j]) + frame[2][j]);
        double product = reference_dot(half_vector, outgoing);
        for (int j = 0; j < 3; j++)
            incoming[j] = 2 * product * half_vector[j] - outgoing[j];
        double reflected = reference_dot(frame[2], incoming);
        if (product <= 0 || reflected <= 0)
            continue;
        double weight =
            reference_masking_shadowing(LOBE_DISTRIBUTION_GGX, reflected, cosine, alpha) * product /
            height;
        sum += weight * (1 - reference_facet_masking(slope, incoming));
        weights += weight;
    }
    return sum / weights;
}

enum { MICROFACET_COUNT = 600 };

/// The error matters as much as the share of the ray that meets the mapped facet.
static void test_exchange_of_microfacets(void **state) {
    make_arguments(94);
    double mean = 0;
    for (size_t i = 0; i < MICROFACET_COUNT; i++) {
        arguments[i] = arguments[i * (COUNT / MICROFACET_COUNT)];
        arguments[i].c[0] = (float)geometric(0.01, 1, (i * 7) % MICROFACET_COUNT, MICROFACET_COUNT);
    }
    harness_evaluate(state, shader, MICROFACETS, arguments, MICROFACET_COUNT, results);
    for (size_t i = 0; i < MICROFACET_COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double slope[2], direction[3], shares[2];
        widen(at->b, slope, 2);
        widen(at->a, direction, 3);
        reference_facet_shares(slope, direction, shares);
        if (shares[MAPPED_FACET] < 1e-3)
            continue;
        double error = shares[MAPPED_FACET] *
                       (results[i].value[0] - exact_exchange(slope, direction, at->c[0]));
        check_close("facet_pair_exchange_of_microfacets", at, error, 0, 0.08);
        mean += fabs(error) / MICROFACET_COUNT;
    }
    report_worst_error("facet_pair_exchange_of_microfacets");
    assert_true(mean < 0.006);
}

/// The mean over a surface lit from everywhere.
static double exact_mean_exchange(const double slope[2], double alpha) {
    enum { RINGS = 6, AZIMUTHS = 8 };
    double sum = 0, weights = 0;
    for (int i = 0; i < RINGS * AZIMUTHS; i++) {
        double height = sqrt((i / AZIMUTHS + 0.5) / RINGS), sine = sqrt(1 - height * height);
        double azimuth = 2 * M_PI * (i % AZIMUTHS + 0.5) / AZIMUTHS, shares[2];
        const double direction[3] = {sine * cos(azimuth), sine * sin(azimuth), height};
        reference_facet_shares(slope, direction, shares);
        if (shares[MAPPED_FACET] > 0)
            sum += shares[MAPPED_FACET] * exact_exchange(slope, direction, alpha);
        weights += shares[MAPPED_FACET];
    }
    return sum / weights;
}

static void test_mean_exchange_of_microfacets(void **state) {
    static const float slopes[] = {0.1f, 0.3f, 0.6f, 1, 1.6f}, alphas[] = {0.01f, 0.25f, 0.6f, 1};
    enum { CASES = 20 };
    for (int i = 0; i < CASES; i++) {
        arguments[i] =
            (harness_arguments){.a = {0, 0, 1}, .b = {slopes[i % 5]}, .c = {alphas[i / 5]}};
    }
    harness_evaluate(state, shader, MICROFACETS, arguments, CASES, results);
    for (int i = 0; i < CASES; i++) {
        const double slope[2] = {arguments[i].b[0], 0};
        check_close("facet_pair_mean_exchange_of_microfacets", &arguments[i], results[i].value[1],
                    exact_mean_exchange(slope, arguments[i].c[0]), 0.03);
    }
    report_worst_error("facet_pair_mean_exchange_of_microfacets");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares),
        cmocka_unit_test(test_light_from_below_is_masked),
        cmocka_unit_test(test_gain),
        cmocka_unit_test(test_exchange_of_microfacets),
        cmocka_unit_test(test_mean_exchange_of_microfacets),
    };
    return cmocka_run_group_tests_name("facet_pair", tests, harness_set_up, harness_tear_down);
}
