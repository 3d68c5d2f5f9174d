// shaders/lib/lobe/von_mises_fisher.glsl against MPFR, and its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/exact.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/von_mises_fisher.comp";
enum { DENSITY, RESULTANT, CONCENTRATION, ROUND_TRIP };

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// kappa from 0 and 1e-8 to 1e6, evenly spaced in its logarithm.
static float concentration_at(size_t i, size_t count) {
    return i == 0 ? 0 : (float)geometric(1e-8, 1e6, i - 1, count - 1);
}

static void check_density(const harness_arguments *at, const harness_result *result) {
    release_reals();
    real exponent = exact_von_mises_fisher_exponent(at->a, at->b, at->c[0]);
    real peak = exact_von_mises_fisher_peak(real_from(at->c[0]));
    double expected = to_double(multiply(peak, exponential(exponent)));
    double x = fabs(to_double(exponent));
    // The exponent x is rounded four times and through the floats' lengths, which are off by up to
    // 1e-7 each; exp(x) is 2^(x log2 e), 3 + 2|x| units in the last place (Vulkan 1.3). So 4e-6
    // while the lobe is above exp(-7) of its peak, and digits are lost only where it is nothing.
    // Where exp(x) is flushed to zero, so is its product with the peak.
    check_close("von_mises_fisher", at, result->value[0], expected,
                (10 + 8 * x) * FLOAT_ROUNDING * expected +
                    2 * FLOAT_SMALLEST * fmax(to_double(peak), 1));
    check_relative("von_mises_fisher_peak", at, result->value[1], to_double(peak),
                   10 * FLOAT_ROUNDING);
}

// At angles within, around and far off the lobe, opposite to the mean included.
static void make_density_arguments(void) {
    uint64_t random = 2;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        at->c[0] = concentration_at(i / 10, COUNT / 10);
        double width = fmin(1 / sqrt(at->c[0]), 1);
        const double angles[10] = {0,         0.01 * width, 0.3 * width, width, 2 * width,
                                   3 * width, 5 * width,    M_PI / 2,    3,     M_PI};
        random_direction(&random, at->b);
        direction_at(at->b, angles[i % 10], scenes_random_between(&random, 0, 6), at->a);
    }
}

static void test_density(void **state) {
    make_density_arguments();
    harness_evaluate(state, shader, DENSITY, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_density(&arguments[i], &results[i]);
    report_worst_error("von_mises_fisher");
}

static void test_opposite_direction(void **state) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] =
            (harness_arguments){{-0.6f, 0, 0.8f}, {0.6f, 0, -0.8f}, {concentration_at(i, COUNT)}};
    harness_evaluate(state, shader, DENSITY, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_density(&arguments[i], &results[i]);
    report_worst_error("von_mises_fisher opposite to the mean");
}

static void make_concentrations(void) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){{concentration_at(i, COUNT)}, {0}, {0}};
}

static void test_resultant(void **state) {
    make_concentrations();
    harness_evaluate(state, shader, RESULTANT, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        real kappa = real_from(arguments[i].a[0]);
        double length = to_double(exact_resultant(kappa));
        double complement = to_double(exact_resultant_complement(kappa));
        // From kappa = 1 on a difference, of 1 and 0.31 at first, with the error of exp.
        check_relative("mean_resultant_length", &arguments[i], results[i].value[0], length, 5e-7);
        check_relative("mean_resultant_complement", &arguments[i], results[i].value[1], complement,
                       5e-7);
    }
    report_worst_error("mean_resultant_length, mean_resultant_complement");
}

// Both arguments of the inverse are given exactly, as floats of the exact numbers.
static void make_resultants(void) {
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        real kappa = real_from(concentration_at(i, COUNT));
        arguments[i] = (harness_arguments){{0}, {0}, {0}};
        arguments[i].a[0] = (float)to_double(exact_resultant(kappa));
        arguments[i].a[1] = (float)to_double(exact_resultant_complement(kappa));
    }
}

static void test_inverse(void **state) {
    make_resultants();
    harness_evaluate(state, shader, CONCENTRATION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double kappa = concentration_at(i, COUNT);
        // The fit's 6.6e-6 and the roundings of its two polynomials.
        check_relative("concentration_from_resultant", &arguments[i], results[i].value[0], kappa,
                       8e-6);
        // With the complement alone, R = 1 - s is rounded to 2^-24; kappa is 3 R there.
        check_close("concentration_from_complement", &arguments[i], results[i].value[1], kappa,
                    8e-6 * kappa + 4 * FLOAT_ROUNDING);
    }
    report_worst_error("concentration_from_resultant, concentration_from_complement");
}

static void test_inverse_out_of_range(void **state) {
    // Rounding may bring 1 - |r| to zero or below, or |r| above one: the sharpest lobe there is.
    const harness_arguments outside[] = {{{1, 0}, {0}, {0}},
                                         {{1.0000001f, -1e-7f}, {0}, {0}},
                                         {{1, 1e-9f}, {0}, {0}},
                                         {{0, 1}, {0}, {0}}};
    const double expected[] = {1e6, 1e6, 1e6, 0};
    harness_result values[4];
    harness_evaluate(state, shader, CONCENTRATION, outside, 4, values);
    for (int i = 0; i < 4; i++) {
        check_relative("concentration_from_resultant", &outside[i], values[i].value[0], expected[i],
                       2e-6);
        check_relative("concentration_from_complement", &outside[i], values[i].value[1],
                       expected[i], 2e-6);
    }
    report_worst_error("concentration of the sharpest lobe");
}

static void test_round_trip(void **state) {
    make_concentrations();
    harness_evaluate(state, shader, ROUND_TRIP, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double kappa = arguments[i].a[0];
        // s is rounded twice near one, where kappa is three times 1 - s.
        check_close("kappa to s to kappa", &arguments[i], results[i].value[0], kappa,
                    9e-6 * kappa + 12 * FLOAT_ROUNDING);
        check_relative("kappa to R and s to kappa", &arguments[i], results[i].value[1], kappa,
                       9e-6);
    }
    report_worst_error("there and back");
}

// With u = 1 - cos(angle), the integral over the sphere is 2 pi times that over u in [0, 2].
static size_t make_sphere(float kappa, const float mean[3], quadrature_node *nodes) {
    enum { PANELS = 24, AZIMUTHS = 6 };
    geometric_quadrature(fmin(0.5 / kappa, 0.5), 2, PANELS, nodes);
    size_t count = 0;
    for (size_t i = 0; i < PANELS * QUADRATURE_ORDER; i++) {
        for (size_t j = 0; j < AZIMUTHS; j++) {
            double angle = 2 * asin(sqrt(nodes[i].x / 2));
            harness_arguments *at = &arguments[count++];
            *at = (harness_arguments){{0}, {mean[0], mean[1], mean[2]}, {kappa}};
            direction_at(mean, angle, 2 * M_PI * ((double)j + 0.3) / AZIMUTHS, at->a);
        }
    }
    return count;
}

static double integrate_over_sphere(void **state, float kappa, const float mean[3]) {
    static quadrature_node nodes[COUNT];
    size_t count = make_sphere(kappa, mean, nodes);
    assert_true(count <= COUNT);
    harness_evaluate(state, shader, DENSITY, arguments, count, results);
    double integral = 0;
    for (size_t i = 0; i < count; i++)
        integral += 2 * M_PI * nodes[i / 6].weight / 6 * results[i].value[0];
    return integral;
}

static void test_integral_over_sphere(void **state) {
    static const float pole[3] = {0, 0, 1}, leaning[3] = {-0.36f, 0.48f, -0.8f};
    for (size_t i = 0; i < 16; i++) {
        float kappa = concentration_at(i, 16);
        const harness_arguments at = {{0}, {0}, {kappa}};
        // Rounding of exp, and of directions where the lobe is not about the pole.
        check_close("integral about the pole", &at, integrate_over_sphere(state, kappa, pole), 1,
                    2e-6);
        double rounding = 1e-6 * sqrt(kappa) + 2e-6;
        check_close("integral", &at, integrate_over_sphere(state, kappa, leaning), 1, rounding);
    }
    report_worst_error("integral over the sphere");
}

static void check_twin_density(const harness_arguments *at) {
    const float *a = at->a, *b = at->b;
    double kappa = at->c[0];
    // Of vectors as they are, not made unit length.
    real_vector u = vector_from(a), v = vector_from(b);
    real_vector d = {subtract(u.x, v.x), subtract(u.y, v.y), subtract(u.z, v.z)};
    real exponent = multiply(real_from(-0.5 * kappa), dot(d, d));
    real expected = multiply(exact_von_mises_fisher_peak(real_from(kappa)), exponential(exponent));
    double actual = reference_von_mises_fisher((double[]){a[0], a[1], a[2]},
                                               (double[]){b[0], b[1], b[2]}, kappa);
    check_relative("reference_von_mises_fisher", at, actual, to_double(expected),
                   1e-15 * (8 + 8 * fabs(to_double(exponent))));
}

static void check_twin_resultant(const harness_arguments *at) {
    double kappa = at->c[0];
    double complement = to_double(exact_resultant_complement(real_from(kappa)));
    check_relative("reference_mean_resultant_complement", at,
                   reference_mean_resultant_complement(kappa), complement, 1e-14);
    check_relative("reference_mean_resultant_length", at, reference_mean_resultant_length(kappa),
                   to_double(exact_resultant(real_from(kappa))), 1e-14);
    check_close("reference_concentration_from_complement", at,
                reference_concentration_from_complement(complement), kappa, 1e-13 * kappa + 1e-15);
}

static void test_twin(void **state) {
    (void)state;
    make_density_arguments();
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        check_twin_density(&arguments[i]);
        check_twin_resultant(&arguments[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_density),
        cmocka_unit_test(test_opposite_direction),
        cmocka_unit_test(test_resultant),
        cmocka_unit_test(test_inverse),
        cmocka_unit_test(test_inverse_out_of_range),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_integral_over_sphere),
        cmocka_unit_test(test_twin),
    };
    return cmocka_run_group_tests_name("von_mises_fisher", tests, harness_set_up,
                                       harness_tear_down);
}
