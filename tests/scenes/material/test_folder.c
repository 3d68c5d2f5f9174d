// Folders of maps: which file becomes which map, and what the log says of it.

#include "tests/scenes/material/folder_fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/exr.h>

#include "tests/scenes/scene/scene_check.h"

static void separate_maps_are_packed(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "Wall_BaseColor.png", 4, 4, 10, 20, 30);
    write_map(fixture, "Wall_NormalGL.png", 8, 8, 128, 140, 250);
    write_map(fixture, "Wall_Roughness.png", 2, 6, 90, 90, 90);
    write_map(fixture, "Wall_Metalness.png", 5, 3, 200, 200, 200);
    write_map(fixture, "Wall_AmbientOcclusion.png", 2, 1, 60, 60, 60);
    write_map(fixture, "Wall_Displacement.png", 2, 1, 70, 70, 70);
    write_folder_text(fixture, "Wall_normal.txt", "not an image");
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 5);
    assert_int_equal(material->model, LOBE_MATERIAL_MICROFACET);
    const lobe_image *albedo = image_of_use(fixture, &material->base_colour_map);
    assert_int_equal(albedo->format, LOBE_FORMAT_RGBA8_SRGB);
    assert_texel(albedo, 10, 20, 30);
    const lobe_image *normals = image_of_use(fixture, &material->normal_map);
    assert_int_equal(normals->format, LOBE_FORMAT_RGBA8_UNORM);
    assert_texel(normals, 128, 140, 250);
    const lobe_image *packed = image_of_use(fixture, &material->metallic_roughness_map);
    assert_int_equal(packed->format, LOBE_FORMAT_RGBA8_UNORM);
    assert_true(packed->width == 5 && packed->height == 6);
    assert_texel(packed, 255, 90, 200);
    assert_texel(image_of_use(fixture, &material->occlusion_map), 60, 60, 60);
    assert_texel(image_of_use(fixture, &material->height_map), 70, 70, 70);
    assert_true(material->height_scale == 0.05f);
    assert_true(material->roughness == 1 && material->metallic == 1);
    for (int i = 0; i < 3; i++)
        assert_true(material->base_colour[i] == 1 && material->emissive[i] == 0);
}

static void packed_map_serves_occlusion_too(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "arm_1k.png", 3, 3, 1, 2, 3);
    write_map(fixture, "rough_1k.png", 3, 3, 9, 9, 9);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 1);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 1, 2, 3);
    assert_int_equal(material->occlusion_map.image, material->metallic_roughness_map.image);
    assert_true(material->roughness == 1 && material->metallic == 1);
}

static void metallic_roughness_has_no_occlusion(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "metallicRoughness.png", 3, 3, 1, 2, 3);
    write_map(fixture, "emissive.png", 2, 2, 4, 5, 6);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 1, 2, 3);
    assert_int_equal(material->occlusion_map.image, -1);
    assert_int_equal(image_of_use(fixture, &material->emissive_map)->format,
                     LOBE_FORMAT_RGBA8_SRGB);
    assert_true(material->emissive[0] == 1);
}

static void workflow_is_no_map(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "MetalBricks_COL_2K_METALNESS.png", 2, 2, 1, 2, 3);
    write_map(fixture, "MetalBricks_NRM_2K_METALNESS.png", 2, 2, 128, 140, 250);
    write_map(fixture, "MetalBricks_METALNESS_2K_METALNESS.png", 2, 2, 9, 9, 9);
    write_map(fixture, "MetalBricks_ROUGHNESS_2K_METALNESS.png", 2, 2, 8, 8, 8);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->base_colour_map), 1, 2, 3);
    assert_texel(image_of_use(fixture, &material->normal_map), 128, 140, 250);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 8, 9);
}

static void metalness_after_a_resolution_is_a_map(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "Metal01_1K-PNG_Color.png", 2, 2, 1, 2, 3);
    write_map(fixture, "Metal01_1K-PNG_Metalness.png", 2, 2, 9, 9, 9);
    write_map(fixture, "Metal01_2K-PNG_Metalness.png", 2, 2, 7, 7, 7);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->base_colour_map), 1, 2, 3);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 255, 9);
}

static void directx_normals_are_turned_up(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "nor_dx.png", 2, 2, 100, 30, 220);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->normal_map), 100, 225, 220);
    // An OpenGL map takes precedence and is used unchanged.
    write_map(fixture, "nor_gl.png", 2, 2, 101, 31, 221);
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 1);
    assert_texel(image_of_use(fixture, &material->normal_map), 101, 31, 221);
}

static void gloss_becomes_roughness(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "wall_GLOSS.png", 2, 2, 200, 200, 200);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 55, 255);
    assert_true(material->roughness == 1);
    // Roughness itself takes precedence.
    write_map(fixture, "wall_rgh.png", 2, 2, 90, 90, 90);
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 90, 255);
    assert_non_null(strstr(fixture->recorder.all_notices, "roughness from wall_rgh.png"));
    assert_non_null(strstr(fixture->recorder.all_notices,
                           "ignored wall_GLOSS.png (there is another one for this)"));
}

static void smoothness_is_in_alpha(void **state) {
    folder_fixture *fixture = *state;
    write_rgba_map(fixture, "Wall_MetallicSmoothness.png", (uint8_t[]){180, 1, 2, 215});
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 40, 180);
    assert_true(material->roughness == 1 && material->metallic == 1);
    assert_non_null(strstr(fixture->recorder.all_notices,
                           "roughness (1 - gloss) from Wall_MetallicSmoothness.png (alpha), "
                           "metallic from Wall_MetallicSmoothness.png (red)"));
    // Without alpha there is no smoothness, rather than a mirror.
    write_rgba_map(fixture, "Wall_MetallicSmoothness.png", (uint8_t[]){180, 1, 2, 255});
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->recorder.warnings, 1);
    assert_non_null(strstr(fixture->recorder.last_warning, "no alpha"));
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 255, 180);
    assert_true(material->roughness == 0.5f && material->metallic == 1);
}

static void packed_files_are_taken_apart(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "wall_MRA.png", 3, 3, 11, 22, 33);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 22, 11);
    assert_texel(image_of_use(fixture, &material->occlusion_map), 33, 33, 33);
    char path[512];
    folder_file_path(fixture, "wall_MRA.png", path);
    assert_int_equal(remove(path), 0);
    // Occlusion, roughness and height; separate files come before it.
    write_map(fixture, "wall_ORD.png", 3, 3, 44, 55, 66);
    write_map(fixture, "wall_roughness.png", 3, 3, 77, 77, 77);
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 77, 255);
    assert_texel(image_of_use(fixture, &material->occlusion_map), 44, 44, 44);
    assert_texel(image_of_use(fixture, &material->height_map), 66, 66, 66);
}

/// The name by which Khronos and Substance call it.
static void occlusion_roughness_metallic_is_that_of_gltf(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "Wall_occlusionRoughnessMetallic.png", 3, 3, 1, 2, 3);
    write_map(fixture, "Wall_baseColor.png", 3, 3, 4, 5, 6);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 2);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 1, 2, 3);
    assert_int_equal(material->occlusion_map.image, material->metallic_roughness_map.image);
    assert_true(material->roughness == 1 && material->metallic == 1);
}

/// Which file became which map, and which images were left out and why.
static void the_log_says_what_was_taken(void **state) {
    folder_fixture *fixture = *state;
    static const char *const expected[] = {
        "base colour from Metal2_Color.png, normals (DirectX) from Metal2_NormalDX.png",
        "Metal2.png (names no map)",
        "Metal2_Color_old.png (there is another one for this)",
        "Metal2_Specular.png (specular)",
    };
    write_map(fixture, "Metal2_Color.png", 2, 2, 1, 2, 3);
    write_map(fixture, "Metal2_NormalDX.png", 2, 2, 128, 128, 255);
    write_map(fixture, "Metal2_Color_old.png", 2, 2, 1, 2, 3);
    write_map(fixture, "Metal2_Specular.png", 2, 2, 1, 2, 3);
    write_map(fixture, "Metal2.png", 2, 2, 1, 2, 3); // a picture of the material
    write_folder_text(fixture, "Metal2_Color.mtlx", "not an image");
    must_open_folder(fixture, LOBE_CARRIER_PLANE);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!strstr(fixture->recorder.all_notices, expected[i]))
            fail_msg("no '%s' in:\n%s", expected[i], fixture->recorder.all_notices);
    assert_null(strstr(fixture->recorder.all_notices, ".mtlx"));
    assert_int_equal(fixture->recorder.notices, 3); // maps, ignored files, the sky
}

static void two_materials_are_an_error(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "brick_1k_albedo.png", 2, 2, 1, 2, 3);
    write_map(fixture, "brick_2k_albedo.png", 2, 2, 1, 2, 3);
    write_map(fixture, "brick_normal.png", 2, 2, 1, 2, 3);
    must_open_folder(fixture, LOBE_CARRIER_PLANE);
    write_map(fixture, "old_wood_normal.png", 2, 2, 1, 2, 3);
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_UNSUPPORTED, fixture->path,
                     "2 materials: 'brick', 'old wood'");
}

static void two_materials_may_be_named_behind_the_map(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "albedo_brick.png", 2, 2, 1, 2, 3);
    write_map(fixture, "albedo_red.png", 2, 2, 1, 2, 3);
    write_map(fixture, "normal_brick.png", 2, 2, 1, 2, 3);
    must_open_folder(fixture, LOBE_CARRIER_PLANE);
    write_map(fixture, "normal_wood.png", 2, 2, 1, 2, 3);
    write_map(fixture, "albedo_wood.png", 2, 2, 1, 2, 3);
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_UNSUPPORTED, fixture->path,
                     "2 materials: 'brick', 'wood'");
}

static void missing_maps_become_factors(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "normal.png", 2, 2, 128, 128, 255);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_true(material->base_colour[0] == 0.5f && material->base_colour[3] == 1);
    assert_true(material->metallic == 1 && material->roughness == 0.5f);
    assert_int_equal(material->metallic_roughness_map.image, -1);
    assert_int_equal(material->base_colour_map.image, -1);
    assert_true(material->height_map.image == -1 && material->height_scale == 0);
    write_map(fixture, "albedo.png", 2, 2, 1, 2, 3);
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_true(material->base_colour[0] == 1 && material->metallic == 0);
    assert_true(material->roughness == 0.5f);
    write_map(fixture, "rough.png", 2, 2, 70, 70, 70);
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 70, 255);
    assert_true(material->metallic == 0 && material->roughness == 1);
    write_map(fixture, "metal.png", 2, 2, 80, 80, 80);
    char path[512];
    folder_file_path(fixture, "rough.png", path);
    assert_int_equal(remove(path), 0);
    material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of_use(fixture, &material->metallic_roughness_map), 255, 255, 80);
    assert_true(material->metallic == 1 && material->roughness == 0.5f);
}

static void first_in_alphabetical_order_is_taken(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "col_2.png", 2, 1, 2, 2, 2);
    write_map(fixture, "col_1.png", 2, 1, 1, 1, 1);
    write_map(fixture, "col_3.png", 2, 1, 3, 3, 3);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 1);
    assert_texel(image_of_use(fixture, &material->base_colour_map), 1, 1, 1);
}

static void a_folder_is_a_scene(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "albedo.png", 64, 64, 1, 2, 3);
    must_open_folder(fixture, LOBE_CARRIER_CLOTH);
    lobe_scene *opened;
    assert_int_equal(lobe_scene_open(fixture->path, NULL, &opened), LOBE_OK);
    assert_string_equal(opened->name, fixture->path);
    scene_check_equal(opened, fixture->scene);
    lobe_scene_destroy(&opened);
}

static void write_exr(const folder_fixture *fixture, const char *name, const float rgba[8]) {
    char path[512];
    folder_file_path(fixture, name, path);
    const lobe_image image = {
        .format = LOBE_FORMAT_RGBA32_FLOAT, .width = 2, .height = 1, .texels = (float *)rgba};
    const lobe_exr_layer layer = {.image = &image, .depth = LOBE_EXR_FLOAT};
    const lobe_exr_parameters parameters = {.layers = &layer, .layer_count = 1};
    assert_int_equal(lobe_exr_write(path, &parameters, NULL), LOBE_OK);
}

static void maps_may_be_openexr(void **state) {
    folder_fixture *fixture = *state;
    write_exr(fixture, "wall_diff_1k.exr", (const float[]){0.5f, 0, 1, 1, 0.25f, 0, 1, 1});
    write_exr(fixture, "wall_nor_gl_1k.exr", (const float[]){0.5f, 0.25f, 1, 1, 0.5f, 0, 1, 1});
    write_exr(fixture, "wall_rough_1k.exr", (const float[]){0.2f, 0.2f, 0.2f, 1, 0.8f, 1, 1, 1});
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->recorder.warnings, 0);
    const lobe_image *colour = image_of_use(fixture, &material->base_colour_map);
    assert_int_equal(colour->format, LOBE_FORMAT_RGBA8_SRGB);
    assert_memory_equal(colour->texels, ((const uint8_t[]){188, 0, 255, 255, 137, 0, 255, 255}), 8);
    const lobe_image *normals = image_of_use(fixture, &material->normal_map);
    assert_int_equal(normals->format, LOBE_FORMAT_RGBA16_UNORM);
    assert_memory_equal(normals->texels, ((const uint16_t[]){32768, 16384, 65535, 65535}), 8);
    assert_int_equal(
        ((const uint8_t *)image_of_use(fixture, &material->metallic_roughness_map)->texels)[1], 51);
}

/// Whose numbers may lie outside [0, 1].
static void png_is_preferred_to_openexr(void **state) {
    folder_fixture *fixture = *state;
    write_exr(fixture, "wall_diff.exr", (const float[]){2, -1, NAN, 1, 0.25f, 0, 1, 1});
    write_map(fixture, "wall_diff.png", 2, 2, 1, 2, 3);
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->recorder.warnings, 0);
    assert_texel(image_of_use(fixture, &material->base_colour_map), 1, 2, 3);
}

static void texels_of_openexr_outside_of_the_range_are_counted(void **state) {
    folder_fixture *fixture = *state;
    write_exr(fixture, "wall_diff.exr", (const float[]){2, -1, NAN, 1, 0.25f, 0, 1, 1});
    const lobe_material *material = must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->recorder.warnings, 1);
    assert_non_null(strstr(fixture->recorder.last_warning, "1 of 2 texels are outside [0, 1]"));
    assert_memory_equal(image_of_use(fixture, &material->base_colour_map)->texels,
                        ((const uint8_t[]){255, 0, 0, 255}), 4);
}

static void images_of_other_formats_are_named(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "albedo.png", 2, 2, 1, 2, 3);
    write_folder_text(fixture, "normal.tga", "");
    must_open_folder(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->recorder.warnings, 1);
    assert_non_null(strstr(fixture->recorder.last_warning, "normal.tga"));
}

static void bad_folders_are_named(void **state) {
    folder_fixture *fixture = *state;
    char path[512];
    must_fail_folder(fixture, "/nonexistent/folder", LOBE_ERROR_NOT_FOUND, "/nonexistent/folder",
                     "no such folder");
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_NOT_FOUND, fixture->path, "no PNG, JPEG");
    write_map(fixture, "holiday.png", 1, 1, 0, 0, 0);
    write_map(fixture, "height.png", 1, 1, 0, 0, 0);
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_NOT_FOUND, fixture->path,
                     "heights alone are no material");
    folder_file_path(fixture, "holiday.png", path);
    must_fail_folder(fixture, path, LOBE_ERROR_READ, "holiday.png", "irectory");
}

static void bad_images_are_named(void **state) {
    folder_fixture *fixture = *state;
    write_map(fixture, "albedo.png", 64, 64, 1, 2, 3);
    write_folder_text(fixture, "normal.png", "this is no image at all");
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_UNSUPPORTED, "normal.png", "PNG");
    write_folder_text(fixture, "normal.png", "\x89PNG\r\n\x1a\n and no more");
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_MALFORMED, "normal.png", ":");
    write_folder_text(fixture, "normal.png", "");
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_MALFORMED, "normal.png", ":");
    char path[512];
    folder_file_path(fixture, "normal.png", path);
    assert_int_equal(remove(path), 0);
    // The last map to be read fails: everything read before is freed.
    folder_file_path(fixture, "metallic.png", path);
    write_map(fixture, "roughness.png", 64, 64, 1, 1, 1);
    assert_int_equal(mkdir(path, 0700), 0);
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_READ, "metallic.png", "file");
    folder_file_path(fixture, "albedo.png", path);
    assert_int_equal(truncate(path, 60), 0);
    must_fail_folder(fixture, fixture->path, LOBE_ERROR_MALFORMED, "albedo.png", ":");
}

// Real material folders, if available.
static void real_sets_are_understood(void **state) {
    static const struct {
        const char *folder;
        size_t images;
        bool albedo, normal, packed, occlusion, height;
        double height_scale[2]; // minimum and maximum
    } sets[] = {
        {"ambientcg_Bark014", 4, true, true, true, false, true, {0.01, 0.05}},
        {"ambientcg_Metal053C", 4, true, true, true, false, true, {0.001, 0.02}},
        {"ambientcg_Rock058", 4, true, true, true, false, true, {0.03, 0.1}},
        {"godot_tps", 1, false, true, false, false, false, {0, 0}},
        {"godot_wool", 3, true, true, false, false, true, {-0.05, -0.004}},
        {"materialx_brick", 3, true, true, true, false, false, {0, 0}},
        {"polyhaven_fabric_pattern_07", 3, true, true, true, true, false, {0, 0}},
    };
    folder_fixture *fixture = *state;
    const char *assets = LOBE_TEST_ASSETS;
    if (access(assets, R_OK) != 0)
        skip();
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/tex/%s", assets, sets[i].folder);
        log_recorder_start(&fixture->recorder);
        lobe_scene *scene = NULL;
        assert_int_equal(lobe_scene_open(path, &fixture->recorder.host, &scene), LOBE_OK);
        assert_int_equal(fixture->recorder.errors + fixture->recorder.warnings, 0);
        scene_check(scene);
        const lobe_material *material = &scene->materials[0];
        assert_int_equal(scene->image_count, sets[i].images);
        assert_int_equal(material->base_colour_map.image >= 0, sets[i].albedo);
        assert_int_equal(material->normal_map.image >= 0, sets[i].normal);
        assert_int_equal(material->metallic_roughness_map.image >= 0, sets[i].packed);
        assert_int_equal(material->occlusion_map.image >= 0, sets[i].occlusion);
        assert_int_equal(material->height_map.image >= 0, sets[i].height);
        assert_true(material->height_scale >= (float)sets[i].height_scale[0]);
        assert_true(material->height_scale <= (float)sets[i].height_scale[1]);
        lobe_scene_destroy(&scene);
    }
}

#define FOLDER_TEST(name)                                                                          \
    cmocka_unit_test_setup_teardown(name, folder_fixture_create, folder_fixture_destroy)

int main(void) {
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(separate_maps_are_packed),
        FOLDER_TEST(packed_map_serves_occlusion_too),
        FOLDER_TEST(metallic_roughness_has_no_occlusion),
        FOLDER_TEST(workflow_is_no_map),
        FOLDER_TEST(metalness_after_a_resolution_is_a_map),
        FOLDER_TEST(directx_normals_are_turned_up),
        FOLDER_TEST(gloss_becomes_roughness),
        FOLDER_TEST(smoothness_is_in_alpha),
        FOLDER_TEST(packed_files_are_taken_apart),
        FOLDER_TEST(occlusion_roughness_metallic_is_that_of_gltf),
        FOLDER_TEST(the_log_says_what_was_taken),
        FOLDER_TEST(two_materials_are_an_error),
        FOLDER_TEST(two_materials_may_be_named_behind_the_map),
        FOLDER_TEST(missing_maps_become_factors),
        FOLDER_TEST(first_in_alphabetical_order_is_taken),
        FOLDER_TEST(a_folder_is_a_scene),
        FOLDER_TEST(maps_may_be_openexr),
        FOLDER_TEST(png_is_preferred_to_openexr),
        FOLDER_TEST(texels_of_openexr_outside_of_the_range_are_counted),
        FOLDER_TEST(images_of_other_formats_are_named),
        FOLDER_TEST(bad_folders_are_named),
        FOLDER_TEST(bad_images_are_named),
        FOLDER_TEST(real_sets_are_understood),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
