#include "tests/scenes/material/folder_fixture.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lobe/png.h>

#include "tests/scenes/scene/scene_check.h"

int folder_fixture_create(void **state) {
    folder_fixture *fixture = calloc(1, sizeof *fixture);
    if (!fixture)
        return -1;
    strcpy(fixture->path, "/tmp/lobe-material-XXXXXX");
    *state = fixture;
    return mkdtemp(fixture->path) ? 0 : -1;
}

void folder_file_path(const folder_fixture *fixture, const char *name, char path[512]) {
    snprintf(path, 512, "%s/%s", fixture->path, name);
}

int folder_fixture_destroy(void **state) {
    folder_fixture *fixture = *state;
    lobe_scene_destroy(&fixture->scene);
    DIR *folder = opendir(fixture->path);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char path[512];
        folder_file_path(fixture, entry->d_name, path);
        if (entry->d_name[0] != '.')
            remove(path);
    }
    if (folder)
        closedir(folder);
    int result = rmdir(fixture->path);
    free(fixture);
    return result;
}

// A map with one value would become a factor.
static void vary_last_texel(lobe_image *image) {
    const size_t last = (size_t)image->width * image->height - 1;
    for (size_t i = 0; i < 3; i++)
        ((uint8_t *)image->texels)[4 * last + i] ^= 1;
}

void write_map(const folder_fixture *fixture, const char *name, uint32_t width, uint32_t height,
               uint8_t red, uint8_t green, uint8_t blue) {
    lobe_image image;
    char path[512];
    folder_file_path(fixture, name, path);
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA8_UNORM, width, height, NULL),
                     LOBE_OK);
    for (size_t i = 0; i < (size_t)width * height; i++)
        memcpy((uint8_t *)image.texels + 4 * i, (uint8_t[]){red, green, blue, 255}, 4);
    vary_last_texel(&image);
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    lobe_image_free(&image);
}

void write_rgba_map(const folder_fixture *fixture, const char *name, const uint8_t rgba[4]) {
    lobe_image image;
    char path[512];
    folder_file_path(fixture, name, path);
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA8_UNORM, 3, 2, NULL), LOBE_OK);
    for (size_t i = 0; i < 6; i++)
        memcpy((uint8_t *)image.texels + 4 * i, rgba, 4);
    vary_last_texel(&image);
    ((uint8_t *)image.texels)[4 * 6 - 1] ^= rgba[3] < 255; // all of a full alpha stays full
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    lobe_image_free(&image);
}

void write_folder_text(const folder_fixture *fixture, const char *name, const char *text) {
    char path[512];
    folder_file_path(fixture, name, path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

const lobe_material *must_open_folder(folder_fixture *fixture, lobe_carrier carrier) {
    log_recorder_start(&fixture->recorder);
    lobe_scene_destroy(&fixture->scene);
    assert_int_equal(
        lobe_scene_open_material(fixture->path, carrier, &fixture->recorder.host, &fixture->scene),
        LOBE_OK);
    assert_int_equal(fixture->recorder.errors, 0);
    scene_check(fixture->scene);
    assert_int_equal(fixture->scene->material_count, 1);
    return &fixture->scene->materials[0];
}

void must_fail_folder(folder_fixture *fixture, const char *path, lobe_result expected,
                      const char *name, const char *cause) {
    log_recorder_start(&fixture->recorder);
    lobe_scene *scene = (lobe_scene *)&scene;
    assert_int_equal(
        lobe_scene_open_material(path, LOBE_CARRIER_PLANE, &fixture->recorder.host, &scene),
        expected);
    assert_null(scene);
    assert_int_equal(fixture->recorder.errors, 1);
    assert_non_null(strstr(fixture->recorder.last_error, name));
    assert_non_null(strstr(fixture->recorder.last_error, cause));
    assert_null(strchr(fixture->recorder.last_error, '\n'));
}

const lobe_image *image_of_use(const folder_fixture *fixture, const lobe_texture_use *use) {
    assert_in_range(use->image, 0, fixture->scene->image_count - 1);
    return &fixture->scene->images[use->image].image;
}

void assert_texel(const lobe_image *image, uint8_t red, uint8_t green, uint8_t blue) {
    const uint8_t *texel = image->texels;
    assert_int_equal(texel[0], red);
    assert_int_equal(texel[1], green);
    assert_int_equal(texel[2], blue);
}
