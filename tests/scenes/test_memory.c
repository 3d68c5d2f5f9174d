// Scenes and environments in a host's memory: everything comes from its allocator and goes back
// there, and whenever an allocation fails, the call reports it and leaks nothing.

#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#include <lobe/exr.h>
#include <lobe/file.h>
#include <lobe/png.h>
#include <lobe/scene.h>

#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/temporary_folder.h"

static lobe_result work_with_scene(void *parameters, const lobe_host *host) {
    lobe_scene *scene;
    lobe_result result = lobe_scene_open_with(parameters, host, &scene);
    assert_true((scene != NULL) == (result == LOBE_OK));
    lobe_scene_destroy(&scene);
    return result;
}

static void write_image(const char *path, lobe_format format) {
    uint8_t texels[4][4] = {{255, 0, 0, 255}, {0, 0, 255, 255}, {9, 9, 9, 255}, {7, 7, 7, 255}};
    const lobe_image image = {format, 2, 2, texels};
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
}

// ---------------------------------------------------------------------------------------------
// glTF

/// Two triangles without normals and one with unusable ones; each also mirrored. One map in a file
/// beside it, one inside it, and an environment.
static const char document[] =
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"EXT_lights_image_based\"],"
    "\"buffers\":[{\"uri\":\"triangle.bin\",\"byteLength\":60}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
    "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3,"
    "\"min\":[0,0,0],\"max\":[1,1,0]},"
    "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC2\",\"count\":3}],"
    "\"images\":[{\"uri\":\"map.png\"}],\"textures\":[{\"source\":0}],"
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}},"
    "\"normalTexture\":{\"index\":0}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},"
    "\"material\":0},{\"attributes\":{\"POSITION\":0,\"NORMAL\":0},\"material\":0}]}],"
    "\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"scale\":[-1,1,1]}],"
    "\"extensions\":{\"EXT_lights_image_based\":{\"lights\":[{\"intensity\":1,"
    "\"specularImageSize\":2,\"specularImages\":[[0,0,0,0,0,0]]}]}},"
    "\"scenes\":[{\"nodes\":[0,1],\"extensions\":{\"EXT_lights_image_based\":{\"light\":0}}}],"
    "\"scene\":0}";

static const float triangle[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};

static void glTF_files_say_where_memory_ends(void **state) {
    (void)state;
    char path[512];
    lobe_file_write(temporary_folder_file(&test_folder, "triangle.bin"), triangle, sizeof triangle,
                    NULL);
    write_image(temporary_folder_file(&test_folder, "map.png"), LOBE_FORMAT_RGBA8_SRGB);
    snprintf(path, sizeof path, "%s", temporary_folder_file(&test_folder, "scene.gltf"));
    lobe_file_write(path, document, sizeof document - 1, NULL);
    lobe_scene_open_parameters parameters = {.scene = path};
    const size_t from_file = fail_each_allocation(work_with_scene, &parameters);
    assert_true(from_file > 80);
    parameters.data = document;
    parameters.size = sizeof document - 1;
    assert_int_equal(fail_each_allocation(work_with_scene, &parameters), from_file);
}

/// A mesh with a skin, morph targets and an animation, from the same bytes.
static const char moving_document[] =
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"triangle.bin\",\"byteLength\":60}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteLength\":12},"
    "{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":8,\"byteLength\":8},"
    "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3},"
    "{\"bufferView\":1,\"componentType\":5121,\"type\":\"VEC4\",\"count\":3},"
    "{\"bufferView\":2,\"componentType\":5126,\"type\":\"VEC4\",\"count\":3},"
    "{\"bufferView\":3,\"componentType\":5126,\"type\":\"SCALAR\",\"count\":2},"
    "{\"bufferView\":4,\"componentType\":5126,\"type\":\"VEC3\",\"count\":2},"
    "{\"bufferView\":4,\"componentType\":5126,\"type\":\"VEC2\",\"count\":3}],"
    "\"images\":[{\"uri\":\"map.png\"}],\"textures\":[{\"source\":0}],"
    "\"materials\":[{\"normalTexture\":{\"index\":0}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":5,\"JOINTS_0\":1,"
    "\"WEIGHTS_0\":2},\"targets\":[{\"POSITION\":0}],\"material\":0}]}],\"skins\":[{\"joints\":[1]}"
    "],"
    "\"nodes\":[{\"mesh\":0,\"skin\":0,\"weights\":[1]},{},{\"mesh\":0}],"
    "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,"
    "\"path\":\"translation\"}}],\"samplers\":[{\"input\":3,\"output\":4}]}]}";

static lobe_result work_with_pose(void *parameters, const lobe_host *host) {
    lobe_scene *scene;
    lobe_result result = lobe_scene_open_with(parameters, host, &scene);
    if (result == LOBE_OK)
        result = lobe_scene_set_pose(scene, &(lobe_pose){.seconds = 0.5}, host);
    lobe_scene_destroy(&scene);
    return result;
}

static void rigs_say_where_memory_ends(void **state) {
    (void)state;
    char path[512];
    lobe_file_write(temporary_folder_file(&test_folder, "triangle.bin"), triangle, sizeof triangle,
                    NULL);
    write_image(temporary_folder_file(&test_folder, "map.png"), LOBE_FORMAT_RGBA8_SRGB);
    snprintf(path, sizeof path, "%s", temporary_folder_file(&test_folder, "moving.gltf"));
    lobe_scene_open_parameters parameters = {
        .scene = path, .data = moving_document, .size = sizeof moving_document - 1};
    assert_true(fail_each_allocation(work_with_pose, &parameters) > 80);
}

// ---------------------------------------------------------------------------------------------
// Others

static lobe_result work_with_material(void *folder, const lobe_host *host) {
    lobe_scene *scene;
    lobe_result result = lobe_scene_open_material(folder, LOBE_CARRIER_PLANE, host, &scene);
    lobe_scene_destroy(&scene);
    return result;
}

static void folders_of_maps_say_where_memory_ends(void **state) {
    (void)state;
    static const char *const maps[] = {"stone_albedo.png",   "stone_normal.png",  "stone_rough.png",
                                       "stone_metal.png",    "stone_height.png",  "stone_ao.png",
                                       "stone_emissive.png", "stone_albedo_2.png"};
    for (size_t n = 0; n < sizeof maps / sizeof *maps; n++)
        write_image(temporary_folder_file(&test_folder, maps[n]), LOBE_FORMAT_RGBA8_UNORM);
    assert_true(fail_each_allocation(work_with_material, test_folder.path) > 80);
}

static void scenes_by_code_say_where_memory_ends(void **state) {
    (void)state;
    lobe_scene_open_parameters parameters = {.scene = "bumps"};
    assert_true(fail_each_allocation(work_with_scene, &parameters) > 10);
}

static lobe_result work_with_environment(void *path, const lobe_host *host) {
    lobe_environment *environment;
    lobe_result result = lobe_environment_open(path, host, &environment);
    assert_true((environment != NULL) == (result == LOBE_OK));
    lobe_environment_destroy(&environment);
    return result;
}

static void environments_say_where_memory_ends(void **state) {
    (void)state;
    char path[512];
    snprintf(path, sizeof path, "%s", temporary_folder_file(&test_folder, "light"));
    static const char radiance[] = "#?RADIANCE\n\n-Y 1 +X 2\n\x40\x40\x40\x80\x40\x40\x40\x80";
    lobe_file_write(path, radiance, sizeof radiance - 1, NULL);
    assert_true(fail_each_allocation(work_with_environment, path) >= 7);
    float texels[8][16][4] = {{{1}}};
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 8, 4, texels};
    const lobe_exr_layer layer = {.image = &image, .depth = LOBE_EXR_HALF};
    const lobe_exr_parameters exr = {.layers = &layer, .layer_count = 1};
    assert_int_equal(lobe_exr_write(path, &exr, NULL), LOBE_OK);
    assert_true(fail_each_allocation(work_with_environment, path) >= 8);
    assert_true(fail_each_allocation(work_with_environment, "sky") >= 3);
}

/// Shrinking saves memory and needs none.
static void environments_shrink_without_memory(void **state) {
    (void)state;
    for (size_t failing = 0; failing < 2; failing++) {
        counting_allocator counting;
        counting_allocator_start(&counting);
        lobe_environment *environment;
        assert_int_equal(lobe_environment_open(
                             "sky", &(lobe_host){.allocator = &counting.allocator}, &environment),
                         LOBE_OK);
        const size_t bytes = counting.bytes;
        counting.failing = failing ? counting.taken + 1 : 0;
        lobe_environment_shrink(environment, (environment->image.width + 1) / 2);
        assert_true((counting.bytes < bytes) == !failing);
        lobe_environment_destroy(&environment);
        assert_nothing_left(&counting);
    }
}

/// lobe frees a scene that the host filled with the allocator it came from.
static void the_hosts_own_scene_is_freed(void **state) {
    (void)state;
    counting_allocator counting;
    counting_allocator_start(&counting);
    const lobe_allocator *from = &counting.allocator;
    lobe_scene *scene = lobe_allocate(from, 1, sizeof *scene);
    scene->name = lobe_copy_text(from, "own");
    scene->lights = lobe_allocate(from, 2, sizeof *scene->lights);
    scene->light_count = 2;
    scene->materials = lobe_allocate(from, 1, sizeof *scene->materials);
    scene->materials[0].name = lobe_copy_text(from, "material");
    scene->material_count = 1;
    lobe_environment *environment;
    assert_int_equal(lobe_environment_open("sky", &(lobe_host){.allocator = from}, &environment),
                     LOBE_OK);
    lobe_scene_set_environment(scene, environment);
    lobe_scene_set_environment(scene, NULL);
    assert_int_equal(counting.blocks, 5);
    lobe_scene_destroy(&scene);
    assert_nothing_left(&counting);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(glTF_files_say_where_memory_ends),
        IN_TEST_FOLDER(rigs_say_where_memory_ends),
        IN_TEST_FOLDER(folders_of_maps_say_where_memory_ends),
        cmocka_unit_test(scenes_by_code_say_where_memory_ends),
        IN_TEST_FOLDER(environments_say_where_memory_ends),
        cmocka_unit_test(environments_shrink_without_memory),
        cmocka_unit_test(the_hosts_own_scene_is_freed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
