// shaders/lib/microfacet/facing_area.glsl against sums over two correlated normal numbers.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/lambert_plane.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 300 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// What normals show to a direction, then their mean by that.
static void sum_over_normals(const harness_arguments *at, double expected[4]) {
    double sum[4] = {0}, first = sqrt((double)at->a[0]), mixed = at->a[2] / first;
    double second = sqrt(at->a[1] - mixed * mixed);
    const double direction[3] = {at->b[0], at->b[1], at->b[2]}, step = 0.05;
    for (double u = -5; u < 5; u += step) {
        for (double v = -5; v < 5; v += step) {
            const double place[2] = {at->c[0] + first * u, at->c[1] + mixed * u + second * v};
            double normal[3], part = exp(-0.5 * (u * u + v * v)) / (2 * M_PI) * step * step;
            reference_direction_from_plane(place, normal);
            const double cosine = fmax(reference_dot(normal, direction), 0);
            sum[0] += part * cosine;
            for (int i = 0; i < 3; i++)
                sum[1 + i] += part * cosine * normal[i];
        }
    }
    expected[0] = sum[0];
    for (int i = 1; i < 4; i++)
        expected[i] = sum[i] / sum[0];
}

/// Groups within 45 degrees of the pole, from directions all over, which they face in part.
static void areas_are_those_of_all_normals(void **state) {
    uint64_t random = 33;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        const double x = scenes_random_between(&random, 0.05, 0.3),
                     y = scenes_random_between(&random, 0.05, 0.3);
        at->a[0] = (float)(x * x);
        at->a[1] = (float)(y * y);
        at->a[2] = (float)(x * y * scenes_random_between(&random, -0.9, 0.9));
        random_direction(&random, at->b);
        for (int j = 0; j < 2; j++)
            at->c[j] = (float)scenes_random_between(&random, -0.5, 0.5);
    }
    harness_evaluate(state, "microfacet/facing_area.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double expected[4];
        sum_over_normals(at, expected);
        check_close("area", at, results[i].value[0], expected[0], 0.025);
        for (int j = 1; j < 4 && expected[0] > 0.2; j++) // normals move in their planes
            check_close("mean normal", at, results[i].value[j], expected[j], 0.08);
    }
    report_worst_error("facing_area");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(areas_are_those_of_all_normals)};
    return cmocka_run_group_tests_name("facing_area", tests, harness_set_up, harness_tear_down);
}
