// shaders/lib/lobe/spherical_cap.glsl: rows and columns of a face that a cap reaches, against a
// test of every texel.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/light/cube_texel.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

enum { SIZE = 16, CAPS = 300, COUNT = CAPS * 6 * SIZE };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void make_caps(void) {
    uint64_t random = 5;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        size_t cap = i / (6 * SIZE);
        at->b[0] = (float)(i / SIZE % 6);
        at->b[1] = SIZE;
        at->b[2] = (float)(i % SIZE);
        if (i % (6 * SIZE) == 0) {
            random_direction(&random, at->a);
            at->a[3] = (float)geometric(0.02, 3.1, cap, CAPS);
        } else {
            for (int k = 0; k < 4; k++)
                at->a[k] = arguments[i - 1].a[k];
        }
    }
}

/// How far inside the cap a texel's centre is, by cosine; below 0: outside.
static double depth(const harness_arguments *at, int column) {
    double centre[3], axis[3] = {at->a[0], at->a[1], at->a[2]};
    reference_cube_texel_direction((int)at->b[0], column, (int)at->b[2], SIZE, centre);
    reference_normalise(axis);
    return reference_dot(centre, axis) - cos(at->a[3]);
}

/// Exactly the texels inside are named; caps as large as a hemisphere name all.
static void test_texels(void **state) {
    make_caps();
    harness_evaluate(state, "lobe/spherical_cap.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *found = results[i].value;
        bool row = arguments[i].b[2] >= found[0] && arguments[i].b[2] <= found[1];
        for (int column = 0; column < SIZE; column++) {
            bool named = row && (float)column >= found[2] && (float)column <= found[3];
            double inside = depth(&arguments[i], column);
            if (inside > 1e-5 && !named)
                fail_msg("%zu: column %d is left out, %g within", i, column, inside);
            if (inside < -1e-5 && named && arguments[i].a[3] < 0.5 * M_PI)
                fail_msg("%zu: column %d is named, %g outside", i, column, -inside);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_texels)};
    return cmocka_run_group_tests(tests, harness_set_up, harness_tear_down);
}
