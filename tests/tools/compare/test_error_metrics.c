#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include <lobe/colour.h>

#include "tests/engine/support/log_recorder.h"
#include "tools/compare/error_metrics.h"
#include "tools/compare/flip.h"

static lobe_image wrap(float *texels, uint32_t width, uint32_t height) {
    return (lobe_image){LOBE_FORMAT_RGBA32_FLOAT, width, height, texels};
}

static error_metrics measure(const lobe_image *test, const lobe_image *reference, bool high) {
    error_metrics_parameters parameters = {"test", "reference", high, 0.0, NULL};
    error_metrics metrics;
    assert_int_equal(error_metrics_measure(test, reference, &parameters, NULL, &metrics, NULL),
                     LOBE_OK);
    return metrics;
}

static bool near(double value, double expected) {
    return fabs(value - expected) <= 1e-6 * fabs(expected);
}

static void sums_are_those_of_the_definitions(void **state) {
    (void)state;
    // alpha differs wildly and must not count
    float a[8] = {1.5f, 2.0f, 0.0f, 9.0f, 0.0f, 1.0f, 4.0f, -50.0f};
    float b[8] = {1.0f, 2.0f, 0.5f, 1.0f, 0.0f, 3.0f, 4.0f, 1.0f};
    lobe_image test = wrap(a, 2, 1), reference = wrap(b, 2, 1);
    error_metrics metrics = measure(&test, &reference, true);
    // differences 0.5 0 -0.5 | 0 -2 0
    assert_true(near(metrics.rmse, sqrt(4.5 / 6.0)));
    assert_true(near(metrics.relative_mse, (0.25 / 1.01 + 0.25 / 0.26 + 4.0 / 9.01) / 6.0));
    assert_true(near(metrics.relative_l2, sqrt(4.5 / (1.0 + 4.0 + 0.25 + 9.0 + 16.0))));
    assert_true(near(metrics.relative_l1, 3.0 / (1.0 + 2.0 + 0.5 + 3.0 + 4.0)));
    assert_true(near(metrics.psnr, 10.0 * log10(16.0 / (4.5 / 6.0))));
    assert_true(near(metrics.mean_ratio, 8.5 / 10.5));
    assert_true(metrics.flip > 0.0 && metrics.flip <= 1.0);
}

static void low_dynamic_range_is_measured_as_it_is_shown(void **state) {
    (void)state;
    float a[4] = {0.5f, 0.2f, 2.0f, 1.0f}, b[4] = {0.4f, 0.2f, 1.0f, 1.0f};
    lobe_image test = wrap(a, 1, 1), reference = wrap(b, 1, 1);
    error_metrics metrics = measure(&test, &reference, false);
    double difference = (double)lobe_srgb_encode(0.5f) - lobe_srgb_encode(0.4f);
    assert_true(near(metrics.rmse, difference / sqrt(3.0))); // 2 is displayed as 1
    assert_true(near(metrics.psnr, 10.0 * log10(3.0 / (difference * difference))));
}

static void only_the_chosen_pixels_are_measured(void **state) {
    (void)state;
    float a[12] = {1.5f, 2.0f, 0.0f, 1.0f, 0.0f, 1.0f, 4.0f, 1.0f, 3.0f, 3.0f, 3.0f, 1.0f};
    float b[12] = {1.0f, 2.0f, 0.5f, 1.0f, 9.0f, 9.0f, 9.0f, 1.0f, 3.0f, 3.0f, 3.0f, 1.0f};
    lobe_image test = wrap(a, 3, 1), reference = wrap(b, 3, 1);
    const bool pixels[3] = {true, false, true};
    error_metrics_parameters parameters = {"test", "reference", true, 0.0, pixels};
    error_metrics metrics;
    lobe_image errors;
    assert_int_equal(error_metrics_measure(&test, &reference, &parameters, NULL, &metrics, &errors),
                     LOBE_OK);
    assert_true(near(metrics.rmse, sqrt(0.5 / 6.0)));
    assert_true(near(metrics.relative_l2, sqrt(0.5 / (1.0 + 4.0 + 0.25 + 27.0))));
    assert_true(near(metrics.mean_ratio, 12.5 / 12.5));
    assert_true(near(metrics.psnr, 10.0 * log10(9.0 / (0.5 / 6.0))));
    const float *flip = errors.texels;
    assert_true(near(metrics.flip, (flip[0] + (double)flip[2]) / 2.0));
    assert_true(flip[1] == 0.0f);
    lobe_image_free(&errors);
}

static void equal_images_have_no_error(void **state) {
    (void)state;
    float a[4] = {0.5f, 7.0f, 0.0f, 1.0f};
    lobe_image image = wrap(a, 1, 1);
    for (int high = 0; high < 2; high++) {
        error_metrics metrics = measure(&image, &image, high);
        assert_true(metrics.rmse == 0.0 && metrics.relative_mse == 0.0);
        assert_true(metrics.relative_l2 == 0.0 && metrics.relative_l1 == 0.0);
        assert_true(metrics.flip == 0.0);
        assert_true(isinf(metrics.psnr) && metrics.psnr > 0.0);
    }
}

static void a_black_reference_leaves_nothing_to_divide_by(void **state) {
    (void)state;
    float a[4] = {0.1f, 0.1f, 0.1f, 1.0f}, b[4] = {0};
    lobe_image test = wrap(a, 1, 1), reference = wrap(b, 1, 1);
    error_metrics metrics = measure(&test, &reference, true);
    assert_true(near(metrics.rmse, 0.1f));
    assert_true(near(metrics.relative_mse, 1.0));
    assert_true(isinf(metrics.relative_l2) && isinf(metrics.relative_l1));
    assert_true(isinf(metrics.mean_ratio));
    metrics = measure(&reference, &reference, true);
    assert_true(metrics.relative_l2 == 0.0 && metrics.relative_l1 == 0.0);
    assert_true(metrics.mean_ratio == 1.0);
}

static void the_error_map_has_the_mean_that_is_told(void **state) {
    (void)state;
    float a[16 * 4], b[16 * 4];
    for (int index = 0; index < 64; index++) {
        a[index] = (float)(index % 7) * 0.1f;
        b[index] = (float)(index % 5) * 0.1f;
    }
    lobe_image test = wrap(a, 4, 4), reference = wrap(b, 4, 4), errors;
    error_metrics_parameters parameters = {"test", "reference", true, 40.0, NULL};
    error_metrics metrics;
    assert_int_equal(error_metrics_measure(&test, &reference, &parameters, NULL, &metrics, &errors),
                     LOBE_OK);
    assert_true(near(flip_mean(&errors, NULL), metrics.flip));
    parameters.pixels_per_degree = 100.0;
    error_metrics farther;
    assert_int_equal(error_metrics_measure(&test, &reference, &parameters, NULL, &farther, NULL),
                     LOBE_OK);
    assert_true(farther.flip != metrics.flip);
    lobe_image_free(&errors);
}

static void refuse(const lobe_image *test, const lobe_image *reference, const char *const *causes) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    error_metrics_parameters parameters = {"a.exr", "b.exr", true, 0.0, NULL};
    error_metrics metrics;
    lobe_image errors;
    assert_int_equal(
        error_metrics_measure(test, reference, &parameters, &recorder.host, &metrics, &errors),
        LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_null(errors.texels);
    for (; *causes != NULL; causes++)
        assert_non_null(strstr(recorder.last_error, *causes));
}

static void images_that_cannot_be_compared_are_named(void **state) {
    (void)state;
    float a[24] = {0}, b[24] = {0};
    lobe_image wide = wrap(a, 6, 1), tall = wrap(b, 1, 5);
    refuse(&wide, &tall, (const char *[]){"a.exr", "6x1", "b.exr", "1x5", NULL});
    lobe_image other = {LOBE_FORMAT_RGBA8_UNORM, 6, 1, b};
    refuse(&wide, &other, (const char *[]){"RGBA32_FLOAT", NULL});
    lobe_image square = wrap(a, 3, 2), finite = wrap(b, 3, 2);
    a[4 * 4 + 1] = NAN; // x 1, y 1
    a[4 * 5] = INFINITY;
    a[4 * 5 + 1] = NAN; // still one pixel
    a[4 * 2 + 3] = NAN; // alpha does not count
    refuse(&square, &finite, (const char *[]){"a.exr", "2 of 6", "x 1, y 1", NULL});
    refuse(&finite, &square, (const char *[]){"b.exr", "2 of 6", "x 1, y 1", NULL});
}

static void metrics_are_listed_by_name(void **state) {
    (void)state;
    error_metrics metrics = {1, 2, 3, 4, 5, 6, 7};
    const char *const names[] = {"rmse", "relative_mse", "relative_l2", "relative_l1",
                                 "psnr", "mean_ratio",   "flip"};
    for (int index = 0; index < ERROR_METRICS_COUNT; index++) {
        assert_string_equal(error_metrics_name(index), names[index]);
        assert_true(error_metrics_value(&metrics, index) == index + 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_those_of_the_definitions),
        cmocka_unit_test(low_dynamic_range_is_measured_as_it_is_shown),
        cmocka_unit_test(only_the_chosen_pixels_are_measured),
        cmocka_unit_test(equal_images_have_no_error),
        cmocka_unit_test(a_black_reference_leaves_nothing_to_divide_by),
        cmocka_unit_test(the_error_map_has_the_mean_that_is_told),
        cmocka_unit_test(images_that_cannot_be_compared_are_named),
        cmocka_unit_test(metrics_are_listed_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
