// shaders/lib/microfacet/directional_albedo.glsl against double precision. The table itself is
// tested with its pass.

#include <math.h>
#include <stdint.h>

#include <lobe/scene.h>

#include "shaders/interface/environment/directional_albedo.h"
#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 1000, POSITION = 0, ALBEDO = 1 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// From the first texel's centre to the last one's.
static double coordinate(double place) {
    return (0.5 + place * (DIRECTIONAL_ALBEDO_SIZE - 1)) / DIRECTIONAL_ALBEDO_SIZE;
}

/// A roughness, through the distribution's own parameter, and back.
static void test_position(void **state) {
    uint64_t random = 101;
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){.a = {(float)(i % 4),
                                                 (float)scenes_random_between(&random, 0.04, 1),
                                                 (float)random_number(&random), 1}};
    harness_evaluate(state, "microfacet/directional_albedo.comp", POSITION, arguments, COUNT,
                     results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *a = arguments[i].a, *found = results[i].value;
        check_close("position of a cosine", &arguments[i], found[0], coordinate(sqrt(a[2])), 1e-6);
        check_close("position of a roughness", &arguments[i], found[1], coordinate(a[1]), 2e-6);
    }
    report_worst_error("directional_albedo_position");
}

/// Beyond the table: its edge.
static void test_edges(void **state) {
    // Lobes broader than any material's, then sharper ones; cosines out of range.
    static const float parameters[2][4] = {{30, 30, 0, 0}, {0, 0, 1e30f, 1e30f}};
    for (int i = 0; i < 8; i++)
        arguments[i] = (harness_arguments){
            .a = {(float)(i % 4), 0.5f, i / 4 ? 1.5f : -0.5f, parameters[i / 4][i % 4]}};
    harness_evaluate(state, "microfacet/directional_albedo.comp", POSITION, arguments, 8, results);
    for (int i = 0; i < 8; i++) {
        check_close("cosine out of range", &arguments[i], results[i].value[2],
                    coordinate(i / 4 ? 1 : 0), 1e-6);
        check_close("roughness out of range", &arguments[i], results[i].value[3],
                    coordinate(i / 4 ? 0 : 1), 1e-6);
    }
}

static void test_albedo(void **state) {
    uint64_t random = 102;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        for (int j = 0; j < 3; j++) {
            at->a[j] = (float)scenes_random_between(&random, 0.1, 0.6);
            at->b[j] = (float)random_number(&random);
        }
    }
    harness_evaluate(state, "microfacet/directional_albedo.comp", ALBEDO, arguments, COUNT,
                     results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        double x = at->a[0], y = at->a[1], z = at->a[2];
        double f0 = at->b[0], f90 = at->b[1], diffuse = at->b[2];
        check_close("specular_albedo", at, results[i].value[0], f0 * x + f90 * y, 1e-6);
        check_close("diffuse_albedo", at, results[i].value[1],
                    diffuse * (1 - f0 * (1 - z) - f90 * z), 1e-6);
        check_close("multiple_scattering_scale", at, results[i].value[2],
                    1 + f0 * (1 / (x + y) - 1), 4e-6);
    }
    report_worst_error("specular_albedo, diffuse_albedo, multiple_scattering_scale");
}

/// A white surface reflects all, whatever it reflects at first.
static void test_white(void **state) {
    uint64_t random = 103;
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){.a = {(float)scenes_random_between(&random, 0.1, 1),
                                                 (float)scenes_random_between(&random, 0.1, 1)},
                                           .b = {1, 1}};
    harness_evaluate(state, "microfacet/directional_albedo.comp", ALBEDO, arguments, COUNT,
                     results);
    for (size_t i = 0; i < COUNT; i++)
        check_close("white", &arguments[i],
                    (double)results[i].value[0] * (double)results[i].value[2], 1, 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_position),
        cmocka_unit_test(test_edges),
        cmocka_unit_test(test_albedo),
        cmocka_unit_test(test_white),
    };
    return cmocka_run_group_tests_name("directional_albedo", tests, harness_set_up,
                                       harness_tear_down);
}
