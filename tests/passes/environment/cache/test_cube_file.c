// Cubes with levels in OpenEXR files, and the files of the cache. No device.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>

#include "passes/environment/cache/cube_file.h"
#include "scenes/environment/direction.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

/// Khronos Group, 2023, Vulkan 1.3 Specification, "Cube Map Face Selection": the point (s, t), both
/// in [-1, 1], of a face.
static void vulkan_direction(uint32_t face, double s, double t, double direction[3]) {
    const double faces[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
    double length = sqrt(1 + s * s + t * t);
    for (int i = 0; i < 3; i++)
        direction[i] = faces[face][i] / length;
}

/// Each texel holds its direction and its level.
static cube_image cube_of_directions(uint32_t width) {
    cube_image cube;
    assert_int_equal(passes_cube_image_allocate(&cube, width, NULL), LOBE_OK);
    for (uint32_t level = 0; level < cube.levels; level++) {
        for (uint32_t face = 0; face < 6; face++) {
            float *texel = passes_cube_image_face(&cube, level, face);
            uint32_t extent = width >> level;
            for (uint32_t i = 0; i < extent * extent; i++, texel += 4) {
                double direction[3];
                vulkan_direction(face, (2.0 * (i % extent) + 1) / extent - 1,
                                 (2.0 * (i / extent) + 1) / extent - 1, direction);
                for (int k = 0; k < 3; k++)
                    texel[k] = (float)direction[k];
                texel[3] = (float)level;
            }
        }
    }
    return cube;
}

static void expect_same(const cube_image *found, const cube_image *expected) {
    assert_int_equal(found->width, expected->width);
    assert_int_equal(found->levels, expected->levels);
    assert_memory_equal(found->texels, expected->texels, 16 * passes_cube_image_texels(expected));
}

static void cubes_survive_a_file(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "cube.exr");
    for (uint32_t width = 1; width <= 64; width *= 4) {
        cube_image cube = cube_of_directions(width), read;
        lobe_exr_contents contents;
        assert_int_equal(passes_cube_image_write(path, &cube, NULL, 0, NULL), LOBE_OK);
        assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
        assert_int_equal(passes_cube_image_from(path, &contents, NULL, &read), LOBE_OK);
        expect_same(&read, &cube);
        lobe_exr_contents_free(&contents);
        passes_cube_image_free(&read);
        passes_cube_image_free(&cube);
    }
}

/// In each direction of the format, the file holds the cube's texel, on every level; the format's
/// further levels hold the mean of all directions, which is zero.
static void files_are_oriented_as_the_format_says(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "cube.exr");
    cube_image cube = cube_of_directions(16);
    lobe_exr_contents contents;
    assert_int_equal(passes_cube_image_write(path, &cube, NULL, 0, NULL), LOBE_OK);
    assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
    assert_int_equal(contents.level_count, 7);
    for (uint32_t level = 0; level < contents.level_count; level++) {
        const lobe_image *image = &contents.levels[level];
        const float *texel = image->texels;
        for (uint32_t i = 0; i < image->width * image->height; i++, texel += 4) {
            double direction[3] = {0, 0, 0};
            double position[2] = {i % image->width + 0.5, i / image->width + 0.5};
            if (level < 5)
                assert_true(scenes_environment_direction(LOBE_ENVIRONMENT_CUBE_COLUMN, image->width,
                                                         image->height, position, direction));
            for (int k = 0; k < 3; k++)
                assert_true(fabs((double)texel[k] - direction[k]) < 1e-6);
            assert_true(texel[3] == (float)(level < 5 ? level : 4));
        }
    }
    lobe_exr_contents_free(&contents);
    passes_cube_image_free(&cube);
}

static void other_files_are_no_cubes(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "flat.exr");
    lobe_image images[2][8];
    const uint32_t extents[2][2] = {{8, 48}, {6, 36}};
    for (int i = 0; i < 2; i++) {
        uint32_t count = 0;
        for (uint32_t w = extents[i][0], h = extents[i][1]; h > 0; w /= 2, h /= 2)
            assert_int_equal(lobe_image_allocate(&images[i][count++], LOBE_FORMAT_RGBA32_FLOAT,
                                                 w > 0 ? w : 1, h, NULL),
                             LOBE_OK);
        const lobe_exr_layer layer = {.image = images[i]};
        lobe_exr_parameters parameters = {.layers = &layer,
                                          .layer_count = 1,
                                          .level_count = count,
                                          .environment =
                                              i == 0 ? LOBE_EXR_NO_ENVIRONMENT : LOBE_EXR_CUBE};
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_exr_contents contents;
        cube_image cube;
        assert_int_equal(lobe_exr_write(path, &parameters, NULL), LOBE_OK);
        assert_int_equal(lobe_exr_read_contents(path, NULL, NULL, &contents), LOBE_OK);
        assert_int_equal(passes_cube_image_from(path, &contents, &recorder.host, &cube),
                         LOBE_ERROR_MALFORMED);
        assert_int_equal(recorder.errors, 1);
        assert_null(cube.texels);
        lobe_exr_contents_free(&contents);
        while (count > 0)
            lobe_image_free(&images[i][--count]);
    }
}

// ---------------------------------------------------------------------------------------------
// The cache

static void keys_tell_content_apart(void **state) {
    (void)state;
    float texels[2][8] = {{1, 2, 3, 1, 4, 5, 6, 1}, {1, 2, 3, 1, 4, 5, 6, 1}};
    lobe_environment a = {
        .name = "a", .image = {LOBE_FORMAT_RGBA32_FLOAT, 2, 1, texels[0]}, .intensity = 1};
    lobe_environment b = a;
    b.name = "b";
    b.intensity = 3;
    b.image.texels = texels[1];
    uint64_t key = passes_cube_file_key(&a, 64, LOBE_ENVIRONMENT_GGX);
    assert_true(key == passes_cube_file_key(&b, 64, LOBE_ENVIRONMENT_GGX));
    assert_true(key != passes_cube_file_key(&b, 128, LOBE_ENVIRONMENT_GGX));
    assert_true(key != passes_cube_file_key(&b, 64, LOBE_ENVIRONMENT_VON_MISES_FISHER));
    for (int i = 0; i < 7; i++) {
        float kept = texels[1][i];
        texels[1][i] = nextafterf(kept, 9);
        assert_true(key != passes_cube_file_key(&b, 64, LOBE_ENVIRONMENT_GGX));
        texels[1][i] = kept;
    }
    b.layout = LOBE_ENVIRONMENT_CUBE_ROW;
    assert_true(key != passes_cube_file_key(&b, 64, LOBE_ENVIRONMENT_GGX));
    b.layout = a.layout;
    b.image.width = 1;
    b.image.height = 2;
    assert_true(key != passes_cube_file_key(&b, 64, LOBE_ENVIRONMENT_GGX));
}

static void saved_cubes_are_loaded(void **state) {
    (void)state;
    cube_image cube = cube_of_directions(16), found;
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_false(passes_cube_file_load(test_folder.path, 7, 16, &recorder.host, &found));
    passes_cube_file_save(test_folder.path, 7, &cube, &recorder.host);
    assert_int_equal(temporary_folder_count(&test_folder), 1);
    assert_true(passes_cube_file_load(test_folder.path, 7, 16, &recorder.host, &found));
    expect_same(&found, &cube);
    passes_cube_image_free(&found);
    assert_false(passes_cube_file_load(test_folder.path, 8, 16, &recorder.host, &found));
    assert_null(found.texels);
    assert_int_equal(recorder.notices + recorder.warnings + recorder.errors, 0);
    passes_cube_image_free(&cube);
}

/// The file of key 7.
static const char *kept_file(void) {
    return temporary_folder_file(&test_folder, "0000000000000007.exr");
}

static void expect_not_loaded(uint32_t width) {
    log_recorder recorder;
    cube_image found;
    log_recorder_start(&recorder);
    assert_false(passes_cube_file_load(test_folder.path, 7, width, &recorder.host, &found));
    assert_null(found.texels);
    assert_int_equal(recorder.notices, 1);
    assert_int_equal(recorder.warnings + recorder.errors, 0);
}

/// The format itself cannot detect it.
static void change_a_texel(cube_image *cube) {
    lobe_exr_contents contents;
    assert_int_equal(lobe_exr_read_contents(kept_file(), NULL, NULL, &contents), LOBE_OK);
    float *texel = passes_cube_image_face(cube, 2, 3), kept = *texel;
    *texel = nextafterf(kept, 9);
    assert_int_equal(lobe_exr_find_attribute(&contents, "environmentHash", LOBE_EXR_TEXT) -
                         contents.attributes,
                     contents.attribute_count - 2);
    assert_int_equal(passes_cube_image_write(kept_file(), cube,
                                             &contents.attributes[contents.attribute_count - 2], 2,
                                             NULL),
                     LOBE_OK);
    *texel = kept;
    lobe_exr_contents_free(&contents);
}

/// Truncated, with a flipped bit, of another key, of another size, not a picture: none is loaded,
/// and the next save replaces each.
static void damaged_and_foreign_files_are_replaced(void **state) {
    (void)state;
    cube_image cube = cube_of_directions(16), found;
    uint8_t *data;
    size_t size;
    passes_cube_file_save(test_folder.path, 7, &cube, NULL);
    expect_not_loaded(32);
    assert_int_equal(lobe_file_read(kept_file(), NULL, NULL, &data, &size), LOBE_OK);
    for (size_t at = 0; at < size; at += size / 23) {
        assert_int_equal(lobe_file_write(kept_file(), data, at, NULL), LOBE_OK);
        expect_not_loaded(16);
    }
    data[size / 2] ^= 1;
    assert_int_equal(lobe_file_write(kept_file(), data, size, NULL), LOBE_OK);
    expect_not_loaded(16);
    data[size / 2] ^= 1;
    assert_int_equal(lobe_file_write(kept_file(), data, size, NULL), LOBE_OK);
    lobe_release(data);
    change_a_texel(&cube);
    expect_not_loaded(16);
    passes_cube_file_save(test_folder.path, 8, &cube, NULL);
    char other[512];
    snprintf(other, sizeof other, "%s", kept_file());
    assert_int_equal(rename(temporary_folder_file(&test_folder, "0000000000000008.exr"), other), 0);
    expect_not_loaded(16);
    passes_cube_file_save(test_folder.path, 7, &cube, NULL);
    assert_true(passes_cube_file_load(test_folder.path, 7, 16, NULL, &found));
    expect_same(&found, &cube);
    passes_cube_image_free(&found);
    passes_cube_image_free(&cube);
}

static void an_unwritable_folder_is_warned_of(void **state) {
    (void)state;
    cube_image cube = cube_of_directions(4), found;
    const char *folder = temporary_folder_file(&test_folder, "none");
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_false(passes_cube_file_load(folder, 7, 4, &recorder.host, &found));
    assert_false(passes_cube_file_save(folder, 7, &cube, &recorder.host));
    assert_int_equal(recorder.warnings, 1);
    assert_int_equal(recorder.errors, 0);
    passes_cube_image_free(&cube);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(cubes_survive_a_file),
        IN_TEST_FOLDER(files_are_oriented_as_the_format_says),
        IN_TEST_FOLDER(other_files_are_no_cubes),
        cmocka_unit_test(keys_tell_content_apart),
        IN_TEST_FOLDER(saved_cubes_are_loaded),
        IN_TEST_FOLDER(damaged_and_foreign_files_are_replaced),
        IN_TEST_FOLDER(an_unwritable_folder_is_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
