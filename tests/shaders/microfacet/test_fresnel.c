// shaders/lib/microfacet/fresnel.glsl against its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 1000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static double exact_fresnel(double f0, double f90, double cosine) {
    release_reals();
    real complement = subtract(real_from(1), real_from(fmin(fmax(cosine, 0), 1)));
    real fifth = multiply(square(square(complement)), complement);
    return to_double(add(real_from(f0), multiply(subtract(real_from(f90), real_from(f0)), fifth)));
}

static void test_fresnel(void **state) {
    uint64_t random = 12;
    for (size_t i = 0; i < COUNT; i++) {
        // Beyond [0, 1] at both ends, where the cosine is clamped.
        arguments[i].c[0] = (float)scenes_random_between(&random, -0.05, 1.05);
        for (int j = 0; j < 3; j++) {
            arguments[i].a[j] = (float)random_number(&random);
            arguments[i].b[j] = i % 2 ? 1 : (float)random_number(&random);
        }
    }
    arguments[0].c[0] = 0;
    arguments[1].c[0] = 1;
    harness_evaluate(state, "microfacet/fresnel.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        for (int j = 0; j < 3; j++) {
            const harness_arguments *at = &arguments[i];
            double expected = exact_fresnel(at->a[j], at->b[j], at->c[0]);
            check_close("fresnel_schlick", at, results[i].value[j], expected, 6 * FLOAT_ROUNDING);
            check_close("reference_fresnel", at, reference_fresnel(at->a[j], at->b[j], at->c[0]),
                        expected, 1e-15);
        }
    }
    report_worst_error("fresnel_schlick");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fresnel),
    };
    return cmocka_run_group_tests_name("fresnel", tests, harness_set_up, harness_tear_down);
}
