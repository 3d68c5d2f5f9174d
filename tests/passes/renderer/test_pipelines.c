// Pipelines depend on which features a scene has, not on its values or a user's numbers: when these
// change from frame to frame, nothing is compiled, and what the device keeps does not grow.

#include "tests/passes/support/fixture.h"

#include <stdio.h>
#include <string.h>

#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/maps/filtered_maps.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/long_runs.h"
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
        // Unless they are set, counts of lobes are those that suit the values.
        if (strcmp(request.filter, "moments") == 0) {
            request.settings[0] = "bins=2";
            request.settings[1] = "colour=bins";
        } else if (strcmp(request.filter, "lobes") == 0) {
            request.settings[0] = "subdivision=2";
        }
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
    // A mask that keeps all is no feature: this one keeps nothing.
    scene->materials[0].alpha_mask = true;
    scene->materials[0].base_colour[3] = 0;
    faults.pipelines = 0;
    frame = draw_scene(f, scene, &request);
    assert_int_equal(faults.pipelines, 1);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Knobs

/// A textured sphere, and a plane seen both near and far: whatever the bias, some pixel sees level
/// 0 of the maps.
static lobe_scene *curved_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.5, 11));
    material.metallic_roughness_map = scene_add_map(scene, random_map(64, 64, 0.1, 0.9, 12));
    scene_add_square(scene, &material, 1, NULL);
    lobe_mesh mesh;
    uint32_t sphere;
    assert_int_equal(scenes_shape_sphere(12, 24, 2, 1, NULL, &mesh), LOBE_OK);
    assert_int_equal(scenes_add_mesh(scene, &mesh, NULL, &sphere), LOBE_OK);
    const float scaled[16] = {0.4f, 0, 0, 0, 0, 0.4f, 0, 0, 0, 0, 0.4f, 0, 0.5f, 0.2f, 0.2f, 1};
    assert_int_equal(scenes_add_instance(scene, sphere, 0, scaled, NULL), LOBE_OK);
    scene_add_sun(scene, (double[]){0.2, 1, 0.3}, 2);
    scene_add_sun(scene, (double[]){0, 1, -3}, 2);
    scene_end(scene);
    scene->camera = (lobe_camera){.eye = {0.5f, 0.2f, 0.9f},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.9f,
                                  .near_plane = 0.01f};
    return scene;
}

/// Choices that would otherwise depend on the material's values; NULL: none.
static const char *fixed_choice(const char *filter) {
    return strcmp(filter, "moments") == 0 ? "bins=6"
           : strcmp(filter, "lobes") == 0 ? "subdivision=2"
                                          : NULL;
}

static const char *fixed_colour(const char *filter) {
    return strcmp(filter, "moments") == 0 ? "colour=mean" : NULL;
}

/// Draws with the knob at this value, and returns the picture's hash.
static uint64_t draw_at(fixture *f, const char *filter, const lobe_knob *knob, double value) {
    char assignment[64];
    snprintf(assignment, sizeof assignment, "%s=%.9g", knob->name, value);
    picture_request request = {.filter = filter,
                               .settings = {assignment, fixed_choice(filter), fixed_colour(filter)},
                               .width = 12,
                               .height = 8,
                               .samples = 1};
    lobe_frame frame = draw(f, &request);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// Draws with many values of a number over its range; returns how many pictures differ from
/// the previous one.
static int drag(fixture *f, const char *filter, const lobe_knob *knob) {
    int different = 0;
    uint64_t last = 0;
    const int values = long_runs() ? 100 : 20;
    for (int i = 0; i < values; i++) {
        const uint64_t hash = draw_at(
            f, filter, knob, knob->minimum + (knob->maximum - knob->minimum) * i / (values - 1));
        different += i > 0 && hash != last;
        last = hash;
    }
    return different;
}

static void check_number(fixture *f, const lobe_filter *filter, const filter_knob *knob) {
    const char *name = lobe_filter_name(filter);
    draw_at(f, name, &knob->description, knob->description.initial);
    // Where a number leaves code out (one that compiles does at 0, `bias` where it keeps level 0
    // from being seen), there is one pipeline without it and one with it.
    if (knob->compiles || knob == &passes_knob_bias) {
        draw_at(f, name, &knob->description, knob->compiles ? 0 : knob->description.minimum);
        draw_at(f, name, &knob->description, knob->description.maximum);
    }
    faults.pipelines = 0;
    const int different = drag(f, name, &knob->description);
    if (faults.pipelines)
        fail_msg("%s: %d pipelines for many values of %s", name, faults.pipelines,
                 knob->description.name);
    // Knobs read only by C concern environment light, which this scene does not have.
    if (knob->feeds.route != KNOB_HOST && different < 5)
        fail_msg("%s: many values of %s make %d different pictures", name, knob->description.name,
                 different + 1);
}

static void numbers_make_no_pipelines(void **state) {
    fixture *f = *state;
    lobe_scene *scene = curved_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        const filter_knob *knob;
        for (size_t j = 0; (knob = passes_filter_knob(filter, j)); j++)
            if (knob->description.kind == LOBE_KNOB_NUMBER)
                check_number(f, filter, knob);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_make_no_pipelines),
        cmocka_unit_test(features_make_pipelines),
        cmocka_unit_test(numbers_make_no_pipelines),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
