// Radiance pictures in every packing and direction, and broken ones.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/format/radiance_hdr.h"
#include "tests/engine/support/log_recorder.h"

typedef struct byte_buffer {
    uint8_t *bytes;
    size_t size;
} byte_buffer;

static void append(byte_buffer *buffer, const void *bytes, size_t size) {
    buffer->bytes = realloc(buffer->bytes, buffer->size + size);
    assert_non_null(buffer->bytes);
    memcpy(buffer->bytes + buffer->size, bytes, size);
    buffer->size += size;
}

static void append_text(byte_buffer *buffer, const char *text) {
    append(buffer, text, strlen(text));
}

static void append_byte(byte_buffer *buffer, unsigned byte) {
    append(buffer, &(uint8_t){(uint8_t)byte}, 1);
}

typedef enum packing { FLAT, OLD, NEW, PACKING_COUNT } packing;

// Texel (line, i) of a picture: runs of several lengths between individual texels.
static void texel_bytes(uint32_t line, uint32_t i, uint8_t texel[4]) {
    const bool run = (i / 7 + line) % 3 == 0;
    const uint32_t value = run ? i / 7 + line : 1000 * line + i;
    texel[0] = (uint8_t)(128 + value * 37 % 128);
    texel[1] = (uint8_t)(value * 91 % 256);
    texel[2] = (uint8_t)(3 + value * 11 % 250);
    texel[3] = (uint8_t)(120 + value % 17);
}

static bool same(const uint8_t *line, uint32_t a, uint32_t b, int first, int count) {
    return memcmp(line + 4 * a + first, line + 4 * b + first, (size_t)count) == 0;
}

static uint32_t run_length(const uint8_t *line, uint32_t at, uint32_t end, int first, int count) {
    uint32_t length = 1;
    while (at + length < end && same(line, at, at + length, first, count))
        length++;
    return length;
}

static void pack_new(byte_buffer *out, const uint8_t *line, uint32_t length) {
    append(out, (uint8_t[4]){2, 2, (uint8_t)(length >> 8), (uint8_t)length}, 4);
    for (int component = 0; component < 4; component++) {
        for (uint32_t at = 0; at < length;) {
            uint32_t count = run_length(line, at, length, component, 1);
            count = count > 127 ? 127 : count;
            append_byte(out, count > 2 ? 128 + count : count);
            for (uint32_t i = 0; i < (count > 2 ? 1 : count); i++)
                append_byte(out, line[4 * (at + i) + (uint32_t)component]);
            at += count;
        }
    }
}

static void pack_old(byte_buffer *out, const uint8_t *line, uint32_t length) {
    for (uint32_t at = 0; at < length;) {
        const uint32_t count = run_length(line, at, length, 0, 4);
        append(out, line + 4 * at, 4);
        for (uint32_t left = count - 1; left > 0; left >>= 8)
            append(out, (uint8_t[4]){1, 1, 1, (uint8_t)left}, 4);
        at += count;
    }
}

static byte_buffer picture(const char *variables, const char *resolution, uint32_t lines,
                           uint32_t length, packing packing) {
    byte_buffer out = {0};
    append_text(&out, "#?RADIANCE\n");
    append_text(&out, variables);
    append_text(&out, "\n");
    append_text(&out, resolution);
    append_text(&out, "\n");
    uint8_t *line = malloc(4 * (size_t)length);
    for (uint32_t k = 0; k < lines; k++) {
        for (uint32_t i = 0; i < length; i++)
            texel_bytes(k, i, line + 4 * i);
        if (packing == NEW)
            pack_new(&out, line, length);
        else if (packing == OLD)
            pack_old(&out, line, length);
        else
            append(&out, line, 4 * (size_t)length);
    }
    free(line);
    return out;
}

static lobe_result decode(const byte_buffer *file, size_t size, log_recorder *recorder,
                          lobe_image *image) {
    log_recorder_start(recorder);
    // A copy of the exact size lets the sanitizer detect reads past the end.
    uint8_t *copy = malloc(size ? size : 1);
    if (size > 0)
        memcpy(copy, file->bytes, size);
    lobe_result result = scenes_radiance_hdr_decode(copy, size, "p.hdr", &recorder->host, image);
    free(copy);
    assert_int_equal(recorder->errors, result != LOBE_OK);
    assert_true((image->texels != NULL) == (result == LOBE_OK));
    if (result != LOBE_OK)
        assert_non_null(strstr(recorder->last_error, "p.hdr"));
    return result;
}

static lobe_image must_decode(byte_buffer file) {
    log_recorder recorder;
    lobe_image image;
    if (decode(&file, file.size, &recorder, &image) != LOBE_OK)
        fail_msg("%s", recorder.last_error);
    free(file.bytes);
    assert_int_equal(image.format, LOBE_FORMAT_RGBA32_FLOAT);
    return image;
}

static void must_fail(byte_buffer file, lobe_result expected, const char *cause) {
    log_recorder recorder;
    lobe_image image;
    assert_int_equal(decode(&file, file.size, &recorder, &image), expected);
    if (!strstr(recorder.last_error, cause))
        fail_msg("no '%s' in: %s", cause, recorder.last_error);
    free(file.bytes);
}

static const float *texel(const lobe_image *image, uint32_t x, uint32_t y) {
    return (const float *)image->texels + 4 * ((size_t)y * image->width + x);
}

// Half a step of the mantissa above the written value.
static double radiance_of(const uint8_t texel[4], int component) {
    return (texel[component] + 0.5) / 256 * pow(2, texel[3] - 128);
}

static void expect_texel(const lobe_image *image, uint32_t x, uint32_t y, uint32_t line,
                         uint32_t i) {
    uint8_t bytes[4];
    texel_bytes(line, i, bytes);
    for (int component = 0; component < 3; component++)
        assert_true(texel(image, x, y)[component] == (float)radiance_of(bytes, component));
    assert_true(texel(image, x, y)[3] == 1);
}

static void every_packing_and_size_is_read(void **state) {
    (void)state;
    const uint32_t sizes[][2] = {{1, 1}, {7, 3}, {8, 2}, {9, 1}, {130, 4}, {1000, 2}, {33000, 1}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        for (packing packing = FLAT; packing < PACKING_COUNT; packing++) {
            const uint32_t width = sizes[s][0], height = sizes[s][1];
            if (packing == NEW && (width < 8 || width > 32767))
                continue; // such lines are never packed this way
            char resolution[64];
            snprintf(resolution, sizeof resolution, "-Y %u +X %u", height, width);
            lobe_image image = must_decode(picture("", resolution, height, width, packing));
            assert_int_equal(image.width, width);
            assert_int_equal(image.height, height);
            for (uint32_t y = 0; y < height; y++) {
                for (uint32_t x = 0; x < width; x++)
                    expect_texel(&image, x, y, y, x);
            }
            lobe_image_free(&image);
        }
    }
}

// Of 5 columns and 3 rows: where the texel (line, i) must be.
static void every_direction_is_read(void **state) {
    (void)state;
    static const char *const resolutions[8] = {"-Y 3 +X 5", "-Y 3 -X 5", "+Y 3 -X 5", "+Y 3 +X 5",
                                               "+X 5 -Y 3", "-X 5 -Y 3", "-X 5 +Y 3", "+X 5 +Y 3"};
    for (int k = 0; k < 8; k++) {
        const char *r = resolutions[k];
        const bool columns = r[1] == 'X';
        lobe_image image = must_decode(
            picture("FORMAT=32-bit_rle_rgbe\n", r, columns ? 5 : 3, columns ? 3 : 5, FLAT));
        assert_int_equal(image.width, 5);
        assert_int_equal(image.height, 3);
        const bool left_to_right = strstr(r, "+X") != NULL, downwards = strstr(r, "-Y") != NULL;
        for (uint32_t y = 0; y < 3; y++) {
            for (uint32_t x = 0; x < 5; x++) {
                const uint32_t column = left_to_right ? x : 4 - x, row = downwards ? y : 2 - y;
                expect_texel(&image, x, y, columns ? column : row, columns ? row : column);
            }
        }
        lobe_image_free(&image);
    }
}

static void exposures_are_undone(void **state) {
    (void)state;
    lobe_image image = must_decode(picture("# a comment\nEXPOSURE= 4\nSOFTWARE=x\nEXPOSURE=0.5e0\n"
                                           "COLORCORR=1 2 .25\nCOLORCORR= 2 1 1\n"
                                           "FORMAT=32-bit_rle_rgbe\r\n",
                                           "-Y 1 +X 1", 1, 1, FLAT));
    uint8_t bytes[4];
    texel_bytes(0, 0, bytes);
    const double factors[3] = {4, 4, 0.5};
    for (int i = 0; i < 3; i++)
        assert_true(texel(&image, 0, 0)[i] == (float)(radiance_of(bytes, i) / factors[i]));
    lobe_image_free(&image);
}

static byte_buffer one_texel(const char *variables, const uint8_t bytes[4]) {
    byte_buffer out = picture(variables, "-Y 1 +X 1", 1, 1, FLAT);
    memcpy(out.bytes + out.size - 4, bytes, 4);
    return out;
}

static void an_exponent_of_zero_is_black(void **state) {
    (void)state;
    lobe_image image = must_decode(one_texel("", (uint8_t[4]){200, 200, 200, 0}));
    for (int i = 0; i < 3; i++)
        assert_true(texel(&image, 0, 0)[i] == 0);
    lobe_image_free(&image);
}

static void xyz_becomes_rgb(void **state) {
    (void)state;
    // Equal parts are white, which is also equal parts of RGB with the same primaries.
    lobe_image image =
        must_decode(one_texel("FORMAT=32-bit_rle_xyze\n", (uint8_t[4]){200, 200, 200, 129}));
    for (int i = 0; i < 3; i++)
        assert_true(fabs(texel(&image, 0, 0)[i] - 200.5 / 128) < 1e-6);
    lobe_image_free(&image);
    // The primary red, x = 0.64, y = 0.33, z = 0.03, contains no green and blue.
    image = must_decode(one_texel("FORMAT=32-bit_rle_xyze\n", (uint8_t[4]){191, 98, 8, 128}));
    const float *red = texel(&image, 0, 0);
    assert_true(red[0] > 1 && fabsf(red[1]) < 0.02f && fabsf(red[2]) < 0.02f);
    lobe_image_free(&image);
}

static void colours_of_other_primaries_are_converted(void **state) {
    (void)state;
    // Its green is the blue of Rec. 709, and its blue the green.
    lobe_image image = must_decode(picture("FORMAT=32-bit_rle_rgbe\n"
                                           "PRIMARIES= .64 .33 .15 .06 .30 .60 .3127 .3290\n",
                                           "-Y 1 +X 1", 1, 1, FLAT));
    uint8_t bytes[4];
    texel_bytes(0, 0, bytes);
    const float expected[3] = {(float)radiance_of(bytes, 0), (float)radiance_of(bytes, 2),
                               (float)radiance_of(bytes, 1)};
    for (int i = 0; i < 3; i++)
        assert_float_equal(texel(&image, 0, 0)[i], expected[i], 1e-5f * expected[0]);
    lobe_image_free(&image);
}

static void primaries_that_say_nothing_are_ignored(void **state) {
    (void)state;
    static const char *const headers[] = {"PRIMARIES=0 0 0 0 0 0 0 0\n", "PRIMARIES=.64 .33\n",
                                          "PRIMARIES=\n",
                                          "PRIMARIES=.64 .33 .29 .60 .15 .06 .333 .333\n"};
    for (size_t k = 0; k < sizeof headers / sizeof *headers; k++) {
        lobe_image image = must_decode(picture(headers[k], "-Y 1 +X 1", 1, 1, FLAT));
        uint8_t bytes[4];
        texel_bytes(0, 0, bytes);
        for (int i = 0; i < 3; i++)
            assert_true(texel(&image, 0, 0)[i] == (float)radiance_of(bytes, i));
        lobe_image_free(&image);
    }
}

static byte_buffer text(const char *content) {
    byte_buffer out = {0};
    append_text(&out, content);
    return out;
}

static void what_is_wrong_is_said(void **state) {
    (void)state;
    must_fail(text("no picture at all"), LOBE_ERROR_MALFORMED, "'#?'");
    must_fail(text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"), LOBE_ERROR_MALFORMED, "header");
    must_fail(text("#?RADIANCE\nFORMAT=16-bit\n\n-Y 1 +X 1\nabcd"), LOBE_ERROR_UNSUPPORTED,
              "format");
    static const char *const exposures[] = {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=x",
                                            "EXPOSURE=", "EXPOSURE=nan"};
    for (size_t i = 0; i < sizeof exposures / sizeof *exposures; i++) {
        char content[128];
        snprintf(content, sizeof content, "#?RADIANCE\n%s\n\n-Y 1 +X 1\nabcd", exposures[i]);
        must_fail(text(content), LOBE_ERROR_MALFORMED, "exposure");
    }
    must_fail(text("#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\nabcd"), LOBE_ERROR_MALFORMED,
              "correction");
    static const char *const resolutions[] = {
        "",           "-Y 1",        "-Y 1 +Y 1", "Y 1 X 1",      "-Y 0 +X 1",
        "-Y 1 +X -1", "-Y 1 +X 1.5", "*Y 1 +X 1", "-Y 1 +X 65536"};
    for (size_t i = 0; i < sizeof resolutions / sizeof *resolutions; i++)
        must_fail(picture("", resolutions[i], 1, 1, FLAT), LOBE_ERROR_MALFORMED, "resolution");
    must_fail(picture("", "-Y 65535 +X 65535", 1, 1, FLAT), LOBE_ERROR_LIMIT, "65535");
    must_fail(picture("", "-Y 65535 +X 1", 1, 1, FLAT), LOBE_ERROR_MALFORMED, "ends early");
}

static byte_buffer line_of_eight(const uint8_t *bytes, size_t size) {
    byte_buffer out = picture("", "-Y 1 +X 8", 0, 8, FLAT);
    append(&out, bytes, size);
    return out;
}

static void lines_that_do_not_fit_are_refused(void **state) {
    (void)state;
    must_fail(line_of_eight((uint8_t[8]){2, 2, 0, 9, 136, 1, 136, 1}, 8), LOBE_ERROR_MALFORMED,
              "longer or shorter");
    must_fail(line_of_eight((uint8_t[8]){2, 2, 0, 8, 137, 1, 136, 1}, 8), LOBE_ERROR_MALFORMED,
              "run");
    must_fail(line_of_eight((uint8_t[8]){2, 2, 0, 8, 0, 1, 136, 1}, 8), LOBE_ERROR_MALFORMED,
              "run");
    must_fail(line_of_eight((uint8_t[8]){2, 2, 0, 8, 128, 1, 136, 1}, 8), LOBE_ERROR_MALFORMED,
              "run");
    must_fail(line_of_eight((uint8_t[8]){2, 2, 0, 8, 8, 1, 2, 3}, 8), LOBE_ERROR_MALFORMED,
              "early");
    must_fail(line_of_eight((uint8_t[4]){1, 1, 1, 8}, 4), LOBE_ERROR_MALFORMED, "run");
    must_fail(line_of_eight((uint8_t[8]){9, 9, 9, 9, 1, 1, 1, 8}, 8), LOBE_ERROR_MALFORMED, "run");
    must_fail(line_of_eight((uint8_t[24]){9, 9, 9, 9, 1, 1, 1, 0, 1, 1, 1, 0,
                                          1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1},
                            24),
              LOBE_ERROR_MALFORMED, "run");
}

static void a_file_cut_off_anywhere_is_refused(void **state) {
    (void)state;
    for (packing packing = FLAT; packing < PACKING_COUNT; packing++) {
        byte_buffer file = picture("EXPOSURE=2\n", "-Y 3 +X 40", 3, 40, packing);
        for (size_t size = 0; size < file.size; size++) {
            log_recorder recorder;
            lobe_image image;
            assert_int_equal(decode(&file, size, &recorder, &image), LOBE_ERROR_MALFORMED);
        }
        free(file.bytes);
    }
}

// Whatever changes, the result is an image or one message, and never a crash.
static void any_byte_may_be_wrong(void **state) {
    (void)state;
    random_sequence random = scenes_random_start(7);
    for (packing packing = FLAT; packing < PACKING_COUNT; packing++) {
        byte_buffer file = picture("EXPOSURE=2\n", "-Y 3 +X 40", 3, 40, packing);
        for (size_t offset = 0; offset < file.size; offset++) {
            for (int k = 0; k < 4; k++) {
                const uint8_t kept = file.bytes[offset];
                log_recorder recorder;
                lobe_image image;
                file.bytes[offset] = (uint8_t)scenes_random_bits(&random);
                decode(&file, file.size, &recorder, &image);
                lobe_image_free(&image);
                file.bytes[offset] = kept;
            }
        }
        free(file.bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_packing_and_size_is_read),
        cmocka_unit_test(every_direction_is_read),
        cmocka_unit_test(exposures_are_undone),
        cmocka_unit_test(colours_of_other_primaries_are_converted),
        cmocka_unit_test(primaries_that_say_nothing_are_ignored),
        cmocka_unit_test(an_exponent_of_zero_is_black),
        cmocka_unit_test(xyz_becomes_rgb),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(lines_that_do_not_fit_are_refused),
        cmocka_unit_test(a_file_cut_off_anywhere_is_refused),
        cmocka_unit_test(any_byte_may_be_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
