// Files of MIP levels: written and read back, and as OpenEXRCore's own reader sees them.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/exr.h>
#include <lobe/file.h>

#include "tests/engine/support/exr_fixture.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

#define MOST_LEVELS 16

static uint32_t smaller(uint32_t extent) {
    return extent > 1 ? extent / 2 : 1;
}

/// Values that identify level, position and channel, with noise that hardly compresses.
static uint32_t make_levels(uint32_t width, uint32_t height, lobe_image *levels) {
    uint32_t seed = 7;
    for (uint32_t level = 0;; level++) {
        assert_int_equal(
            lobe_image_allocate(&levels[level], LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
            LOBE_OK);
        for (size_t index = 0; index < (size_t)4 * width * height; index++) {
            seed = seed * 1664525u + 1013904223u;
            ((float *)levels[level].texels)[index] =
                (float)(level + 1) + (float)(seed >> 8) * 0x1p-24f;
        }
        if (width == 1 && height == 1)
            return level + 1;
        width = smaller(width);
        height = smaller(height);
    }
}

static void free_levels(lobe_image *levels, uint32_t count) {
    for (uint32_t level = 0; level < count; level++)
        lobe_image_free(&levels[level]);
}

static void expect_equal(const lobe_image *found, const lobe_image *expected) {
    assert_int_equal(found->format, LOBE_FORMAT_RGBA32_FLOAT);
    assert_int_equal(found->width, expected->width);
    assert_int_equal(found->height, expected->height);
    assert_memory_equal(found->texels, expected->texels,
                        (size_t)16 * expected->width * expected->height);
}

static lobe_result write_levels(const char *path, const lobe_image *levels, uint32_t count,
                                const lobe_host *host) {
    const lobe_exr_layer layer = {.image = levels, .depth = LOBE_EXR_FLOAT};
    const lobe_exr_attribute attributes[] = {
        {.name = "lobe.kernel", .type = LOBE_EXR_TEXT, .text = "vmf"},
        {.name = "lobe.kappa", .type = LOBE_EXR_NUMBER, .number = 0.25f},
        {.name = "lobe.size", .type = LOBE_EXR_INTEGER, .integer = -3},
    };
    const lobe_exr_parameters parameters = {.layers = &layer,
                                            .layer_count = 1,
                                            .attributes = attributes,
                                            .attribute_count = 3,
                                            .level_count = count,
                                            .environment = LOBE_EXR_CUBE};
    return lobe_exr_write(path, &parameters, host);
}

static void levels_survive_bit_by_bit(void **state) {
    (void)state;
    const uint32_t sizes[][2] = {{16, 96}, {128, 64}, {67, 45}, {2, 1}, {1, 130}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lobe_image levels[MOST_LEVELS];
        uint32_t count = make_levels(sizes[i][0], sizes[i][1], levels);
        const char *path = temporary_folder_file(&test_folder, "levels.exr");
        lobe_exr_contents contents;
        assert_int_equal(write_levels(path, levels, count, NULL), LOBE_OK);
        assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
        assert_int_equal(contents.level_count, count);
        for (uint32_t level = 0; level < count; level++)
            expect_equal(&contents.levels[level], &levels[level]);
        lobe_image finest;
        assert_int_equal(lobe_exr_read(path, NULL, NULL, &finest), LOBE_OK);
        expect_equal(&finest, &levels[0]);
        lobe_image_free(&finest);
        lobe_exr_contents_free(&contents);
        free_levels(levels, count);
    }
}

static void the_header_is_read_back(void **state) {
    (void)state;
    lobe_image levels[MOST_LEVELS];
    uint32_t count = make_levels(4, 24, levels);
    const char *path = temporary_folder_file(&test_folder, "levels.exr");
    lobe_exr_contents contents;
    assert_int_equal(write_levels(path, levels, count, NULL), LOBE_OK);
    assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
    assert_int_equal(contents.environment, LOBE_EXR_CUBE);
    const lobe_exr_attribute *kernel =
        lobe_exr_find_attribute(&contents, "lobe.kernel", LOBE_EXR_TEXT);
    const lobe_exr_attribute *kappa =
        lobe_exr_find_attribute(&contents, "lobe.kappa", LOBE_EXR_NUMBER);
    const lobe_exr_attribute *size =
        lobe_exr_find_attribute(&contents, "lobe.size", LOBE_EXR_INTEGER);
    assert_non_null(kernel);
    assert_string_equal(kernel->text, "vmf");
    assert_non_null(kappa);
    assert_true(kappa->number == 0.25f);
    assert_non_null(size);
    assert_int_equal(size->integer, -3);
    assert_null(lobe_exr_find_attribute(&contents, "lobe.size", LOBE_EXR_NUMBER));
    assert_null(lobe_exr_find_attribute(&contents, "lobe.none", LOBE_EXR_TEXT));
    lobe_exr_contents_free(&contents);
    lobe_exr_contents_free(&contents);
    free_levels(levels, count);
}

/// What another program reads.
static void the_file_is_a_cube_of_levels_for_others(void **state) {
    (void)state;
    lobe_image levels[MOST_LEVELS];
    uint32_t count = make_levels(16, 96, levels);
    const char *path = temporary_folder_file(&test_folder, "levels.exr");
    assert_int_equal(write_levels(path, levels, count, NULL), LOBE_OK);
    exr_context_t context;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    assert_int_equal(exr_start_read(&context, path, &settings), EXR_ERR_SUCCESS);
    exr_envmap_t environment;
    exr_storage_t storage;
    uint32_t width, height;
    exr_tile_level_mode_t mode;
    exr_tile_round_mode_t rounding;
    int32_t columns, rows;
    assert_int_equal(exr_attr_get_envmap(context, 0, "envmap", &environment), EXR_ERR_SUCCESS);
    assert_int_equal(environment, EXR_ENVMAP_CUBE);
    assert_int_equal(exr_get_storage(context, 0, &storage), EXR_ERR_SUCCESS);
    assert_int_equal(storage, EXR_STORAGE_TILED);
    assert_int_equal(exr_get_tile_descriptor(context, 0, &width, &height, &mode, &rounding),
                     EXR_ERR_SUCCESS);
    assert_int_equal(mode, EXR_TILE_MIPMAP_LEVELS);
    assert_int_equal(rounding, EXR_TILE_ROUND_DOWN);
    assert_int_equal(exr_get_tile_levels(context, 0, &columns, &rows), EXR_ERR_SUCCESS);
    assert_int_equal(columns, 7);
    assert_int_equal(columns, count);
    for (int level = 0; level < columns; level++) {
        exr_chunk_info_t chunk;
        assert_int_equal(exr_read_tile_chunk_info(context, 0, 0, 0, level, level, &chunk),
                         EXR_ERR_SUCCESS);
    }
    exr_finish(&context);
    free_levels(levels, count);
}

/// Written by OpenEXRCore: coarser levels hold the negative of the finest's values.
static void levels_of_others_are_read(void **state) {
    (void)state;
    const exr_fixture_channel channels[] = {
        {"B", EXR_PIXEL_HALF, 0}, {"G", EXR_PIXEL_FLOAT, 0}, {"R", EXR_PIXEL_HALF, 0}};
    const exr_attr_box2i_t window = {{.x = -5, .y = 7}, {.x = 64, .y = 40}};
    exr_fixture_part part = {.data_window = window,
                             .display_window = window,
                             .compression = EXR_COMPRESSION_PIZ,
                             .tile_width = 16,
                             .tile_height = 9,
                             .mipmap = true,
                             .channels = channels,
                             .channel_count = 3};
    const char *path = temporary_folder_file(&test_folder, "others.exr");
    exr_fixture_write(path, &part, 1);
    lobe_exr_contents contents;
    assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
    assert_int_equal(contents.level_count, 7);
    assert_int_equal(contents.environment, LOBE_EXR_NO_ENVIRONMENT);
    uint32_t width = 70, height = 34;
    for (uint32_t level = 0; level < 7; level++) {
        const lobe_image *image = &contents.levels[level];
        assert_int_equal(image->width, width);
        assert_int_equal(image->height, height);
        for (uint32_t y = 0; y < height; y++) {
            for (uint32_t x = 0; x < width; x++) {
                float expected = exr_fixture_value(2, (int)x - 5, (int)y + 7);
                float found = ((float *)image->texels)[4 * (y * width + x)];
                assert_true(found == (level == 0 ? expected : -expected));
            }
        }
        width = smaller(width);
        height = smaller(height);
    }
    lobe_exr_contents_free(&contents);
    // A window that is cut off: its coarser levels would not fit the finest.
    part.display_window = (exr_attr_box2i_t){{.x = 0, .y = 7}, {.x = 64, .y = 40}};
    exr_fixture_write(path, &part, 1);
    assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
    assert_int_equal(contents.level_count, 1);
    assert_int_equal(contents.levels[0].width, 65);
    lobe_exr_contents_free(&contents);
}

static void expect_refused(const lobe_image *levels, uint32_t count, const char *cause) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    const char *path = temporary_folder_file(&test_folder, "refused.exr");
    assert_int_equal(write_levels(path, levels, count, &recorder.host),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, cause));
    assert_int_equal(temporary_folder_count(&test_folder), 0);
}

static void wrong_levels_are_refused(void **state) {
    (void)state;
    lobe_image levels[MOST_LEVELS], other;
    uint32_t count = make_levels(8, 8, levels);
    expect_refused(levels, count - 1, "3 levels are given, 8x8 texels have 4");
    other = levels[2];
    levels[2] = levels[1];
    expect_refused(levels, count, "4x4 texels on level 2 instead of 2x2");
    levels[2] = other;
    levels[1].format = LOBE_FORMAT_R32_FLOAT;
    expect_refused(levels, count, "differ in their channels");
    levels[1].format = LOBE_FORMAT_RGBA8_UNORM;
    expect_refused(levels, count, "RGBA8_UNORM");
    free_levels(levels, count);
}

/// Truncated anywhere, the file is rejected with one log line; contents stay empty.
static void cut_off_files_are_refused(void **state) {
    (void)state;
    lobe_image levels[MOST_LEVELS];
    uint32_t count = make_levels(8, 48, levels);
    const char *path = temporary_folder_file(&test_folder, "cut.exr");
    uint8_t *data;
    size_t size;
    assert_int_equal(write_levels(path, levels, count, NULL), LOBE_OK);
    assert_int_equal(lobe_file_read(path, NULL, NULL, &data, &size), LOBE_OK);
    for (size_t length = 1; length < size; length += size / 61) {
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_exr_contents contents;
        assert_int_equal(lobe_file_write(path, data, length, NULL), LOBE_OK);
        assert_int_equal(lobe_exr_read_contents(path, NULL, &recorder.host, &contents),
                         LOBE_ERROR_MALFORMED);
        assert_int_equal(recorder.errors, 1);
        assert_null(contents.levels);
        assert_int_equal(contents.level_count, 0);
    }
    lobe_release(data);
    free_levels(levels, count);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(levels_survive_bit_by_bit),
        IN_TEST_FOLDER(the_header_is_read_back),
        IN_TEST_FOLDER(the_file_is_a_cube_of_levels_for_others),
        IN_TEST_FOLDER(levels_of_others_are_read),
        IN_TEST_FOLDER(wrong_levels_are_refused),
        IN_TEST_FOLDER(cut_off_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
