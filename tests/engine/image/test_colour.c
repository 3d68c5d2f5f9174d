#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include <lobe/colour.h>

#include "tests/engine/support/log_recorder.h"

static void srgb_is_the_standards_curve(void **state) {
    (void)state;
    assert_float_equal(lobe_srgb_encode(0.0f), 0.0, 0.0);
    assert_float_equal(lobe_srgb_encode(1.0f), 1.0, 1e-6);
    for (int index = 0; index <= 4096; index++) {
        double linear = index / 4096.0;
        double encoded =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
        assert_true(fabs(lobe_srgb_encode((float)linear) - encoded) < 2e-7);
        double decoded = linear <= 0.04045 ? linear / 12.92 : pow((linear + 0.055) / 1.055, 2.4);
        assert_true(fabs(lobe_srgb_decode((float)linear) - decoded) < 2e-7);
    }
}

static void every_code_of_eight_bits_survives(void **state) {
    (void)state;
    for (int code = 0; code < 256; code++) {
        float encoded = lobe_srgb_encode(lobe_srgb_decode((float)code / 255.0f));
        assert_int_equal((int)(encoded * 255.0f + 0.5f), code);
    }
}

static void values_beyond_the_range_are_clamped(void **state) {
    (void)state;
    assert_true(lobe_srgb_encode(-1.0f) == 0.0f && lobe_srgb_encode(NAN) == 0.0f);
    assert_true(fabsf(lobe_srgb_encode(INFINITY) - 1.0f) < 1e-6f);
    assert_true(lobe_srgb_decode(-1.0f) == 0.0f && lobe_srgb_decode(2.0f) == 1.0f);
}

static void luminance_of_white_is_one(void **state) {
    (void)state;
    assert_true(fabsf(lobe_luminance((float[3]){1.0f, 1.0f, 1.0f}) - 1.0f) < 1e-6f);
    assert_true(lobe_luminance((float[3]){0.0f, 1.0f, 0.0f}) > 0.71f);
}

// ---------------------------------------------------------------------------------------------

static void display(const float linear[4], const lobe_display_parameters *parameters,
                    uint8_t texel[4]) {
    lobe_image source = {LOBE_FORMAT_RGBA32_FLOAT, 1, 1, (void *)linear}, picture;
    assert_int_equal(lobe_display_encode(&source, parameters, NULL, &picture), LOBE_OK);
    assert_int_equal(picture.format, LOBE_FORMAT_RGBA8_SRGB);
    for (int channel = 0; channel < 4; channel++)
        texel[channel] = ((uint8_t *)picture.texels)[channel];
    lobe_image_free(&picture);
}

static void expect(const uint8_t texel[4], int red, int green, int blue, int alpha) {
    assert_int_equal(texel[0], red);
    assert_int_equal(texel[1], green);
    assert_int_equal(texel[2], blue);
    assert_int_equal(texel[3], alpha);
}

static void without_tone_map_values_are_clamped(void **state) {
    (void)state;
    const lobe_display_parameters none = {.tone_map = LOBE_TONE_MAP_NONE};
    uint8_t texel[4];
    display((float[4]){0.0f, 1.0f, 2.0f, 0.25f}, &none, texel);
    expect(texel, 0, 255, 255, 255);
    display((float[4]){0.2140411f, -3.0f, NAN, 1.0f}, &none, texel); // 0.214 is code 127.5
    assert_in_range(texel[0], 127, 128);
    expect((uint8_t[4]){0, texel[1], texel[2], texel[3]}, 0, 0, 0, 255);
}

static void exposure_counts_in_stops(void **state) {
    (void)state;
    const lobe_display_parameters brighter = {.exposure = 3.0f, .tone_map = LOBE_TONE_MAP_NONE};
    const lobe_display_parameters plain = {.tone_map = LOBE_TONE_MAP_NONE};
    uint8_t left[4], right[4];
    display((float[4]){0.1f, 0.05f, 0.01f, 1.0f}, &brighter, left);
    display((float[4]){0.8f, 0.4f, 0.08f, 1.0f}, &plain, right);
    assert_memory_equal(left, right, 4);
}

static void the_shoulder_keeps_darks_and_never_clips(void **state) {
    (void)state;
    const lobe_display_parameters none = {.tone_map = LOBE_TONE_MAP_NONE};
    uint8_t left[4], right[4];
    display((float[4]){0.5f, 0.3f, 0.1f, 1.0f}, NULL, left);
    display((float[4]){0.5f, 0.3f, 0.1f, 1.0f}, &none, right);
    assert_memory_equal(left, right, 4);
    int last = 0;
    for (float value = 0.1f; value < 8.0f; value *= 1.3f) {
        display((float[4]){value, 0.5f * value, 0.0f, 1.0f}, NULL, left);
        assert_true(left[0] > last); // still distinct
        last = left[0];
    }
    // 8 goes to 1 - 1/32, and the other channels keep their share of it
    display((float[4]){8.0f, 4.0f, 0.0f, 1.0f}, NULL, left);
    display((float[4]){0.96875f, 0.484375f, 0.0f, 1.0f}, &none, right);
    assert_memory_equal(left, right, 4);
    display((float[4]){INFINITY, 1.0f, -INFINITY, 1.0f}, NULL, left);
    expect(left, 255, 0, 0, 255);
    display((float[4]){INFINITY, INFINITY, INFINITY, 1.0f}, NULL, left);
    expect(left, 255, 255, 255, 255);
}

static void alpha_is_kept_on_request_and_colour_divided_by_it(void **state) {
    (void)state;
    const lobe_display_parameters keep = {.tone_map = LOBE_TONE_MAP_NONE, .keep_alpha = true};
    uint8_t texel[4];
    display((float[4]){0.4f, 0.2f, 0.0f, 0.4f}, &keep, texel);
    assert_int_equal(texel[0], 255);
    assert_int_equal(texel[3], 102);
    display((float[4]){0.0f, 0.0f, 0.0f, 0.0f}, &keep, texel);
    expect(texel, 0, 0, 0, 0);
}

static void only_float_images_become_pictures(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    uint8_t texel[4] = {0};
    lobe_image source = {LOBE_FORMAT_RGBA8_UNORM, 1, 1, texel}, picture;
    assert_int_equal(lobe_display_encode(&source, NULL, &recorder.host, &picture),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_null(picture.texels);
}

// ---------------------------------------------------------------------------------------------

/// CIE lightness of sRGB bytes.
static double lightness(const uint8_t srgb[3]) {
    float rgb[3];
    for (int channel = 0; channel < 3; channel++)
        rgb[channel] = lobe_srgb_decode((float)srgb[channel] / 255.0f);
    double y = lobe_luminance(rgb);
    return y > 216.0 / 24389.0 ? 116.0 * cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

static void the_heat_map_grows_lighter_evenly(void **state) {
    (void)state;
    uint8_t colour[3];
    lobe_heat_colour(0.0f, colour);
    double first = lightness(colour);
    lobe_heat_colour(1.0f, colour);
    double last = lightness(colour);
    assert_true(first < 10.0 && last > 90.0);
    double previous = first;
    for (int step = 1; step <= 20; step++) {
        lobe_heat_colour((float)step / 20.0f, colour);
        double now = lightness(colour);
        // a twentieth of the way each, within half of that
        assert_true(fabs(now - previous - (last - first) / 20.0) < (last - first) / 40.0);
        previous = now;
    }
}

static void the_heat_map_clamps(void **state) {
    (void)state;
    uint8_t left[3], right[3];
    lobe_heat_colour(-5.0f, left);
    lobe_heat_colour(0.0f, right);
    assert_memory_equal(left, right, 3);
    lobe_heat_colour(INFINITY, left);
    lobe_heat_colour(1.0f, right);
    assert_memory_equal(left, right, 3);
    lobe_heat_colour(NAN, left);
    assert_memory_equal(left, ((uint8_t[3]){0, 0, 0}), 3);
}

// ACEScg (S-2014-004) to Rec. 709 with Bradford's adaptation, as ACES' own transforms print it.
static void primaries_become_those_of_rec_709(void **state) {
    (void)state;
    static const float acescg[4][2] = {
        {0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}};
    static const float expected[3][3] = {{1.70505f, -0.13026f, -0.02400f},
                                         {-0.62179f, 1.14080f, -0.12897f},
                                         {-0.08326f, -0.01055f, 1.15297f}};
    float texels[4][4] = {{2, 1, 1, 0.5f}, {1, 2, 1, 0.5f}, {1, 1, 2, 0.5f}, {3, 3, 3, 0.5f}};
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 4, 1, texels};
    assert_true(lobe_image_to_rec709(&image, acescg));
    for (int i = 0; i < 9; i++)
        assert_float_equal(texels[i / 3][i % 3], 1 + expected[i / 3][i % 3], 2e-4f);
    for (int i = 0; i < 3; i++)
        assert_float_equal(texels[3][i], 3, 1e-4f); // white stays white
    for (int i = 0; i < 4; i++)
        assert_true(texels[i][3] == 0.5f);
}

/// Of CIE XYZ itself, two primaries have no luminance.
static void xyz_is_a_space_of_colours(void **state) {
    (void)state;
    static const float xyz[4][2] = {{1, 0}, {0, 1}, {0, 0}, {1 / 3.0f, 1 / 3.0f}};
    float texels[4][4] = {{1, 1, 1, 1}, {0.5f, 0, 0, 1}, {INFINITY, 1, 2, 1}, {-0.5f, 0, 0, 1}};
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 4, 1, texels};
    assert_true(lobe_image_to_rec709(&image, xyz));
    for (int i = 0; i < 3; i++)
        assert_float_equal(texels[0][i], 1, 1e-4f);
    // X alone is red, and has less than no green.
    assert_true(texels[1][0] > 1 && texels[1][1] == 0 && texels[3][1] > 0);
    assert_memory_equal(texels[2], ((const float[]){INFINITY, 1, 2, 1}), sizeof texels[2]);
}

static void primaries_that_span_nothing_are_refused(void **state) {
    (void)state;
    static const float line[4][2] = {{0.1f, 0.2f}, {0.2f, 0.3f}, {0.3f, 0.4f}, {0.3f, 0.3f}};
    static const float none[4][2] = {{0}};
    float texel[4] = {1, 2, 3, 4};
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 1, 1, texel};
    assert_false(lobe_image_to_rec709(&image, line));
    assert_false(lobe_image_to_rec709(&image, none));
    assert_false(lobe_image_to_rec709(&image, NULL));
    assert_false(lobe_image_to_rec709(NULL, line));
    assert_memory_equal(texel, ((const float[]){1, 2, 3, 4}), sizeof texel);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(srgb_is_the_standards_curve),
        cmocka_unit_test(every_code_of_eight_bits_survives),
        cmocka_unit_test(values_beyond_the_range_are_clamped),
        cmocka_unit_test(luminance_of_white_is_one),
        cmocka_unit_test(without_tone_map_values_are_clamped),
        cmocka_unit_test(exposure_counts_in_stops),
        cmocka_unit_test(the_shoulder_keeps_darks_and_never_clips),
        cmocka_unit_test(alpha_is_kept_on_request_and_colour_divided_by_it),
        cmocka_unit_test(only_float_images_become_pictures),
        cmocka_unit_test(the_heat_map_grows_lighter_evenly),
        cmocka_unit_test(the_heat_map_clamps),
        cmocka_unit_test(primaries_become_those_of_rec_709),
        cmocka_unit_test(xyz_is_a_space_of_colours),
        cmocka_unit_test(primaries_that_span_nothing_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
