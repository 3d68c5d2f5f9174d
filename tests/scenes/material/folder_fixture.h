#ifndef TESTS_SCENES_MATERIAL_FOLDER_FIXTURE_H
#define TESTS_SCENES_MATERIAL_FOLDER_FIXTURE_H

#include "tests/engine/support/cmocka_all.h"

#include <lobe/scene.h>

#include "tests/engine/support/log_recorder.h"

/// An empty folder for the maps of a material, and the scene opened from it.
typedef struct folder_fixture {
    char path[64];
    log_recorder recorder;
    lobe_scene *scene; ///< the last one opened
} folder_fixture;

/// Set-up and tear-down of a test.
int folder_fixture_create(void **state);
int folder_fixture_destroy(void **state);

void folder_file_path(const folder_fixture *fixture, const char *name, char path[512]);
/// An image with the same colour in all texels, except that the last one's differs by one.
void write_map(const folder_fixture *fixture, const char *name, uint32_t width, uint32_t height,
               uint8_t red, uint8_t green, uint8_t blue);
/// The same, small, with a value for alpha.
void write_rgba_map(const folder_fixture *fixture, const char *name, const uint8_t rgba[4]);
void write_folder_text(const folder_fixture *fixture, const char *name, const char *text);

/// Opens the folder, asserts that nothing is wrong, and returns its only material.
const lobe_material *must_open_folder(folder_fixture *fixture, lobe_carrier carrier);
/// Asserts a failure with one message that names the file and the cause.
void must_fail_folder(folder_fixture *fixture, const char *path, lobe_result expected,
                      const char *name, const char *cause);

const lobe_image *image_of_use(const folder_fixture *fixture, const lobe_texture_use *use);
void assert_texel(const lobe_image *image, uint8_t red, uint8_t green, uint8_t blue);

#endif
