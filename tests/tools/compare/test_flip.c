#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/tools/compare/flip_reference.h"
#include "tools/compare/flip.h"
#include "tools/compare/flip_colour.h"
#include "tools/compare/flip_exposures.h"

static lobe_image make_image(uint32_t width, uint32_t height) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
                     LOBE_OK);
    return image;
}

static lobe_image make_constant(uint32_t width, uint32_t height, const float rgb[3]) {
    lobe_image image = make_image(width, height);
    for (size_t index = 0; index < (size_t)width * height; index++)
        memcpy((float *)image.texels + 4 * index, rgb, 3 * sizeof *rgb);
    return image;
}

static float random_unit(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) * 0x1p-24f;
}

/// Smooth colours with added noise of the given amplitude; never negative.
static lobe_image make_scene(uint32_t width, uint32_t height, float scale, float noise) {
    lobe_image image = make_image(width, height);
    uint32_t seed = 77;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            float *texel = (float *)image.texels + 4 * (y * width + x);
            for (int channel = 0; channel < 3; channel++) {
                float smooth = 0.5f + 0.45f * sinf(0.21f * (float)x * (float)(channel + 1)) *
                                          cosf(0.13f * (float)y);
                float grain = noise * (random_unit(&seed) - 0.5f);
                texel[channel] = fmaxf(scale * (smooth + grain), 0.0f);
            }
        }
    }
    return image;
}

typedef lobe_result (*flip_function)(const lobe_image *test, const lobe_image *reference,
                                     double pixels_per_degree, const lobe_host *host,
                                     lobe_image *errors);

static lobe_image measure(flip_function flip, const lobe_image *test, const lobe_image *reference) {
    lobe_image errors;
    assert_int_equal(flip(test, reference, FLIP_PIXELS_PER_DEGREE, NULL, &errors), LOBE_OK);
    assert_int_equal(errors.format, LOBE_FORMAT_R32_FLOAT);
    assert_int_equal(errors.width, reference->width);
    assert_int_equal(errors.height, reference->height);
    for (size_t index = 0; index < (size_t)errors.width * errors.height; index++) {
        float error = ((float *)errors.texels)[index];
        assert_true(error >= 0.0f && error <= 1.0f);
    }
    return errors;
}

static double mean_of(flip_function flip, const lobe_image *test, const lobe_image *reference) {
    lobe_image errors = measure(flip, test, reference);
    double mean = flip_mean(&errors, NULL);
    lobe_image_free(&errors);
    return mean;
}

static const flip_function both[2] = {flip_low_dynamic_range, flip_high_dynamic_range};

// ---------------------------------------------------------------------------------------------

static void equal_images_do_not_differ(void **state) {
    (void)state;
    lobe_image image = make_scene(40, 30, 1.0f, 0.5f);
    for (int range = 0; range < 2; range++)
        assert_true(mean_of(both[range], &image, &image) == 0.0);
    lobe_image_free(&image);
}

/// Constant images have no features and no structure: only HyAB and its redistribution remain.
static void constants_differ_as_their_colours_do(void **state) {
    (void)state;
    lobe_image black = make_constant(9, 7, (float[3]){0, 0, 0});
    lobe_image white = make_constant(9, 7, (float[3]){1, 1, 1});
    lobe_image green = make_constant(9, 7, (float[3]){0, 1, 0});
    lobe_image blue = make_constant(9, 7, (float[3]){0, 0, 1});
    // L* differs by 100; green and blue by 203.305 in Hunt-adjusted Lab (cmax = 203.305^0.7)
    double largest = pow(203.305, 0.7), distance = pow(100.0, 0.7);
    double expected = 0.95 + 0.05 * (distance - 0.4 * largest) / (0.6 * largest);
    assert_true(fabs(mean_of(flip_low_dynamic_range, &white, &black) - expected) < 1e-4);
    assert_true(fabs(mean_of(flip_low_dynamic_range, &green, &blue) - 1.0) < 1e-5);
    lobe_image_free(&black);
    lobe_image_free(&white);
    lobe_image_free(&green);
    lobe_image_free(&blue);
}

static void the_order_does_not_matter(void **state) {
    (void)state;
    lobe_image a = make_scene(40, 30, 1.0f, 0.0f), b = make_scene(40, 30, 0.9f, 0.4f);
    lobe_image forth = measure(flip_low_dynamic_range, &a, &b);
    lobe_image back = measure(flip_low_dynamic_range, &b, &a);
    assert_memory_equal(forth.texels, back.texels, 40 * 30 * sizeof(float));
    lobe_image_free(&forth);
    lobe_image_free(&back);
    lobe_image_free(&a);
    lobe_image_free(&b);
}

static void more_noise_is_more_error(void **state) {
    (void)state;
    for (int range = 0; range < 2; range++) {
        float scale = range == 0 ? 1.0f : 20.0f;
        lobe_image clean = make_scene(48, 40, scale, 0.0f);
        double last = 0.0;
        for (float noise = 0.02f; noise < 0.8f; noise *= 2.0f) {
            lobe_image noisy = make_scene(48, 40, scale, noise);
            double mean = mean_of(both[range], &noisy, &clean);
            assert_true(mean > 1.2 * last);
            last = mean;
            lobe_image_free(&noisy);
        }
        lobe_image_free(&clean);
    }
}

static void compare_with_paper(uint32_t width, uint32_t height, double pixels_per_degree) {
    lobe_image a = make_scene(width, height, 1.0f, 0.3f),
               b = make_scene(width, height, 0.95f, 0.0f);
    size_t count = (size_t)width * height;
    double *test = calloc(count, 3 * sizeof *test), *reference = calloc(count, 3 * sizeof *test);
    double *expected = calloc(count, sizeof *expected);
    for (size_t index = 0; index < 3 * count; index++) {
        size_t channel = 4 * (index / 3) + index % 3;
        test[index] = fmin(((float *)a.texels)[channel], 1.0);
        reference[index] = fmin(((float *)b.texels)[channel], 1.0);
    }
    lobe_image errors;
    flip_reference(test, reference, (int)width, (int)height, pixels_per_degree, expected);
    assert_int_equal(flip_low_dynamic_range(&a, &b, pixels_per_degree, NULL, &errors), LOBE_OK);
    for (size_t index = 0; index < count; index++)
        assert_true(fabs(((float *)errors.texels)[index] - expected[index]) < 1e-3);
    free(test);
    free(reference);
    free(expected);
    lobe_image_free(&errors);
    lobe_image_free(&a);
    lobe_image_free(&b);
}

static void each_texel_is_what_the_papers_formulas_give(void **state) {
    (void)state;
    compare_with_paper(37, 29, FLIP_PIXELS_PER_DEGREE);
    compare_with_paper(20, 20, 30.0);
    compare_with_paper(24, 9, 110.0);
    compare_with_paper(1, 1, FLIP_PIXELS_PER_DEGREE); // smaller than any filter
    compare_with_paper(5, 1, FLIP_PIXELS_PER_DEGREE);
    compare_with_paper(2, 11, 1.0);
}

/// From a distance, fine noise vanishes.
static void distance_hides_detail(void **state) {
    (void)state;
    lobe_image clean = make_constant(64, 64, (float[3]){0.4f, 0.4f, 0.4f});
    lobe_image noisy = make_constant(64, 64, (float[3]){0.4f, 0.4f, 0.4f});
    for (size_t index = 0; index < 64 * 64; index++) {
        for (int channel = 0; channel < 3; channel++)
            ((float *)noisy.texels)[4 * index + channel] += (index + index / 64) % 2 ? 0.1f : -0.1f;
    }
    lobe_image near, far;
    assert_int_equal(flip_low_dynamic_range(&noisy, &clean, 20.0, NULL, &near), LOBE_OK);
    assert_int_equal(flip_low_dynamic_range(&noisy, &clean, 200.0, NULL, &far), LOBE_OK);
    assert_true(flip_mean(&far, NULL) < 0.2 * flip_mean(&near, NULL));
    lobe_image_free(&near);
    lobe_image_free(&far);
    lobe_image_free(&clean);
    lobe_image_free(&noisy);
}

static void values_beyond_the_screens_range_are_clamped(void **state) {
    (void)state;
    lobe_image white = make_constant(8, 8, (float[3]){1, 1, 1});
    lobe_image bright = make_constant(8, 8, (float[3]){7, 1e30f, 2});
    lobe_image black = make_constant(8, 8, (float[3]){0, 0, 0});
    lobe_image negative = make_constant(8, 8, (float[3]){-1, -1e30f, -0.1f});
    assert_true(mean_of(flip_low_dynamic_range, &bright, &white) == 0.0);
    assert_true(mean_of(flip_low_dynamic_range, &negative, &black) == 0.0);
    assert_true(mean_of(flip_high_dynamic_range, &negative, &black) == 0.0);
    lobe_image_free(&white);
    lobe_image_free(&bright);
    lobe_image_free(&black);
    lobe_image_free(&negative);
}

// ---------------------------------------------------------------------------------------------
// High dynamic range

static void exposures_bring_maximum_and_median_to_the_same_brightness(void **state) {
    (void)state;
    lobe_image image = make_constant(5, 1, (float[3]){2, 2, 2});
    ((float *)image.texels)[0] = ((float *)image.texels)[1] = ((float *)image.texels)[2] = 500.0f;
    flip_exposures exposures;
    assert_int_equal(flip_choose_exposures(&image, NULL, &exposures), LOBE_OK);
    assert_true(fabsf(flip_tone_map(500.0f, (float)exp2(exposures.start)) - 0.85f) < 1e-5f);
    assert_true(fabsf(flip_tone_map(2.0f, (float)exp2(exposures.stop)) - 0.85f) < 1e-5f);
    assert_true(fabs(exposures.stop - exposures.start - log2(250.0)) < 1e-5);
    assert_int_equal(exposures.count, 8);
    lobe_image_free(&image);
}

static void the_median_of_an_even_count_lies_between(void **state) {
    (void)state;
    lobe_image image = make_constant(4, 1, (float[3]){1, 1, 1});
    for (int index = 0; index < 4; index++) {
        const float value[4] = {8, 1, 3, 2};
        for (int channel = 0; channel < 3; channel++)
            ((float *)image.texels)[4 * index + channel] = value[index];
    }
    flip_exposures exposures;
    assert_int_equal(flip_choose_exposures(&image, NULL, &exposures), LOBE_OK);
    assert_true(fabs(exposures.stop - exposures.start - log2(8.0 / 2.5)) < 1e-5);
    assert_int_equal(exposures.count, 2);
    lobe_image_free(&image);
}

static void black_does_not_ask_for_infinite_exposure(void **state) {
    (void)state;
    lobe_image image = make_constant(10, 1, (float[3]){0, 0, 0});
    flip_exposures exposures;
    assert_int_equal(flip_choose_exposures(&image, NULL, &exposures), LOBE_OK);
    assert_int_equal(exposures.count, 1);
    ((float *)image.texels)[1] =
        16.0f; // of ten texels, one is bright and one is dark, the others are black
    ((float *)image.texels)[5] = 4.0f;
    assert_int_equal(flip_choose_exposures(&image, NULL, &exposures), LOBE_OK);
    assert_true(fabs(exposures.stop - exposures.start - log2(16.0 / 10.0)) < 1e-5);
    for (int index = 0; index < 10; index++)
        ((float *)image.texels)[4 * index] = index == 0 ? 1.0f : 1e-30f;
    assert_int_equal(flip_choose_exposures(&image, NULL, &exposures), LOBE_OK);
    assert_true(exposures.count <= 25);
    lobe_image_free(&image);
}

static lobe_image expose(const lobe_image *image, double stops) {
    lobe_image exposed = make_image(image->width, image->height);
    for (size_t index = 0; index < (size_t)4 * image->width * image->height; index++)
        ((float *)exposed.texels)[index] =
            flip_tone_map(((float *)image->texels)[index], (float)exp2(stops));
    return exposed;
}

static void the_largest_error_of_all_exposures_counts(void **state) {
    (void)state;
    lobe_image a = make_scene(32, 24, 50.0f, 0.3f), b = make_scene(32, 24, 50.0f, 0.0f);
    ((float *)b.texels)[0] = 9000.0f;
    float largest[32 * 24] = {0};
    flip_exposures exposures;
    assert_int_equal(flip_choose_exposures(&b, NULL, &exposures), LOBE_OK);
    assert_true(exposures.count >= 4);
    for (unsigned index = 0; index < exposures.count; index++) {
        double stops =
            exposures.start + index * (exposures.stop - exposures.start) / (exposures.count - 1);
        lobe_image exposed_a = expose(&a, stops), exposed_b = expose(&b, stops);
        lobe_image errors = measure(flip_low_dynamic_range, &exposed_a, &exposed_b);
        for (int texel = 0; texel < 32 * 24; texel++)
            largest[texel] = fmaxf(largest[texel], ((float *)errors.texels)[texel]);
        lobe_image_free(&exposed_a);
        lobe_image_free(&exposed_b);
        lobe_image_free(&errors);
    }
    lobe_image errors = measure(flip_high_dynamic_range, &a, &b);
    for (int texel = 0; texel < 32 * 24; texel++)
        assert_true(fabsf(((float *)errors.texels)[texel] - largest[texel]) < 1e-4f);
    lobe_image_free(&errors);
    lobe_image_free(&a);
    lobe_image_free(&b);
}

static void the_unit_of_radiance_does_not_matter(void **state) {
    (void)state;
    double means[2];
    for (int unit = 0; unit < 2; unit++) {
        float scale = unit == 0 ? 1.0f : 1024.0f;
        lobe_image a = make_scene(32, 24, scale, 0.3f), b = make_scene(32, 24, scale, 0.0f);
        means[unit] = mean_of(flip_high_dynamic_range, &a, &b);
        lobe_image_free(&a);
        lobe_image_free(&b);
    }
    assert_true(means[0] > 0.05);
    assert_true(fabs(means[0] - means[1]) < 1e-5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_images_do_not_differ),
        cmocka_unit_test(constants_differ_as_their_colours_do),
        cmocka_unit_test(the_order_does_not_matter),
        cmocka_unit_test(more_noise_is_more_error),
        cmocka_unit_test(each_texel_is_what_the_papers_formulas_give),
        cmocka_unit_test(distance_hides_detail),
        cmocka_unit_test(values_beyond_the_screens_range_are_clamped),
        cmocka_unit_test(exposures_bring_maximum_and_median_to_the_same_brightness),
        cmocka_unit_test(the_median_of_an_even_count_lies_between),
        cmocka_unit_test(black_does_not_ask_for_infinite_exposure),
        cmocka_unit_test(the_largest_error_of_all_exposures_counts),
        cmocka_unit_test(the_unit_of_radiance_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
