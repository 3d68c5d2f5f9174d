// shaders/lib/light/cube_texel.glsl against double precision.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/light/cube_texel.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 6 * 1024 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void evaluate(void **state, size_t count) {
    harness_evaluate(state, "light/cube_texel.comp", 0, arguments, count, results);
}

static void set_texel(harness_arguments *at, int face, int x, int y, int size) {
    *at = (harness_arguments){.a = {(float)face, (float)x, (float)y, (float)size}};
}

static void check_texel(const harness_arguments *at, const harness_result *result) {
    int face = (int)at->a[0], x = (int)at->a[1], y = (int)at->a[2], size = (int)at->a[3];
    double exact[3];
    reference_cube_texel_direction(face, x, y, size, exact);
    for (int i = 0; i < 3; i++)
        check_close("cube_texel_direction", at, result->value[i], exact[i], 8 * FLOAT_ROUNDING);
    // Corners that are no float are off by a rounding of 1, a texel's extent by one of itself.
    check_close("cube_texel_solid_angle", at, result->value[3],
                reference_cube_texel_solid_angle(x, y, size),
                32 * FLOAT_ROUNDING * reference_cube_texel_solid_angle(x, y, size));
}

/// Any texel of any size up to 4096, odd ones too.
static void test_texels(void **state) {
    uint64_t random = 71;
    for (size_t i = 0; i < COUNT; i++) {
        int size = (int)geometric(1, 4096, i, COUNT);
        set_texel(&arguments[i], (int)(i % 6), (int)(size * random_number(&random)),
                  (int)(size * random_number(&random)), size);
    }
    evaluate(state, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        check_texel(&arguments[i], &results[i]);
    report_worst_error("cube_texel_direction, cube_texel_solid_angle");
}

/// The corners of faces, where texels are smallest and most oblique.
static void test_corners(void **state) {
    static const int sizes[] = {1, 2, 3, 16, 256, 2048};
    size_t count = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int face = 0; face < 6; face++)
            for (int corner = 0; corner < 4; corner++)
                set_texel(&arguments[count++], face, corner % 2 * (sizes[i] - 1),
                          corner / 2 * (sizes[i] - 1), sizes[i]);
    evaluate(state, count);
    for (size_t i = 0; i < count; i++)
        check_texel(&arguments[i], &results[i]);
}

/// A sampler that looks along a texel's direction finds the texel's centre.
static void test_lookup(void **state) {
    const int size = 32;
    for (int i = 0; i < COUNT; i++)
        set_texel(&arguments[i], i / (size * size), i % size, i / size % size, size);
    evaluate(state, COUNT);
    for (int i = 0; i < COUNT; i++) {
        const float *found = results[i].value;
        double position[2];
        int face = reference_cube_face((double[3]){found[0], found[1], found[2]}, position);
        assert_int_equal(face, (int)arguments[i].a[0]);
        for (int j = 0; j < 2; j++)
            check_close("cube_texel_direction", &arguments[i], size * position[j],
                        (double)arguments[i].a[1 + j] + 0.5, 1e-5);
    }
}

/// All texels together are the sphere.
static void test_sphere(void **state) {
    static const int sizes[] = {1, 2, 7, 32};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int size = sizes[i], count = 6 * size * size;
        for (int j = 0; j < count; j++)
            set_texel(&arguments[j], j / (size * size), j % size, j / size % size, size);
        evaluate(state, (size_t)count);
        double sum = 0;
        for (int j = 0; j < count; j++)
            sum += (double)results[j].value[3];
        check_close("sum of cube_texel_solid_angle", &arguments[0], sum, 4 * M_PI, 2e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texels),
        cmocka_unit_test(test_corners),
        cmocka_unit_test(test_lookup),
        cmocka_unit_test(test_sphere),
    };
    return cmocka_run_group_tests_name("cube_texel", tests, harness_set_up, harness_tear_down);
}
