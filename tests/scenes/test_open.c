// Scenes whose files come from the host: in memory, or through a callback.

#include "tests/scenes/gltf/gltf_fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>
#include <lobe/png.h>

#include "tests/engine/support/log_recorder.h"

static const char document[] =
    "{\"asset\":{\"version\":\"2.0\"},"
    "\"buffers\":[{\"uri\":\"triangle.bin\",\"byteLength\":60}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
    "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3,"
    "\"min\":[0,0,0],\"max\":[1,1,0]},"
    "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC2\",\"count\":3}],"
    "\"images\":[{\"uri\":\"maps/red%20and%20blue.png\"}],\"textures\":[{\"source\":0}],"
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},"
    "\"material\":0}]}],"
    "\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}],\"scene\":0}";

static const float triangle[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};

/// Files in memory, and a count of what is done with them.
typedef struct archive {
    log_recorder recorder;
    const char *names[3];
    const void *contents[3];
    size_t sizes[3];
    int read, released, failures;
    uint8_t *png;
    lobe_file_source source;
} archive;

static lobe_result read(void *user, const char *path, const void **data, size_t *size) {
    archive *a = user;
    for (int i = 0; i < 3; i++)
        if (a->names[i] && strcmp(a->names[i], path) == 0) {
            *data = a->contents[i];
            *size = a->sizes[i];
            a->read++;
            return LOBE_OK;
        }
    a->failures++;
    return LOBE_ERROR_NOT_FOUND;
}

static void release(void *user, const void *data, size_t size) {
    archive *a = user;
    bool known = false;
    for (int i = 0; i < 3; i++)
        known = known || (a->contents[i] == data && a->sizes[i] == size);
    assert_true(known);
    a->released++;
}

static int open_archive(void **state) {
    uint8_t texels[2][4] = {{255, 0, 0, 255}, {0, 0, 255, 255}};
    const lobe_image image = {LOBE_FORMAT_RGBA8_SRGB, 2, 1, texels};
    archive *a = calloc(1, sizeof *a);
    *state = a;
    log_recorder_start(&a->recorder);
    *a = (archive){
        .recorder = a->recorder,
        .names = {"pack/scene.gltf", "pack/triangle.bin", "pack/maps/red and blue.png"},
        .contents = {document, triangle},
        .sizes = {sizeof document - 1, sizeof triangle},
        .source = {read, release, a},
    };
    log_recorder_start(&a->recorder);
    lobe_result result = lobe_png_encode("png", &image, NULL, &a->png, &a->sizes[2]);
    a->contents[2] = a->png;
    return result != LOBE_OK;
}

static int close_archive(void **state) {
    archive *a = *state;
    lobe_release(a->png);
    free(a);
    return 0;
}

static void check_scene(const lobe_scene *scene) {
    assert_int_equal(scene->mesh_count, 1);
    assert_int_equal(scene->meshes[0].index_count, 3);
    assert_float_equal(scene->meshes[0].vertices[1].position[0], 1, 0);
    assert_int_equal(scene->image_count, 1);
    assert_int_equal(scene->images[0].image.width, 2);
    static const uint8_t red[4] = {255, 0, 0, 255};
    assert_memory_equal(scene->images[0].image.texels, red, 4);
}

static lobe_scene *must_open(archive *a, const lobe_scene_open_parameters *parameters) {
    lobe_scene *scene = NULL;
    if (lobe_scene_open_with(parameters, &a->recorder.host, &scene) != LOBE_OK)
        fail_msg("%s", a->recorder.last_error);
    assert_int_equal(a->recorder.errors, 0);
    return scene;
}

static void the_hosts_files_are_read_and_released(void **state) {
    archive *a = *state;
    lobe_scene *scene = must_open(
        a, &(lobe_scene_open_parameters){.scene = "pack/scene.gltf", .files = &a->source});
    check_scene(scene);
    assert_int_equal(a->read, 3);
    assert_int_equal(a->released, 3);
    assert_int_equal(a->failures, 0);
    lobe_scene_destroy(&scene);
}

/// The file itself comes from memory, which is not modified; the files it refers to from the host.
static void a_file_in_memory_refers_to_the_hosts_files(void **state) {
    archive *a = *state;
    char copy[sizeof document];
    memcpy(copy, document, sizeof copy);
    lobe_scene *scene = must_open(a, &(lobe_scene_open_parameters){.scene = "pack/anything",
                                                                   .data = copy,
                                                                   .size = sizeof copy - 1,
                                                                   .files = &a->source});
    check_scene(scene);
    assert_string_equal(scene->name, "pack/anything");
    assert_int_equal(a->read, 2);
    assert_int_equal(a->released, 2);
    assert_memory_equal(copy, document, sizeof copy);
    lobe_scene_destroy(&scene);
}

static void a_whole_file_in_memory_needs_no_other(void **state) {
    archive *a = *state;
    // A GLB file whose buffer is its second chunk; a material without maps.
    const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3,"
        "\"min\":[0,0,0],\"max\":[1,1,0]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}],\"scene\":0}";
    enum { JSON = (sizeof json - 1 + 3) / 4 * 4, SIZE = 12 + 8 + JSON + 8 + 36 };
    _Alignas(4) char glb[SIZE];
    const uint32_t header[5] = {0x46546c67, 2, SIZE, JSON, 0x4e4f534a};
    const uint32_t chunk[2] = {36, 0x004e4942};
    memset(glb, ' ', sizeof glb);
    memcpy(glb, header, sizeof header);
    memcpy(glb + 20, json, sizeof json - 1);
    memcpy(glb + 20 + JSON, chunk, sizeof chunk);
    memcpy(glb + 28 + JSON, triangle, 36);
    lobe_scene *scene = must_open(
        a, &(lobe_scene_open_parameters){.scene = "in memory", .data = glb, .size = SIZE});
    assert_float_equal(scene->meshes[0].vertices[2].position[1], 1, 0);
    lobe_scene_destroy(&scene);
}

static void assert_refused(archive *a, const lobe_scene_open_parameters *parameters,
                           lobe_result expected, const char *words) {
    lobe_scene *scene = (lobe_scene *)a;
    log_recorder_start(&a->recorder);
    assert_int_equal(lobe_scene_open_with(parameters, &a->recorder.host, &scene), expected);
    assert_null(scene);
    assert_int_equal(a->recorder.errors, 1);
    if (!strstr(a->recorder.last_error, words))
        fail_msg("%s", a->recorder.last_error);
    assert_int_equal(a->read, a->released);
}

static void what_the_host_lacks_is_named(void **state) {
    archive *a = *state;
    lobe_scene_open_parameters parameters = {.scene = "pack/scene.gltf", .files = &a->source};
    a->names[2] = NULL;
    assert_refused(a, &parameters, LOBE_ERROR_NOT_FOUND,
                   "pack/scene.gltf: pack/maps/red and blue.png: not found");
    a->names[1] = NULL;
    assert_refused(a, &parameters, LOBE_ERROR_NOT_FOUND, "pack/triangle.bin");
    a->names[0] = NULL;
    assert_refused(a, &parameters, LOBE_ERROR_NOT_FOUND, "pack/scene.gltf");
    parameters.data = "nonsense";
    parameters.size = 8;
    assert_refused(a, &parameters, LOBE_ERROR_MALFORMED, "neither GLB nor JSON");
    parameters.size = 0;
    assert_refused(a, &parameters, LOBE_ERROR_MALFORMED, "empty");
}

/// Built-in scenes need no file, also with a file source.
static void built_in_scenes_come_first(void **state) {
    archive *a = *state;
    lobe_scene *scene =
        must_open(a, &(lobe_scene_open_parameters){.scene = "bumps", .files = &a->source});
    assert_int_equal(a->failures, 0);
    lobe_scene_destroy(&scene);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, open_archive, close_archive)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(the_hosts_files_are_read_and_released),
        TEST(a_file_in_memory_refers_to_the_hosts_files),
        TEST(a_whole_file_in_memory_needs_no_other),
        TEST(what_the_host_lacks_is_named),
        TEST(built_in_scenes_come_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
