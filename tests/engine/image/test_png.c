#include "tests/engine/support/cmocka_all.h"

#include <dirent.h>
#include <png.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>
#include <lobe/png.h>

#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

/// A pattern without repetition, so that no filter or palette hides a mistake.
static lobe_image make_pattern(uint32_t width, uint32_t height, bool opaque) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA8_SRGB, width, height, NULL),
                     LOBE_OK);
    uint8_t *texels = image.texels;
    for (size_t index = 0; index < (size_t)4 * width * height; index++)
        texels[index] = index % 4 == 3 && opaque ? 255 : (uint8_t)(index * 2654435761u >> 13);
    return image;
}

static void expect_same_texels(const lobe_image *read, const lobe_image *written) {
    assert_int_equal(read->format, written->format);
    assert_int_equal(read->width, written->width);
    assert_int_equal(read->height, written->height);
    assert_memory_equal(read->texels, written->texels,
                        (size_t)written->width * written->height *
                            lobe_format_size(written->format));
}

static void what_was_written_is_read(void **state) {
    (void)state;
    const uint32_t sizes[][2] = {{1, 1}, {7, 1}, {1, 5}, {67, 45}};
    const char *path = temporary_folder_file(&test_folder, "pattern.png");
    for (int index = 0; index < 4; index++) {
        for (int opaque = 0; opaque < 2; opaque++) {
            lobe_image written = make_pattern(sizes[index][0], sizes[index][1], opaque), read;
            assert_int_equal(lobe_png_write(path, &written, NULL), LOBE_OK);
            assert_int_equal(lobe_png_read(path, NULL, &read), LOBE_OK);
            expect_same_texels(&read, &written);
            lobe_image_free(&written);
            lobe_image_free(&read);
        }
    }
}

static void memory_holds_what_a_file_would(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "memory.png");
    lobe_image image = make_pattern(67, 45, true);
    uint8_t *encoded, *file;
    size_t encoded_size, file_size;
    assert_int_equal(lobe_png_encode("memory", &image, NULL, &encoded, &encoded_size), LOBE_OK);
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    assert_int_equal(lobe_file_read(path, NULL, NULL, &file, &file_size), LOBE_OK);
    assert_int_equal(encoded_size, file_size);
    assert_memory_equal(encoded, file, file_size);
    lobe_release(encoded);
    lobe_release(file);
    image.format = LOBE_FORMAT_R32_FLOAT;
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(lobe_png_encode("memory", &image, &recorder.host, &encoded, &encoded_size),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "memory"));
    assert_true(encoded == NULL && encoded_size == 0);
    lobe_image_free(&image);
}

static void header_byte(const char *path, size_t offset, int expected) {
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(path, NULL, NULL, &data, &size), LOBE_OK);
    assert_int_equal(data[offset], expected);
    lobe_release(data);
}

static void alpha_is_stored_only_where_there_is_any(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "alpha.png");
    lobe_image image = make_pattern(4, 4, true);
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    header_byte(path, 25, PNG_COLOR_TYPE_RGB);
    ((uint8_t *)image.texels)[4 * 15 + 3] = 254;
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    header_byte(path, 25, PNG_COLOR_TYPE_RGB_ALPHA);
    lobe_image_free(&image);
}

static void equal_images_give_equal_bytes(void **state) {
    (void)state;
    uint8_t *data[2];
    size_t sizes[2];
    const char *path = temporary_folder_file(&test_folder, "again.png");
    lobe_image image = make_pattern(31, 17, false);
    for (int run = 0; run < 2; run++) {
        assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
        assert_int_equal(lobe_file_read(path, NULL, NULL, &data[run], &sizes[run]), LOBE_OK);
    }
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(data[0], data[1], sizes[0]);
    lobe_release(data[0]);
    lobe_release(data[1]);
    lobe_image_free(&image);
}

/// Writes a file of another kind straight through libpng.
static void write_raw(const char *path, int depth, int colour_type, uint32_t width, uint32_t height,
                      const uint8_t *rows, size_t row_size) {
    static const png_color palette[2] = {{10, 20, 30}, {200, 100, 50}};
    static const png_byte transparency[2] = {255, 128};
    FILE *file = fopen(path, "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop information = png_create_info_struct(png);
    assert_non_null(file);
    png_init_io(png, file);
    png_set_IHDR(png, information, width, height, depth, colour_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (colour_type == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, information, palette, 2);
        png_set_tRNS(png, information, transparency, 2, NULL);
    }
    png_write_info(png, information);
    for (uint32_t row = 0; row < height; row++)
        png_write_row(png, rows + row * row_size);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &information);
    fclose(file);
}

static void sixteen_bits_are_kept_in_this_machines_order(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "sixteen.png");
    const uint8_t rows[12] = {0x12, 0x34, 0x00, 0x01, 0xff, 0xff,
                              0x80, 0x00, 0x00, 0x00, 0x7f, 0xff};
    write_raw(path, 16, PNG_COLOR_TYPE_RGB, 2, 1, rows, sizeof rows);
    lobe_image image;
    assert_int_equal(lobe_png_read(path, NULL, &image), LOBE_OK);
    assert_int_equal(image.format, LOBE_FORMAT_RGBA16_UNORM);
    const uint16_t expected[8] = {0x1234, 1, 0xffff, 0xffff, 0x8000, 0, 0x7fff, 0xffff};
    assert_memory_equal(image.texels, expected, sizeof expected);
    lobe_image_free(&image);
}

static void grey_is_spread_and_palettes_are_looked_up(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "kind.png");
    lobe_image image;
    write_raw(path, 8, PNG_COLOR_TYPE_GRAY, 2, 1, (uint8_t[2]){7, 250}, 2);
    assert_int_equal(lobe_png_read(path, NULL, &image), LOBE_OK);
    assert_int_equal(image.format, LOBE_FORMAT_RGBA8_SRGB);
    assert_memory_equal(image.texels, ((uint8_t[8]){7, 7, 7, 255, 250, 250, 250, 255}), 8);
    lobe_image_free(&image);
    write_raw(path, 1, PNG_COLOR_TYPE_PALETTE, 2, 1, (uint8_t[1]){0x40}, 1);
    assert_int_equal(lobe_png_read(path, NULL, &image), LOBE_OK);
    assert_memory_equal(image.texels, ((uint8_t[8]){10, 20, 30, 255, 200, 100, 50, 128}), 8);
    lobe_image_free(&image);
}

// ---------------------------------------------------------------------------------------------

static void expect_read_error(const char *path, lobe_result expected) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    assert_int_equal(lobe_png_read(path, &recorder.host, &image), expected);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, path));
    assert_null(image.texels);
}

static void a_file_cut_off_anywhere_is_refused(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "cut.png");
    lobe_image image = make_pattern(40, 30, false);
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    lobe_image_free(&image);
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(path, NULL, NULL, &data, &size), LOBE_OK);
    for (size_t length = 0; length < size; length += length < 128 ? 1 : 64) {
        assert_int_equal(lobe_file_write(path, data, length, NULL), LOBE_OK);
        expect_read_error(path, LOBE_ERROR_MALFORMED);
    }
    assert_int_equal(lobe_file_write(path, data, size - 1, NULL), LOBE_OK);
    expect_read_error(path, LOBE_ERROR_MALFORMED);
    lobe_release(data);
}

static void absurd_extents_are_refused_before_memory_is_taken(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "absurd.png");
    const uint8_t row[20000] = {0};
    write_raw(path, 1, PNG_COLOR_TYPE_GRAY, 70000, 2, row, 70000 / 8);
    expect_read_error(path, LOBE_ERROR_LIMIT);
    // The header of a 60000 x 60000 image before the rest of a small one: libpng checks the
    // header's checksum, so it is computed again.
    uint8_t start[33] = {0x89, 'P', 'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,
                         0,    13,  'I',  'H',  'D',  'R',  0,    0,    0xea, 0x60,
                         0,    0,   0xea, 0x60, 8,    6,    0,    0,    0};
    uint32_t checksum = 0xffffffffu;
    for (int index = 12; index < 29; index++) {
        checksum ^= start[index];
        for (int bit = 0; bit < 8; bit++)
            checksum = checksum >> 1 ^ (checksum & 1 ? 0xedb88320u : 0);
    }
    for (int index = 0; index < 4; index++)
        start[29 + index] = (uint8_t)(~checksum >> (24 - 8 * index));
    assert_int_equal(lobe_file_write(path, start, sizeof start, NULL), LOBE_OK);
    expect_read_error(path, LOBE_ERROR_MALFORMED);
}

static void what_cannot_be_read_is_named(void **state) {
    (void)state;
    expect_read_error(temporary_folder_file(&test_folder, "missing.png"), LOBE_ERROR_NOT_FOUND);
    expect_read_error(test_folder.path, LOBE_ERROR_READ);
    const char *path = temporary_folder_file(&test_folder, "text.png");
    assert_int_equal(lobe_file_write(path, "not a picture", 13, NULL), LOBE_OK);
    expect_read_error(path, LOBE_ERROR_MALFORMED);
}

static void what_cannot_be_written_leaves_nothing(void **state) {
    (void)state;
    lobe_image image = make_pattern(4, 4, true);
    const char *paths[3] = {"/dev/full", test_folder.path, NULL};
    char missing[256];
    snprintf(missing, sizeof missing, "%s/none/picture.png", test_folder.path);
    paths[2] = missing;
    for (int index = 0; index < 3; index++) {
        log_recorder recorder;
        log_recorder_start(&recorder);
        assert_int_equal(lobe_png_write(paths[index], &image, &recorder.host), LOBE_ERROR_WRITE);
        assert_int_equal(recorder.errors, 1);
        assert_non_null(strstr(recorder.last_error, paths[index]));
    }
    lobe_image_free(&image);
    assert_int_equal(temporary_folder_count(&test_folder), 0);
}

static void only_pictures_are_written(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, 2, 2, NULL), LOBE_OK);
    assert_int_equal(
        lobe_png_write(temporary_folder_file(&test_folder, "float.png"), &image, &recorder.host),
        LOBE_ERROR_INVALID_ARGUMENT);
    assert_int_equal(recorder.errors, 1);
    assert_int_equal(temporary_folder_count(&test_folder), 0);
    lobe_image_free(&image);
}

static void damaged_files_of_the_wild_are_refused(void **state) {
    (void)state;
    DIR *directory = opendir(LOBE_ASSETS "/bad/png");
    if (directory == NULL)
        skip();
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        if (strstr(entry->d_name, ".png") == NULL)
            continue;
        char path[512];
        snprintf(path, sizeof path, "%s/bad/png/%s", LOBE_ASSETS, entry->d_name);
        expect_read_error(path, LOBE_ERROR_MALFORMED);
    }
    closedir(directory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(what_was_written_is_read),
        IN_TEST_FOLDER(memory_holds_what_a_file_would),
        IN_TEST_FOLDER(alpha_is_stored_only_where_there_is_any),
        IN_TEST_FOLDER(equal_images_give_equal_bytes),
        IN_TEST_FOLDER(sixteen_bits_are_kept_in_this_machines_order),
        IN_TEST_FOLDER(grey_is_spread_and_palettes_are_looked_up),
        IN_TEST_FOLDER(a_file_cut_off_anywhere_is_refused),
        IN_TEST_FOLDER(absurd_extents_are_refused_before_memory_is_taken),
        IN_TEST_FOLDER(what_cannot_be_read_is_named),
        IN_TEST_FOLDER(what_cannot_be_written_leaves_nothing),
        IN_TEST_FOLDER(only_pictures_are_written),
        cmocka_unit_test(damaged_files_of_the_wild_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
