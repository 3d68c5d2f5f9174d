// shaders/lib/number/complex.glsl against double precision.

#include <complex.h>
#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 4096 };

static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// All quarters, their borders at eighths, and steps of one unit around those.
static uint32_t turns_of(size_t index) {
    return index % 2 ? (uint32_t)(index / 2) * 2097152u
                     : (uint32_t)(index % 16 / 2) * 536870912u + (uint32_t)(index / 16) - 128u;
}

static void turns_are_exact(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        arguments[i].a[0] = (float)(turns_of(i) >> 16);
        arguments[i].a[1] = (float)(turns_of(i) & 0xffff);
    }
    harness_evaluate(state, "number/complex.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const double angle = 2 * M_PI * turns_of(i) / 4294967296.0;
        check_close("turned", &arguments[i], results[i].value[0], cos(angle), 3 * FLOAT_ROUNDING);
        check_close("turned", &arguments[i], results[i].value[1], sin(angle), 3 * FLOAT_ROUNDING);
    }
    report_worst_error("turned");
}

static void products_are_exact(void **state) {
    uint64_t random = 1;
    for (size_t i = 0; i < COUNT; i++)
        for (int k = 0; k < 2; k++) {
            arguments[i].a[k] = (float)scenes_random_between(&random, -1, 1);
            arguments[i].b[k] = (float)scenes_random_between(&random, -1, 1);
        }
    harness_evaluate(state, "number/complex.comp", 1, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const double complex a = arguments[i].a[0] + I * (double)arguments[i].a[1],
                             b = arguments[i].b[0] + I * (double)arguments[i].b[1];
        check_close("times", &arguments[i], results[i].value[0], creal(a * b), 4 * FLOAT_ROUNDING);
        check_close("times", &arguments[i], results[i].value[1], cimag(a * b), 4 * FLOAT_ROUNDING);
        assert_true(results[i].value[2] == (float)creal(I * a) &&
                    results[i].value[3] == (float)cimag(I * a));
    }
    report_worst_error("times");
    harness_evaluate(state, "number/complex.comp", 2, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(results[i].value[0] == arguments[i].a[0] &&
                    results[i].value[1] == -arguments[i].a[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_are_exact),
        cmocka_unit_test(products_are_exact),
    };
    return cmocka_run_group_tests_name("complex", tests, harness_set_up, harness_tear_down);
}
