// shaders/lib/microfacet/seen_slopes.glsl against sums over slopes in double precision.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/seen_slopes.comp";
enum { VISIBILITY, HEIGHTS, SEEN };

enum { COUNT = 1000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Means up to 1, deviations from 0.02 to 1.5; directions above the horizon. c.w: a deviation.
static void make_arguments(uint64_t random) {
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        float incoming[3];
        random_direction(&random, at->a);
        random_direction(&random, incoming);
        at->a[2] = fabsf(at->a[2]);
        at->a[3] = incoming[0];
        at->b[2] = incoming[1];
        at->b[3] = fabsf(incoming[2]);
        const double x = geometric(0.02, 1.5, i, COUNT),
                     y = geometric(0.02, 1.5, (i * 31) % COUNT, COUNT);
        for (int k = 0; k < 2; k++)
            at->b[k] = (float)scenes_random_between(&random, -0.7, 0.7);
        at->c[0] = (float)(x * x);
        at->c[1] = (float)(y * y);
        at->c[2] = (float)(scenes_random_between(&random, -0.9, 0.9) * x * y);
        at->c[3] = (float)scenes_random_between(&random, -2.5, 2.5);
    }
}

/// What is masked and then shadowed is what is masked and shadowed.
static void parts_are_those_of_both(void **state) {
    make_arguments(5);
    harness_evaluate(state, shader, VISIBILITY, arguments, COUNT, results);
    size_t visible = 0;
    for (size_t i = 0; i < COUNT; i++) {
        check_close("visibility", &arguments[i], results[i].value[0], results[i].value[1], 2e-6);
        visible += results[i].value[1] > 0.1f;
    }
    assert_true(visible > COUNT / 5);
}

/// Sums of z^0, z^1, z^2 times (c + z)^+ over a normal distribution: moments of what is seen.
static void seen_moments(double c, double moments[3]) {
    enum { STEPS = 20000 };
    moments[0] = moments[1] = moments[2] = 0;
    for (int i = 0; i < STEPS; i++) {
        const double z = -10 + 20 * (i + 0.5) / STEPS;
        const double weight = fmax(c + z, 0) * exp(-0.5 * z * z) / sqrt(2 * M_PI) * 20 / STEPS;
        for (int k = 0; k < 3; k++)
            moments[k] += weight * pow(z, k);
    }
}

static void heights_are_means_over_slopes(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i] = (harness_arguments){0};
        arguments[i].a[0] = (float)(-3 + 6.0 * (double)i / COUNT);
        arguments[i].a[1] = (float)geometric(0.01, 4, (i * 31) % COUNT, COUNT);
    }
    harness_evaluate(state, shader, HEIGHTS, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const double height = arguments[i].a[0], deviation = sqrt((double)arguments[i].a[1]);
        double moments[3];
        if (fabs(height / deviation) < 4) {
            seen_moments(height / deviation, moments);
            check_close("mean_height", &arguments[i], results[i].value[0], deviation * moments[0],
                        6e-4 * deviation);
        }
        check_close("part_below", &arguments[i], results[i].value[1], 0.5 * erfc(-height / sqrt(2)),
                    3e-4);
    }
}

/// A slope keeps its place: as many deviations from the mean as before, of those that are seen;
/// across the direction nothing changes.
static void slopes_keep_their_places(void **state) {
    make_arguments(9);
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        const double variance = (double)at->c[0] * at->a[0] * at->a[0] +
                                (double)at->c[1] * at->a[1] * at->a[1] +
                                2.0 * (double)at->c[2] * at->a[0] * at->a[1];
        at->a[3] = (float)(sqrt(variance) * (-1.4 + 5.0 * (double)i / COUNT)); // the height
    }
    harness_evaluate(state, shader, SEEN, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const double *m = (const double[]){at->b[0], at->b[1]};
        const double cx = at->c[0], cy = at->c[1], cxy = at->c[2];
        const double towards[2] = {cx * at->a[0] + cxy * at->a[1], cxy * at->a[0] + cy * at->a[1]};
        const double deviation = sqrt(towards[0] * at->a[0] + towards[1] * at->a[1]);
        if (deviation < 1e-2)
            continue;
        const float *v = results[i].value;
        const double place = -((v[0] - m[0]) * at->a[0] + (v[1] - m[1]) * at->a[1]) / deviation;
        double moments[3];
        seen_moments(at->a[3] / deviation, moments);
        const double mean = moments[1] / moments[0];
        const double spread = sqrt(moments[2] / moments[0] - mean * mean);
        const double moved = mean + spread * place - place;
        for (int k = 0; k < 2; k++)
            check_close("slope_that_is_seen", at, v[2 + k], v[k] - towards[k] / deviation * moved,
                        1e-5 + 0.06 * hypot(towards[0], towards[1]) / deviation);
    }
    report_worst_error("slope_that_is_seen");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_those_of_both),
        cmocka_unit_test(heights_are_means_over_slopes),
        cmocka_unit_test(slopes_keep_their_places),
    };
    return cmocka_run_group_tests_name("seen_slopes", tests, harness_set_up, harness_tear_down);
}
