// shaders/lib/lobe/lambert_plane.glsl against MPFR and its double-precision twin.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/lambert_plane.h"
#include "tests/reference/vector.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/real.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "lobe/lambert_plane.comp";
enum { PLACE, DIRECTION, ROUND_TRIP, DISTORTION };

enum { COUNT = 8000 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

/// Directions at angles from 1e-6 to 3.1 from the pole.
static void make_directions(void) {
    static const float pole[3] = {0, 0, 1};
    uint64_t random = 91;
    for (size_t i = 0; i < COUNT; i++) {
        double angle =
            i % 2 ? geometric(1e-6, 3.1, i, COUNT) : scenes_random_between(&random, 0, 3.1);
        direction_at(pole, angle, scenes_random_between(&random, 0, 2 * M_PI), arguments[i].a);
    }
}

/// Places within 0.999 of the disc of the sphere.
static void make_places(void) {
    uint64_t random = 92;
    for (size_t i = 0; i < COUNT; i++) {
        double radius =
            i % 2 ? geometric(1e-6, 1.998, i, COUNT) : 1.998 * sqrt(random_number(&random));
        double azimuth = scenes_random_between(&random, 0, 2 * M_PI);
        arguments[i].a[0] = (float)(radius * cos(azimuth));
        arguments[i].a[1] = (float)(radius * sin(azimuth));
    }
}

static void test_place(void **state) {
    make_directions();
    harness_evaluate(state, shader, PLACE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const harness_arguments *at = &arguments[i];
        const double direction[3] = {at->a[0], at->a[1], at->a[2]};
        double twin[2];
        reference_plane_from_direction(direction, twin);
        release_reals();
        real scale = divide(real_from(2), add(real_from(1), real_from(at->a[2])));
        scale = square_root(scale);
        // Off by how much a float's direction is not of unit length, the more the nearer it is to
        // the pole's opposite.
        double length = 2 * FLOAT_ROUNDING * (1 + 1 / (1 + direction[2]));
        for (int j = 0; j < 2; j++) {
            double expected = to_double(multiply(real_from(at->a[j]), scale));
            check_relative("plane_from_direction", at, results[i].value[j], expected,
                           8 * FLOAT_ROUNDING);
            check_close("reference_plane_from_direction", at, twin[j], expected,
                        2 * length * fabs(expected));
        }
    }
    report_worst_error("plane_from_direction");
}

static void test_direction(void **state) {
    make_places();
    harness_evaluate(state, shader, DIRECTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const double place[2] = {arguments[i].a[0], arguments[i].a[1]};
        double expected[3];
        reference_direction_from_plane(place, expected);
        // cos(theta / 2), which is the root of a difference, is what rounding harms.
        double height = sqrt(0.5 * (1 + expected[2]));
        for (int j = 0; j < 3; j++)
            check_close("direction_from_plane", &arguments[i], results[i].value[j], expected[j],
                        (j < 2 ? fabs(place[j]) * (2 / height + 4 * height) : 4) * FLOAT_ROUNDING);
    }
    report_worst_error("direction_from_plane");
}

static void test_round_trip(void **state) {
    make_directions();
    harness_evaluate(state, shader, ROUND_TRIP, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        // Near the pole's opposite, what a direction's length lacks of one goes into cos(theta /
        // 2).
        double height = sqrt(0.5 * (1 + (double)arguments[i].a[2]));
        for (int j = 0; j < 3; j++)
            check_close("round trip", &arguments[i], results[i].value[j], arguments[i].a[j],
                        (8 + 0.5 / pow(height, 3)) * FLOAT_ROUNDING);
    }
    report_worst_error("round trip");
}

/// Sides of a small square of the plane span as much of the sphere: in the twin, which the device
/// agrees with above.
static void test_area(void **state) {
    (void)state;
    static const double step = 1e-5;
    make_places();
    for (size_t i = 0; i < COUNT; i++) {
        double sides[2][3], length[2], product;
        for (int j = 0; j < 2; j++) {
            double ahead[3], behind[3], place[2] = {arguments[i].a[0], arguments[i].a[1]};
            place[j] += step;
            reference_direction_from_plane(place, ahead);
            place[j] -= 2 * step;
            reference_direction_from_plane(place, behind);
            for (int k = 0; k < 3; k++)
                sides[j][k] = (ahead[k] - behind[k]) / (2 * step);
            length[j] = reference_dot(sides[j], sides[j]);
        }
        product = reference_dot(sides[0], sides[1]);
        check_close("area", &arguments[i], sqrt(length[0] * length[1] - product * product), 1,
                    1e-4);
    }
}

/// J J^T by differences of the projection, as far out as distortion is bounded.
static void test_distortion(void **state) {
    make_places();
    for (size_t i = 0; i < COUNT; i++)
        for (int j = 0; j < 2; j++)
            arguments[i].a[j] *= 0.97f;
    harness_evaluate(state, shader, DISTORTION, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const double place[2] = {arguments[i].a[0], arguments[i].a[1]};
        const float *value = results[i].value;
        double expected[3], c = 1 - 0.25 * (place[0] * place[0] + place[1] * place[1]);
        reference_plane_distortion(place, expected);
        for (int j = 0; j < 3; j++)
            check_close("plane_distortion", &arguments[i], value[j], expected[j],
                        16 * FLOAT_ROUNDING / (c * c) + 1e-8 / (c * c));
        check_close("its determinant", &arguments[i],
                    (double)value[0] * (double)value[1] - (double)value[2] * (double)value[2], 1,
                    40 * FLOAT_ROUNDING / (c * c * c));
    }
    report_worst_error("plane_distortion");
}

/// The pole, its opposite and whatever lies beyond the disc of the sphere.
static void test_ends(void **state) {
    static const harness_arguments directions[] = {{{0, 0, 1}, {0}, {0}}, {{0, 0, -1}, {0}, {0}}};
    static const harness_arguments places[] = {{{0, 0}, {0}, {0}},       {{2, 0}, {0}, {0}},
                                               {{0, -2}, {0}, {0}},      {{1.99f, 0}, {0}, {0}},
                                               {{1.5f, 1.5f}, {0}, {0}}, {{1e4f, -3}, {0}, {0}}};
    enum { DIRECTIONS = 2, PLACES = 6 };
    harness_evaluate(state, shader, PLACE, directions, DIRECTIONS, results);
    assert_true(results[0].value[0] == 0 && results[0].value[1] == 0);
    assert_true(results[1].value[0] == 2 && results[1].value[1] == 0);
    harness_evaluate(state, shader, DIRECTION, places, PLACES, results);
    for (int i = 0; i < PLACES; i++) {
        double expected = i == 0 ? 1 : i == 3 ? 1 - 0.5 * 1.99 * 1.99 : -1;
        check_close("height at the rim", &places[i], results[i].value[2], expected, 1e-6);
        assert_true(isfinite(results[i].value[0]) && isfinite(results[i].value[1]));
    }
    harness_evaluate(state, shader, DISTORTION, places, PLACES, results);
    for (int i = 0; i < PLACES; i++) {
        const float *value = results[i].value;
        double determinant =
            (double)value[0] * (double)value[1] - (double)value[2] * (double)value[2];
        // A covariance still.
        if (!(value[0] > 0 && value[1] > 0 && determinant > 0.5 && value[0] + value[1] < 21))
            fail_msg("place %d: (%g, %g, %g)", i, (double)value[0], (double)value[1],
                     (double)value[2]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_place),      cmocka_unit_test(test_direction),
        cmocka_unit_test(test_round_trip), cmocka_unit_test(test_area),
        cmocka_unit_test(test_distortion), cmocka_unit_test(test_ends),
    };
    return cmocka_run_group_tests_name("lambert_plane", tests, harness_set_up, harness_tear_down);
}
