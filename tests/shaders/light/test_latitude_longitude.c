// shaders/lib/light/latitude_longitude.glsl against double precision.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Directions all around, along the axes, and close to the poles and to the seam.
static void make_directions(void) {
    uint64_t random = 3;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        if (i % 4 == 1)
            arguments[i].a[i / 4 % 3] = 0;
        if (i % 4 == 2)
            arguments[i].a[0] = arguments[i].a[2] = (float)geometric(1e-8, 1, i, COUNT);
        if (i % 4 == 3)
            arguments[i].a[0] = (float)geometric(1e-8, 1, i, COUNT);
    }
    arguments[0] = (harness_arguments){{0, 1, 0}, {0}, {0}};
    arguments[4] = (harness_arguments){{0, -1, 0}, {0}, {0}};
}

static void test_positions(void **state) {
    make_directions();
    harness_evaluate(state, "light/latitude_longitude.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *d = arguments[i].a;
        double longitude = atan2(d[0], d[2]), from_top = atan2(hypot(d[0], d[2]), d[1]);
        check_close("longitude", &arguments[i], results[i].value[0], 0.5 - longitude / (2 * M_PI),
                    4 * FLOAT_ROUNDING);
        check_close("latitude", &arguments[i], results[i].value[1], from_top / M_PI,
                    6 * FLOAT_ROUNDING);
        check_relative("arctangent_of_quotient", &arguments[i], results[i].value[2],
                       atan2(d[0], d[1]), 8 * FLOAT_ROUNDING);
    }
    report_worst_error("latitude_longitude");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_positions)};
    return cmocka_run_group_tests(tests, harness_set_up, harness_tear_down);
}
