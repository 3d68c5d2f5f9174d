#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdlib.h>

#include <lobe/colour.h>

#include "tools/compare/error_metrics.h"
#include "tools/report/report_picture.h"

enum { WIDTH = 30, HEIGHT = 20 };

static lobe_image make_linear(uint32_t seed) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT, NULL),
                     LOBE_OK);
    for (size_t i = 0; i < 4 * WIDTH * HEIGHT; ++i) {
        seed = seed * 1664525u + 1013904223u;
        ((float *)image.texels)[i] = (float)(seed >> 8) / (float)(1 << 24);
    }
    return image;
}

static lobe_image make_errors(float value) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_R32_FLOAT, WIDTH, HEIGHT, NULL),
                     LOBE_OK);
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i)
        ((float *)image.texels)[i] = value;
    return image;
}

static void a_map_has_the_error_that_is_reported(void **state) {
    (void)state;
    lobe_image test = make_linear(1), reference = make_linear(2), errors;
    error_metrics metrics;
    const error_metrics_parameters parameters = {"test", "reference", true, 0};
    assert_int_equal(error_metrics_measure(&test, &reference, &parameters, NULL, &metrics, NULL),
                     LOBE_OK);
    assert_int_equal(report_error_map(&test, &reference, NULL, &errors), LOBE_OK);
    double sum = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i)
        sum += pow(((float *)errors.texels)[i], 2);
    assert_float_equal(sqrt(sum / (WIDTH * HEIGHT)), metrics.relative_l2, 1e-5);
    lobe_image_free(&test);
    lobe_image_free(&reference);
    lobe_image_free(&errors);
}

static void quantiles_pool_all_images(void **state) {
    (void)state;
    lobe_image images[2] = {make_errors(0.25f), make_errors(3.0f)};
    assert_float_equal(report_quantile(images, 2, 0.4), 0.25, 0.25 * 0.05);
    assert_float_equal(report_quantile(images, 2, 0.6), 3.0, 3.0 * 0.05);
    assert_true(report_quantile(images, 2, 1) >= 3.0);
    assert_float_equal(report_quantile(images, 0, 0.5), 0, 0);
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i)
        ((float *)images[1].texels)[i] = i % 2 ? NAN : INFINITY;
    assert_float_equal(report_quantile(images, 2, 1), 0.25, 0.25 * 0.05);
    lobe_image_free(&images[0]);
    lobe_image_free(&images[1]);
}

static void the_worst_window_is_found(void **state) {
    (void)state;
    lobe_image errors = make_errors(0.1f);
    for (size_t y = 10; y < 14; ++y) {
        for (size_t x = 15; x < 21; ++x)
            ((float *)errors.texels)[y * WIDTH + x] = 1;
    }
    report_window window = report_worst_window(&errors, 1, 6, 4);
    assert_int_equal(window.x, 15);
    assert_int_equal(window.y, 10);
    assert_int_equal(window.width, 6);
    assert_int_equal(window.height, 4);
    lobe_image_free(&errors);
}

static void pictures_are_averaged_as_light(void **state) {
    (void)state;
    lobe_image linear;
    assert_int_equal(lobe_image_allocate(&linear, LOBE_FORMAT_RGBA32_FLOAT, 5, 2, NULL), LOBE_OK);
    // Columns of 0 and 0.5 by turns; the last block has a single column, of 0.
    for (size_t i = 0; i < 10; ++i) {
        for (size_t channel = 0; channel < 3; ++channel)
            ((float *)linear.texels)[4 * i + channel] = i % 5 % 2 ? 0.5f : 0;
    }
    lobe_image picture;
    assert_int_equal(report_show(&linear, 2, NULL, &picture), LOBE_OK);
    assert_int_equal(picture.width, 3);
    assert_int_equal(picture.height, 1);
    const uint8_t *texels = picture.texels;
    assert_true(abs(texels[0] - (int)lroundf(255 * lobe_srgb_encode(0.25f))) <= 1);
    assert_int_equal(texels[0], texels[4]);
    assert_int_equal(texels[8], 0);
    assert_int_equal(texels[11], 255);
    lobe_image_free(&picture);
    lobe_image_free(&linear);
}

static void heat_maps_end_at_the_scale(void **state) {
    (void)state;
    lobe_image errors = make_errors(0.5f), picture;
    uint8_t expected[3];
    const double scales[] = {2, 0.5, 0.1};
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(report_show_errors(&errors, scales[i], 4, NULL, &picture), LOBE_OK);
        lobe_heat_colour((float)(0.5 / scales[i]), expected);
        assert_memory_equal(picture.texels, expected, 3);
        assert_int_equal(picture.width, 8);
        lobe_image_free(&picture);
    }
    lobe_image_free(&errors);
}

static void a_window_is_shown_texel_for_texel(void **state) {
    (void)state;
    lobe_image linear = make_linear(3), whole, part;
    const report_window window = {7, 5, 9, 4};
    assert_int_equal(report_show(&linear, 1, NULL, &whole), LOBE_OK);
    assert_int_equal(report_show_window(&linear, &window, NULL, &part), LOBE_OK);
    assert_int_equal(part.width, 9);
    assert_int_equal(part.height, 4);
    for (size_t y = 0; y < 4; ++y)
        assert_memory_equal((uint8_t *)part.texels + 4 * 9 * y,
                            (uint8_t *)whole.texels + 4 * ((5 + y) * WIDTH + 7), 4 * 9);
    lobe_image_free(&linear);
    lobe_image_free(&whole);
    lobe_image_free(&part);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_map_has_the_error_that_is_reported),
        cmocka_unit_test(quantiles_pool_all_images),
        cmocka_unit_test(the_worst_window_is_found),
        cmocka_unit_test(pictures_are_averaged_as_light),
        cmocka_unit_test(heat_maps_end_at_the_scale),
        cmocka_unit_test(a_window_is_shown_texel_for_texel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
