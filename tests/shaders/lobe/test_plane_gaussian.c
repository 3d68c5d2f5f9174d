// shaders/lib/lobe/plane_gaussian.glsl against MPFR, and its integral.

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/plane_gaussian.comp";
enum { MAKE, EVALUATE, COVARIANCE };

enum { COUNT = 8000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Standard deviations from 2e-3 to 2, correlations up to 0.95; distances within four of them.
static void make_arguments(void) {
    uint64_t random = 93;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double sigma[2] = {geometric(2e-3, 2, i, COUNT),
                           geometric(2e-3, 2, (i * 31) % COUNT, COUNT)};
        double correlation = i % 3 ? scenes_random_between(&random, -0.95, 0.95) : 0;
        at->a[0] = (float)(sigma[0] * sigma[0]);
        at->a[1] = (float)(sigma[1] * sigma[1]);
        at->a[2] = (float)(correlation * sigma[0] * sigma[1]);
        at->a[3] = (float)scenes_random_between(&random, 0.1, 3);
        for (int j = 0; j < 2; j++)
            at->b[j] = (float)(scenes_random_between(&random, -3, 3) * sigma[j]);
    }
}

static double rest_of_correlation(const harness_arguments *at) {
    return 1 - (double)at->a[2] * (double)at->a[2] / ((double)at->a[0] * (double)at->a[1]);
}

static void test_value(void **state) {
    make_arguments();
    harness_evaluate(state, shader, EVALUATE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        release_reals();
        real xx = real_from(at->a[0]), yy = real_from(at->a[1]), xy = real_from(at->a[2]);
        real x = real_from(at->b[0]), y = real_from(at->b[1]);
        real determinant = subtract(multiply(xx, yy), square(xy));
        real form = add(multiply(yy, square(x)), multiply(xx, square(y)));
        form = subtract(form, multiply(real_from(2), multiply(xy, multiply(x, y))));
        form = divide(form, determinant);
        real value = exponential(multiply(real_from(-0.5), form));
        value = divide(multiply(real_from(at->a[3]), value),
                       multiply(multiply(real_from(2), real_pi()), square_root(determinant)));
        double rest = rest_of_correlation(at);
        double bound = (16 + 16 * to_double(form) / rest) / rest * FLOAT_ROUNDING;
        check_relative("evaluate_plane_gaussian", at, results[i].value[0], to_double(value), bound);
    }
    report_worst_error("evaluate_plane_gaussian");
}

/// Panels on each side of the middle, each way; QUADRATURE_ORDER nodes a panel.
enum { PANELS = 3, NODES = 2 * PANELS * QUADRATURE_ORDER };
static harness_arguments grid[NODES * NODES];
static harness_result values[NODES * NODES];

/// Over nine standard deviations each way the integral is the mass.
static void check_integral(void **state, const float covariance[3], float mass) {
    quadrature_node nodes[NODES];
    for (int i = 0; i < 2 * PANELS; i++)
        gauss_legendre(-9 + 3 * i, -6 + 3 * i, nodes + i * QUADRATURE_ORDER);
    double sigma[2] = {sqrt((double)covariance[0]), sqrt((double)covariance[1])}, sum = 0;
    for (int i = 0; i < NODES * NODES; i++) {
        memcpy(grid[i].a, covariance, 3 * sizeof *covariance);
        grid[i].a[3] = mass;
        grid[i].b[0] = (float)(nodes[i % NODES].x * sigma[0]);
        grid[i].b[1] = (float)(nodes[i / NODES].x * sigma[1]);
    }
    harness_evaluate(state, shader, EVALUATE, grid, NODES * NODES, values);
    for (int i = 0; i < NODES * NODES; i++)
        sum += (double)values[i].value[0] * nodes[i % NODES].weight * nodes[i / NODES].weight;
    check_relative("integral", &grid[0], sum * sigma[0] * sigma[1], mass, 1e-5);
}

static void test_integral(void **state) {
    static const float covariances[][3] = {
        {1, 1, 0}, {1e-6f, 1e-6f, 0}, {0.25f, 1e-4f, 0}, {0.5f, 0.2f, 0.2f}, {4, 1e-3f, -0.05f}};
    for (size_t i = 0; i < sizeof covariances / sizeof *covariances; i++)
        check_integral(state, covariances[i], 1 + 0.5f * (float)i);
}

/// Lines, points and what rounding makes of covariances: finite at any distance.
static void test_degenerate(void **state) {
    static const float covariances[6][3] = {
        {0, 0, 0},      {0, 0, 1e-9f},         {1, 0, 1e-7f},
        {0, 1, -1e-7f}, {0.25f, 0.25f, 0.25f}, {1e-6f, 1e-6f, 1.1e-6f}};
    make_arguments();
    for (size_t i = 0; i < COUNT; i++) {
        memcpy(arguments[i].a, covariances[i % 6], sizeof covariances[0]);
        arguments[i].b[0] *= i % 4 ? 1 : 0;
        arguments[i].b[1] *= i % 4 ? 1 : 0;
    }
    harness_evaluate(state, shader, MAKE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        for (int j = 0; j < 4; j++)
            assert_true(isfinite(results[i].value[j]));
}

/// Second moments less squared means: of no negative variance, no correlation above one.
static void test_covariance(void **state) {
    make_arguments();
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        // Every other one has rounding alone for its covariance, every fifth too much of it.
        double part = i % 2 ? 1 : 0, x = at->b[0], y = at->b[1];
        at->c[0] = (float)(part * (double)at->a[0] + x * x);
        at->c[1] = (float)(part * (double)at->a[1] + y * y);
        at->c[2] = (float)(part * (double)at->a[2] * (i % 5 ? 1 : 30) + x * y);
    }
    harness_evaluate(state, shader, COVARIANCE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *value = results[i].value;
        double x = at->b[0], y = at->b[1];
        double xx = at->c[0] - x * x, yy = at->c[1] - y * y, xy = at->c[2] - x * y;
        check_close("xx", at, value[0], fmax(xx, 0), 4 * FLOAT_ROUNDING * at->c[0]);
        check_close("yy", at, value[1], fmax(yy, 0), 4 * FLOAT_ROUNDING * at->c[1]);
        double limit = sqrt((double)value[0] * (double)value[1]);
        check_close("xy", at, value[2], fmin(fmax(xy, -limit), limit),
                    8 * FLOAT_ROUNDING * (fabs((double)at->c[2]) + fabs(x * y)) + 1e-30);
        assert_true(value[0] >= 0 && value[1] >= 0 &&
                    fabs((double)value[2]) <= limit * (1 + 8 * FLOAT_ROUNDING));
    }
    report_worst_error("covariance_of");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_value),
        cmocka_unit_test(test_integral),
        cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_covariance),
    };
    return cmocka_run_group_tests_name("plane_gaussian", tests, harness_set_up, harness_tear_down);
}
