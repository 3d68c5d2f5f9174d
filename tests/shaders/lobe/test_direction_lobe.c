// shaders/lib/lobe/direction_lobe.glsl against differences of the reflection itself, and integrals
// of normal distributions.

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/direction_lobe.comp";
enum { REFLECTED, PRINCIPAL, ABOVE, NORMAL, MEASURES };

enum { COUNT = 2000 };
static harness_arguments arguments[COUNT];
static harness_result results[3][COUNT];

/// Two vectors perpendicular to a unit axis and to each other, of unit length.
static void frame_of(const float axis[3], double first[3], double second[3]) {
    double n[3] = {axis[0], axis[1], axis[2]}, any[3] = {1, 0, 0};
    if (fabs(n[0]) > 0.5) {
        any[0] = 0;
        any[1] = 1;
    }
    double product = reference_dot(n, any);
    for (int i = 0; i < 3; i++)
        first[i] = any[i] - product * n[i];
    reference_normalise(first);
    for (int i = 0; i < 3; i++)
        second[i] = n[(i + 1) % 3] * first[(i + 2) % 3] - n[(i + 2) % 3] * first[(i + 1) % 3];
}

/// Lobes of any direction, with displacements of up to `largest`, as long as 1 : 30, at any angle
/// to each other.
static void make_lobes(double largest) {
    uint64_t random = 17;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double across[2][3];
        random_direction(&random, at->a);
        frame_of(at->a, across[0], across[1]);
        for (int side = 0; side < 2; side++) {
            double size = largest * pow(30, -random_number(&random));
            double angle = scenes_random_between(&random, 0, 2 * M_PI);
            for (int j = 0; j < 3; j++)
                (side ? at->c : at->b)[j] =
                    (float)(size * (cos(angle) * across[0][j] + sin(angle) * across[1][j]));
        }
        at->a[3] = (float)scenes_random_between(&random, 0, M_PI);
        at->c[3] = (float)scenes_random_between(&random, 0, 2 * M_PI);
    }
}

/// Axis and displacements of the lobes that a function gives.
static void evaluate_lobes(void **state, uint32_t function) {
    for (int member = 0; member < 3; member++) {
        for (size_t i = 0; i < COUNT; i++)
            arguments[i].b[3] = (float)member;
        harness_evaluate(state, shader, function, arguments, COUNT, results[member]);
    }
}

static void outgoing_of(const harness_arguments *at, double outgoing[3]) {
    double polar = at->a[3], azimuth = at->c[3];
    outgoing[0] = sin(polar) * cos(azimuth);
    outgoing[1] = sin(polar) * sin(azimuth);
    outgoing[2] = cos(polar);
}

static void reflect(const double outgoing[3], const double half_vector[3], double incoming[3]) {
    double unit[3] = {half_vector[0], half_vector[1], half_vector[2]};
    reference_normalise(unit);
    double twice = 2 * reference_dot(outgoing, unit);
    for (int i = 0; i < 3; i++)
        incoming[i] = twice * unit[i] - outgoing[i];
}

static void test_reflected(void **state) {
    make_lobes(1);
    evaluate_lobes(state, REFLECTED);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double outgoing[3], axis[3] = {at->a[0], at->a[1], at->a[2]}, incoming[3];
        outgoing_of(at, outgoing);
        reflect(outgoing, axis, incoming);
        for (int j = 0; j < 3; j++)
            check_close("axis", at, results[0][i].value[j], incoming[j], 1e-6);
        for (int side = 0; side < 2; side++) {
            const float *move = side ? at->c : at->b;
            double ends[2][3];
            for (int end = 0; end < 2; end++) {
                double moved[3];
                for (int j = 0; j < 3; j++)
                    moved[j] = axis[j] + (end ? 1e-5 : -1e-5) * (double)move[j];
                reflect(outgoing, moved, ends[end]);
            }
            for (int j = 0; j < 3; j++)
                check_close("displacement", at, results[1 + side][i].value[j],
                            (ends[1][j] - ends[0][j]) / 2e-5, 5e-6);
        }
    }
    report_worst_error("reflected_lobe");
}

static double product_of(const float a[4], const float b[4]) {
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

static void test_principal(void **state) {
    make_lobes(1);
    // A round lobe has no axes of its own.
    memcpy(arguments[0].a, (float[4]){0, 0, 1}, sizeof arguments[0].a);
    memcpy(arguments[0].b, (float[4]){0.5f, 0, 0}, sizeof arguments[0].b);
    memcpy(arguments[0].c, (float[4]){0, 0.5f, 0}, sizeof arguments[0].c);
    evaluate_lobes(state, PRINCIPAL);
    for (size_t i = 0; i < COUNT; i++) {
        const float *first = results[1][i].value, *second = results[2][i].value;
        const harness_arguments *at = &arguments[i];
        double scale = product_of(first, first);
        check_close("perpendicular", at, product_of(first, second), 0, 1e-6 * scale);
        if (product_of(second, second) > scale * (1 + 1e-6))
            fail_msg("lobe %zu: the second displacement is the longer one", i);
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                check_close("covariance", at,
                            (double)first[row] * first[column] +
                                (double)second[row] * second[column],
                            (double)at->b[row] * at->b[column] + (double)at->c[row] * at->c[column],
                            2e-6 * scale);
    }
    report_worst_error("principal_lobe");
}

/// Mass, mean and variance of a normal number above -x.
static void cut_off(double x, double moments[3]) {
    double sum[3] = {0};
    const double step = 1e-3;
    for (double t = -x + step / 2; t < 9; t += step) {
        double density = exp(-0.5 * t * t) / sqrt(2 * M_PI) * step;
        sum[0] += density;
        sum[1] += density * t;
        sum[2] += density * t * t;
    }
    moments[0] = sum[0];
    moments[1] = sum[1] / sum[0];
    moments[2] = sum[2] / sum[0] - moments[1] * moments[1];
}

/// Lobes that a horizon cuts: heights of -2 to 4 standard deviations.
static void test_above(void **state) {
    enum { LOBES = 200 };
    uint64_t random = 5;
    make_lobes(0.2);
    for (size_t i = 0; i < LOBES; i++) {
        harness_arguments *at = &arguments[i];
        double deviation = hypot((double)at->b[2], (double)at->c[2]);
        double height = scenes_random_between(&random, -2, 4) * deviation;
        double planar = hypot((double)at->a[0], (double)at->a[1]);
        if (fabs(height) > 0.9 || planar < 0.1 || deviation < 0.01)
            continue;
        // The displacements stay as they are, and are no longer quite perpendicular.
        for (int j = 0; j < 2; j++)
            at->a[j] = (float)(at->a[j] * sqrt(1 - height * height) / planar);
        at->a[2] = (float)height;
    }
    evaluate_lobes(state, ABOVE);
    static harness_result measures[COUNT];
    harness_evaluate(state, shader, MEASURES, arguments, COUNT, measures);
    for (size_t i = 0; i < LOBES; i++) {
        const harness_arguments *at = &arguments[i];
        double deviation = hypot((double)at->b[2], (double)at->c[2]);
        double x = at->a[2] / deviation, expected[3];
        if (deviation < 0.01 || x < -2 || x > 6)
            continue;
        cut_off(x, expected);
        check_close("share above", at, measures[i].value[1], expected[0], 4e-4);
        // Along the horizon's normal; q is a quotient of approximations.
        double spread = hypot((double)results[1][i].value[2], (double)results[2][i].value[2]);
        check_close("height's deviation", at, spread / deviation, sqrt(expected[2]), 0.1);
        double moved[3];
        for (int j = 0; j < 3; j++)
            moved[j] = at->a[j] + expected[1] *
                                      ((double)at->b[2] * at->b[j] + (double)at->c[2] * at->c[j]) /
                                      deviation;
        reference_normalise(moved);
        for (int j = 0; j < 3; j++)
            check_close("axis", at, results[0][i].value[j], moved[j], 0.08 * deviation + 1e-6);
    }
    report_worst_error("lobe_above");
}

static void test_normal(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i] = (harness_arguments){{(float)(12.0 * (double)i / COUNT - 6)}, {0}, {0}};
        arguments[i].a[1] = (float)geometric(1e-3, 10, i, COUNT);
    }
    harness_evaluate(state, shader, NORMAL, arguments, COUNT, results[0]);
    for (size_t i = 0; i < COUNT; i++) {
        double mean = arguments[i].a[0], deviation = arguments[i].a[1], x = mean / deviation;
        check_close("normal_below", &arguments[i], results[0][i].value[0],
                    0.5 * erfc(-mean / sqrt(2)), 3e-4);
        check_close("mean_above_zero", &arguments[i], results[0][i].value[1],
                    mean * 0.5 * erfc(-x / sqrt(2)) +
                        deviation * exp(-0.5 * x * x) / sqrt(2 * M_PI),
                    4e-4 * fmin(fabs(mean), 5 * deviation) + 1e-6 * (fabs(mean) + deviation));
    }
    report_worst_error("normal_below");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reflected),
        cmocka_unit_test(test_principal),
        cmocka_unit_test(test_above),
        cmocka_unit_test(test_normal),
    };
    return cmocka_run_group_tests_name("direction_lobe", tests, harness_set_up, harness_tear_down);
}
