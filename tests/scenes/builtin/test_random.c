#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdlib.h>

#include "scenes/builtin/random.h"

// The first outputs that O'Neill's own pcg32_oneseq prints for seed 42.
static void follows_the_published_sequence(void **state) {
    (void)state;
    static const uint32_t expected[] = {0xc2f57bd6, 0x6b07c4a9, 0x72b7b29b,
                                        0x44215383, 0xf5af5ead, 0x68beb632};
    random_sequence sequence = scenes_random_start(42);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(scenes_random_bits(&sequence), expected[i]);
}

static void between_is_uniform(void **state) {
    (void)state;
    enum { COUNT = 100000, BINS = 20 };
    int bins[BINS] = {0};
    random_sequence sequence = scenes_random_start(1);
    for (int i = 0; i < COUNT; i++) {
        double value = scenes_random_between(&sequence, -3, 2);
        assert_true(value >= -3 && value < 2);
        bins[(int)((value + 3) / 5 * BINS)]++;
    }
    // Five standard deviations of a bin's count.
    for (int i = 0; i < BINS; i++)
        assert_true(fabs(bins[i] - (double)COUNT / BINS) < 5 * sqrt((double)COUNT / BINS));
}

static void lattice_depends_on_each_argument(void **state) {
    (void)state;
    double correlation[3] = {0, 0, 0};
    int ones[32] = {0};
    enum { EXTENT = 128 };
    for (uint32_t y = 0; y < EXTENT; y++)
        for (uint32_t x = 0; x < EXTENT; x++) {
            uint32_t bits = scenes_random_lattice(x, y, 5);
            uint32_t others[3] = {scenes_random_lattice(x + 1, y, 5),
                                  scenes_random_lattice(x, y + 1, 5),
                                  scenes_random_lattice(x, y, 6)};
            for (int i = 0; i < 3; i++)
                correlation[i] += (bits / 2147483648.0 - 1) * (others[i] / 2147483648.0 - 1);
            for (int bit = 0; bit < 32; bit++)
                ones[bit] += bits >> bit & 1;
        }
    // The product of independent uniform numbers has variance 1/9.
    for (int i = 0; i < 3; i++)
        assert_true(fabs(correlation[i]) < 5 * EXTENT / 3.0);
    for (int bit = 0; bit < 32; bit++)
        assert_true(abs(ones[bit] - EXTENT * EXTENT / 2) < 5 * EXTENT / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_the_published_sequence),
        cmocka_unit_test(between_is_uniform),
        cmocka_unit_test(lattice_depends_on_each_argument),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
