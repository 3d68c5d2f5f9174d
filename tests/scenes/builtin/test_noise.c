#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "scenes/builtin/noise.h"
#include "scenes/builtin/random.h"

enum { PERIOD = 13, SEED = 3 };

static void slope_is_the_derivative(void **state) {
    (void)state;
    const double step = 1e-5;
    random_sequence sequence = scenes_random_start(1);
    for (int i = 0; i < 1000; i++) {
        double x = scenes_random_between(&sequence, -20, 20),
               y = scenes_random_between(&sequence, -20, 20);
        double slope[2];
        double height = scenes_noise_gradient(x, y, PERIOD, SEED, slope);
        assert_true(fabs(height) < 1);
        double along_x = scenes_noise_gradient(x + step, y, PERIOD, SEED, NULL) -
                         scenes_noise_gradient(x - step, y, PERIOD, SEED, NULL);
        double along_y = scenes_noise_gradient(x, y + step, PERIOD, SEED, NULL) -
                         scenes_noise_gradient(x, y - step, PERIOD, SEED, NULL);
        assert_true(fabs(slope[0] - along_x / (2 * step)) < 1e-7);
        assert_true(fabs(slope[1] - along_y / (2 * step)) < 1e-7);
    }
}

static void repeats_after_its_period(void **state) {
    (void)state;
    // Binary fractions, to which the period can be added without rounding.
    for (int i = -40; i < 40; i++) {
        double x = i * 0.375, y = i * 0.625, slope[2], moved_slope[2];
        double height = scenes_noise_gradient(x, y, PERIOD, SEED, slope);
        double moved = scenes_noise_gradient(x + PERIOD, y - 2 * PERIOD, PERIOD, SEED, moved_slope);
        assert_true(height == moved);
        assert_true(slope[0] == moved_slope[0] && slope[1] == moved_slope[1]);
    }
}

static void is_zero_at_lattice_points_and_on_average(void **state) {
    (void)state;
    enum { EXTENT = 64, STEPS = 8 };
    double sum = 0, squares = 0;
    for (int y = 0; y < EXTENT * STEPS; y++)
        for (int x = 0; x < EXTENT * STEPS; x++) {
            double height =
                scenes_noise_gradient((double)x / STEPS, (double)y / STEPS, EXTENT, SEED, NULL);
            if (x % STEPS == 0 && y % STEPS == 0)
                assert_true(height == 0);
            sum += height;
            squares += height * height;
        }
    double count = (double)EXTENT * EXTENT * STEPS * STEPS;
    assert_true(fabs(sum / count) < 0.01);
    assert_true(sqrt(squares / count) > 0.1 && sqrt(squares / count) < 0.4);
}

static void seeds_give_different_noise(void **state) {
    (void)state;
    int equal = 0;
    for (int i = 0; i < 100; i++)
        equal += scenes_noise_gradient(i * 0.37, i * 0.73, PERIOD, 1, NULL) ==
                 scenes_noise_gradient(i * 0.37, i * 0.73, PERIOD, 2, NULL);
    assert_true(equal < 3); // the lattice point (0, 0) is one of them
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slope_is_the_derivative),
        cmocka_unit_test(repeats_after_its_period),
        cmocka_unit_test(is_zero_at_lattice_points_and_on_average),
        cmocka_unit_test(seeds_give_different_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
