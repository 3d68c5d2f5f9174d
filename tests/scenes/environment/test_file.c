// Environments from files: shapes, sizes, damage, and real files.

#include "tests/engine/support/cmocka_all.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/environment.h>
#include <lobe/exr.h>
#include <lobe/file.h>

#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

static lobe_result open_file(const char *path, log_recorder *recorder,
                             lobe_environment **environment) {
    log_recorder_start(recorder);
    *environment = (lobe_environment *)recorder; // must be overwritten
    lobe_result result = lobe_environment_open(path, &recorder->host, environment);
    assert_int_equal(recorder->errors, result != LOBE_OK);
    assert_true((*environment != NULL) == (result == LOBE_OK));
    if (result != LOBE_OK) {
        assert_non_null(strstr(recorder->last_error, path));
        assert_null(strpbrk(recorder->last_error, "\n\r\t\x1b"));
        return result;
    }
    assert_string_equal((*environment)->name, path);
    assert_int_equal((*environment)->image.format, LOBE_FORMAT_RGBA32_FLOAT);
    const lobe_image *image = &(*environment)->image;
    for (size_t i = 0; i < 4 * (size_t)image->width * image->height; i++)
        assert_true(isfinite(((float *)image->texels)[i]) && ((float *)image->texels)[i] >= 0);
    return result;
}

static void write_exr(const char *path, uint32_t width, uint32_t height,
                      lobe_exr_environment kind) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
                     LOBE_OK);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        float *texel = (float *)image.texels + 4 * i;
        texel[0] = (float)(i % width);
        texel[1] = (float)(i / width);
        texel[2] = 0.5f;
    }
    const lobe_exr_layer layer = {.image = &image, .depth = LOBE_EXR_FLOAT};
    const lobe_exr_parameters parameters = {
        .layers = &layer, .layer_count = 1, .environment = kind};
    assert_int_equal(lobe_exr_write(path, &parameters, NULL), LOBE_OK);
    lobe_image_free(&image);
}

static void the_shape_tells_the_layout(void **state) {
    (void)state;
    const struct {
        uint32_t width, height;
        lobe_exr_environment said;
        lobe_environment_layout layout;
    } files[] = {
        {32, 16, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
        {1, 1, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
        {33, 17, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
        {7, 5, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
        {9, 9, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
        {5, 30, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_CUBE_COLUMN},
        {24, 4, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_CUBE_ROW},
        {9, 12, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_VERTICAL_CROSS},
        {12, 9, LOBE_EXR_NO_ENVIRONMENT, LOBE_ENVIRONMENT_HORIZONTAL_CROSS},
        {1, 6, LOBE_EXR_CUBE, LOBE_ENVIRONMENT_CUBE_COLUMN},
        {12, 9, LOBE_EXR_CUBE, LOBE_ENVIRONMENT_HORIZONTAL_CROSS},
        {12, 9, LOBE_EXR_LATITUDE_LONGITUDE, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
        {5, 30, LOBE_EXR_LATITUDE_LONGITUDE, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE},
    };
    const char *path = temporary_folder_file(&test_folder, "shape.exr");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        log_recorder recorder;
        lobe_environment *environment;
        write_exr(path, files[i].width, files[i].height, files[i].said);
        assert_int_equal(open_file(path, &recorder, &environment), LOBE_OK);
        assert_int_equal(recorder.warnings, 0);
        assert_int_equal(environment->layout, files[i].layout);
        assert_int_equal(environment->image.width, files[i].width);
        assert_int_equal(environment->image.height, files[i].height);
        assert_true(environment->intensity == 1);
        for (int k = 0; k < 9; k++)
            assert_true(environment->world_from_environment[k / 3][k % 3] == (k % 4 == 0));
        // The rows of the file are the rows of the image.
        const float *texels = environment->image.texels;
        const size_t last = (size_t)files[i].width * files[i].height - 1;
        if (files[i].layout == LOBE_ENVIRONMENT_CUBE_COLUMN)
            assert_true(texels[4 * last + 1] == (float)(files[i].height - 1));
        lobe_environment_destroy(&environment);
        assert_null(environment);
    }
}

/// Says in the file's header that its green is blue and its blue green.
static void exchange_primaries(const char *path) {
    static const char type[] = "chromaticities\0chromaticities"; // the attribute's name and type
    static const float exchanged[4] = {0.15f, 0.06f, 0.30f, 0.60f};
    uint8_t *bytes;
    size_t size, at = 0;
    assert_int_equal(lobe_file_read(path, NULL, NULL, &bytes, &size), LOBE_OK);
    while (at + sizeof type < size && memcmp(bytes + at, type, sizeof type) != 0)
        at++;
    assert_memory_equal(bytes + at, type, sizeof type);
    memcpy(bytes + at + sizeof type + 4 + 2 * sizeof(float), exchanged, sizeof exchanged);
    assert_int_equal(lobe_file_write(path, bytes, size, NULL), LOBE_OK);
    lobe_release(bytes);
}

static void colours_of_other_primaries_are_converted(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "primaries.exr");
    log_recorder recorder;
    lobe_environment *environment;
    write_exr(path, 4, 2, LOBE_EXR_NO_ENVIRONMENT);
    exchange_primaries(path);
    assert_int_equal(open_file(path, &recorder, &environment), LOBE_OK);
    const float *texel = (const float *)environment->image.texels + 4 * 6; // column 2, row 1
    assert_float_equal(texel[0], 2, 1e-5f);
    assert_float_equal(texel[1], 0.5f, 1e-5f);
    assert_float_equal(texel[2], 1, 1e-5f);
    lobe_environment_destroy(&environment);
}

static void unknown_shapes_are_refused(void **state) {
    (void)state;
    const uint32_t sizes[][2] = {{5, 7}, {40, 9}, {5, 31}, {1, 2}};
    const char *path = temporary_folder_file(&test_folder, "shape.exr");
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        log_recorder recorder;
        lobe_environment *environment;
        write_exr(path, sizes[i][0], sizes[i][1], LOBE_EXR_NO_ENVIRONMENT);
        assert_int_equal(open_file(path, &recorder, &environment), LOBE_ERROR_UNSUPPORTED);
        assert_non_null(strstr(recorder.last_error, "(1:6, 6:1)"));
    }
    log_recorder recorder;
    lobe_environment *environment;
    write_exr(path, 32, 16, LOBE_EXR_CUBE);
    assert_int_equal(open_file(path, &recorder, &environment), LOBE_ERROR_UNSUPPORTED);
}

static void what_no_light_has_is_repaired_with_one_warning(void **state) {
    (void)state;
    lobe_image image;
    const char *path = temporary_folder_file(&test_folder, "faults.exr");
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, 8, 4, NULL), LOBE_OK);
    float *texels = image.texels;
    texels[0] = -1;
    texels[4 * 9 + 1] = NAN;
    texels[4 * 20 + 2] = INFINITY;
    texels[4 * 30 + 2] = -0.25f;
    const lobe_exr_layer layer = {.image = &image, .depth = LOBE_EXR_FLOAT};
    assert_int_equal(
        lobe_exr_write(path, &(lobe_exr_parameters){.layers = &layer, .layer_count = 1}, NULL),
        LOBE_OK);
    lobe_image_free(&image);
    log_recorder recorder;
    lobe_environment *environment;
    assert_int_equal(open_file(path, &recorder, &environment), LOBE_OK);
    assert_int_equal(recorder.warnings, 1);
    assert_non_null(strstr(recorder.last_warning, path));
    assert_non_null(strstr(recorder.last_warning, "2 negative, 1 NaN, 1 infinite"));
    lobe_environment_destroy(&environment);
}

// Two texels in the newest packing, repeated over the width of every line.
static void write_hdr(const char *path, uint32_t width, uint32_t height) {
    uint8_t *bytes = malloc(64 + (size_t)height * (4 + 8 * (width / 127 + 1)));
    assert_non_null(bytes);
    size_t size = (size_t)sprintf((char *)bytes, "#?RADIANCE\n\n-Y %u +X %u\n", height, width);
    for (uint32_t y = 0; y < height; y++) {
        const uint8_t texel[4] = {(uint8_t)(y < height / 2 ? 255 : 127), 127, 63, 128};
        memcpy(bytes + size, (uint8_t[4]){2, 2, (uint8_t)(width >> 8), (uint8_t)width}, 4);
        size += 4;
        for (int component = 0; component < 4; component++) {
            for (uint32_t left = width; left > 0;) {
                const uint32_t count = left < 127 ? left : 127;
                bytes[size++] = (uint8_t)(128 + count);
                bytes[size++] = texel[component];
                left -= count;
            }
        }
    }
    assert_int_equal(lobe_file_write(path, bytes, size, NULL), LOBE_OK);
    free(bytes);
}

static void expect_halves(const char *path, uint32_t width, uint32_t height,
                          uint32_t expected_width) {
    log_recorder recorder;
    lobe_environment *environment;
    write_hdr(path, width, height);
    assert_int_equal(open_file(path, &recorder, &environment), LOBE_OK);
    assert_int_equal(recorder.warnings, 0);
    const lobe_image *image = &environment->image;
    assert_int_equal(image->width, expected_width);
    const float *texels = image->texels;
    const size_t last = (size_t)image->width * image->height - 1;
    assert_true(fabsf(texels[0] - 255.5f / 256) < 1e-6f);
    assert_true(fabsf(texels[4 * last] - 127.5f / 256) < 1e-6f);
    assert_true(fabsf(texels[4 * last + 2] - 63.5f / 256) < 1e-6f);
    lobe_environment_destroy(&environment);
}

// Wide and low, so that little needs to be decoded; 4:1 may still be latitude and longitude.
static void images_finer_than_needed_are_halved(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "wide.hdr");
    expect_halves(path, 8192, 2048, 8192);
    expect_halves(path, 8193, 2049, 4096);
}

static void the_largest_image_is_read(void **state) {
    (void)state;
#if defined(__SANITIZE_ADDRESS__)
    skip(); // would take a minute and six gibibytes
#endif
    expect_halves(temporary_folder_file(&test_folder, "large.hdr"), 16384, 8192, 8192);
}

static void all_that_is_cut_off_is_refused(void **state) {
    (void)state;
    const char *names[2] = {"cut.hdr", "cut.exr"};
    for (int i = 0; i < 2; i++) {
        const char *path = temporary_folder_file(&test_folder, names[i]);
        if (i == 0)
            write_hdr(path, 16, 8);
        else
            write_exr(path, 8, 4, LOBE_EXR_LATITUDE_LONGITUDE);
        uint8_t *bytes;
        size_t size;
        assert_int_equal(lobe_file_read(path, NULL, NULL, &bytes, &size), LOBE_OK);
        for (size_t part = 0; part < size; part++) {
            log_recorder recorder;
            lobe_environment *environment;
            assert_int_equal(lobe_file_write(path, bytes, part, NULL), LOBE_OK);
            lobe_result result = open_file(path, &recorder, &environment);
            assert_true(result == LOBE_ERROR_MALFORMED ||
                        (part >= 4 && part < 12 && result == LOBE_ERROR_UNSUPPORTED));
        }
        lobe_release(bytes);
    }
}

static void what_is_no_image_is_refused(void **state) {
    (void)state;
    log_recorder recorder;
    lobe_environment *environment;
    const char *path = temporary_folder_file(&test_folder, "text.hdr");
    assert_int_equal(lobe_file_write(path, "hello, world", 12, NULL), LOBE_OK);
    assert_int_equal(open_file(path, &recorder, &environment), LOBE_ERROR_UNSUPPORTED);
    assert_int_equal(
        open_file(temporary_folder_file(&test_folder, "none"), &recorder, &environment),
        LOBE_ERROR_NOT_FOUND);
    assert_int_equal(open_file(test_folder.path, &recorder, &environment), LOBE_ERROR_READ);
}

static void damaged_files_of_the_wild_are_refused(void **state) {
    (void)state;
    DIR *directory = opendir(LOBE_TEST_ASSETS "/bad/exr");
    if (!directory)
        skip();
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[512];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%s", LOBE_TEST_ASSETS "/bad/exr", entry->d_name);
        log_recorder recorder;
        lobe_environment *environment;
        assert_int_not_equal(open_file(path, &recorder, &environment), LOBE_OK);
        assert_int_equal(recorder.warnings, 0);
        count++;
    }
    closedir(directory);
    assert_true(count > 50);
}

static void environments_of_the_wild_are_read(void **state) {
    (void)state;
    static const char *const names[] = {"deb_courtyard.exr",
                                        "deb_interior.exr",
                                        "deb_studio.exr",
                                        "dresden_square_1k.hdr",
                                        "openexr_StageEnvLatLong.exr",
                                        "openexr_WavyLinesLatLong.exr"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/env/%s", LOBE_TEST_ASSETS, names[i]);
        FILE *file = fopen(path, "rb");
        if (!file)
            skip();
        fclose(file);
        log_recorder recorder;
        lobe_environment *environment;
        assert_int_equal(open_file(path, &recorder, &environment), LOBE_OK);
        assert_int_equal(environment->layout, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE);
        lobe_environment_destroy(&environment);
    }
}

// ---------------------------------------------------------------------------------------------
// Files from a host

typedef struct host_file {
    uint8_t *data;
    size_t size;
    int given, released;
} host_file;

static lobe_result give(void *user, const char *path, const void **data, size_t *size) {
    host_file *file = user;
    if (strcmp(path, "pack/sky.exr") != 0)
        return LOBE_ERROR_NOT_FOUND;
    *data = file->data;
    *size = file->size;
    file->given++;
    return LOBE_OK;
}

static void take_back(void *user, const void *data, size_t size) {
    host_file *file = user;
    assert_ptr_equal(data, file->data);
    assert_int_equal(size, file->size);
    file->released++;
}

static void assert_opened_alike(const lobe_environment_open_parameters *parameters,
                                const lobe_environment *expected) {
    lobe_environment *environment;
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(lobe_environment_open_with(parameters, &recorder.host, &environment), LOBE_OK);
    assert_string_equal(environment->name, parameters->environment);
    assert_int_equal(environment->layout, expected->layout);
    assert_int_equal(environment->image.width, 24);
    assert_memory_equal(environment->image.texels, expected->image.texels,
                        (size_t)24 * 4 * 4 * sizeof(float));
    lobe_environment_destroy(&environment);
}

static void files_come_from_memory_or_from_the_host(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "row.exr");
    host_file file = {0};
    lobe_environment *expected, *none;
    log_recorder recorder;
    write_exr(path, 24, 4, LOBE_EXR_NO_ENVIRONMENT);
    assert_int_equal(open_file(path, &recorder, &expected), LOBE_OK);
    assert_int_equal(lobe_file_read(path, NULL, NULL, &file.data, &file.size), LOBE_OK);
    const lobe_file_source source = {give, take_back, &file};
    assert_opened_alike(
        &(lobe_environment_open_parameters){.environment = "pack/sky.exr", .files = &source},
        expected);
    assert_int_equal(file.given, 1);
    assert_int_equal(file.released, 1);
    assert_int_equal(
        lobe_environment_open_with(
            &(lobe_environment_open_parameters){.environment = "other.exr", .files = &source},
            &recorder.host, &none),
        LOBE_ERROR_NOT_FOUND);
    assert_non_null(strstr(recorder.last_error, "other.exr"));
    lobe_environment_open_parameters memory = {
        .environment = "sky", .data = file.data, .size = file.size};
    assert_opened_alike(&memory, expected);
    memory.size /= 2;
    log_recorder_start(&recorder);
    assert_int_equal(lobe_environment_open_with(&memory, &recorder.host, &none),
                     LOBE_ERROR_MALFORMED);
    assert_int_equal(recorder.errors, 1);
    assert_null(none);
    lobe_release(file.data);
    lobe_environment_destroy(&expected);
}

// ---------------------------------------------------------------------------------------------
// Turning

static void expect_turned(const lobe_environment *environment, const float from[3],
                          const float to[3]) {
    for (int row = 0; row < 3; row++) {
        float sum = 0;
        for (int column = 0; column < 3; column++)
            sum += environment->world_from_environment[column][row] * from[column];
        assert_true(fabsf(sum - to[row]) < 1e-6f);
    }
}

static void turning_is_counter_clockwise_from_above(void **state) {
    (void)state;
    lobe_environment environment = {.world_from_environment = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    lobe_environment_turn(&environment, 90);
    expect_turned(&environment, (float[3]){0, 0, 1}, (float[3]){1, 0, 0});
    expect_turned(&environment, (float[3]){1, 0, 0}, (float[3]){0, 0, -1});
    expect_turned(&environment, (float[3]){0, 1, 0}, (float[3]){0, 1, 0});
    lobe_environment_turn(&environment, -30);
    lobe_environment_turn(&environment, -60);
    expect_turned(&environment, (float[3]){0.6f, 0, 0.8f}, (float[3]){0.6f, 0, 0.8f});
    // The world's axis turns an environment that was turned about another axis before.
    lobe_environment upside = {.world_from_environment = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    lobe_environment_turn(&upside, 90); // its +Y faces +Z of the world, which turns to +X
    expect_turned(&upside, (float[3]){0, 1, 0}, (float[3]){1, 0, 0});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(the_shape_tells_the_layout),
        IN_TEST_FOLDER(colours_of_other_primaries_are_converted),
        IN_TEST_FOLDER(unknown_shapes_are_refused),
        IN_TEST_FOLDER(what_no_light_has_is_repaired_with_one_warning),
        IN_TEST_FOLDER(images_finer_than_needed_are_halved),
        IN_TEST_FOLDER(the_largest_image_is_read),
        IN_TEST_FOLDER(all_that_is_cut_off_is_refused),
        IN_TEST_FOLDER(what_is_no_image_is_refused),
        cmocka_unit_test(damaged_files_of_the_wild_are_refused),
        cmocka_unit_test(environments_of_the_wild_are_read),
        IN_TEST_FOLDER(files_come_from_memory_or_from_the_host),
        cmocka_unit_test(turning_is_counter_clockwise_from_above),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
