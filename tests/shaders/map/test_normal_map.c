// shaders/lib/map/normal_map.glsl against MPFR, and its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/map/normal_map.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

enum { COUNT = 2000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static real_vector exact_normal(const harness_arguments *at) {
    real one = real_from(1), two = real_from(2), scale = real_from(at->b[0]);
    const lobe_normal_encoding encoding = (lobe_normal_encoding)at->b[1];
    const bool is_signed = encoding == LOBE_NORMALS_SIGNED || encoding == LOBE_NORMALS_SIGNED_XY;
    real_vector texel = vector_from(at->a);
    real x = is_signed ? texel.x : subtract(multiply(two, texel.x), one);
    real y = is_signed ? texel.y : subtract(multiply(two, texel.y), one);
    real z = is_signed ? texel.z : subtract(multiply(two, texel.z), one);
    if (encoding == LOBE_NORMALS_UNSIGNED_XY || encoding == LOBE_NORMALS_SIGNED_XY)
        z = square_root(subtract(subtract(one, multiply(x, x)), multiply(y, y)));
    x = multiply(scale, x);
    y = multiply(scale, y);
    real length = square_root(dot((real_vector){x, y, z}, (real_vector){x, y, z}));
    return (real_vector){divide(x, length), divide(y, length), divide(z, length)};
}

static void check_normal(const harness_arguments *at, const harness_result *result) {
    release_reals();
    real_vector exact = exact_normal(at);
    const double expected[3] = {to_double(exact.x), to_double(exact.y), to_double(exact.z)};
    double twin[3];
    reference_decode_stored_normal((double[]){at->a[0], at->a[1], at->a[2]}, at->b[0],
                                   (lobe_normal_encoding)at->b[1], twin);
    for (int j = 0; j < 3; j++) {
        check_close("decode_normal", at, result->value[j], expected[j], 8 * FLOAT_ROUNDING);
        check_close("reference_decode_normal", at, twin[j], expected[j], 1e-12);
    }
}

// Texels of 8 and 16 bits and of any value in [0, 1]; scales from 0 to 10, some negative.
static void test_decode(void **state) {
    uint64_t random = 16;
    for (size_t i = 0; i < COUNT; i++) {
        for (int j = 0; j < 3; j++) {
            double value = random_number(&random);
            double steps = i % 3 == 0 ? 255 : i % 3 == 1 ? 65535 : 0x1p30;
            arguments[i].a[j] = (float)(floor(value * (steps + 1)) / steps);
        }
        arguments[i].b[0] = i % 2 ? 1 : (float)scenes_random_between(&random, -1, 10);
    }
    harness_evaluate(state, "map/normal_map.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_normal(&arguments[i], &results[i]);
    report_worst_error("decode_normal");
}

// Signed, without z, or both; x and y no longer than 0.9, so that z does not vanish.
static void test_encodings(void **state) {
    uint64_t random = 17;
    for (size_t i = 0; i < COUNT; i++) {
        const unsigned encoding = 1 + i % 3;
        arguments[i] = (harness_arguments){{0}, {1, (float)encoding}, {0}};
        for (int j = 0; j < 3; j++) {
            const double value = scenes_random_between(&random, -0.63, 0.63);
            arguments[i].a[j] =
                (float)(encoding == LOBE_NORMALS_UNSIGNED_XY ? 0.5 * value + 0.5 : value);
        }
        arguments[i].b[0] = i % 2 ? 1 : (float)scenes_random_between(&random, -1, 10);
    }
    harness_evaluate(state, "map/normal_map.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_normal(&arguments[i], &results[i]);
    report_worst_error("decode_normal of other encodings");
}

// Longer than a unit vector: in the surface. Not a number: the flat normal.
static void test_lacking_z(void **state) {
    static const harness_arguments texels[] = {
        {{0.96f, 0.72f, 5}, {1, LOBE_NORMALS_SIGNED_XY}, {0}},
        {{0.98f, 0.86f, -3}, {1, LOBE_NORMALS_UNSIGNED_XY}, {0}},
        {{NAN, 0, 1}, {1, LOBE_NORMALS_SIGNED_XY}, {0}},
        {{0, INFINITY, 1}, {1, LOBE_NORMALS_SIGNED_XY}, {0}},
        {{0, 0, NAN}, {1, LOBE_NORMALS_SIGNED_XY}, {0}},
    };
    harness_result values[5];
    harness_evaluate(state, "map/normal_map.comp", 0, texels, 5, values);
    for (int i = 0; i < 5; i++) {
        const double expected[3] = {i < 2 ? 0.8 : 0, i < 2 ? 0.6 : 0, i < 2 ? 0 : 1};
        for (int j = 0; j < 3; j++)
            assert_true(fabs(values[i].value[j] - expected[j]) < 1e-6);
    }
}

// Float textures may hold anything; lengths whose squares leave the range of float are no reason
// to lose the direction.
static void test_great_lengths(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        float size = (float)geometric(1, 1e38, i, COUNT);
        arguments[i] = (harness_arguments){{0.6f * size, -0.48f * size, 0.64f * size}, {1}, {0}};
    }
    harness_evaluate(state, "map/normal_map.comp", 0, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_normal(&arguments[i], &results[i]);
    report_worst_error("decode_normal of great length");
}

static void test_no_normal(void **state) {
    static const harness_arguments none[] = {
        {{0.5f, 0.5f, 0.5f}, {1}, {0}}, // no length
        {{0.9f, 0.1f, 0.5f}, {0}, {0}}, // none after scaling
        {{0.50000006f, 0.5f, 0.5f}, {1}, {0}},
        {{NAN, 0.5f, 1}, {1}, {0}},
        {{0.5f, NAN, 1}, {1}, {0}},
        {{0.5f, 0.5f, NAN}, {1}, {0}},
        {{INFINITY, 0.5f, 1}, {1}, {0}},
        {{0.5f, -INFINITY, 1}, {1}, {0}},
        {{3.4e38f, 0.5f, 1}, {1}, {0}}, // infinite after doubling
        {{0.7f, 0.5f, 1}, {NAN}, {0}},
        {{0.7f, 0.5f, 1}, {INFINITY}, {0}},
    };
    enum { NONE = sizeof none / sizeof *none };
    harness_result values[NONE];
    harness_evaluate(state, "map/normal_map.comp", 0, none, NONE, values);
    for (int i = 0; i < NONE; i++) {
        assert_true(values[i].value[0] == 0 && values[i].value[1] == 0);
        assert_true(values[i].value[2] == 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_decode),    cmocka_unit_test(test_encodings),
        cmocka_unit_test(test_lacking_z), cmocka_unit_test(test_great_lengths),
        cmocka_unit_test(test_no_normal),
    };
    return cmocka_run_group_tests_name("normal_map", tests, harness_set_up, harness_tear_down);
}
