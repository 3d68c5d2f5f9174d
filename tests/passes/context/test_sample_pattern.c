// The positions of the reference's samples within a pixel.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/context/sample_pattern.h"

static void one_sample_is_the_centre(void **state) {
    (void)state;
    float position[2];
    passes_sample_position(0, 1, position);
    assert_true(position[0] == 0.5f && position[1] == 0.5f);
}

/// Every column of 1/count and every row of 1/(power of two) has one sample, all are inside, and
/// for powers of two the mean is the centre.
static void any_count_is_stratified(void **state) {
    (void)state;
    static const uint32_t counts[] = {1, 2, 3, 5, 8, 64, 100, 255, 256, 4095, 4096};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        uint32_t count = counts[i];
        unsigned char *rows = calloc(count, 1);
        assert_non_null(rows);
        double mean[2] = {0, 0};
        for (uint32_t j = 0; j < count; j++) {
            float position[2];
            passes_sample_position(j, count, position);
            for (int axis = 0; axis < 2; axis++) {
                assert_true(position[axis] >= 0 && position[axis] < 1);
                mean[axis] += (double)position[axis] / count;
            }
            assert_int_equal((uint32_t)(position[0] * (float)count), j);
            rows[(uint32_t)(position[1] * (float)count)]++;
        }
        assert_true(fabs(mean[0] - 0.5) < 1e-5);
        assert_true(fabs(mean[1] - 0.5) < 1.0 / count);
        bool power_of_two = (count & (count - 1)) == 0;
        for (uint32_t j = 0; j < count; j++)
            assert_in_range(rows[j], power_of_two ? 1 : 0, power_of_two ? 1 : 3);
        if (power_of_two)
            assert_true(fabs(mean[1] - 0.5) < 1e-5);
        free(rows);
    }
}

/// Every box of area 1/64 whose sides are powers of two has one of 64 samples: errors fall faster
/// than those of independent samples.
static void samples_are_even_in_both_directions(void **state) {
    (void)state;
    enum { COUNT = 64 };
    for (int columns = 1; columns <= COUNT; columns *= 2) {
        int rows = COUNT / columns, found[COUNT] = {0};
        for (uint32_t i = 0; i < COUNT; i++) {
            float position[2];
            passes_sample_position(i, COUNT, position);
            int column = (int)(position[0] * (float)columns);
            int row = (int)(position[1] * (float)rows);
            found[row * columns + column]++;
        }
        for (int i = 0; i < COUNT; i++)
            assert_int_equal(found[i], 1);
    }
}

/// Patterns are shifted as a whole, within the pixel, and no two by nearly the same amount.
static void patterns_are_moved_apart(void **state) {
    (void)state;
    enum { COUNT = 16, PATTERNS = 20 };
    float moved[PATTERNS][2];
    for (uint32_t pattern = 0; pattern < PATTERNS; pattern++) {
        for (uint32_t i = 0; i < COUNT; i++) {
            float plain[2], position[2];
            passes_sample_position(i, COUNT, plain);
            memcpy(position, plain, sizeof position);
            passes_sample_position_in_pattern(pattern, position);
            for (int axis = 0; axis < 2; axis++) {
                assert_true(position[axis] >= 0 && position[axis] < 1);
                float by = position[axis] - plain[axis];
                by -= floorf(by);
                if (i == 0)
                    moved[pattern][axis] = by;
                assert_true(fabsf(by - moved[pattern][axis]) < 1e-5f);
            }
        }
        for (uint32_t other = 0; other < pattern; other++) {
            double distance = 0;
            for (int axis = 0; axis < 2; axis++) {
                float by = fabsf(moved[pattern][axis] - moved[other][axis]);
                distance += pow((double)fminf(by, 1 - by), 2);
            }
            assert_true(sqrt(distance) > 0.5 / sqrt(PATTERNS));
        }
    }
    assert_true(moved[0][0] == 0 && moved[0][1] == 0);
}

/// One in each row and each column of cells.
static void spread_positions_are_even(void **state) {
    (void)state;
    enum { COUNT = 12 };
    bool taken[2][COUNT] = {0};
    for (uint32_t i = 0; i < COUNT; i++) {
        double position[2];
        passes_spread_position(i, COUNT, position);
        for (int axis = 0; axis < 2; axis++) {
            assert_true(position[axis] >= 0 && position[axis] < 1);
            bool *cell = &taken[axis][(int)(position[axis] * COUNT)];
            assert_false(*cell);
            *cell = true;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_sample_is_the_centre),
        cmocka_unit_test(any_count_is_stratified),
        cmocka_unit_test(samples_are_even_in_both_directions),
        cmocka_unit_test(patterns_are_moved_apart),
        cmocka_unit_test(spread_positions_are_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
