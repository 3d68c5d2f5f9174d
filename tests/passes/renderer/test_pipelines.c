// Pipelines depend on which features a scene has, not on its values: when a host changes values
// from frame to frame, nothing is compiled, and what the device keeps does not grow.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static lobe_scene *changing_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.4, 7));
    material.metallic_roughness_map = scene_add_map(scene, random_map(8, 8, 0.3, 0.9, 8));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[3]){1, 2, 0.5}, 3);
    scene_look_down(scene, 8);
    scene_end(scene);
    return scene;
}

static void change_values(lobe_scene *scene) {
    lobe_material *material = &scene->materials[0];
    material->roughness = 0.37f;
    material->metallic = 0.6f;
    material->base_colour[1] = 0.45f;
    material->normal_scale = 1.3f;
    for (int map = 0; map < 2; map++) {
        float *texels = scene->images[map].image.texels;
        texels[0] = 0.7f;
        texels[1] = 0.35f;
    }
    scene->lights[0].intensity[2] = 2.5f;
    scene->lights[0].direction[0] *= -1;
    scene->camera.orthographic_height = 7;
}

static void values_make_no_pipelines(void **state) {
    fixture *f = *state;
    static const uint32_t changed[] = {0, 1};
    const lobe_scene_changes changes = {
        .images = changed, .image_count = 2, .materials = changed, .material_count = 1};
    for (size_t n = 0; n < lobe_filter_count(); n++) {
        picture_request request = {
            .filter = lobe_filter_name(lobe_filter_get(n)), .width = 4, .height = 4, .samples = 2};
        if (strcmp(request.filter, "moments") == 0)
            request.settings[0] = "bins=2"; // as many as suit the values, otherwise
        lobe_scene *scene = changing_scene();
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        lobe_frame first = draw(f, &request);
        change_values(scene);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        faults.pipelines = 0;
        lobe_frame second = draw(f, &request);
        if (faults.pipelines)
            fail_msg("%s: %d pipelines for other values", request.filter, faults.pipelines);
        assert_true(image_hash(&first.radiance) != image_hash(&second.radiance));
        lobe_frame_free(&first);
        lobe_frame_free(&second);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

static void features_make_pipelines(void **state) {
    fixture *f = *state;
    const picture_request request = {.filter = "direct", .width = 4, .height = 4};
    lobe_scene *scene = changing_scene();
    lobe_frame frame = draw_scene(f, scene, &request);
    lobe_frame_free(&frame);
    scene->materials[0].alpha_mask = true;
    faults.pipelines = 0;
    frame = draw_scene(f, scene, &request);
    assert_int_equal(faults.pipelines, 1);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_make_no_pipelines),
        cmocka_unit_test(features_make_pipelines),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
