// shaders/lib/map/ordered_dither.glsl: thresholds are spread evenly over every aligned block, and
// those of two layers have nothing to do with each other.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"

static const char shader[] = "map/ordered_dither.comp";

enum { SIDE = 64, LAYERS = 3, COUNT = SIDE * SIDE * LAYERS };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static double threshold(int x, int y, int layer) {
    return (double)results[(layer * SIDE + y) * SIDE + x].value[0];
}

static void evaluate(void **state) {
    for (int i = 0; i < COUNT; i++) {
        arguments[i].a[0] = (float)(i % SIDE);
        arguments[i].a[1] = (float)(i / SIDE % SIDE);
        arguments[i].a[2] = (float)(i / (SIDE * SIDE));
    }
    harness_evaluate(state, shader, 0, arguments, COUNT, results);
}

static void check_block(int corner_x, int corner_y, int side, int layer) {
    bool found[256] = {false};
    for (int i = 0; i < side * side; i++) {
        double value = threshold(corner_x + i % side, corner_y + i / side, layer);
        assert_true(value > 0 && value < 1);
        int part = (int)(value * side * side);
        if (found[part])
            fail_msg("block of %d at %d, %d: two thresholds in part %d", side, corner_x, corner_y,
                     part);
        found[part] = true;
    }
}

static void test_blocks(void **state) {
    evaluate(state);
    for (int side = 2; side <= 16; side *= 2)
        for (int layer = 0; layer < LAYERS; layer++)
            for (int i = 0; i < SIDE / side * (SIDE / side); i++)
                check_block(i % (SIDE / side) * side, i / (SIDE / side) * side, side, layer);
}

/// Stripes of a picture are not in step with the order: each second column, row and diagonal has
/// thresholds of all sizes. Bound: five standard deviations of as many random numbers.
static void test_stripes(void **state) {
    evaluate(state);
    double sums[3] = {0};
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            double value = threshold(x, y, 0) - 0.5;
            sums[0] += x % 2 ? value : -value;
            sums[1] += y % 2 ? value : -value;
            sums[2] += (x + y) % 2 ? value : -value;
        }
    for (int i = 0; i < 3; i++)
        assert_true(fabs(sums[i]) < 5 * SIDE * sqrt(1 / 12.0));
}

/// Of two layers with a coverage of one half each, a quarter of the pixels shows both.
static void test_layers(void **state) {
    evaluate(state);
    for (int layer = 1; layer < LAYERS; layer++) {
        int both = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            both += threshold(i % SIDE, i / SIDE, 0) < 0.5 &&
                    threshold(i % SIDE, i / SIDE, layer) < 0.5;
        assert_true(fabs((double)both / (SIDE * SIDE) - 0.25) < 0.02);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blocks),
        cmocka_unit_test(test_stripes),
        cmocka_unit_test(test_layers),
    };
    return cmocka_run_group_tests_name("ordered_dither", tests, harness_set_up, harness_tear_down);
}
