// PNG and JPEG files, good and bad.

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jpeglib.h>
#include <png.h>

#include "scenes/format/image_file.h"

#define BAD_FILES LOBE_TEST_ASSETS "/bad/png"

static size_t errors;
static char error[1024];

static void on_log(void *user, lobe_log_level level, const char *message) {
    (void)user;
    assert_int_equal(level, LOBE_LOG_ERROR);
    errors++;
    snprintf(error, sizeof error, "%s", message);
}

static const lobe_host test_log = {.write = on_log};

static void assert_said(lobe_result result, const lobe_image *image, const char *name) {
    if (result == LOBE_OK) {
        assert_non_null(image->texels);
        assert_int_equal(errors, 0);
    } else {
        assert_null(image->texels);
        assert_int_equal(errors, 1);
        assert_non_null(strstr(error, name));
    }
}

static lobe_result decode(const void *bytes, size_t size, scene_image_use use, lobe_image *image) {
    errors = 0;
    // A copy of the exact size lets the sanitizer detect reads past the end.
    void *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    lobe_result result = scenes_image_decode(copy, size, "picture", use, &test_log, image);
    free(copy);
    assert_said(result, image, "picture");
    return result;
}

static lobe_result load(const char *path, lobe_image *image) {
    errors = 0;
    lobe_result result = scenes_image_load(path, SCENE_IMAGE_DATA, &test_log, image);
    assert_said(result, image, path);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Encoders

typedef struct encoded {
    char *bytes;
    size_t size;
} encoded;

typedef struct png_content {
    uint32_t width, height;
    int bits, colour_type, interlace;
    const void *rows;
    size_t row_size;
    const uint8_t *transparency; // of palette entries
    size_t transparency_count;
} png_content;

static const png_color palette[] = {{10, 20, 30}, {40, 50, 60}, {70, 80, 90}, {1, 2, 3}};

static encoded encode_png(const png_content *content) {
    encoded out = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE *memory = open_memstream(&out.bytes, &out.size);
    png_init_io(png, memory);
    png_set_IHDR(png, info, content->width, content->height, content->bits, content->colour_type,
                 content->interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (content->colour_type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 4);
    if (content->transparency)
        png_set_tRNS(png, info, content->transparency, (int)content->transparency_count, NULL);
    png_write_info(png, info);
    png_bytep rows[64];
    for (uint32_t y = 0; y < content->height; y++)
        rows[y] = (png_bytep)content->rows + y * content->row_size;
    png_write_image(png, rows);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(memory);
    return out;
}

static encoded encode_jpeg(const uint8_t *texels, uint32_t width, uint32_t height, int channels,
                           bool progressive) {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr manager;
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&manager);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = channels;
    jpeg.in_color_space = channels == 4 ? JCS_CMYK : channels == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    if (progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < height) {
        JSAMPROW row = (JSAMPROW)texels + jpeg.next_scanline * width * (uint32_t)channels;
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return (encoded){(char *)bytes, size};
}

// ---------------------------------------------------------------------------------------------
// Good files

static void assert_png(const png_content *content, const uint8_t *rgba) {
    encoded file = encode_png(content);
    lobe_image image;
    assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_DATA, &image), LOBE_OK);
    assert_int_equal(image.format, LOBE_FORMAT_RGBA8_UNORM);
    assert_int_equal(image.width, content->width);
    assert_int_equal(image.height, content->height);
    assert_memory_equal(image.texels, rgba, (size_t)content->width * content->height * 4);
    lobe_image_free(&image);
    free(file.bytes);
}

static void every_kind_of_png_becomes_rgba(void **state) {
    (void)state;
    const uint8_t rgb[] = {1, 2, 3, 4, 5, 6};
    const png_content colour = {2, 1, 8, PNG_COLOR_TYPE_RGB, 0, rgb, 6, NULL, 0};
    assert_png(&colour, (const uint8_t[]){1, 2, 3, 255, 4, 5, 6, 255});
    const uint8_t grey[] = {7, 200};
    const png_content plain = {1, 2, 8, PNG_COLOR_TYPE_GRAY, 0, grey, 1, NULL, 0};
    assert_png(&plain, (const uint8_t[]){7, 7, 7, 255, 200, 200, 200, 255});
    const uint8_t bits[] = {0x60};
    const png_content bitmap = {3, 1, 1, PNG_COLOR_TYPE_GRAY, 0, bits, 1, NULL, 0};
    assert_png(&bitmap, (const uint8_t[]){0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255});
    const uint8_t quarter[] = {0x1b};
    const png_content fine = {4, 1, 2, PNG_COLOR_TYPE_GRAY, 0, quarter, 1, NULL, 0};
    assert_png(&fine, (const uint8_t[]){0, 0, 0, 255, 85, 85, 85, 255, 170, 170, 170, 255, 255, 255,
                                        255, 255});
    const uint8_t pair[] = {9, 128};
    const png_content alpha = {1, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, 0, pair, 2, NULL, 0};
    assert_png(&alpha, (const uint8_t[]){9, 9, 9, 128});
    const uint8_t entries[] = {2, 0}, opacity[] = {33};
    const png_content indexed = {2, 1, 8, PNG_COLOR_TYPE_PALETTE, 0, entries, 2, opacity, 1};
    assert_png(&indexed, (const uint8_t[]){70, 80, 90, 255, 10, 20, 30, 33});
}

static void interlaced_png_is_the_same_image(void **state) {
    (void)state;
    uint8_t texels[13 * 11 * 4];
    for (size_t i = 0; i < sizeof texels; i++)
        texels[i] = (uint8_t)(i * 7 + i / 5);
    const png_content content = {13,     11,   8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_ADAM7, texels,
                                 13 * 4, NULL, 0};
    assert_png(&content, texels);
}

static void sixteen_bits_of_grey_are_kept_for_data(void **state) {
    (void)state;
    const uint8_t rows[] = {0x12, 0x34, 0xff, 0x01};
    const png_content content = {2, 1, 16, PNG_COLOR_TYPE_GRAY, 0, rows, 4, NULL, 0};
    encoded file = encode_png(&content);
    lobe_image image;
    assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_DATA, &image), LOBE_OK);
    assert_int_equal(image.format, LOBE_FORMAT_RGBA16_UNORM);
    const uint16_t expected[] = {0x1234, 0x1234, 0x1234, 0xffff, 0xff01, 0xff01, 0xff01, 0xffff};
    assert_memory_equal(image.texels, expected, sizeof expected);
    lobe_image_free(&image);
    assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_COLOUR, &image), LOBE_OK);
    assert_int_equal(image.format, LOBE_FORMAT_RGBA8_SRGB);
    assert_memory_equal(image.texels,
                        ((const uint8_t[]){0x12, 0x12, 0x12, 255, 254, 254, 254, 255}), 8);
    lobe_image_free(&image);
    free(file.bytes);
}

static void jpeg_becomes_rgba(void **state) {
    (void)state;
    uint8_t texels[16 * 8 * 3];
    for (int i = 0; i < 16 * 8; i++)
        memcpy(texels + 3 * i, i % 16 < 8 ? (uint8_t[]){200, 30, 60} : (uint8_t[]){20, 90, 250}, 3);
    for (int kind = 0; kind < 4; kind++) {
        int channels = kind % 2 ? 1 : 3;
        encoded file = encode_jpeg(texels, channels == 3 ? 16 : 24, channels == 3 ? 8 : 16,
                                   channels, kind >= 2);
        lobe_image image;
        assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_COLOUR, &image), LOBE_OK);
        assert_int_equal(image.format, LOBE_FORMAT_RGBA8_SRGB);
        const uint8_t *rgba = image.texels;
        assert_int_equal(rgba[3], 255);
        if (channels == 3) {
            assert_in_range(rgba[0], 196, 204);
            assert_in_range(rgba[1], 26, 34);
            assert_in_range(rgba[4 * 15 + 2], 246, 254);
        } else {
            assert_int_equal(rgba[0], rgba[1]);
            assert_int_equal(rgba[0], rgba[2]);
        }
        lobe_image_free(&image);
        free(file.bytes);
    }
}

// ---------------------------------------------------------------------------------------------
// Bad files

static void other_formats_are_named_unsupported(void **state) {
    (void)state;
    lobe_image image;
    assert_int_equal(decode("GIF89a..........", 16, SCENE_IMAGE_DATA, &image),
                     LOBE_ERROR_UNSUPPORTED);
    assert_int_equal(decode("RIFF....WEBPVP8 ", 16, SCENE_IMAGE_DATA, &image),
                     LOBE_ERROR_UNSUPPORTED);
    assert_int_equal(decode("", 0, SCENE_IMAGE_DATA, &image), LOBE_ERROR_MALFORMED);
    uint8_t ink[16] = {0};
    encoded file = encode_jpeg(ink, 2, 2, 4, false);
    assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_DATA, &image), LOBE_ERROR_MALFORMED);
    assert_non_null(strstr(error, "unsupported JPEG: its colours are neither grey nor RGB"));
    free(file.bytes);
}

static void assert_every_truncation_fails(encoded file, size_t end) {
    for (size_t size = 0; size < end; size++) {
        lobe_image image;
        assert_int_not_equal(decode(file.bytes, size, SCENE_IMAGE_DATA, &image), LOBE_OK);
    }
}

static void every_truncation_is_refused(void **state) {
    (void)state;
    uint8_t texels[24 * 24];
    for (size_t i = 0; i < sizeof texels; i++)
        texels[i] = (uint8_t)(i * i);
    const png_content content = {24, 24, 8, PNG_COLOR_TYPE_GRAY, 0, texels, 24, NULL, 0};
    encoded file = encode_png(&content);
    assert_every_truncation_fails(file, file.size);
    free(file.bytes);
    for (int progressive = 0; progressive < 2; progressive++) {
        file = encode_jpeg(texels, 24, 24, 1, progressive);
        // Without the end marker all texels are there; libjpeg may accept or reject that.
        assert_every_truncation_fails(file, file.size - 2);
        free(file.bytes);
    }
}

static void damaged_files_never_do_harm(void **state) {
    (void)state;
    uint8_t texels[16 * 16 * 3];
    for (size_t i = 0; i < sizeof texels; i++)
        texels[i] = (uint8_t)(i * 31 >> 3);
    const png_content content = {16, 16, 8, PNG_COLOR_TYPE_RGB, 0, texels, 48, NULL, 0};
    encoded files[] = {encode_png(&content), encode_jpeg(texels, 16, 16, 3, false),
                       encode_jpeg(texels, 16, 16, 3, true)};
    uint32_t seed = 1;
    for (int kind = 0; kind < 3; kind++) {
        for (int trial = 0; trial < 300; trial++) {
            seed = seed * 1664525u + 1013904223u;
            char *byte = &files[kind].bytes[seed % files[kind].size];
            char before = *byte;
            *byte = (char)(seed >> 24);
            lobe_image image;
            decode(files[kind].bytes, files[kind].size, SCENE_IMAGE_COLOUR, &image);
            lobe_image_free(&image);
            *byte = before;
        }
        free(files[kind].bytes);
    }
}

static void store_big_endian(char *bytes, uint32_t value) {
    for (int i = 0; i < 4; i++)
        bytes[i] = (char)(value >> (24 - 8 * i));
}

// Changes the extent in a PNG header, and its checksum.
static void set_extent(encoded *file, uint32_t width, uint32_t height) {
    store_big_endian(file->bytes + 16, width);
    store_big_endian(file->bytes + 20, height);
    uint32_t sum = 0xffffffff;
    for (int i = 12; i < 29; i++) {
        sum ^= (uint8_t)file->bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
    store_big_endian(file->bytes + 29, ~sum);
}

static void absurd_extents_take_no_memory(void **state) {
    (void)state;
    static const struct {
        uint32_t width, height;
        lobe_result result;
        const char *cause;
    } cases[] = {
        {65536, 65536, LOBE_ERROR_LIMIT, "exceed"},
        {65536, 1, LOBE_ERROR_LIMIT, "exceed"},
        {0x7fffffff, 1, LOBE_ERROR_LIMIT, "exceed"},
        {20000, 20000, LOBE_ERROR_LIMIT, "exceed"},
        {16384, 16384, LOBE_ERROR_MALFORMED, "cannot hold"},
        {0, 1, LOBE_ERROR_MALFORMED, "broken PNG"},
        {0xffffffff, 1, LOBE_ERROR_MALFORMED, "broken PNG"},
        {3, 4, LOBE_ERROR_MALFORMED, "broken PNG"},
    };
    const uint8_t texels[12] = {0};
    const png_content content = {2, 2, 8, PNG_COLOR_TYPE_RGB, 0, texels, 6, NULL, 0};
    encoded file = encode_png(&content);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_image image;
        set_extent(&file, cases[i].width, cases[i].height);
        assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_DATA, &image), cases[i].result);
        assert_non_null(strstr(error, cases[i].cause));
    }
    set_extent(&file, 2, 2);
    lobe_image image;
    assert_int_equal(decode(file.bytes, file.size, SCENE_IMAGE_DATA, &image), LOBE_OK);
    lobe_image_free(&image);
    free(file.bytes);
}

static void what_is_no_file_is_not_waited_for(void **state) {
    (void)state;
    char folder[] = "/tmp/lobe-image-XXXXXX", pipe[64];
    lobe_image image;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(load(folder, &image), LOBE_ERROR_READ);
    snprintf(pipe, sizeof pipe, "%s/pipe", folder);
    assert_int_equal(load(pipe, &image), LOBE_ERROR_NOT_FOUND);
    assert_int_equal(mkfifo(pipe, 0600), 0);
    assert_int_equal(load(pipe, &image), LOBE_ERROR_READ);
    assert_int_equal(load("/dev/zero", &image), LOBE_ERROR_READ);
    unlink(pipe);
    rmdir(folder);
}

static void corrupt_files_of_the_test_suite_fail(void **state) {
    (void)state;
    DIR *folder = opendir(BAD_FILES);
    if (!folder)
        skip();
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        char path[512];
        lobe_image image;
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, BAD_FILES "/%s", entry->d_name);
        lobe_result result = load(path, &image);
        if (result != LOBE_ERROR_MALFORMED && result != LOBE_ERROR_UNSUPPORTED)
            fail_msg("%s: %s", path, lobe_result_name(result));
        count++;
    }
    closedir(folder);
    assert_true(count > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_png_becomes_rgba),
        cmocka_unit_test(interlaced_png_is_the_same_image),
        cmocka_unit_test(sixteen_bits_of_grey_are_kept_for_data),
        cmocka_unit_test(jpeg_becomes_rgba),
        cmocka_unit_test(other_formats_are_named_unsupported),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(damaged_files_never_do_harm),
        cmocka_unit_test(absurd_extents_take_no_memory),
        cmocka_unit_test(what_is_no_file_is_not_waited_for),
        cmocka_unit_test(corrupt_files_of_the_test_suite_fail),
    };
    return cmocka_run_group_tests_name("image files", tests, NULL, NULL);
}
