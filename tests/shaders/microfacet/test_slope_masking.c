// shaders/lib/microfacet/slope_masking.glsl against MPFR, and its double-precision twin; and what
// the specular model without shadowing and Fresnel comes to over all lights.

#include <assert.h>
#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/microfacet/slope_distribution.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/slope_masking.comp";
enum { MASKING, SPECULAR };

enum { COUNT = 8000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static reference_slopes slopes_of(const harness_arguments *at) {
    return (reference_slopes){{at->b[0], at->b[1]}, {at->c[0], at->c[1], at->c[2]}};
}

/// The outgoing direction, and the incoming one in the elements that are left.
static void directions_of(const harness_arguments *at, double outgoing[3], double incoming[3]) {
    for (int i = 0; i < 3; i++)
        outgoing[i] = at->a[i];
    incoming[0] = at->a[3];
    incoming[1] = at->b[2];
    incoming[2] = at->b[3];
}

static void upper_direction(uint64_t *random, float direction[3]) {
    random_direction(random, direction);
    direction[2] = fabsf(direction[2]);
}

/// Means up to 1.5, standard deviations from 1e-2 to 2, correlations up to 0.95; every ninth
/// direction straight up.
static void make_arguments(uint64_t random) {
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double length = i % 5 ? scenes_random_between(&random, 0, 1.5) : 0;
        double azimuth = scenes_random_between(&random, 0, 2 * M_PI);
        double sigma[2] = {geometric(1e-2, 2, i, COUNT),
                           geometric(1e-2, 2, (i * 31) % COUNT, COUNT)};
        double correlation = i % 3 ? scenes_random_between(&random, -0.95, 0.95) : 0;
        float incoming[3];
        upper_direction(&random, at->a);
        upper_direction(&random, incoming);
        if (i % 9 == 0) {
            at->a[0] = at->a[1] = 0;
            at->a[2] = 1;
        }
        at->a[3] = incoming[0];
        at->b[2] = incoming[1];
        at->b[3] = incoming[2];
        at->b[0] = (float)(length * cos(azimuth));
        at->b[1] = (float)(length * sin(azimuth));
        at->c[0] = (float)(sigma[0] * sigma[0]);
        at->c[1] = (float)(sigma[1] * sigma[1]);
        at->c[2] = (float)(correlation * sigma[0] * sigma[1]);
    }
}

/// nu of the direction, and Lambda by its definition.
static real exact_lambda(const harness_arguments *at, double *nu) {
    real x = real_from(at->a[0]), y = real_from(at->a[1]);
    real mean = add(multiply(x, real_from(at->b[0])), multiply(y, real_from(at->b[1])));
    real variance =
        add(multiply(real_from(at->c[0]), square(x)), multiply(real_from(at->c[1]), square(y)));
    variance = add(variance, multiply(multiply(real_from(2), real_from(at->c[2])), multiply(x, y)));
    if (compare(variance, real_from(0)) == 0) {
        *nu = 1e3; // straight up: nothing is masked
        return real_from(0);
    }
    real a =
        divide(subtract(real_from(at->a[2]), mean), square_root(multiply(real_from(2), variance)));
    *nu = to_double(a);
    if (*nu <= 0)
        return real_from(0);
    real gauss = divide(exponential(negate(square(a))), multiply(a, square_root(real_pi())));
    return multiply(real_from(0.5), subtract(gauss, complementary_error_function(a)));
}

static void check_lambda(const harness_arguments *at, const harness_result *result) {
    release_reals();
    double nu, lambda = to_double(exact_lambda(at, &nu));
    if (nu <= 0) {
        assert_true(result->value[1] <= 1e-6 && result->value[2] == 0);
        return;
    }
    double outgoing[3], incoming[3];
    directions_of(at, outgoing, incoming);
    // What nu loses by the difference in it, and by correlation: 1/nu and 2 nu times in Lambda.
    double correlation = at->c[2] * at->c[2] / ((double)at->c[0] * at->c[1]);
    double height = outgoing[2] - at->b[0] * outgoing[0] - at->b[1] * outgoing[1];
    double relative = (4 + 8 / fmax(height, 1e-9) + 4 / (1 - correlation)) * FLOAT_ROUNDING;
    double bound = (9e-6 + (1 + 2 * nu * nu) * relative) * lambda + 1e-17;
    check_close("lambda_of_slopes", at, result->value[0], lambda, bound);
    reference_slopes slopes = slopes_of(at);
    check_close("reference_slope_lambda", at, reference_slope_lambda(&slopes, outgoing), lambda,
                (1e-9 + 1e-14 / height) * lambda + 1e-14);
    double seen = reference_slope_masking_shadowing(&slopes, incoming, outgoing);
    check_close("masking_shadowing_of_slopes", at, result->value[2], seen,
                1e-5 + (1 + 2 * nu * nu) * relative);
}

static void test_masking(void **state) {
    make_arguments(81);
    harness_evaluate(state, shader, MASKING, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_lambda(&arguments[i], &results[i]);
    report_worst_error("lambda_of_slopes, masking_shadowing_of_slopes");
}

/// Centred and isotropic: that of the Beckmann distribution of alpha^2 = 2 sigma^2.
static void test_beckmann(void **state) {
    make_arguments(82);
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].b[0] = arguments[i].b[1] = arguments[i].c[2] = 0;
        arguments[i].c[1] = arguments[i].c[0];
    }
    harness_evaluate(state, shader, MASKING, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double outgoing[3], incoming[3];
        directions_of(&arguments[i], outgoing, incoming);
        double expected =
            reference_masking_shadowing(LOBE_DISTRIBUTION_BECKMANN, incoming[2], outgoing[2],
                                        sqrt(2 * (double)arguments[i].c[0]));
        check_close("Beckmann", &arguments[i], results[i].value[2], expected, 2e-5);
    }
}

enum { PANELS = 6, RINGS = PANELS * QUADRATURE_ORDER, AZIMUTHS = 108 };

/// The outgoing direction and the moments of one surface, seen from above its mean plane.
static void random_surface(uint64_t *random, double outgoing[3], reference_slopes *slopes) {
    double height = 0;
    while (height < 0.05) {
        double sigma_x = scenes_random_between(random, 0.02, 0.8);
        double sigma_y = scenes_random_between(random, 0.02, 0.8);
        float direction[3];
        upper_direction(random, direction);
        for (int i = 0; i < 3; i++)
            outgoing[i] = direction[i];
        for (int i = 0; i < 2; i++)
            slopes->mean[i] = scenes_random_between(random, -0.8, 0.8);
        slopes->covariance[0] = sigma_x * sigma_x;
        slopes->covariance[1] = sigma_y * sigma_y;
        slopes->covariance[2] = scenes_random_between(random, -0.9, 0.9) * sigma_x * sigma_y;
        height = outgoing[2] - slopes->mean[0] * outgoing[0] - slopes->mean[1] * outgoing[1];
    }
}

/// Lights are the reflections about normals n = n(s): d(incoming) = 4 <o, n> n_z^3 ds. Returns the
/// weight of the light in element i, or 0 where the normal faces away.
static double place_light(int i, const quadrature_node *ring, const reference_slopes *slopes,
                          const double outgoing[3]) {
    double root_x = sqrt(slopes->covariance[0]), shear = slopes->covariance[2] / root_x;
    double root_y = sqrt(slopes->covariance[1] - shear * shear);
    double azimuth = 2 * M_PI * (i % AZIMUTHS) / AZIMUTHS, normal[3], incoming[3];
    double x = ring->x * cos(azimuth), y = ring->x * sin(azimuth);
    const double slope[2] = {slopes->mean[0] + root_x * x,
                             slopes->mean[1] + shear * x + root_y * y};
    reference_normal_of_slope(slope, normal);
    double cosine = reference_dot(outgoing, normal);
    for (int j = 0; j < 3; j++) {
        incoming[j] = 2 * cosine * normal[j] - outgoing[j];
        arguments[i].a[j] = (float)outgoing[j];
        arguments[i].c[j] = (float)slopes->covariance[j];
    }
    arguments[i].a[3] = (float)incoming[0];
    arguments[i].b[0] = (float)slopes->mean[0];
    arguments[i].b[1] = (float)slopes->mean[1];
    arguments[i].b[2] = (float)incoming[1];
    arguments[i].b[3] = (float)incoming[2];
    double area = ring->weight * ring->x * root_x * root_y * 2 * M_PI / AZIMUTHS;
    return cosine > 1e-4 ? area * 4 * cosine * pow(normal[2], 3) : 0;
}

/// Dupuy et al. 2013, section 4.4: over all lights, the specular model without shadowing and
/// Fresnel is one, for any view, mean and covariance.
static void test_specular_integral(void **state) {
    static_assert(RINGS * AZIMUTHS <= COUNT, "all lights fit");
    static double weights[RINGS * AZIMUTHS];
    uint64_t random = 83;
    for (int surface = 0; surface < 30; surface++) {
        quadrature_node radii[RINGS];
        reference_slopes slopes;
        double outgoing[3], sum = 0, twin = 0;
        geometric_quadrature(0.5, 6.5, PANELS, radii);
        random_surface(&random, outgoing, &slopes);
        for (int i = 0; i < RINGS * AZIMUTHS; i++)
            weights[i] = place_light(i, &radii[i / AZIMUTHS], &slopes, outgoing);
        harness_evaluate(state, shader, SPECULAR, arguments, (size_t)RINGS * AZIMUTHS, results);
        double masked = 1 + reference_slope_lambda(&slopes, outgoing);
        double height = outgoing[2] - slopes.mean[0] * outgoing[0] - slopes.mean[1] * outgoing[1];
        for (int i = 0; i < RINGS * AZIMUTHS; i++) {
            double from[3], incoming[3], half_vector[3];
            directions_of(&arguments[i], from, incoming);
            if (weights[i] == 0)
                continue;
            for (int j = 0; j < 3; j++)
                half_vector[j] = from[j] + incoming[j];
            reference_normalise(half_vector);
            double value =
                reference_distribution_of_slopes(&slopes, half_vector) / (4 * height * masked);
            sum += weights[i] * results[i].value[0];
            twin += weights[i] * value;
        }
        if (!(fabs(sum - 1) < 1e-3 && fabs(twin - 1) < 1e-3))
            fail_msg("surface %d: %.6g on the device, %.6g in double precision", surface, sum,
                     twin);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_masking),
        cmocka_unit_test(test_beckmann),
        cmocka_unit_test(test_specular_integral),
    };
    return cmocka_run_group_tests_name("slope_masking", tests, harness_set_up, harness_tear_down);
}
