#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "scenes/material/image_channel.h"
#include "tests/engine/support/log_recorder.h"

static lobe_image make_image(lobe_format format, uint32_t width, uint32_t height) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, format, width, height, NULL), LOBE_OK);
    return image;
}

static void packs_channels_of_one_size_exactly(void **state) {
    (void)state;
    lobe_image a = make_image(LOBE_FORMAT_RGBA8_UNORM, 5, 3);
    lobe_image b = make_image(LOBE_FORMAT_RGBA16_UNORM, 5, 3), packed;
    for (int i = 0; i < 5 * 3 * 4; i++) {
        ((uint8_t *)a.texels)[i] = (uint8_t)(i * 4 + 1);
        ((uint16_t *)b.texels)[i] = (uint16_t)((255 - i) * 257); // 257 times the 8-bit value
    }
    const image_channel channels[4] = {
        {&a, 2, 0, false}, {&b, 1, 0, false}, {NULL, 0, 0.2f, false}, {.value = 1}};
    assert_int_equal(scenes_image_channel_pack(channels, "test", NULL, &packed), LOBE_OK);
    assert_int_equal(packed.format, LOBE_FORMAT_RGBA8_UNORM);
    assert_true(packed.width == 5 && packed.height == 3);
    const uint8_t *texel = packed.texels;
    for (int i = 0; i < 5 * 3; i++, texel += 4) {
        assert_int_equal(texel[0], (i * 4 + 2) * 4 + 1);
        assert_int_equal(texel[1], 255 - (i * 4 + 1));
        assert_int_equal(texel[2], 51);
        assert_int_equal(texel[3], 255);
    }
    lobe_image_free(&a);
    lobe_image_free(&b);
    lobe_image_free(&packed);
}

static void smaller_channels_are_interpolated_and_repeat(void **state) {
    (void)state;
    lobe_image small = make_image(LOBE_FORMAT_RGBA8_UNORM, 2, 1);
    lobe_image large = make_image(LOBE_FORMAT_RGBA8_UNORM, 4, 2), packed;
    memcpy(small.texels, (uint8_t[]){0, 0, 0, 0, 200, 0, 0, 0}, 8);
    memset(large.texels, 77, 4 * 2 * 4);
    const image_channel channels[4] = {
        {&small, 0, 0, false}, {&large, 1, 0, false}, {.value = 0}, {.value = 1}};
    assert_int_equal(scenes_image_channel_pack(channels, "test", NULL, &packed), LOBE_OK);
    assert_true(packed.width == 4 && packed.height == 2);
    // Texel centres are at 1/4 and 3/4 of a small texel; the first one reaches around the edge.
    static const uint8_t expected[4] = {50, 50, 150, 150};
    const uint8_t *texel = packed.texels;
    for (int i = 0; i < 8; i++, texel += 4) {
        assert_int_equal(texel[0], expected[i % 4]);
        assert_int_equal(texel[1], 77);
    }
    lobe_image_free(&small);
    lobe_image_free(&large);
    lobe_image_free(&packed);
}

static void extent_is_that_of_the_widest_and_the_highest(void **state) {
    (void)state;
    lobe_image wide = make_image(LOBE_FORMAT_RGBA8_UNORM, 7, 1), packed;
    lobe_image high = make_image(LOBE_FORMAT_RGBA8_UNORM, 1, 5);
    const image_channel channels[4] = {
        {&wide, 0, 0, false}, {&high, 0, 0, false}, {.value = 0}, {.value = 1}};
    assert_int_equal(scenes_image_channel_pack(channels, "test", NULL, &packed), LOBE_OK);
    assert_true(packed.width == 7 && packed.height == 5);
    lobe_image_free(&packed);
    lobe_image_free(&wide);
    lobe_image_free(&high);
    wide = make_image(LOBE_FORMAT_RGBA8_UNORM, 60000, 1);
    high = make_image(LOBE_FORMAT_RGBA8_UNORM, 1, 60000);
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(scenes_image_channel_pack(channels, "two strips", &recorder.host, &packed),
                     LOBE_ERROR_LIMIT);
    assert_null(packed.texels);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "two strips"));
    lobe_image_free(&wide);
    lobe_image_free(&high);
}

static void inverting_changes_one_channel(void **state) {
    (void)state;
    lobe_image eight = make_image(LOBE_FORMAT_RGBA8_UNORM, 2, 1);
    lobe_image sixteen = make_image(LOBE_FORMAT_RGBA16_UNORM, 1, 1);
    memcpy(eight.texels, (uint8_t[]){1, 2, 3, 4, 5, 255, 7, 8}, 8);
    memcpy(sixteen.texels, (uint16_t[]){1, 20000, 3, 4}, 8);
    scenes_image_channel_invert(&eight, 1);
    scenes_image_channel_invert(&sixteen, 1);
    assert_memory_equal(eight.texels, ((uint8_t[]){1, 253, 3, 4, 5, 0, 7, 8}), 8);
    assert_memory_equal(sixteen.texels, ((uint16_t[]){1, 45535, 3, 4}), 8);
    lobe_image_free(&eight);
    lobe_image_free(&sixteen);
}

static void inverted_channels_are_turned_around(void **state) {
    (void)state;
    lobe_image image = make_image(LOBE_FORMAT_RGBA8_UNORM, 2, 1), packed;
    memcpy(image.texels, (uint8_t[]){10, 20, 30, 40, 50, 60, 70, 80}, 8);
    const image_channel channels[4] = {{&image, 3, 0, true},
                                       {&image, 1, 0, false},
                                       {.value = 0.2f, .inverted = true},
                                       {.value = 1}};
    assert_int_equal(scenes_image_channel_pack(channels, "test", NULL, &packed), LOBE_OK);
    assert_memory_equal(packed.texels, ((uint8_t[]){215, 20, 51, 255, 175, 60, 51, 255}), 8);
    lobe_image_free(&packed);
    lobe_image_free(&image);
}

static void full_channels_are_recognised(void **state) {
    (void)state;
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA8_UNORM, LOBE_FORMAT_RGBA16_UNORM};
    for (int i = 0; i < 2; i++) {
        lobe_image image = make_image(formats[i], 3, 2);
        const size_t size = 3 * 2 * lobe_format_size(formats[i]);
        memset(image.texels, 0xff, size);
        assert_true(scenes_image_channel_is_full(&image, 3));
        ((uint8_t *)image.texels)[size - 1] = 0xfe;
        assert_false(scenes_image_channel_is_full(&image, 3));
        assert_true(scenes_image_channel_is_full(&image, 2));
        lobe_image_free(&image);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packs_channels_of_one_size_exactly),
        cmocka_unit_test(smaller_channels_are_interpolated_and_repeat),
        cmocka_unit_test(extent_is_that_of_the_widest_and_the_highest),
        cmocka_unit_test(inverting_changes_one_channel),
        cmocka_unit_test(inverted_channels_are_turned_around),
        cmocka_unit_test(full_channels_are_recognised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
