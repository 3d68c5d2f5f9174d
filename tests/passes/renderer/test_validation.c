// The validation layer, with synchronisation validation, is silent where maps of any size are
// rebuilt, pictures resized, and the view changes in between. See `error` for every filter and
// built-in scene, and `knobs` for every knob.

#include "tests/passes/support/fixture.h"

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static void draw_mixed(fixture *f, const picture_request *request) {
    lobe_frame frame = draw_silently(f, "mixed", request);
    lobe_frame_free(&frame);
}

/// Sizes that are not powers of two, several materials, an atlas, every storage and subdivision.
static lobe_scene *mixed_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    material.normal_map = scene_add_map(scene, random_normal_map(67, 45, 0.5, 101));
    material.specular_map = scene_add_map(scene, random_map(24, 16, 0, 1, 102));
    scene_add_square(scene, &material, 1, NULL);
    lobe_material_default(&material);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 16, 0.5, 103));
    material.metallic_roughness_map = scene_add_map(scene, random_map(8, 32, 0, 1, 104));
    material.emissive_map = material.base_colour_map =
        scene_add_map(scene, random_map(1, 7, 0, 1, 105));
    float aside[16] = {1, 0, 0, 0, 0, 0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0.5f, 0.5f, 0, 1};
    scene_add_square(scene, &material, 1, aside);
    lobe_material_default(&material);
    aside[12] = -0.5f;
    scene_add_square(scene, &material, 1, aside);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.4, 1, 0.9}, 3);
    scene_end(scene);
    return scene;
}

static void knobs_are_valid(void **state) {
    static const char *const requests[][3] = {
        {"lobes", "space=camera", NULL},
        {"lobes", "subdivision=0", "space=object"},
        {"lobes", "storage=float16", "space=camera"},
        {"lobes", "probes=4", "view=level"},
        {"mipmap", "probes=4", "bias=1"},
        {"mipmap", "anisotropy=4", "probes=2"},
        {"lobes", "samples=auto", NULL},
        {"direct", "samples=2", "view=samples"},
    };
    fixture *f = *state;
    lobe_scene *scene = mixed_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        picture_request request = {.filter = requests[i][0],
                                   .settings = {requests[i][1], requests[i][2], NULL},
                                   .width = 40 + (uint32_t)i,
                                   .height = 30,
                                   .outputs = i % 2};
        draw_mixed(f, &request);
        draw_mixed(f, &request);
        // Retained maps are used, then rebuilt in place.
        scene_look_from(scene, (double[]){0.1 * (double)i, 1, 0.5}, 3);
        draw_mixed(f, &request);
    }
    lobe_render_parameters parameters = {.width = 50, .height = 20, .rebuild = true};
    lobe_frame frame;
    for (int i = 0; i < 3; i++) {
        parameters.discard = i == 1;
        assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
        lobe_frame_free(&frame);
    }
    picture_request last = {.filter = "rebuild"};
    assert_silence(f, "mixed", &last);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(knobs_are_valid),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
