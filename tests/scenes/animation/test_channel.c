// Values of channels between keys: against the formulas of glTF 2.0, appendix C, evaluated in
// another way and in extended precision.

#include "tests/engine/support/cmocka_all.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "scenes/animation/channel.h"

#define KEYS 4

static float times[KEYS] = {0.25f, 1, 1.5f, 4};

static double random_number(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 8388608.0 - 1;
}

static void fill(float *values, size_t count, uint32_t seed) {
    for (size_t i = 0; i < count; i++)
        values[i] = (float)(3 * random_number(&seed));
}

/// The key at or before a time, and how far the time is from it to the next.
static int locate(double seconds, long double *part) {
    int key = 0;
    while (key < KEYS - 2 && times[key + 1] <= seconds)
        key++;
    *part = ((long double)seconds - times[key]) / ((long double)times[key + 1] - times[key]);
    return key;
}

static void near(const double *values, const long double *expected, size_t count,
                 double tolerance) {
    for (size_t i = 0; i < count; i++)
        if (!(fabsl(values[i] - expected[i]) <= tolerance))
            fail_msg("value %zu is %.17g instead of %.17Lg", i, values[i], expected[i]);
}

// ---------------------------------------------------------------------------------------------
// Step and linear

static void steps_hold_their_key(void **state) {
    (void)state;
    float values[3 * KEYS];
    fill(values, 3 * KEYS, 1);
    const lobe_animation_channel channel = {
        0, LOBE_CHANNEL_SCALE, LOBE_INTERPOLATION_STEP, times, KEYS, 3, values, 0};
    for (double seconds = -1; seconds < 6; seconds += 0.125) {
        int key = 0;
        while (key < KEYS - 1 && times[key + 1] <= seconds)
            key++;
        double result[3];
        scenes_channel_evaluate(&channel, seconds, result);
        for (int i = 0; i < 3; i++)
            assert_true(result[i] == values[3 * key + i]);
    }
}

static void lines_join_keys(void **state) {
    (void)state;
    enum { WIDTH = 7 }; // morph weights
    float values[WIDTH * KEYS];
    fill(values, WIDTH * KEYS, 2);
    const lobe_animation_channel channel = {
        0, LOBE_CHANNEL_WEIGHTS, LOBE_INTERPOLATION_LINEAR, times, KEYS, WIDTH, values, 0};
    for (double seconds = 0.25; seconds <= 4; seconds += 0.01) {
        long double part, expected[WIDTH];
        const int key = locate(seconds, &part);
        for (int i = 0; i < WIDTH; i++)
            expected[i] =
                values[key * WIDTH + i] +
                part * ((long double)values[(key + 1) * WIDTH + i] - values[key * WIDTH + i]);
        double result[WIDTH];
        scenes_channel_evaluate(&channel, seconds, result);
        near(result, expected, WIDTH, 1e-13);
    }
}

// ---------------------------------------------------------------------------------------------
// Rotations

static void multiply(const long double a[4], const long double b[4], long double out[4]) {
    out[0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
    out[1] = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
    out[2] = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
    out[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

static void load_unit(const float *from, long double out[4]) {
    long double square = 0;
    for (int i = 0; i < 4; i++)
        square += (long double)from[i] * from[i];
    for (int i = 0; i < 4; i++)
        out[i] = from[i] / sqrtl(square);
}

/// q0 (q0^-1 q1)^t by the axis and angle of the rotation in between: not the formula with sines.
static void slerp(const float *from, const float *to, long double part, long double out[4]) {
    long double a[4], b[4], inverse[4], between[4], powered[4];
    load_unit(from, a);
    load_unit(to, b);
    for (int i = 0; i < 4; i++)
        inverse[i] = i < 3 ? -a[i] : a[i];
    multiply(inverse, b, between);
    if (between[3] < 0)
        for (int i = 0; i < 4; i++)
            between[i] = -between[i];
    const long double sine =
        sqrtl(between[0] * between[0] + between[1] * between[1] + between[2] * between[2]);
    const long double half = atan2l(sine, between[3]);
    for (int i = 0; i < 3; i++)
        powered[i] = sine > 0 ? between[i] / sine * sinl(part * half) : 0;
    powered[3] = cosl(part * half);
    multiply(a, powered, out);
}

static void rotations_turn_at_constant_speed(void **state) {
    (void)state;
    float values[4 * KEYS];
    fill(values, 4 * KEYS, 3); // of any length, some of them on opposite sides
    const lobe_animation_channel channel = {
        0, LOBE_CHANNEL_ROTATION, LOBE_INTERPOLATION_LINEAR, times, KEYS, 4, values, 0};
    for (double seconds = 0.25; seconds <= 4; seconds += 0.01) {
        long double part, expected[4], square = 0;
        const int key = locate(seconds, &part);
        slerp(values + 4 * key, values + 4 * (key + 1), part, expected);
        double result[4];
        scenes_channel_evaluate(&channel, seconds, result);
        if (seconds == 0.25)
            continue; // the key itself, of any length
        near(result, expected, 4, 1e-13);
        for (int i = 0; i < 4; i++)
            square += result[i] * result[i];
        assert_true(fabsl(square - 1) < 1e-13);
    }
}

/// Where sines vanish: equal keys, nearly equal ones, opposite ones (the same rotation), half
/// turns.
static void rotations_at_their_limits(void **state) {
    (void)state;
    static const float pairs[][8] = {{0, 0, 0, 1, 0, 0, 0, 1},       {0, 0, 0, 1, 1e-7f, 0, 0, 1},
                                     {0, 0, 0, 1, 0, 0, 0, -1},      {0, 0, 0, 1, 1, 0, 0, 0},
                                     {0, 0, 0, 1, 1, 0, 0, -1e-7f},  {1, 0, 0, 0, -1, 1e-5f, 0, 0},
                                     {0, 0, 0, 1e-3f, 0, 0, 1e3f, 1}};
    float two[2] = {0, 1};
    for (size_t n = 0; n < sizeof pairs / sizeof *pairs; n++) {
        float values[8];
        memcpy(values, pairs[n], sizeof values);
        const lobe_animation_channel channel = {
            0, LOBE_CHANNEL_ROTATION, LOBE_INTERPOLATION_LINEAR, two, 2, 4, values, 0};
        for (double part = 0.1; part < 1; part += 0.1) {
            long double expected[4];
            double result[4];
            slerp(values, values + 4, part, expected);
            scenes_channel_evaluate(&channel, part, result);
            near(result, expected, 4, 1e-12);
        }
    }
}

// ---------------------------------------------------------------------------------------------
// Cubic splines

/// De Casteljau's algorithm on the Bezier points of the same curve.
static long double bezier(long double from, long double out_tangent, long double to,
                          long double in_tangent, long double seconds, long double t) {
    long double p[4] = {from, from + seconds * out_tangent / 3, to - seconds * in_tangent / 3, to};
    for (int level = 3; level > 0; level--)
        for (int i = 0; i < level; i++)
            p[i] += t * (p[i + 1] - p[i]);
    return p[0];
}

static void check_spline(lobe_channel_path path, size_t width, uint32_t seed) {
    float values[3 * 8 * KEYS];
    fill(values, 3 * width * KEYS, seed);
    const lobe_animation_channel channel = {
        0, path, LOBE_INTERPOLATION_CUBIC, times, (size_t)KEYS, width, values, 0};
    for (double seconds = 0.2; seconds <= 4.1; seconds += 0.013) {
        const double clamped = fmin(fmax(seconds, times[0]), times[KEYS - 1]);
        long double part, expected[8];
        const int key = locate(clamped, &part);
        const float *from = values + width * (3 * (size_t)key + 1), *to = from + 3 * width;
        const long double length = (long double)times[key + 1] - times[key];
        for (size_t i = 0; i < width; i++)
            expected[i] = bezier(from[i], from[width + i], to[i], to[i - width], length, part);
        double result[8];
        scenes_channel_evaluate(&channel, seconds, result);
        near(result, expected, width, 1e-12);
    }
}

static void splines_are_hermite(void **state) {
    (void)state;
    check_spline(LOBE_CHANNEL_TRANSLATION, 3, 4);
    check_spline(LOBE_CHANNEL_ROTATION, 4, 5);
    check_spline(LOBE_CHANNEL_SCALE, 3, 6);
    check_spline(LOBE_CHANNEL_WEIGHTS, 8, 7);
    check_spline(LOBE_CHANNEL_WEIGHTS, 1, 8);
}

/// From a quaternion to its opposite, without tangents, the curve passes through zero.
static void splines_of_rotations_never_vanish(void **state) {
    (void)state;
    float two[2] = {0, 1};
    float values[24] = {[7] = 1, [19] = -1};
    const lobe_animation_channel channel = {
        0, LOBE_CHANNEL_ROTATION, LOBE_INTERPOLATION_CUBIC, two, 2, 4, values, 0};
    for (double part = 0; part <= 1; part += 0.125) {
        double result[4];
        scenes_channel_evaluate(&channel, part, result);
        assert_true(fabs(result[3]) > 1e-4);
    }
}

// ---------------------------------------------------------------------------------------------
// Ends

static void before_and_after_keys_stay(void **state) {
    (void)state;
    static const double outside[] = {-INFINITY, -1, 0, 0.25, 4, 4.5, 1e30, INFINITY};
    float values[9 * KEYS];
    fill(values, 9 * KEYS, 9);
    for (int interpolation = 0; interpolation < 3; interpolation++) {
        lobe_animation_channel channel = {
            0, LOBE_CHANNEL_TRANSLATION, (lobe_interpolation)interpolation, times, KEYS, 3, values,
            0};
        const bool cubic = interpolation == LOBE_INTERPOLATION_CUBIC;
        for (channel.key_count = 1; channel.key_count <= KEYS; channel.key_count += KEYS - 1)
            for (size_t n = 0; n < sizeof outside / sizeof *outside; n++) {
                const size_t key = outside[n] > 1 ? channel.key_count - 1 : 0;
                double result[3];
                scenes_channel_evaluate(&channel, outside[n], result);
                for (size_t i = 0; i < 3; i++)
                    assert_true(result[i] == values[3 * (cubic ? 3 * key + 1 : key) + i]);
            }
        double result[3];
        scenes_channel_evaluate(&channel, NAN, result);
        assert_true(isfinite(result[0]));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_hold_their_key),
        cmocka_unit_test(lines_join_keys),
        cmocka_unit_test(rotations_turn_at_constant_speed),
        cmocka_unit_test(rotations_at_their_limits),
        cmocka_unit_test(splines_are_hermite),
        cmocka_unit_test(splines_of_rotations_never_vanish),
        cmocka_unit_test(before_and_after_keys_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
