#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/exr.h>
#include <lobe/file.h>

#include "engine/image/half.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

static uint32_t random_bits(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8 | *state << 24;
}

/// Floats with arbitrary bits, including subnormal, infinite and NaN values.
static lobe_image make_noise(lobe_format format, uint32_t width, uint32_t height, uint32_t seed) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, format, width, height, NULL), LOBE_OK);
    size_t count = (size_t)width * height * lobe_format_size(format) / 4;
    for (size_t index = 0; index < count; index++)
        ((uint32_t *)image.texels)[index] = random_bits(&seed);
    return image;
}

/// Finite radiance of all magnitudes in the range of half.
static lobe_image make_radiance(uint32_t width, uint32_t height) {
    lobe_image image;
    uint32_t seed = 5;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
                     LOBE_OK);
    for (size_t index = 0; index < (size_t)4 * width * height; index++) {
        int exponent = (int)(random_bits(&seed) % 28u) - 13;
        float fraction = (float)(random_bits(&seed) >> 8) * 0x1p-24f;
        ((float *)image.texels)[index] = ldexpf(1.0f + fraction, exponent) * (index % 3 ? 1 : -1);
    }
    return image;
}

static lobe_result write_layers(const char *path, const lobe_exr_layer *layers, size_t count,
                                const lobe_host *host) {
    lobe_exr_parameters parameters = {.layers = layers, .layer_count = count};
    return lobe_exr_write(path, &parameters, host);
}

static lobe_result write_image(const char *path, const lobe_image *image, lobe_exr_depth depth,
                               const lobe_host *host) {
    lobe_exr_layer layer = {.image = image, .depth = depth};
    return write_layers(path, &layer, 1, host);
}

// ---------------------------------------------------------------------------------------------

static void floats_survive_bit_by_bit(void **state) {
    (void)state;
    const uint32_t sizes[][2] = {{1, 1}, {5, 1}, {1, 47}, {16, 16}, {67, 45}, {671, 457}};
    const char *path = temporary_folder_file(&test_folder, "float.exr");
    for (size_t index = 0; index < sizeof sizes / sizeof sizes[0]; index++) {
        lobe_image read,
            written = make_noise(LOBE_FORMAT_RGBA32_FLOAT, sizes[index][0], sizes[index][1], 1);
        assert_int_equal(write_image(path, &written, LOBE_EXR_FLOAT, NULL), LOBE_OK);
        assert_int_equal(lobe_exr_read(path, NULL, NULL, &read), LOBE_OK);
        assert_int_equal(read.width, written.width);
        assert_int_equal(read.height, written.height);
        assert_memory_equal(read.texels, written.texels,
                            (size_t)16 * written.width * written.height);
        lobe_image_free(&written);
        lobe_image_free(&read);
    }
}

/// Blocks that compress badly come close to their raw size, and sometimes have exactly that size.
static void blocks_that_do_not_shrink_survive(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "block.exr");
    for (uint32_t seed = 0; seed < 600; seed++) {
        uint32_t width = 1 + seed % 6, height = 16, mask = (1u << (seed % 7)) - 1u,
                 state_bits = seed;
        lobe_image written, read;
        assert_int_equal(
            lobe_image_allocate(&written, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL), LOBE_OK);
        for (size_t index = 0; index < (size_t)4 * width * height; index++)
            ((float *)written.texels)[index] = (float)(random_bits(&state_bits) & mask);
        assert_int_equal(write_image(path, &written, LOBE_EXR_HALF, NULL), LOBE_OK);
        assert_int_equal(lobe_exr_read(path, NULL, NULL, &read), LOBE_OK);
        assert_memory_equal(read.texels, written.texels, (size_t)16 * width * height);
        lobe_image_free(&written);
        lobe_image_free(&read);
    }
}

static void halves_are_the_nearest(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "half.exr");
    lobe_image written = make_radiance(67, 45), read;
    assert_int_equal(write_image(path, &written, LOBE_EXR_HALF, NULL), LOBE_OK);
    assert_int_equal(lobe_exr_read(path, NULL, NULL, &read), LOBE_OK);
    for (size_t index = 0; index < (size_t)4 * 67 * 45; index++) {
        float before = ((float *)written.texels)[index], after = ((float *)read.texels)[index];
        assert_true(fabsf(after - before) <= fabsf(before) * 0x1p-11f);
    }
    lobe_image_free(&written);
    lobe_image_free(&read);
}

static void half_images_are_written_as_they_are(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "half.exr");
    lobe_image written = make_noise(LOBE_FORMAT_RGBA16_FLOAT, 33, 20, 9), read;
    assert_int_equal(write_image(path, &written, LOBE_EXR_FLOAT, NULL), LOBE_OK);
    assert_int_equal(lobe_exr_read(path, NULL, NULL, &read), LOBE_OK);
    for (size_t index = 0; index < (size_t)4 * 33 * 20; index++) {
        float before = engine_half_to_float(((uint16_t *)written.texels)[index]);
        float after = ((float *)read.texels)[index];
        assert_true(after == before || (isnan(after) && isnan(before)));
    }
    lobe_image_free(&written);
    lobe_image_free(&read);
}

static void what_half_cannot_hold_is_clamped_and_counted(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "clamp.exr");
    float texels[8] = {1e6f, -1e6f, 65504.0f, 65519.0f, INFINITY, -INFINITY, NAN, 65520.0f};
    const float expected[8] = {65504.0f, -65504.0f, 65504.0f, 65504.0f,
                               INFINITY, -INFINITY, NAN,      65504.0f};
    lobe_image written = {LOBE_FORMAT_RGBA32_FLOAT, 2, 1, texels}, read;
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(write_image(path, &written, LOBE_EXR_HALF, &recorder.host), LOBE_OK);
    assert_int_equal(recorder.warnings, 1);
    assert_non_null(strstr(recorder.last_warning, " 3 values"));
    assert_int_equal(lobe_exr_read(path, NULL, NULL, &read), LOBE_OK);
    for (int index = 0; index < 8; index++) {
        float found = ((float *)read.texels)[index];
        assert_true(isnan(expected[index]) ? isnan(found) : found == expected[index]);
    }
    lobe_image_free(&read);
    log_recorder_start(&recorder);
    assert_int_equal(write_image(path, &written, LOBE_EXR_FLOAT, &recorder.host), LOBE_OK);
    assert_int_equal(recorder.warnings, 0);
}

// ---------------------------------------------------------------------------------------------
// Layers

static void expect_layer(const char *path, const char *layer, const lobe_image *source,
                         const int components[4]) {
    lobe_image read;
    assert_int_equal(lobe_exr_read(path, layer, NULL, &read), LOBE_OK);
    uint32_t channels = lobe_format_channels(source->format);
    for (size_t index = 0; index < (size_t)source->width * source->height; index++) {
        for (int component = 0; component < 4; component++) {
            float expected = 1.0f; // missing alpha
            if (components[component] >= 0)
                expected = ((float *)source->texels)[index * channels + components[component]];
            assert_memory_equal((float *)read.texels + 4 * index + component, &expected, 4);
        }
    }
    lobe_image_free(&read);
}

static void expect_channel_list(const char *path, const char *const *names,
                                const exr_pixel_type_t *types, int count) {
    exr_context_t context;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    const exr_attr_chlist_t *channels;
    assert_int_equal(exr_start_read(&context, path, &settings), EXR_ERR_SUCCESS);
    assert_int_equal(exr_get_channels(context, 0, &channels), EXR_ERR_SUCCESS);
    assert_int_equal(channels->num_channels, count);
    for (int index = 0; index < count; index++) {
        assert_string_equal(channels->entries[index].name.str, names[index]);
        assert_int_equal(channels->entries[index].pixel_type, types[index]);
    }
    exr_finish(&context);
}

static void layers_share_a_file_in_sorted_order(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "layers.exr");
    lobe_image colour = make_noise(LOBE_FORMAT_RGBA32_FLOAT, 23, 37, 1);
    lobe_image normal = make_noise(LOBE_FORMAT_RGBA32_FLOAT, 23, 37, 2);
    lobe_image depth = make_noise(LOBE_FORMAT_R32_FLOAT, 23, 37, 3);
    lobe_image pair = make_noise(LOBE_FORMAT_RG32_FLOAT, 23, 37, 4);
    lobe_image count;
    assert_int_equal(lobe_image_allocate(&count, LOBE_FORMAT_R32_FLOAT, 23, 37, NULL), LOBE_OK);
    for (int index = 0; index < 23 * 37; index++)
        ((float *)count.texels)[index] = (float)(index % 9);
    const lobe_exr_layer layers[] = {
        {.image = &colour, .depth = LOBE_EXR_FLOAT},
        {.name = "normal", .channels = {"X", "Y", "Z"}, .image = &normal, .depth = LOBE_EXR_FLOAT},
        {.name = "depth", .channels = {"Z"}, .image = &depth, .depth = LOBE_EXR_FLOAT},
        {.name = "lobes", .channels = {"count"}, .image = &count, .depth = LOBE_EXR_HALF},
        {.name = "level", .channels = {NULL, "value"}, .image = &pair, .depth = LOBE_EXR_FLOAT},
    };
    assert_int_equal(write_layers(path, layers, 5, NULL), LOBE_OK);
    expect_layer(path, NULL, &colour, (int[4]){0, 1, 2, 3});
    expect_layer(path, "normal", &normal, (int[4]){0, 1, 2, -1});
    expect_layer(path, "depth", &depth, (int[4]){0, 0, 0, -1});
    expect_layer(path, "lobes", &count, (int[4]){0, 0, 0, -1});
    expect_layer(path, "level", &pair, (int[4]){1, 1, 1, -1});
    const char *const names[] = {"A",           "B",           "G",        "R",        "depth.Z",
                                 "level.value", "lobes.count", "normal.X", "normal.Y", "normal.Z"};
    const exr_pixel_type_t types[] = {
        EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT,
        EXR_PIXEL_FLOAT, EXR_PIXEL_HALF,  EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT};
    expect_channel_list(path, names, types, 10);
    lobe_image_free(&colour);
    lobe_image_free(&normal);
    lobe_image_free(&depth);
    lobe_image_free(&pair);
    lobe_image_free(&count);
}

static void images_of_fewer_channels_have_names_too(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "grey.exr");
    lobe_image grey = make_noise(LOBE_FORMAT_R32_FLOAT, 8, 8, 1);
    lobe_image pair = make_noise(LOBE_FORMAT_RG32_FLOAT, 8, 8, 2);
    const lobe_exr_layer layers[] = {
        {.image = &grey, .depth = LOBE_EXR_FLOAT},
        {.name = "offset", .image = &pair, .depth = LOBE_EXR_FLOAT},
    };
    assert_int_equal(write_layers(path, layers, 2, NULL), LOBE_OK);
    expect_channel_list(path, (const char *[]){"Y", "offset.X", "offset.Y"},
                        (exr_pixel_type_t[]){EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT}, 3);
    expect_layer(path, NULL, &grey, (int[4]){0, 0, 0, -1});
    lobe_image_free(&grey);
    lobe_image_free(&pair);
}

static void the_header_says_what_was_asked(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "header.exr");
    lobe_image image = make_radiance(20, 10);
    const char *long_name = "lobe.pass.a_name_of_more_than_thirty_one_bytes.milliseconds";
    const lobe_exr_layer layer = {.image = &image, .depth = LOBE_EXR_HALF};
    const lobe_exr_attribute attributes[] = {
        {.name = "lobe.filter", .type = LOBE_EXR_TEXT, .text = "lobes, \xc3\xa9 and \"more\""},
        {.name = "lobe.empty", .type = LOBE_EXR_TEXT, .text = ""},
        {.name = long_name, .type = LOBE_EXR_NUMBER, .number = 0.1f},
        {.name = "lobe.samples", .type = LOBE_EXR_INTEGER, .integer = -4096},
    };
    const lobe_exr_parameters parameters = {
        .layers = &layer, .layer_count = 1, .attributes = attributes, .attribute_count = 4};
    assert_int_equal(lobe_exr_write(path, &parameters, NULL), LOBE_OK);

    exr_context_t context;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    assert_int_equal(exr_start_read(&context, path, &settings), EXR_ERR_SUCCESS);
    int32_t length, integer;
    const char *text;
    float number;
    assert_int_equal(exr_attr_get_string(context, 0, "lobe.filter", &length, &text), 0);
    assert_string_equal(text, attributes[0].text);
    assert_int_equal(exr_attr_get_string(context, 0, "lobe.empty", &length, &text), 0);
    assert_int_equal(length, 0);
    assert_int_equal(exr_attr_get_float(context, 0, long_name, &number), 0);
    assert_float_equal(number, 0.1f, 0.0);
    assert_int_equal(exr_attr_get_int(context, 0, "lobe.samples", &integer), 0);
    assert_int_equal(integer, -4096);
    exr_attr_chromaticities_t found;
    const exr_attr_chromaticities_t rec709 = {0.64f, 0.33f, 0.30f,   0.60f,
                                              0.15f, 0.06f, 0.3127f, 0.3290f};
    assert_int_equal(exr_attr_get_chromaticities(context, 0, "chromaticities", &found), 0);
    assert_memory_equal(&found, &rec709, sizeof rec709);
    exr_compression_t compression;
    assert_int_equal(exr_get_compression(context, 0, &compression), EXR_ERR_SUCCESS);
    assert_int_equal(compression, EXR_COMPRESSION_ZIP);
    exr_finish(&context);
    lobe_image_free(&image);
}

static void equal_parameters_give_equal_bytes(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "again.exr");
    lobe_image image = make_radiance(67, 45);
    uint8_t *data[2];
    size_t sizes[2];
    for (int run = 0; run < 2; run++) {
        assert_int_equal(write_image(path, &image, LOBE_EXR_HALF, NULL), LOBE_OK);
        assert_int_equal(lobe_file_read(path, NULL, NULL, &data[run], &sizes[run]), LOBE_OK);
    }
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(data[0], data[1], sizes[0]);
    lobe_release(data[0]);
    lobe_release(data[1]);
    lobe_image_free(&image);
}

// ---------------------------------------------------------------------------------------------
// Misuse

static void expect_refused(const lobe_exr_parameters *parameters, const char *cause) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    const char *path = temporary_folder_file(&test_folder, "refused.exr");
    assert_int_equal(lobe_exr_write(path, parameters, &recorder.host), LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, path));
    assert_non_null(strstr(recorder.last_error, cause));
    assert_int_equal(temporary_folder_count(&test_folder), 0);
}

static void expect_layers_refused(const lobe_exr_layer *layers, size_t count, const char *cause) {
    expect_refused(&(lobe_exr_parameters){.layers = layers, .layer_count = count}, cause);
}

static void expect_attributes_refused(const lobe_exr_layer *layer,
                                      const lobe_exr_attribute *attributes, size_t count,
                                      const char *cause) {
    expect_refused(
        &(lobe_exr_parameters){
            .layers = layer, .layer_count = 1, .attributes = attributes, .attribute_count = count},
        cause);
}

static void wrong_layers_are_refused(void **state) {
    (void)state;
    lobe_image small = make_noise(LOBE_FORMAT_RGBA32_FLOAT, 4, 4, 1);
    lobe_image large = make_noise(LOBE_FORMAT_RGBA32_FLOAT, 4, 5, 1);
    lobe_image bytes = make_noise(LOBE_FORMAT_RGBA8_UNORM, 4, 4, 1);
    lobe_image single = make_noise(LOBE_FORMAT_R32_FLOAT, 4, 4, 1);
    char long_name[300];
    memset(long_name, 'n', sizeof long_name);
    long_name[sizeof long_name - 1] = '\0';
    expect_layers_refused(NULL, 0, "no layer");
    expect_layers_refused((lobe_exr_layer[]){{.image = &small}, {.name = "a", .image = &large}}, 2,
                          "4x5");
    expect_layers_refused((lobe_exr_layer[]){{.image = &bytes}}, 1, "RGBA8_UNORM");
    expect_layers_refused((lobe_exr_layer[]){{.image = &small}, {.image = &small}}, 2, "twice");
    expect_layers_refused((lobe_exr_layer[]){{.image = &single, .channels = {"Y", "Z"}}}, 1,
                          "more channels");
    expect_layers_refused((lobe_exr_layer[]){{.image = &single, .channels = {""}}}, 1, "name");
    expect_layers_refused((lobe_exr_layer[]){{.image = &single, .name = long_name}}, 1, "name");
    lobe_image_free(&small);
    lobe_image_free(&large);
    lobe_image_free(&bytes);
    lobe_image_free(&single);
}

static void wrong_attributes_are_refused(void **state) {
    (void)state;
    lobe_image image = make_noise(LOBE_FORMAT_RGBA32_FLOAT, 4, 4, 1);
    const lobe_exr_layer layer = {.image = &image};
    const lobe_exr_attribute twice[2] = {{.name = "a", .type = LOBE_EXR_INTEGER},
                                         {.name = "a", .type = LOBE_EXR_INTEGER}};
    const lobe_exr_attribute wrong[] = {
        {.name = "channels", .type = LOBE_EXR_TEXT, .text = "mine"},
        {.name = "", .type = LOBE_EXR_TEXT, .text = "nameless"},
        {.name = NULL, .type = LOBE_EXR_TEXT, .text = "nameless"},
        {.name = "textless", .type = LOBE_EXR_TEXT},
        {.name = "odd", .type = (lobe_exr_attribute_type)99},
    };
    const char *const causes[] = {"channels", "name", "name", "textless", "odd"};
    for (int index = 0; index < 5; index++)
        expect_attributes_refused(&layer, &wrong[index], 1, causes[index]);
    expect_attributes_refused(&layer, twice, 2, "'a'");
    lobe_image_free(&image);
}

static void what_cannot_be_written_leaves_the_old(void **state) {
    (void)state;
    lobe_image image = make_radiance(64, 64);
    char missing[256];
    snprintf(missing, sizeof missing, "%s/none/image.exr", test_folder.path);
    const char *paths[3] = {"/dev/full", test_folder.path, missing};
    for (int index = 0; index < 3; index++) {
        log_recorder recorder;
        log_recorder_start(&recorder);
        assert_int_equal(write_image(paths[index], &image, LOBE_EXR_HALF, &recorder.host),
                         LOBE_ERROR_WRITE);
        assert_int_equal(recorder.errors, 1);
        assert_non_null(strstr(recorder.last_error, paths[index]));
    }
    assert_int_equal(temporary_folder_count(&test_folder), 0);
    // An existing file is unchanged if writing over it fails.
    const char *path = temporary_folder_file(&test_folder, "old.exr");
    assert_int_equal(lobe_file_write(path, "old", 3, NULL), LOBE_OK);
    assert_int_equal(write_layers(path, NULL, 0, NULL), LOBE_ERROR_INVALID_ARGUMENT);
    const lobe_exr_layer layer = {.image = &image};
    const lobe_exr_attribute reserved = {.name = "channels", .type = LOBE_EXR_INTEGER};
    assert_int_equal(lobe_exr_write(path,
                                    &(lobe_exr_parameters){.layers = &layer,
                                                           .layer_count = 1,
                                                           .attributes = &reserved,
                                                           .attribute_count = 1},
                                    NULL),
                     LOBE_ERROR_INVALID_ARGUMENT);
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(path, NULL, NULL, &data, &size), LOBE_OK);
    assert_int_equal(size, 3);
    lobe_release(data);
    lobe_image_free(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(floats_survive_bit_by_bit),
        IN_TEST_FOLDER(blocks_that_do_not_shrink_survive),
        IN_TEST_FOLDER(halves_are_the_nearest),
        IN_TEST_FOLDER(half_images_are_written_as_they_are),
        IN_TEST_FOLDER(what_half_cannot_hold_is_clamped_and_counted),
        IN_TEST_FOLDER(layers_share_a_file_in_sorted_order),
        IN_TEST_FOLDER(images_of_fewer_channels_have_names_too),
        IN_TEST_FOLDER(the_header_says_what_was_asked),
        IN_TEST_FOLDER(equal_parameters_give_equal_bytes),
        IN_TEST_FOLDER(wrong_layers_are_refused),
        IN_TEST_FOLDER(wrong_attributes_are_refused),
        IN_TEST_FOLDER(what_cannot_be_written_leaves_the_old),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
