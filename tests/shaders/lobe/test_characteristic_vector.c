// shaders/lib/lobe/characteristic_vector.glsl against MPFR.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/exact.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/characteristic_vector.comp";
enum { VECTOR, CONCENTRATION, MEAN_DIRECTION };

enum { COUNT = 2000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void test_characteristic_vector(void **state) {
    uint64_t random = 3;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        arguments[i].b[0] = i == 0 ? 0 : (float)geometric(1e-8, 1e6, i, COUNT);
    }
    harness_evaluate(state, shader, VECTOR, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        real kappa = real_from(arguments[i].b[0]);
        double length = to_double(exact_resultant(kappa));
        // R(kappa) is good to 5e-7, see test_von_mises_fisher, and is multiplied once.
        for (int j = 0; j < 3; j++)
            check_relative("characteristic_vector", &arguments[i], results[i].value[j],
                           length * arguments[i].a[j], 6e-7);
        check_relative("characteristic_vector complement", &arguments[i], results[i].value[3],
                       to_double(exact_resultant_complement(kappa)), 5e-7);
    }
    report_worst_error("characteristic_vector");
}

// A weighted sum of vectors as a map holds it, in float, and the exact 1 - |r| of a lobe.
static void make_vectors(void) {
    uint64_t random = 4;
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        harness_arguments *at = &arguments[i];
        real kappa = real_from(geometric(1e-6, 1e6, i, COUNT));
        double weight = i % 2 ? 1 : scenes_random_between(&random, 1e-3, 1);
        double length = weight * to_double(exact_resultant(kappa));
        random_direction(&random, at->a);
        for (int j = 0; j < 3; j++)
            at->a[j] *= (float)length;
        at->b[0] = (float)weight;
        at->b[1] = (float)to_double(exact_resultant_complement(kappa));
    }
}

// What the floats of r say, whatever lobe they came from.
static void check_concentration(const harness_arguments *at, const harness_result *result) {
    release_reals();
    real_vector sum = vector_from(at->a);
    real length = square_root(dot(sum, sum));
    real resultant = divide(length, real_from(at->b[0]));
    double complement = fmax(1 - to_double(resultant), 0);
    // |r| is rounded four times: 1 - |r| is off by as much in absolute terms.
    double rounding = 4 * FLOAT_ROUNDING;
    check_close("resultant_complement", at, result->value[0], complement,
                rounding + FLOAT_ROUNDING * complement);
    if (at->b[0] != 1)
        return;
    // So kappa lies between those of both ends: anywhere above 2e5 or so for the sharpest lobes,
    // which is why 1 - |r| can be carried beside r.
    double low = reference_concentration_from_complement(fmin(complement + rounding, 1));
    double high = reference_concentration_from_complement(fmax(complement - rounding, 1e-6));
    check_close("concentration_of", at, result->value[1], 0.5 * (low + high),
                0.5 * (high - low) + 9e-6 * high);
}

static void test_concentration(void **state) {
    make_vectors();
    harness_evaluate(state, shader, CONCENTRATION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        check_concentration(&arguments[i], &results[i]);
        // With the complement beside it, kappa is that of the lobe, up to the fit's 6.6e-6.
        if (i % 2)
            check_relative("concentration_of with complement", &arguments[i], results[i].value[2],
                           geometric(1e-6, 1e6, i, COUNT), 9e-6);
    }
    report_worst_error("resultant_complement, concentration_of");
}

static void test_no_weight_is_a_uniform_lobe(void **state) {
    const harness_arguments empty[] = {
        {{0, 0, 0}, {0, 1}, {0}}, {{1e-3f, 0, 0}, {0, 1}, {0}}, {{0, 0, 0}, {1, 1}, {0}}};
    harness_result values[3];
    harness_evaluate(state, shader, CONCENTRATION, empty, 3, values);
    for (int i = 0; i < 3; i++)
        assert_true(values[i].value[0] == 1);
    assert_true(values[0].value[1] == 0 && values[2].value[1] == 0);
    assert_true(values[0].value[2] == 0 && values[2].value[2] == 0);
}

static void test_vector_longer_than_its_weight(void **state) {
    // Sums are rounded: the length may come out above the weight.
    const harness_arguments longer = {{0.3000001f, 0, 0}, {0.3f, 0}, {0}};
    harness_result value;
    harness_evaluate(state, shader, CONCENTRATION, &longer, 1, &value);
    assert_true(value.value[0] == 0);
}

static void test_mean_direction(void **state) {
    uint64_t random = 5;
    for (size_t i = 0; i < COUNT; i++) {
        double length = geometric(1e-29, 1e30, i, COUNT);
        random_direction(&random, arguments[i].a);
        for (int j = 0; j < 3; j++) {
            arguments[i].a[j] *= (float)length;
            arguments[i].b[j] = 2;
        }
    }
    harness_evaluate(state, shader, MEAN_DIRECTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        release_reals();
        real_vector exact = unit_vector_from(arguments[i].a);
        const real expected[3] = {exact.x, exact.y, exact.z};
        for (int j = 0; j < 3; j++)
            check_close("mean_direction", &arguments[i], results[i].value[j],
                        to_double(expected[j]), 8 * FLOAT_ROUNDING);
    }
    report_worst_error("mean_direction");
}

static void test_no_direction(void **state) {
    const harness_arguments none[] = {{{0, 0, 0}, {0.6f, 0, 0.8f}, {0}},
                                      {{-0.0f, 0, 0}, {0.6f, 0, 0.8f}, {0}},
                                      {{1e-38f, -1e-40f, 0}, {0.6f, 0, 0.8f}, {0}}};
    harness_result values[3];
    harness_evaluate(state, shader, MEAN_DIRECTION, none, 3, values);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            assert_true(values[i].value[j] == none[i].b[j]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_characteristic_vector),
        cmocka_unit_test(test_concentration),
        cmocka_unit_test(test_no_weight_is_a_uniform_lobe),
        cmocka_unit_test(test_vector_longer_than_its_weight),
        cmocka_unit_test(test_mean_direction),
        cmocka_unit_test(test_no_direction),
    };
    return cmocka_run_group_tests_name("characteristic_vector", tests, harness_set_up,
                                       harness_tear_down);
}
