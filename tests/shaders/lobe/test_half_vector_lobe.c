// shaders/lib/lobe/half_vector_lobe.glsl against MPFR, and its double-precision twin.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/exact.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/half_vector_lobe.comp";
enum { LOBE, ROTATION };

enum { COUNT = 4000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static real exact_blinn_phong(const harness_arguments *at) {
    real cosine = dot(unit_vector_from(at->a), unit_vector_from(at->b));
    real exponent = real_from(at->c[1]);
    real scale = divide(add(exponent, real_from(1)), multiply(real_from(2), real_pi()));
    return multiply(scale, power(cosine, exponent));
}

static void make_lobes(void) {
    uint64_t random = 8;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        at->c[0] = i % 2 ? LOBE_DISTRIBUTION_BLINN_PHONG : LOBE_DISTRIBUTION_VMF;
        at->c[1] = i < 8 ? 0 : (float)geometric(1e-6, 1e6, i / 8, COUNT / 8);
        double width = fmin(1 / sqrt(at->c[1] + 1), 0.4);
        random_direction(&random, at->b);
        direction_at(at->b, width * (double)((i / 2) % 4), scenes_random_between(&random, 0, 6),
                     at->a);
    }
}

static void check_lobe(const harness_arguments *at, const harness_result *result) {
    release_reals();
    bool blinn_phong = at->c[0] == LOBE_DISTRIBUTION_BLINN_PHONG;
    double expected = to_double(blinn_phong ? exact_blinn_phong(at)
                                            : exact_von_mises_fisher(at->a, at->b, at->c[1]));
    // The exponent is at most 5 within three standard deviations; see test_power_of_cosine.
    check_relative("half_vector_lobe", at, result->value[0], expected, 60 * FLOAT_ROUNDING);
    if (blinn_phong)
        assert_true(result->value[0] == result->value[1]);
}

static void test_lobe(void **state) {
    make_lobes();
    harness_evaluate(state, shader, LOBE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_lobe(&arguments[i], &results[i]);
    report_worst_error("half_vector_lobe");
}

// Over u = 1 - cos in [0, 1], about the pole.
static void test_integral_over_hemisphere(void **state) {
    enum { PANELS = 20, NODES = PANELS * QUADRATURE_ORDER };
    for (size_t i = 0; i < 14; i++) {
        float exponent = i == 0 ? 0 : (float)geometric(1e-6, 1e6, i, 14);
        quadrature_node nodes[NODES];
        geometric_quadrature(fmin(0.5 / (exponent + 1), 0.5), 1, PANELS, nodes);
        for (size_t j = 0; j < NODES; j++) {
            static const float pole[3] = {0, 0, 1};
            arguments[j] =
                (harness_arguments){{0}, {0, 0, 1}, {LOBE_DISTRIBUTION_BLINN_PHONG, exponent}};
            direction_at(pole, 2 * asin(sqrt(nodes[j].x / 2)), 1, arguments[j].a);
        }
        harness_evaluate(state, shader, LOBE, arguments, NODES, results);
        double integral = 0;
        for (size_t j = 0; j < NODES; j++)
            integral += 2 * M_PI * nodes[j].weight * results[j].value[0];
        // Below 1 the lobe has a root at the horizon, which the polynomials of the quadrature do
        // not follow.
        bool root = exponent > 0 && exponent < 1;
        check_close("integral of blinn_phong_lobe", &arguments[0], integral, 1, root ? 2e-5 : 2e-6);
    }
    report_worst_error("integral of blinn_phong_lobe");
}

// Normals all over the sphere, and ever closer to either pole.
static void make_rotations(void) {
    static const float poles[2][3] = {{0, 0, 1}, {0, 0, -1}};
    uint64_t random = 9;
    for (size_t i = 0; i < COUNT; i++) {
        if (i % 2)
            random_direction(&random, arguments[i].a);
        else
            direction_at(poles[i / 2 % 2], geometric(1e-14, 1, i, COUNT),
                         scenes_random_between(&random, 0, 6), arguments[i].a);
        if (i % 5)
            random_direction(&random, arguments[i].b);
        else
            arguments[i].b[0] = arguments[i].b[1] = 0, arguments[i].b[2] = 1;
    }
}

static void check_rotation(const harness_arguments *at, const harness_result *result) {
    const double normal[3] = {at->a[0], at->a[1], at->a[2]};
    const double local[3] = {at->b[0], at->b[1], at->b[2]};
    double rotated[3];
    reference_rotate_from_pole(normal, local, rotated);
    // The rounding of the floats' lengths, 1e-7, and of the evaluation.
    for (int i = 0; i < 3; i++)
        check_close("rotate_from_pole", at, result->value[i], rotated[i],
                    2e-7 + 10 * FLOAT_ROUNDING);
}

static void test_rotation(void **state) {
    make_rotations();
    harness_evaluate(state, shader, ROTATION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_rotation(&arguments[i], &results[i]);
    report_worst_error("rotate_from_pole");
}

static void test_rotation_keeps_angles(void **state) {
    make_rotations();
    harness_evaluate(state, shader, ROTATION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *normal = arguments[i].a, *local = arguments[i].b, *v = results[i].value;
        double length = sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
        check_close("length after rotate_from_pole", &arguments[i], length, 1, 6e-7);
        // The pole goes to the normal: angles to them agree.
        double cosine =
            (double)v[0] * normal[0] + (double)v[1] * normal[1] + (double)v[2] * normal[2];
        check_close("angle after rotate_from_pole", &arguments[i], cosine, local[2], 6e-7);
    }
}

static void test_rotation_to_opposite_pole(void **state) {
    const harness_arguments half_turn = {{0, 0, -1}, {0.48f, 0.64f, 0.6f}, {0}};
    harness_result result;
    harness_evaluate(state, shader, ROTATION, &half_turn, 1, &result);
    assert_true(result.value[0] == half_turn.b[0]);
    assert_true(result.value[1] == -half_turn.b[1]);
    assert_true(result.value[2] == -half_turn.b[2]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lobe),
        cmocka_unit_test(test_integral_over_hemisphere),
        cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_rotation_keeps_angles),
        cmocka_unit_test(test_rotation_to_opposite_pole),
    };
    return cmocka_run_group_tests_name("half_vector_lobe", tests, harness_set_up,
                                       harness_tear_down);
}
