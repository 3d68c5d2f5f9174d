// shaders/lib/light/light.glsl against its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/light/light.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 2000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void test_distance(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        double distance = i < 4 ? 0 : geometric(1e-12, 1e12, i, COUNT);
        double range = i % 4 ? geometric(1e-9, 1e9, (i * 7) % COUNT, COUNT) : 0;
        arguments[i].a[3] = (float)(distance * distance);
        arguments[i].b[3] = range > 0 ? (float)(1 / (range * range)) : 0;
    }
    harness_evaluate(state, "light/light.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double distance = sqrt(arguments[i].a[3]), inverse = arguments[i].b[3];
        double range = inverse > 0 ? 1 / sqrt(inverse) : 0;
        double expected = reference_distance_attenuation(distance, range);
        // Near the range 1 - (d/range)^4 cancels: an absolute error, over the squared distance.
        double scale = distance > 0 ? 1 / (distance * distance) : 0;
        check_close("distance_attenuation", &arguments[i], results[i].value[0], expected,
                    4 * FLOAT_ROUNDING * scale + 4 * FLOAT_ROUNDING * expected);
    }
    report_worst_error("distance_attenuation");
}

static void test_cone(void **state) {
    static double inner[COUNT], outer[COUNT];
    uint64_t random = 19;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        outer[i] = scenes_random_between(&random, 0.05, M_PI / 2);
        inner[i] = i % 4 ? scenes_random_between(&random, 0, outer[i]) : outer[i];
        double scale = 1 / fmax(0.001, cos(inner[i]) - cos(outer[i]));
        at->c[0] = (float)scale;
        at->c[1] = (float)(-scale * cos(outer[i]));
        random_direction(&random, at->a);
        const float from_light[3] = {-at->a[0], -at->a[1], -at->a[2]};
        direction_at(from_light, scenes_random_between(&random, 0, 1.2 * outer[i]),
                     scenes_random_between(&random, 0, 6), at->b);
    }
    harness_evaluate(state, "light/light.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a, *b = arguments[i].b;
        double cosine = -((double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2]);
        // The scale, up to 1000 for a sharp edge, magnifies the rounding of the cosine.
        check_close("cone_attenuation", &arguments[i], results[i].value[1],
                    reference_cone_attenuation(cosine, inner[i], outer[i]),
                    8 * FLOAT_ROUNDING * (1 + arguments[i].c[0]));
    }
    report_worst_error("cone_attenuation");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distance),
        cmocka_unit_test(test_cone),
    };
    return cmocka_run_group_tests_name("light", tests, harness_set_up, harness_tear_down);
}
