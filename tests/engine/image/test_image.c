#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/image.h>

#include "tests/engine/support/log_recorder.h"

static void formats_have_size_channels_and_name(void **state) {
    (void)state;
    assert_int_equal(lobe_format_size(LOBE_FORMAT_NONE), 0);
    assert_int_equal(lobe_format_channels(LOBE_FORMAT_NONE), 0);
    for (int format = LOBE_FORMAT_NONE + 1; format < LOBE_FORMAT_COUNT; format++) {
        // The names give the channels, then the bits per channel.
        const char *name = lobe_format_name((lobe_format)format);
        size_t channels = strcspn(name, "0123456789");
        size_t bits = strtoul(name + channels, NULL, 10);
        if (strncmp(name, "BC", 2) == 0) { // of blocks
            assert_int_equal(lobe_format_size((lobe_format)format), 0);
            continue;
        }
        if (strstr(name, "10")) { // packed, of channels that differ in bits
            assert_int_equal(lobe_format_size((lobe_format)format), 4);
            continue;
        }
        assert_int_equal(lobe_format_channels((lobe_format)format), channels);
        assert_int_equal(lobe_format_size((lobe_format)format), channels * bits / 8);
    }
    assert_string_equal(lobe_format_name(LOBE_FORMAT_RGBA16_SNORM), "RGBA16_SNORM");
    assert_non_null(lobe_format_name(LOBE_FORMAT_COUNT));
    assert_int_equal(lobe_format_size((lobe_format)-1), 0);
}

static void texels_start_as_zeroes(void **state) {
    (void)state;
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RG16_FLOAT, 7, 3, NULL), LOBE_OK);
    assert_int_equal(image.width, 7);
    assert_int_equal(image.height, 3);
    assert_int_equal(image.format, LOBE_FORMAT_RG16_FLOAT);
    for (int byte = 0; byte < 7 * 3 * 4; byte++)
        assert_int_equal(((uint8_t *)image.texels)[byte], 0);
    lobe_image_free(&image);
    assert_null(image.texels);
    assert_int_equal(image.width, 0);
    lobe_image_free(&image);
    lobe_image_free(NULL);
}

static void refuse(lobe_format format, uint32_t width, uint32_t height, lobe_result expected) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image = {LOBE_FORMAT_R8_UNORM, 1, 1, &recorder};
    assert_int_equal(lobe_image_allocate(&image, format, width, height, &recorder.host), expected);
    assert_int_equal(recorder.errors, 1);
    assert_null(image.texels);
}

static void absurd_extents_are_refused(void **state) {
    (void)state;
    refuse(LOBE_FORMAT_RGBA8_UNORM, 0, 5, LOBE_ERROR_LIMIT);
    refuse(LOBE_FORMAT_RGBA8_UNORM, 5, 0, LOBE_ERROR_LIMIT);
    refuse(LOBE_FORMAT_RGBA32_FLOAT, 65536, 65536, LOBE_ERROR_LIMIT);
    refuse(LOBE_FORMAT_RGBA32_FLOAT, 1, 65536, LOBE_ERROR_LIMIT);
    refuse(LOBE_FORMAT_RGBA32_FLOAT, UINT32_MAX, 1, LOBE_ERROR_LIMIT);
    refuse(LOBE_FORMAT_NONE, 4, 4, LOBE_ERROR_INVALID_ARGUMENT);
    lobe_image image;
    assert_int_equal(
        lobe_image_allocate(&image, LOBE_FORMAT_R8_UNORM, LOBE_IMAGE_MAXIMUM_EXTENT, 1, NULL),
        LOBE_OK);
    lobe_image_free(&image);
}

static void rectangles_lie_within_images(void **state) {
    static const lobe_rectangle inside[] = {{0, 0, 7, 5}, {6, 4, 1, 1}, {2, 1, 3, 4}};
    static const lobe_rectangle outside[] = {
        {0, 0, 8, 1}, {0, 0, 1, 6}, {7, 0, 1, 1},          {0, 5, 1, 1},
        {0, 0, 0, 1}, {0, 0, 1, 0}, {2, 0, UINT32_MAX, 1}, {UINT32_MAX, 0, 2, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++)
        assert_true(lobe_rectangle_lies_within(&inside[i], 7, 5));
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++)
        assert_false(lobe_rectangle_lies_within(&outside[i], 7, 5));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_have_size_channels_and_name),
        cmocka_unit_test(texels_start_as_zeroes),
        cmocka_unit_test(absurd_extents_are_refused),
        cmocka_unit_test(rectangles_lie_within_images),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
