// Maps with one value become factors of their material.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include <lobe/animation.h>
#include <lobe/colour.h>

#include "scenes/scene/even_maps.h"
#include "scenes/scene/scene.h"
#include "tests/engine/support/log_recorder.h"

enum { BASE_COLOUR, NORMAL, VALUES, EMISSIVE, OCCLUSION, IMAGES };

static void add_image(lobe_scene *scene, lobe_format format, const uint8_t texel[4]) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, format, 6, 4, NULL), LOBE_OK);
    for (int i = 0; i < 6 * 4; i++)
        memcpy((uint8_t *)image.texels + 4 * i, texel, 4);
    assert_int_equal(scenes_add_image(scene, "map", &image, NULL, NULL), LOBE_OK);
}

/// A material whose maps all have one value.
static lobe_scene *even_scene(void) {
    lobe_scene *scene;
    assert_int_equal(scenes_allocate("scene", NULL, &scene), LOBE_OK);
    add_image(scene, LOBE_FORMAT_RGBA8_SRGB, (uint8_t[]){188, 100, 20, 51});
    add_image(scene, LOBE_FORMAT_RGBA8_UNORM, (uint8_t[]){128, 127, 255, 255});
    add_image(scene, LOBE_FORMAT_RGBA8_UNORM, (uint8_t[]){7, 102, 153, 255});
    add_image(scene, LOBE_FORMAT_RGBA8_SRGB, (uint8_t[]){255, 0, 188, 255});
    add_image(scene, LOBE_FORMAT_RGBA8_UNORM, (uint8_t[]){255, 9, 9, 9});
    lobe_material material;
    lobe_material_default(&material);
    material.base_colour[0] = material.base_colour[3] = 0.5f;
    material.roughness = 0.5f;
    material.metallic = 1;
    material.emissive[0] = material.emissive[1] = material.emissive[2] = 4;
    material.base_colour_map.image = BASE_COLOUR;
    material.normal_map.image = NORMAL;
    material.metallic_roughness_map.image = VALUES;
    material.emissive_map.image = EMISSIVE;
    material.occlusion_map.image = OCCLUSION;
    assert_int_equal(scenes_add_material(scene, "even", &material, NULL, NULL), LOBE_OK);
    return scene;
}

static void values_become_factors(void **state) {
    (void)state;
    log_recorder log;
    log_recorder_start(&log);
    lobe_scene *scene = even_scene();
    assert_int_equal(scenes_fold_even_maps(scene, &log.host), LOBE_OK);
    const lobe_material *material = &scene->materials[0];
    assert_int_equal(material->base_colour_map.image, -1);
    assert_float_equal(material->base_colour[0], 0.5f * lobe_srgb_decode(188 / 255.0f), 1e-6);
    assert_float_equal(material->base_colour[1], lobe_srgb_decode(100 / 255.0f), 1e-6);
    assert_float_equal(material->base_colour[3], 0.1f, 1e-6); // alpha is linear
    assert_int_equal(material->normal_map.image, -1);
    assert_int_equal(material->metallic_roughness_map.image, -1);
    assert_float_equal(material->roughness, 0.2f, 1e-6);
    assert_float_equal(material->metallic, 0.6f, 1e-6);
    assert_int_equal(material->emissive_map.image, -1);
    assert_float_equal(material->emissive[0], 4, 1e-6);
    assert_float_equal(material->emissive[1], 0, 0);
    assert_float_equal(material->emissive[2], 4 * lobe_srgb_decode(188 / 255.0f), 1e-5);
    assert_int_equal(material->occlusion_map.image, -1);
    assert_string_equal(log.all_notices, "scene: 5 maps have the same value in all texels: taken "
                                         "as the material's numbers\n");
    for (int i = 0; i < IMAGES; i++)
        assert_true(scene->images[i].image.width == 1 && scene->images[i].image.height == 1);
    assert_memory_equal(scene->images[VALUES].image.texels, ((uint8_t[]){7, 102, 153, 255}), 4);
    lobe_scene_destroy(&scene);
}

static uint8_t *last_texel(lobe_scene *scene, int image) {
    return (uint8_t *)scene->images[image].image.texels + 4 * (6 * 4 - 1);
}

static void maps_that_vary_stay(void **state) {
    (void)state;
    lobe_scene *scene = even_scene();
    for (int i = 0; i < IMAGES; i++)
        last_texel(scene, i)[3] ^= 1;
    lobe_material before = scene->materials[0];
    assert_int_equal(scenes_fold_even_maps(scene, NULL), LOBE_OK);
    assert_memory_equal(&scene->materials[0], &before, sizeof before);
    for (int i = 0; i < IMAGES; i++)
        assert_int_equal(scene->images[i].image.width, 6);
    lobe_scene_destroy(&scene);
}

static void set_value(lobe_scene *scene, int image, const uint8_t texel[4]) {
    for (int i = 0; i < 6 * 4; i++)
        memcpy((uint8_t *)scene->images[image].image.texels + 4 * i, texel, 4);
}

// No factor stands for these.
static void leaning_normals_and_occlusion_stay(void **state) {
    (void)state;
    lobe_scene *scene = even_scene();
    set_value(scene, NORMAL, (uint8_t[]){130, 128, 255, 255});
    set_value(scene, OCCLUSION, (uint8_t[]){254, 0, 0, 255});
    assert_int_equal(scenes_fold_even_maps(scene, NULL), LOBE_OK);
    assert_int_equal(scene->materials[0].normal_map.image, NORMAL);
    assert_int_equal(scene->materials[0].occlusion_map.image, OCCLUSION);
    lobe_scene_destroy(&scene);
}

// Without the flat map, normals would be those of the heights.
static void flat_normals_over_heights_stay(void **state) {
    (void)state;
    lobe_scene *scene = even_scene();
    scene->materials[0].height_map.image = VALUES;
    assert_int_equal(scenes_fold_even_maps(scene, NULL), LOBE_OK);
    assert_int_equal(scene->materials[0].normal_map.image, NORMAL);
    assert_int_equal(scene->materials[0].height_map.image, VALUES);
    assert_int_equal(scene->images[VALUES].image.width, 6);
    lobe_scene_destroy(&scene);
}

static void posed_materials_and_images_on_the_device_stay(void **state) {
    (void)state;
    lobe_scene *scene = even_scene();
    lobe_posed_material posed = {.material = 0};
    lobe_rig rig = {.materials = &posed, .material_count = 1};
    scene->rig = &rig;
    assert_int_equal(scenes_fold_even_maps(scene, NULL), LOBE_OK);
    assert_int_equal(scene->materials[0].base_colour_map.image, BASE_COLOUR);
    posed.material = -1;
    scene->images[BASE_COLOUR].on_device = true;
    assert_int_equal(scenes_fold_even_maps(scene, NULL), LOBE_OK);
    assert_int_equal(scene->materials[0].base_colour_map.image, BASE_COLOUR);
    assert_int_equal(scene->materials[0].metallic_roughness_map.image, -1);
    scene->rig = NULL;
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_become_factors),
        cmocka_unit_test(maps_that_vary_stay),
        cmocka_unit_test(leaning_normals_and_occlusion_stay),
        cmocka_unit_test(flat_normals_over_heights_stay),
        cmocka_unit_test(posed_materials_and_images_on_the_device_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
