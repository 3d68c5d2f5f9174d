// shaders/lib/microfacet/reflection_lobe.glsl: the mean direction that reflected light comes from,
// against brute force in double precision; and limits.

#include <math.h>
#include <stdint.h>

#include <lobe/scene.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/microfacet/directional_albedo.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/reflection_lobe.comp";
enum { F0, F90, MIXED, COMPLETED };
enum { ANGLE, ALONG, ACROSS, SHARE };

static const double cosines[] = {1, 0.95, 0.8, 0.6, 0.45, 0.3};
static const double roughnesses[] = {0.15, 0.3, 0.45, 0.6, 0.8, 1};
enum { COSINES = sizeof cosines / sizeof *cosines };
enum { ROUGHNESSES = sizeof roughnesses / sizeof *roughnesses, COUNT = COSINES * ROUGHNESSES };

static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void evaluate(void **state, uint32_t function, bool ggx) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){
            {ggx, (float)cosines[i % COSINES], (float)roughnesses[i / COSINES], 0}, {0}, {0}};
    harness_evaluate(state, shader, function, arguments, COUNT, results);
}

/// 1 - R of a lobe proportional to GGX's D(theta/2), alpha^2 = 1/(2 kappa): the integral over
/// x = 1 - cos of x (1 + b x)^-2 / of (1 + b x)^-2, b = kappa - 1/2.
static double complement_of_ggx(double concentration) {
    double b = fmax(concentration - 0.5, 1e-3);
    return ((1 + 2 * b) * log1p(2 * b) - 2 * b) / (2 * b * b);
}

/// The length of the mean direction of a lobe as the environment is read: two round lobes where it
/// is long, GGX's where it is narrow (shaders/environment/environment.glsl).
static double resultant(bool ggx, const float lobe[4]) {
    double major = pow((double)lobe[ALONG], 2), minor = pow((double)lobe[ACROSS], 2);
    bool two = ceil(3 * major / minor - 4.5) > 1;
    double variance = two ? fmax(minor, major / 2) : sqrt(major * minor);
    double apart = two ? sqrt(fmax(major - variance, 0)) : 0;
    double alpha = sqrt(variance / 2), t = fmin(fmax((alpha - 0.1) / 0.07, 0), 1);
    double tails = ggx ? 1 - t * t * (3 - 2 * t) : 0;
    double round = tails * (1 - complement_of_ggx(1 / variance)) +
                   (1 - tails) * reference_mean_resultant_length(1 / variance);
    return round / sqrt(1 + apart * apart);
}

static void check_directions(lobe_distribution distribution, int part, double tolerance) {
    bool ggx = distribution == LOBE_DISTRIBUTION_GGX;
    double squares = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const float *lobe = results[i].value;
        double exact[2][2], share = lobe[SHARE], length = (1 - share) * resultant(ggx, lobe);
        reference_specular_directions(distribution, cosines[i % COSINES], roughnesses[i / COSINES],
                                      exact);
        // A Lambert surface gathers light from two thirds of the normal.
        double tangential = length * sin((double)lobe[ANGLE]) - exact[part][0];
        double normal = length * cos((double)lobe[ANGLE]) + share * 2 / 3 - exact[part][1];
        double error = hypot(tangential, normal);
        squares += error * error;
        check_close("mean direction", &arguments[i], error, 0, tolerance);
    }
    print_message("# distribution %d, part %d: root mean square %.4f\n", (int)distribution, part,
                  sqrt(squares / COUNT));
}

static void light_comes_from_where_it_should(void **state) {
    evaluate(state, F0, true);
    check_directions(LOBE_DISTRIBUTION_GGX, 0, 0.07);
    evaluate(state, F0, false);
    check_directions(LOBE_DISTRIBUTION_BECKMANN, 0, 0.06);
}

/// Fresnel's part matters at grazing angles, and there it is far from the mirror.
static void grazing_light_comes_from_near_the_horizon(void **state) {
    evaluate(state, F90, true);
    for (size_t i = 0; i < COUNT; i++) {
        double exact[2][2], angle = results[i].value[ANGLE];
        if (cosines[i % COSINES] > 0.6 || roughnesses[i / COSINES] < 0.2)
            continue;
        reference_specular_directions(LOBE_DISTRIBUTION_GGX, cosines[i % COSINES],
                                      roughnesses[i / COSINES], exact);
        check_close("angle", &arguments[i], angle, atan2(exact[1][0], exact[1][1]), 0.12);
    }
}

/// Smooth surfaces are mirrors: to first order, directions spread twice as far as half vectors in
/// the plane of reflection.
static void narrow_lobes_are_about_the_mirror(void **state) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){
            {(float)(i % 2), (float)(0.3 + 0.7 * (double)i / (COUNT - 1)), 0.05f, 0}, {0}, {0}};
    harness_evaluate(state, shader, F0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *lobe = results[i].value;
        double cosine = arguments[i].a[1];
        check_close("angle", &arguments[i], lobe[ANGLE], acos(fmin(cosine, 1)), 3e-3);
        check_close("share", &arguments[i], lobe[SHARE], 0, 1e-3);
        assert_true(lobe[ACROSS] <= lobe[ALONG] && (double)lobe[ALONG] < 0.0025 * 2);
        assert_true((double)lobe[ACROSS] >= 0.5 * cosine * (double)lobe[ALONG]);
    }
}

static void mixtures_keep_mean_and_variance(void **state) {
    uint64_t random = 61;
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].c[0] = (float)random_number(&random);
        for (int k = 0; k < 4; k++) {
            arguments[i].a[k] = (float)scenes_random_between(&random, 0.1, 1);
            arguments[i].b[k] = (float)scenes_random_between(&random, 0.1, 1);
        }
    }
    harness_evaluate(state, shader, MIXED, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a, *b = arguments[i].b, *found = results[i].value;
        double share = arguments[i].c[0], rest = 1 - share;
        double mean = rest * (double)a[0] + share * (double)b[0];
        double square =
            rest * (pow(a[0], 2) + pow(a[1], 2)) + share * (pow(b[0], 2) + pow(b[1], 2));
        check_close("mean", &arguments[i], found[ANGLE], mean, 1e-6);
        check_close("variance", &arguments[i], pow(found[ALONG], 2), square - mean * mean, 2e-6);
        check_close("share", &arguments[i], found[SHARE], a[3], 0);
    }
}

/// Towards the horizon only where surfaces are not seen from above.
static void completed_lobes_are_narrower_and_lower(void **state) {
    uint64_t random = 67;
    for (size_t i = 0; i < COUNT; i++) {
        for (int k = 0; k < 4; k++)
            arguments[i].a[k] = (float)scenes_random_between(&random, 0.1, 1.2);
        arguments[i].b[0] = (float)cosines[i % COSINES];
        arguments[i].b[1] = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.5f : 1;
    }
    harness_evaluate(state, shader, COMPLETED, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *lobe = arguments[i].a, *found = results[i].value;
        double part = arguments[i].b[1];
        double sine = sqrt(1 - pow(arguments[i].b[0], 2));
        check_close("angle", &arguments[i], found[ANGLE],
                    fmin((double)lobe[ANGLE] + 0.16 * part * sine, 1.5), 1e-5);
        check_close("along", &arguments[i], found[ALONG], (double)lobe[ALONG] * (1 - 0.3 * part),
                    1e-6);
        check_close("across", &arguments[i], found[ACROSS], (double)lobe[ACROSS] * (1 - 0.3 * part),
                    1e-6);
        check_close("share", &arguments[i], found[SHARE], lobe[SHARE], 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_comes_from_where_it_should),
        cmocka_unit_test(grazing_light_comes_from_near_the_horizon),
        cmocka_unit_test(narrow_lobes_are_about_the_mirror),
        cmocka_unit_test(mixtures_keep_mean_and_variance),
        cmocka_unit_test(completed_lobes_are_narrower_and_lower),
    };
    return cmocka_run_group_tests_name("reflection_lobe", tests, harness_set_up, harness_tear_down);
}
