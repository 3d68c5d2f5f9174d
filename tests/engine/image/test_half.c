#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include "engine/image/half.h"

static void every_half_survives_the_way_through_float(void **state) {
    (void)state;
    for (uint32_t half = 0; half < 65536; half++) {
        float value = engine_half_to_float((uint16_t)half);
        uint16_t back = engine_half_from_float(value);
        if (isnan(value))
            assert_true(isnan(engine_half_to_float(back)));
        else
            assert_int_equal(back, half);
    }
}

static void values_are_those_of_the_format(void **state) {
    (void)state;
    // sign, exponent and fraction taken apart by the definition of binary16
    for (uint32_t half = 0; half < 0x7c00; half++) {
        int exponent = (int)(half >> 10);
        double fraction = (double)(half & 0x3ff) / 1024.0;
        double expected =
            exponent == 0 ? ldexp(fraction, -14) : ldexp(1.0 + fraction, exponent - 15);
        assert_true((double)engine_half_to_float((uint16_t)half) == expected);
        assert_true((double)engine_half_to_float((uint16_t)(half | 0x8000)) == -expected);
    }
    assert_true(isinf(engine_half_to_float(0x7c00)));
    assert_true(isnan(engine_half_to_float(0x7c01)));
}

static void floats_go_to_the_nearest_half_and_ties_to_even(void **state) {
    (void)state;
    for (uint32_t half = 0; half < 0x7bff; half++) {
        float low = engine_half_to_float((uint16_t)half);
        float high = engine_half_to_float((uint16_t)(half + 1));
        float middle = 0.5f * (low + high); // exact in float
        assert_int_equal(engine_half_from_float(middle), half + (half & 1));
        assert_int_equal(engine_half_from_float(nextafterf(middle, 0.0f)), half);
        assert_int_equal(engine_half_from_float(nextafterf(middle, INFINITY)), half + 1);
        assert_int_equal(engine_half_from_float(-nextafterf(middle, 0.0f)), half | 0x8000);
    }
}

static void large_values_overflow_where_rounding_would(void **state) {
    (void)state;
    assert_int_equal(engine_half_from_float(65504.0f), 0x7bff);
    assert_int_equal(engine_half_from_float(nextafterf(65520.0f, 0.0f)), 0x7bff);
    assert_int_equal(engine_half_from_float(65520.0f), 0x7c00);
    assert_int_equal(engine_half_from_float(-1e30f), 0xfc00);
    assert_int_equal(engine_half_from_float(INFINITY), 0x7c00);
    assert_int_equal(engine_half_from_float(1e-30f), 0);
    assert_int_equal(engine_half_from_float(-0.0f), 0x8000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_survives_the_way_through_float),
        cmocka_unit_test(values_are_those_of_the_format),
        cmocka_unit_test(floats_go_to_the_nearest_half_and_ties_to_even),
        cmocka_unit_test(large_values_overflow_where_rounding_would),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
