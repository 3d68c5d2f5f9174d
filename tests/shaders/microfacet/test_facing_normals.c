// shaders/lib/microfacet/facing_normals.glsl against sums over two correlated normal numbers.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/lambert_plane.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/facing_normals.comp";
enum { FACING, GRADIENT };

enum { COUNT = 300 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Over normals at Gaussian places: those that face both directions and their mean cosines; and the
/// mean of <n, incoming> over all, 0 for those that do not.
static void sum_over_normals(const harness_arguments *at, double expected[4]) {
    double sum[3] = {0}, first = sqrt((double)at->a[0]), mixed = at->a[2] / first;
    double second = sqrt(at->a[1] - mixed * mixed);
    const double incoming[3] = {at->b[0], at->b[1], at->b[2]};
    const double outgoing[3] = {at->c[0], at->c[1], at->c[2]}, step = 0.05;
    for (double u = -5; u < 5; u += step) {
        for (double v = -5; v < 5; v += step) {
            const double place[2] = {first * u, mixed * u + second * v};
            double normal[3], part = exp(-0.5 * (u * u + v * v)) / (2 * M_PI) * step * step;
            reference_direction_from_plane(place, normal);
            double in = reference_dot(normal, incoming), out = reference_dot(normal, outgoing);
            if (in <= 0 || out <= 0)
                continue;
            sum[0] += part;
            sum[1] += part * in;
            sum[2] += part * out;
        }
    }
    expected[0] = sum[0];
    expected[1] = sum[1] / sum[0];
    expected[2] = sum[2] / sum[0];
    expected[3] = sum[1];
}

/// Directions up to 85 degrees, and slopes of up to 0.4.
static void test_facing(void **state) {
    uint64_t random = 31;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        double x = scenes_random_between(&random, 0.05, 0.4);
        double y = scenes_random_between(&random, 0.05, 0.4);
        at->a[0] = (float)(x * x);
        at->a[1] = (float)(y * y);
        at->a[2] = (float)(x * y * scenes_random_between(&random, -0.9, 0.9));
        for (int side = 0; side < 2; side++) {
            double polar = scenes_random_between(&random, 0, 85) * M_PI / 180;
            double azimuth = scenes_random_between(&random, 0, 2 * M_PI);
            float *direction = side ? at->c : at->b;
            direction[0] = (float)(sin(polar) * cos(azimuth));
            direction[1] = (float)(sin(polar) * sin(azimuth));
            direction[2] = (float)cos(polar);
        }
    }
    harness_evaluate(state, shader, FACING, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *found = results[i].value;
        double expected[4];
        sum_over_normals(at, expected);
        // One direction cuts after the other, and the rest is taken for Gaussian.
        check_close("share", at, found[0], expected[0], 0.05);
        check_close("mean to the light", at, found[1], expected[1], 0.05);
        check_close("mean to the viewer", at, found[2], expected[2], 0.05);
        check_close("facing cosine", at, found[3], expected[3], 0.04);
    }
    report_worst_error("facing_normals");
}

static void test_gradient(void **state) {
    uint64_t random = 32;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].b);
        for (int j = 0; j < 2; j++)
            arguments[i].a[j] = (float)scenes_random_between(&random, -0.9, 0.9);
    }
    harness_evaluate(state, shader, GRADIENT, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const double direction[3] = {at->b[0], at->b[1], at->b[2]};
        for (int j = 0; j < 2; j++) {
            double cosines[2];
            for (int end = 0; end < 2; end++) {
                double place[2] = {at->a[0], at->a[1]}, normal[3];
                place[j] += end ? 1e-5 : -1e-5;
                reference_direction_from_plane(place, normal);
                cosines[end] = reference_dot(normal, direction);
            }
            check_close("gradient", at, results[i].value[j], (cosines[1] - cosines[0]) / 2e-5,
                        5e-6);
        }
    }
    report_worst_error("cosine_gradient");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_facing),
        cmocka_unit_test(test_gradient),
    };
    return cmocka_run_group_tests_name("facing_normals", tests, harness_set_up, harness_tear_down);
}
