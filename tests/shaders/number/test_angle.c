// shaders/lib/number/angle.glsl against MPFR.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 2000 };

static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// Pairs at angles from 1e-7 to 3, and a quarter of them 1e-6 to 0.1 from being opposite.
static void make_pairs(void) {
    uint64_t random = 1;
    for (size_t i = 0; i < COUNT; i++) {
        double angle = i % 4 ? geometric(1e-7, 3, i, COUNT) : M_PI - geometric(1e-6, 0.1, i, COUNT);
        random_direction(&random, arguments[i].a);
        direction_at(arguments[i].a, angle, scenes_random_between(&random, 0, 2 * M_PI),
                     arguments[i].b);
    }
}

static real_vector exact_half_vector(const harness_arguments *pair) {
    real_vector a = vector_from(pair->a), b = vector_from(pair->b);
    real_vector sum = {add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
    real length = square_root(dot(sum, sum));
    return (real_vector){divide(sum.x, length), divide(sum.y, length), divide(sum.z, length)};
}

static void test_half_vector(void **state) {
    make_pairs();
    harness_evaluate(state, "number/angle.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        real_vector exact = exact_half_vector(&arguments[i]);
        const real expected[3] = {exact.x, exact.y, exact.z};
        // One rounding for the sum, three for its square, 2 units in the last place for the root.
        for (int j = 0; j < 3; j++)
            check_close("half_vector", &arguments[i], results[i].value[j], to_double(expected[j]),
                        8 * FLOAT_ROUNDING);
    }
    report_worst_error("half_vector");
}

static void test_half_vector_of_opposite_directions(void **state) {
    const harness_arguments opposite = {{0.6f, 0, 0.8f}, {-0.6f, 0, -0.8f}, {0}};
    harness_result result;
    harness_evaluate(state, "number/angle.comp", 0, &opposite, 1, &result);
    for (int i = 0; i < 3; i++)
        assert_true(result.value[i] == 0);
}

static void check_angle(const harness_arguments *pair, const harness_result *result) {
    release_reals();
    real cosine = dot(unit_vector_from(pair->a), unit_vector_from(pair->b));
    real one = real_from(1);
    double difference = to_double(multiply(real_from(2), subtract(one, cosine)));
    double sine_squared = to_double(subtract(one, square(cosine)));
    // The floats' lengths are off by up to 1e-7 each: their product scales the difference, their
    // own difference adds its square. Ten roundings of the evaluation.
    double relative = 2e-7 + 10 * FLOAT_ROUNDING, absolute = 4e-14;
    check_close("difference_squared", pair, result->value[0], difference,
                relative * difference + absolute);
    // Beyond a right angle 1 - d/4 cancels.
    double cancelled = difference > 2 ? 4 * relative : 0;
    check_close("sine_squared_between", pair, result->value[1], sine_squared,
                relative * sine_squared + absolute + cancelled);
}

static void test_difference(void **state) {
    make_pairs();
    harness_evaluate(state, "number/angle.comp", 1, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_angle(&arguments[i], &results[i]);
    report_worst_error("difference_squared, sine_squared_between");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_half_vector),
        cmocka_unit_test(test_half_vector_of_opposite_directions),
        cmocka_unit_test(test_difference),
    };
    return cmocka_run_group_tests_name("angle", tests, harness_set_up, harness_tear_down);
}
