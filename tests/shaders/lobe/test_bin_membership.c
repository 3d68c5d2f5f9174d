// shaders/lib/lobe/bin_membership.glsl: parts that add up to one, and chances against MPFR.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/mixture/moment_bins.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/bin_membership.comp";
enum { LIKELIHOOD, QUARTERS, CAP };

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Places up to two widths from the middle, and on the edges of hats.
static void make_places(void) {
    uint64_t random = 94;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        at->a[2] = (float)geometric(0.1, 1e4, i, COUNT);
        for (int j = 0; j < 2; j++) {
            double widths = scenes_random_between(&random, -2, 2);
            if (i % 7 == (size_t)j)
                widths = round(2 * widths) / 2;
            at->a[j] = (float)(widths / (double)at->a[2]);
        }
    }
}

static void test_quarters(void **state) {
    make_places();
    harness_evaluate(state, shader, QUARTERS, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double x = (double)at->a[0] * (double)at->a[2], y = (double)at->a[1] * (double)at->a[2];
        double sum = 0;
        for (int j = 0; j < 4; j++) {
            double expected = reference_hat(j % 2 ? -x : x) * reference_hat(j / 2 ? -y : y);
            check_close("quarter", at, results[i].value[j], expected, 4 * FLOAT_ROUNDING);
            assert_true(results[i].value[j] >= 0);
            sum += (double)results[i].value[j];
        }
        check_close("sum of quarters", at, sum, 1, 4 * FLOAT_ROUNDING);
    }
    report_worst_error("quarter");
}

static void test_cap(void **state) {
    make_places();
    harness_evaluate(state, shader, CAP, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *value = results[i].value;
        const double widths[2] = {(double)at->a[0] * (double)at->a[2],
                                  (double)at->a[1] * (double)at->a[2]};
        check_close("cap", at, value[0], reference_cap(widths), 8 * FLOAT_ROUNDING);
        check_close("hats", at, (double)value[1] + (double)value[2], 1, 2 * FLOAT_ROUNDING);
        assert_true(value[0] >= 0 && value[0] <= 1);
    }
    report_worst_error("cap");
}

/// Vasconcelos, Lippman 1998, Eq. 8, of a component of weight w: log w and for each point the
/// logarithms of N(place; mean, C) and of exp(-trace(C^-1) v / 2), without the constant 2 pi.
static real exact_likelihood(const double mean[2], const double covariance[3], double weight,
                             double points, const double place[2], double variance) {
    real xx = real_from(covariance[0]), yy = real_from(covariance[1]);
    real xy = real_from(covariance[2]);
    real x = subtract(real_from(place[0]), real_from(mean[0]));
    real y = subtract(real_from(place[1]), real_from(mean[1]));
    real determinant = subtract(multiply(xx, yy), square(xy));
    real form = add(multiply(yy, square(x)), multiply(xx, square(y)));
    form = subtract(form, multiply(real_from(2), multiply(xy, multiply(x, y))));
    real trace = multiply(real_from(variance), add(xx, yy));
    real sum = add(logarithm(determinant), divide(add(form, trace), determinant));
    return subtract(logarithm(real_from(weight)), multiply(real_from(0.5 * points), sum));
}

static struct moment_bin packed(const double mean[2], const double covariance[3], double weight,
                                double points) {
    double determinant = covariance[0] * covariance[1] - covariance[2] * covariance[2];
    double half = 0.5 * points;
    return (struct moment_bin){
        .centre = {(float)mean[0], (float)mean[1], (float)(log(weight) - half * log(determinant)),
                   (float)(half * (covariance[0] + covariance[1]) / determinant)},
        .shape = {(float)(half * covariance[1] / determinant),
                  (float)(half * covariance[0] / determinant),
                  (float)(-half * covariance[2] / determinant)}};
}

static double expected_likelihoods[COUNT], sizes[COUNT];

static void make_bins(void) {
    uint64_t random = 95;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double sigma = geometric(3e-2, 1, i, COUNT),
               other = sigma * scenes_random_between(&random, 0.3, 1);
        double mean[2], place[2], variance = geometric(1e-6, 1, (i * 17) % COUNT, COUNT);
        const double covariance[3] = {sigma * sigma, other * other,
                                      scenes_random_between(&random, -0.8, 0.8) * sigma * other};
        double weight = scenes_random_between(&random, 0.01, 1), points = i % 2 ? 10 : 1.5;
        for (int j = 0; j < 2; j++) {
            mean[j] = (float)scenes_random_between(&random, -1, 1);
            place[j] = (float)(mean[j] + scenes_random_between(&random, -3, 3) * sigma);
            at->a[j] = (float)place[j];
        }
        at->a[2] = (float)variance;
        struct moment_bin bin = packed(mean, covariance, weight, points);
        for (int j = 0; j < 4; j++) {
            at->b[j] = bin.centre[j];
            at->c[j] = bin.shape[j];
        }
        release_reals();
        expected_likelihoods[i] =
            to_double(exact_likelihood(mean, covariance, weight, points, place, (double)at->a[2]));
        double x = place[0] - mean[0], y = place[1] - mean[1];
        sizes[i] = fabs((double)bin.centre[2]) + (double)bin.centre[3] * variance +
                   (double)bin.shape[0] * x * x + (double)bin.shape[1] * y * y +
                   2 * fabs((double)bin.shape[2] * x * y);
        check_close("reference_bin_likelihood", at, reference_bin_likelihood(&bin, place, variance),
                    expected_likelihoods[i], 4 * FLOAT_ROUNDING * sizes[i]);
    }
}

static void test_likelihood(void **state) {
    make_bins();
    harness_evaluate(state, shader, LIKELIHOOD, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_close("bin_likelihood", &arguments[i], results[i].value[0], expected_likelihoods[i],
                    8 * FLOAT_ROUNDING * sizes[i]);
    report_worst_error("bin_likelihood");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quarters),
        cmocka_unit_test(test_cap),
        cmocka_unit_test(test_likelihood),
    };
    return cmocka_run_group_tests_name("bin_membership", tests, harness_set_up, harness_tear_down);
}
