// shaders/lib/map/footprint.glsl against the singular values of the Jacobian.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "map/footprint.comp";
enum { AXES, LEVEL };

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

// The Jacobian is built from its singular values, in [1e-4, 1e4] with ratios up to 1e4, between two
// rotations; `major` and `minor` are those of the rounded matrix.
static void make_jacobians(double *major, double *minor) {
    uint64_t random = 20;
    for (size_t i = 0; i < COUNT; i++) {
        double u = scenes_random_between(&random, 0, 7), v = scenes_random_between(&random, 0, 7);
        // A quarter of them within 1e-3 of lying along an axis of the map.
        if (i % 4 == 1)
            u = (double)(i / 4 % 4) * M_PI / 2 + 1e-3 * (u - 3.5) / 3.5;
        double s = geometric(1e-4, 1e4, i, COUNT);
        double t = i % 8 == 0 ? s : s * geometric(1e-4, 1, (i * 7) % COUNT, COUNT);
        float *j = arguments[i].a; // dx.x, dx.y, dy.x, dy.y
        j[0] = (float)(s * cos(u) * cos(v) - t * sin(u) * sin(v));
        j[1] = (float)(s * sin(u) * cos(v) + t * cos(u) * sin(v));
        j[2] = (float)(-s * cos(u) * sin(v) - t * sin(u) * cos(v));
        j[3] = (float)(-s * sin(u) * sin(v) + t * cos(u) * cos(v));
        // Blinn, 1996, Consider the Lowly 2x2 Matrix: sums and differences of the two.
        double sum = hypot(j[0] + (double)j[3], j[1] - (double)j[2]);
        double difference = hypot(j[0] - (double)j[3], j[1] + (double)j[2]);
        major[i] = 0.5 * (sum + difference);
        minor[i] = 0.5 * fabs(sum - difference);
    }
}

// Length of the footprint along its major axis: |J^T direction|.
static double extent_along(const float *j, const float *direction) {
    return hypot((double)j[0] * direction[0] + (double)j[1] * direction[1],
                 (double)j[2] * direction[0] + (double)j[3] * direction[1]);
}

static void test_axes(void **state) {
    static double major[COUNT], minor[COUNT];
    make_jacobians(major, minor);
    harness_evaluate(state, shader, AXES, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const float *value = results[i].value;
        check_relative("major axis", at, value[0], major[i], 8 * FLOAT_ROUNDING);
        // The determinant cancels against the product of the lengths.
        check_close("minor axis", at, value[1], minor[i],
                    8 * FLOAT_ROUNDING * (minor[i] + major[i]));
        check_close("length of the direction", at, hypot(value[2], value[3]), 1,
                    8 * FLOAT_ROUNDING);
        check_close("extent along the major axis", at, extent_along(at->a, value + 2), major[i],
                    2e-6 * major[i]);
    }
    report_worst_error("footprint_of");
}

static void test_level(void **state) {
    static double major[COUNT], minor[COUNT];
    make_jacobians(major, minor);
    for (size_t i = 0; i < COUNT; i++)
        arguments[i].b[0] = (float)(1 + i % 16);
    harness_evaluate(state, shader, LEVEL, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double extent = fmax(fmax(major[i] / arguments[i].b[0], minor[i]), 1e-6);
        // The minor axis is good to 1e-6 of the major one, which may be 16 times as long.
        check_close("level_of", &arguments[i], results[i].value[0], log2(extent), 2e-5);
    }
    report_worst_error("level_of");
}

static void test_no_extent(void **state) {
    static const harness_arguments none[] = {
        {{0, 0, 0, 0}, {1}, {0}}, {{3, 0, 0, 0}, {1}, {0}}, {{0, 0, 0, 3}, {1}, {0}}};
    static const float major[] = {0, 3, 3};
    harness_result axes[3], levels[3];
    harness_evaluate(state, shader, AXES, none, 3, axes);
    harness_evaluate(state, shader, LEVEL, none, 3, levels);
    for (int i = 0; i < 3; i++) {
        assert_true(axes[i].value[0] == major[i] && axes[i].value[1] == 0);
        assert_true(isfinite(levels[i].value[0]));
        check_close("length of the direction", &none[i], hypot(axes[i].value[2], axes[i].value[3]),
                    1, 1e-6);
        check_close("extent along the major axis", &none[i],
                    extent_along(none[i].a, axes[i].value + 2), major[i], 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axes),
        cmocka_unit_test(test_level),
        cmocka_unit_test(test_no_extent),
    };
    return cmocka_run_group_tests_name("footprint", tests, harness_set_up, harness_tear_down);
}
