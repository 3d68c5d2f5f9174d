// shaders/lib/map/box_reduction.glsl: the weights of each texel, and that the mean is kept.

#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"

static const char shader[] = "map/box_reduction.comp";
enum { WEIGHTS, TAPS };

enum { MOST_TARGETS = 4096 };
static harness_arguments arguments[MOST_TARGETS];
static harness_result results[MOST_TARGETS];

static const uint32_t sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 31, 64, 335, 457, 671, 1024, 8191};
enum { SIZE_COUNT = sizeof sizes / sizeof *sizes };

static uint32_t target_size(uint32_t size) {
    return size > 1 ? size / 2 : 1;
}

static void check_weights(uint32_t size, uint32_t target, const harness_result *result) {
    double sum = 0;
    for (uint32_t tap = 0; tap < 3; tap++) {
        uint32_t texel = 2 * target + tap;
        double expected = texel < size ? reference_box_weight(texel, size, target) : 0;
        check_close("box_weights", &arguments[target], result->value[tap], expected,
                    2 * FLOAT_ROUNDING);
        sum += result->value[tap];
    }
    check_close("sum of box_weights", &arguments[target], sum, 1, 3 * FLOAT_ROUNDING);
}

static void test_weights(void **state) {
    for (size_t i = 0; i < SIZE_COUNT; i++) {
        uint32_t count = target_size(sizes[i]);
        for (uint32_t j = 0; j < count; j++)
            arguments[j] = (harness_arguments){{(float)sizes[i], (float)j}, {0}, {0}};
        harness_evaluate(state, shader, WEIGHTS, arguments, count, results);
        for (uint32_t j = 0; j < count; j++)
            check_weights(sizes[i], j, &results[j]);
    }
    report_worst_error("box_weights");
}

// Each source texel counts as much as any other: its weights add up to target over source size.
static void test_mean_is_kept(void **state) {
    for (size_t i = 0; i < SIZE_COUNT; i++) {
        static double total[2 * MOST_TARGETS + 3];
        uint32_t size = sizes[i], count = target_size(size);
        for (uint32_t j = 0; j < count; j++)
            arguments[j] = (harness_arguments){{(float)size, (float)j}, {0}, {0}};
        harness_evaluate(state, shader, WEIGHTS, arguments, count, results);
        for (uint32_t k = 0; k < size; k++)
            total[k] = 0;
        for (uint32_t j = 0; j < count; j++)
            for (uint32_t tap = 0; tap < 3 && 2 * j + tap < size; tap++)
                total[2 * j + tap] += results[j].value[tap];
        for (uint32_t k = 0; k < size; k++)
            check_close("total weight of a texel", &arguments[0], total[k], (double)count / size,
                        3 * FLOAT_ROUNDING);
    }
}

static void test_taps(void **state) {
    for (size_t i = 0; i < SIZE_COUNT; i++)
        arguments[i] = (harness_arguments){{(float)sizes[i]}, {0}, {0}};
    harness_evaluate(state, shader, TAPS, arguments, SIZE_COUNT, results);
    for (size_t i = 0; i < SIZE_COUNT; i++) {
        uint32_t taps = sizes[i] == 1 ? 1 : sizes[i] % 2 ? 3 : 2;
        assert_int_equal(results[i].value[0], taps);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_weights),
        cmocka_unit_test(test_mean_is_kept),
        cmocka_unit_test(test_taps),
    };
    return cmocka_run_group_tests_name("box_reduction", tests, harness_set_up, harness_tear_down);
}
