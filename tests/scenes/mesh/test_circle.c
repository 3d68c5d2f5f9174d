#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "scenes/mesh/circle.h"

static void agrees_with_extended_precision(void **state) {
    (void)state;
    for (int i = -3000; i <= 3000; i++) {
        double turns = i / 1024.0, point[2]; // exact, so that the reduction rounds nothing
        scenes_circle_point(turns, point);
        long double angle = 6.283185307179586476925286766559L * turns;
        assert_true(fabsl(point[0] - cosl(angle)) < 4e-16L);
        assert_true(fabsl(point[1] - sinl(angle)) < 4e-16L);
    }
}

static void quarter_turns_are_exact(void **state) {
    (void)state;
    static const double expected[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int i = -8; i < 8; i++) {
        double point[2];
        scenes_circle_point(i / 4.0, point);
        assert_true(point[0] == expected[(i + 8) % 4][0]);
        assert_true(point[1] == expected[(i + 8) % 4][1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_extended_precision),
        cmocka_unit_test(quarter_turns_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
