#include "tests/engine/support/cmocka_all.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/png.h>
#include <lobe/scene.h>

#include "scenes/mesh/vector.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/scenes/scene/scene_check.h"

typedef struct folder_fixture {
    char path[64];
    log_recorder recorder;
    lobe_scene *scene;
} folder_fixture;

static int set_up(void **state) {
    folder_fixture *fixture = calloc(1, sizeof *fixture);
    if (!fixture)
        return -1;
    strcpy(fixture->path, "/tmp/lobe-material-XXXXXX");
    *state = fixture;
    return mkdtemp(fixture->path) ? 0 : -1;
}

static void file_path(const folder_fixture *fixture, const char *name, char path[512]) {
    snprintf(path, 512, "%s/%s", fixture->path, name);
}

static int tear_down(void **state) {
    folder_fixture *fixture = *state;
    lobe_scene_destroy(&fixture->scene);
    DIR *folder = opendir(fixture->path);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char path[512];
        file_path(fixture, entry->d_name, path);
        if (entry->d_name[0] != '.')
            remove(path);
    }
    if (folder)
        closedir(folder);
    int result = rmdir(fixture->path);
    free(fixture);
    return result;
}

// An image with the same colour in all texels.
static void write_image(const folder_fixture *fixture, const char *name, uint32_t width,
                        uint32_t height, uint8_t red, uint8_t green, uint8_t blue) {
    lobe_image image;
    char path[512];
    file_path(fixture, name, path);
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA8_UNORM, width, height, NULL),
                     LOBE_OK);
    for (size_t i = 0; i < (size_t)width * height; i++)
        memcpy((uint8_t *)image.texels + 4 * i, (uint8_t[]){red, green, blue, 255}, 4);
    assert_int_equal(lobe_png_write(path, &image, NULL), LOBE_OK);
    lobe_image_free(&image);
}

static void write_text(const folder_fixture *fixture, const char *name, const char *text) {
    char path[512];
    file_path(fixture, name, path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static const lobe_material *must_open(folder_fixture *fixture, lobe_carrier carrier) {
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

// The failure comes with one message that names the file and the cause.
static void must_fail(folder_fixture *fixture, const char *path, lobe_result expected,
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

static const lobe_image *image_of(const folder_fixture *fixture, const lobe_texture_use *use) {
    assert_in_range(use->image, 0, fixture->scene->image_count - 1);
    return &fixture->scene->images[use->image].image;
}

static void assert_texel(const lobe_image *image, uint8_t red, uint8_t green, uint8_t blue) {
    const uint8_t *texel = image->texels;
    assert_int_equal(texel[0], red);
    assert_int_equal(texel[1], green);
    assert_int_equal(texel[2], blue);
}

static void separate_maps_are_packed(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "Wall_BaseColor.png", 4, 4, 10, 20, 30);
    write_image(fixture, "Wall_NormalGL.png", 8, 8, 128, 140, 250);
    write_image(fixture, "Wall_Roughness.png", 2, 6, 90, 90, 90);
    write_image(fixture, "Wall_Metalness.png", 5, 3, 200, 200, 200);
    write_image(fixture, "Wall_AmbientOcclusion.png", 1, 1, 60, 60, 60);
    write_image(fixture, "Wall_Displacement.png", 1, 1, 70, 70, 70);
    write_text(fixture, "Wall_normal.txt", "not an image");
    const lobe_material *material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 5);
    assert_int_equal(material->model, LOBE_MATERIAL_MICROFACET);
    const lobe_image *albedo = image_of(fixture, &material->base_colour_map);
    assert_int_equal(albedo->format, LOBE_FORMAT_RGBA8_SRGB);
    assert_texel(albedo, 10, 20, 30);
    const lobe_image *normals = image_of(fixture, &material->normal_map);
    assert_int_equal(normals->format, LOBE_FORMAT_RGBA8_UNORM);
    assert_texel(normals, 128, 140, 250);
    const lobe_image *packed = image_of(fixture, &material->metallic_roughness_map);
    assert_int_equal(packed->format, LOBE_FORMAT_RGBA8_UNORM);
    assert_true(packed->width == 5 && packed->height == 6);
    assert_texel(packed, 255, 90, 200);
    assert_texel(image_of(fixture, &material->occlusion_map), 60, 60, 60);
    assert_texel(image_of(fixture, &material->height_map), 70, 70, 70);
    assert_true(material->height_scale == 0.05f);
    assert_true(material->roughness == 1 && material->metallic == 1);
    for (int i = 0; i < 3; i++)
        assert_true(material->base_colour[i] == 1 && material->emissive[i] == 0);
}

static void packed_map_serves_occlusion_too(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "arm_1k.png", 3, 3, 1, 2, 3);
    write_image(fixture, "rough_1k.png", 3, 3, 9, 9, 9);
    const lobe_material *material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 1);
    assert_texel(image_of(fixture, &material->metallic_roughness_map), 1, 2, 3);
    assert_int_equal(material->occlusion_map.image, material->metallic_roughness_map.image);
    assert_true(material->roughness == 1 && material->metallic == 1);
}

static void metallic_roughness_has_no_occlusion(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "metallicRoughness.png", 3, 3, 1, 2, 3);
    write_image(fixture, "emissive.png", 2, 2, 4, 5, 6);
    const lobe_material *material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of(fixture, &material->metallic_roughness_map), 1, 2, 3);
    assert_int_equal(material->occlusion_map.image, -1);
    assert_int_equal(image_of(fixture, &material->emissive_map)->format, LOBE_FORMAT_RGBA8_SRGB);
    assert_true(material->emissive[0] == 1);
}

static void directx_normals_are_turned_up(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "nor_dx.png", 2, 2, 100, 30, 220);
    const lobe_material *material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of(fixture, &material->normal_map), 100, 225, 220);
    // An OpenGL map takes precedence and is used unchanged.
    write_image(fixture, "nor_gl.png", 2, 2, 101, 31, 221);
    material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 1);
    assert_texel(image_of(fixture, &material->normal_map), 101, 31, 221);
}

static void missing_maps_become_factors(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "normal.png", 2, 2, 128, 128, 255);
    const lobe_material *material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_true(material->base_colour[0] == 0.5f && material->base_colour[3] == 1);
    assert_true(material->metallic == 1 && material->roughness == 0.5f);
    assert_int_equal(material->metallic_roughness_map.image, -1);
    assert_int_equal(material->base_colour_map.image, -1);
    assert_true(material->height_map.image == -1 && material->height_scale == 0);
    write_image(fixture, "albedo.png", 2, 2, 1, 2, 3);
    material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_true(material->base_colour[0] == 1 && material->metallic == 0);
    assert_true(material->roughness == 0.5f);
    write_image(fixture, "rough.png", 2, 2, 70, 70, 70);
    material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of(fixture, &material->metallic_roughness_map), 255, 70, 255);
    assert_true(material->metallic == 0 && material->roughness == 1);
    write_image(fixture, "metal.png", 2, 2, 80, 80, 80);
    char path[512];
    file_path(fixture, "rough.png", path);
    assert_int_equal(remove(path), 0);
    material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_texel(image_of(fixture, &material->metallic_roughness_map), 255, 255, 80);
    assert_true(material->metallic == 1 && material->roughness == 0.5f);
}

static void first_in_alphabetical_order_is_taken(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "col_2.png", 1, 1, 2, 2, 2);
    write_image(fixture, "col_1.png", 1, 1, 1, 1, 1);
    write_image(fixture, "col_3.png", 1, 1, 3, 3, 3);
    const lobe_material *material = must_open(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->scene->image_count, 1);
    assert_texel(image_of(fixture, &material->base_colour_map), 1, 1, 1);
}

static void carriers_repeat_the_maps(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "albedo.png", 2, 2, 1, 2, 3);
    must_open(fixture, LOBE_CARRIER_PLANE);
    const lobe_mesh *plane = &fixture->scene->meshes[0];
    assert_int_equal(plane->index_count, 6);
    assert_true(plane->vertices[3].texture_coordinates[0][0] -
                    plane->vertices[0].texture_coordinates[0][0] ==
                4);
    must_open(fixture, LOBE_CARRIER_SPHERE);
    const lobe_mesh *sphere = &fixture->scene->meshes[0];
    assert_int_equal(sphere->index_count, 6 * 63 * 128);
    assert_true(sphere->vertices[sphere->vertex_count - 1].texture_coordinates[0][0] == 4);
}

// Texels of a map of that extent across a pixel of 1280 x 720, at the middle of the three corners.
static double texels_across(const lobe_camera *camera, const lobe_mesh *mesh, size_t first,
                            double extent, bool *inside) {
    vector3 eye = vector3_load(camera->eye);
    vector3 forward = vector3_subtract(vector3_load(camera->target), eye);
    vector3_normalise(&forward, 0);
    vector3 right = vector3_cross(forward, vector3_load(camera->up));
    vector3_normalise(&right, 0);
    vector3 up = vector3_cross(right, forward);
    double scale = 360 / tan(camera->vertical_field_of_view / 2), at[3][2], uv[3][2];
    for (int k = 0; k < 3; k++) {
        const lobe_scene_vertex *vertex = &mesh->vertices[mesh->indices[first + k]];
        vector3 p = vector3_subtract(vector3_load(vertex->position), eye);
        double depth = vector3_dot(p, forward);
        at[k][0] = scale * vector3_dot(p, right) / depth;
        at[k][1] = scale * vector3_dot(p, up) / depth;
        *inside = depth > 0 && fabs(at[k][0]) < 640 && fabs(at[k][1]) < 360;
        uv[k][0] = vertex->texture_coordinates[0][0], uv[k][1] = vertex->texture_coordinates[0][1];
    }
    double pixels = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                    (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
    double texels = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) -
                    (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
    return extent * sqrt(fabs(texels / pixels));
}

static void cloth_is_seen_with_two_to_eight_texels_a_pixel(void **state) {
    folder_fixture *fixture = *state;
    const uint32_t extents[] = {128, 512};
    for (int i = 0; i < 2; i++) {
        write_image(fixture, "albedo.png", extents[i], 16, 1, 2, 3);
        const lobe_material *material = must_open(fixture, LOBE_CARRIER_CLOTH);
        assert_true(material->double_sided);
        const lobe_mesh *cloth = &fixture->scene->meshes[0];
        size_t seen = 0, fitting = 0;
        for (size_t k = 0; k < cloth->index_count; k += 3) {
            bool inside;
            double across = texels_across(&fixture->scene->camera, cloth, k, extents[i], &inside);
            seen += inside;
            fitting += inside && across > 2 && across < 8;
        }
        assert_true(seen > cloth->index_count / 3 / 2);
        assert_true(fitting > seen * 95 / 100);
    }
}

static double distance(const lobe_scene_vertex *a, const lobe_scene_vertex *b) {
    return vector3_length(vector3_subtract(vector3_load(a->position), vector3_load(b->position)));
}

// It waves, but hardly stretches: edges are as long as the maps on them.
static void cloth_keeps_its_lengths(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "albedo.png", 400, 16, 1, 2, 3);
    must_open(fixture, LOBE_CARRIER_CLOTH);
    const lobe_mesh *cloth = &fixture->scene->meshes[0];
    const double tile = 400 * 0.0005;
    for (size_t i = 0; i < cloth->index_count; i++) {
        const lobe_scene_vertex *a = &cloth->vertices[cloth->indices[i]];
        const lobe_scene_vertex *b = &cloth->vertices[cloth->indices[i - i % 3 + (i + 1) % 3]];
        double u = b->texture_coordinates[0][0] - a->texture_coordinates[0][0];
        double v = b->texture_coordinates[0][1] - a->texture_coordinates[0][1];
        double ratio = distance(a, b) / (tile * sqrt(u * u + v * v));
        assert_true(ratio > 0.99 && ratio < 1.15);
    }
    assert_true(cloth->maximum[2] - cloth->minimum[2] > 0.04f);
}

static void a_folder_is_a_scene(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "albedo.png", 64, 64, 1, 2, 3);
    must_open(fixture, LOBE_CARRIER_CLOTH);
    lobe_scene *opened;
    assert_int_equal(lobe_scene_open(fixture->path, NULL, &opened), LOBE_OK);
    assert_string_equal(opened->name, fixture->path);
    scene_check_equal(opened, fixture->scene);
    lobe_scene_destroy(&opened);
}

static void images_of_other_formats_are_named(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "albedo.png", 2, 2, 1, 2, 3);
    write_text(fixture, "normal.exr", "");
    must_open(fixture, LOBE_CARRIER_PLANE);
    assert_int_equal(fixture->recorder.warnings, 1);
    assert_non_null(strstr(fixture->recorder.last_warning, "normal.exr"));
}

static void bad_folders_are_named(void **state) {
    folder_fixture *fixture = *state;
    char path[512];
    must_fail(fixture, "/nonexistent/folder", LOBE_ERROR_NOT_FOUND, "/nonexistent/folder",
              "no such folder");
    must_fail(fixture, fixture->path, LOBE_ERROR_NOT_FOUND, fixture->path, "no PNG or JPEG");
    write_image(fixture, "holiday.png", 1, 1, 0, 0, 0);
    write_image(fixture, "height.png", 1, 1, 0, 0, 0);
    must_fail(fixture, fixture->path, LOBE_ERROR_NOT_FOUND, fixture->path, "no PNG or JPEG");
    file_path(fixture, "holiday.png", path);
    must_fail(fixture, path, LOBE_ERROR_READ, "holiday.png", "irectory");
}

static void bad_images_are_named(void **state) {
    folder_fixture *fixture = *state;
    write_image(fixture, "albedo.png", 64, 64, 1, 2, 3);
    write_text(fixture, "normal.png", "this is no image at all");
    must_fail(fixture, fixture->path, LOBE_ERROR_UNSUPPORTED, "normal.png", "PNG");
    write_text(fixture, "normal.png", "\x89PNG\r\n\x1a\n and no more");
    must_fail(fixture, fixture->path, LOBE_ERROR_MALFORMED, "normal.png", ":");
    write_text(fixture, "normal.png", "");
    must_fail(fixture, fixture->path, LOBE_ERROR_MALFORMED, "normal.png", ":");
    char path[512];
    file_path(fixture, "normal.png", path);
    assert_int_equal(remove(path), 0);
    // The last map to be read fails: everything read before is freed.
    file_path(fixture, "metallic.png", path);
    write_image(fixture, "roughness.png", 64, 64, 1, 1, 1);
    assert_int_equal(mkdir(path, 0700), 0);
    must_fail(fixture, fixture->path, LOBE_ERROR_READ, "metallic.png", "file");
    file_path(fixture, "albedo.png", path);
    assert_int_equal(truncate(path, 60), 0);
    must_fail(fixture, fixture->path, LOBE_ERROR_MALFORMED, "albedo.png", ":");
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

#define FOLDER_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(separate_maps_are_packed),
        FOLDER_TEST(packed_map_serves_occlusion_too),
        FOLDER_TEST(metallic_roughness_has_no_occlusion),
        FOLDER_TEST(directx_normals_are_turned_up),
        FOLDER_TEST(missing_maps_become_factors),
        FOLDER_TEST(first_in_alphabetical_order_is_taken),
        FOLDER_TEST(carriers_repeat_the_maps),
        FOLDER_TEST(cloth_is_seen_with_two_to_eight_texels_a_pixel),
        FOLDER_TEST(cloth_keeps_its_lengths),
        FOLDER_TEST(a_folder_is_a_scene),
        FOLDER_TEST(images_of_other_formats_are_named),
        FOLDER_TEST(bad_folders_are_named),
        FOLDER_TEST(bad_images_are_named),
        FOLDER_TEST(real_sets_are_understood),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
