// Misuse of the renderer: exact error codes, one line that says why, nothing delivered, and a
// renderer that still works.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static lobe_scene *small_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.4, 131));
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// Asserts that the renderer still draws a scene.
static void check_it_works(fixture *f) {
    lobe_scene *scene = small_scene();
    picture_request request = {.filter = "lobes", .settings = {NULL}, .width = 4, .height = 4};
    fixture_forget_messages(f);
    lobe_frame frame = draw_scene(f, scene, &request);
    assert_true(largest_value(&frame.radiance) > 0);
    assert_int_equal(f->errors, 0);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

static void check_render_failure(fixture *f, const lobe_render_parameters *parameters,
                                 lobe_result expected, const char *words) {
    static const lobe_frame nothing;
    lobe_frame frame;
    memset(&frame, 0x55, sizeof frame);
    fixture_forget_messages(f);
    lobe_result result = lobe_renderer_render(f->renderer, parameters, &frame);
    assert_failure(f, result, expected, words);
    assert_memory_equal(&frame, &nothing, sizeof frame);
}

static void there_is_no_scene(void **state) {
    fixture *f = *state;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    check_render_failure(f, &(lobe_render_parameters){0}, LOBE_ERROR_INVALID_ARGUMENT, "no scene");
    // Nor after the scene was removed.
    lobe_scene *scene = small_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    check_render_failure(f, &(lobe_render_parameters){0}, LOBE_ERROR_INVALID_ARGUMENT, "no scene");
    lobe_scene_destroy(&scene);
    check_it_works(f);
}

static void pictures_have_limits(void **state) {
    fixture *f = *state;
    lobe_scene *scene = small_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_render_parameters parameters = {.width = 65536, .height = 65536};
    check_render_failure(f, &parameters, LOBE_ERROR_LIMIT, "65536x65536");
    parameters.width = 4;
    check_render_failure(f, &parameters, LOBE_ERROR_LIMIT, "4x65536");
    parameters = (lobe_render_parameters){.width = UINT32_MAX, .height = 1};
    check_render_failure(f, &parameters, LOBE_ERROR_LIMIT, "4294967295x1");
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    check_it_works(f);
}

static void settings_out_of_range_are_refused(void **state) {
    static const double values[] = {-1, 1e9, 0.5, NAN, INFINITY};
    fixture *f = *state;
    lobe_scene *scene = small_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const lobe_filter *filter = filter_named("lobes");
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        const lobe_knob *knob = lobe_filter_knob(filter, i);
        for (size_t j = 0; j < sizeof values / sizeof *values; j++) {
            bool inside = values[j] >= knob->minimum && values[j] <= knob->maximum;
            if (inside && (knob->kind == LOBE_KNOB_NUMBER || values[j] == floor(values[j])))
                continue;
            lobe_settings settings;
            lobe_settings_default(filter, &settings);
            settings.values[i] = values[j];
            lobe_render_parameters parameters = {
                .filter = filter, .settings = &settings, .width = 4, .height = 4};
            check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, knob->name);
        }
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    check_it_works(f);
}

// ---------------------------------------------------------------------------------------------
// Malformed scenes of a host

typedef struct broken_scene {
    const char *words; ///< of the error line
    void (*damage)(lobe_scene *scene);
} broken_scene;

static void use_missing_mesh(lobe_scene *scene) {
    scene->instances[0].mesh = 1;
}

static void use_missing_material(lobe_scene *scene) {
    scene->instances[0].material = UINT32_MAX;
}

static void use_missing_image(lobe_scene *scene) {
    scene->materials[0].normal_map.image = 1;
}

static void use_missing_vertex(lobe_scene *scene) {
    scene->meshes[0].indices[4] = 4;
}

static void use_missing_coordinates(lobe_scene *scene) {
    scene->materials[0].normal_map.texture_coordinates = 2;
}

static void leave_no_triangles(lobe_scene *scene) {
    scene->meshes[0].index_count = 0;
}

static void leave_no_instances(lobe_scene *scene) {
    scene->instance_count = 0;
}

static void use_too_many_lobes(lobe_scene *scene) {
    scene->materials[0].lobe_count = LOBE_MATERIAL_MAXIMUM_LOBES + 1;
}

static void use_no_lobes(lobe_scene *scene) {
    scene->materials[0].lobe_count = 0;
}

static void make_vertex_infinite(lobe_scene *scene) {
    scene->meshes[0].vertices[2].position[1] = INFINITY;
}

static void make_normal_nan(lobe_scene *scene) {
    scene->meshes[0].vertices[3].normal[0] = NAN;
}

static void make_texel_nan(lobe_scene *scene) {
    ((float *)scene->images[0].image.texels)[4 * (16 * 3 + 5) + 1] = NAN;
}

static void make_texel_infinite(lobe_scene *scene) {
    ((float *)scene->images[0].image.texels)[4 * (16 * 7 + 2)] = -INFINITY;
}

static void broken_scenes_are_refused(void **state) {
    static const broken_scene cases[] = {
        {"mesh 1 of 1", use_missing_mesh},
        {"material 4294967295 of 1", use_missing_material},
        {"image 1 of 1", use_missing_image},
        {"vertex 4 of 4", use_missing_vertex},
        {"texture coordinates", use_missing_coordinates},
        {"no triangles", leave_no_triangles},
        {"nothing to draw", leave_no_instances},
        {"5 lobes", use_too_many_lobes},
        {"0 lobes", use_no_lobes},
        {"vertex 2", make_vertex_infinite},
        {"vertex 3", make_normal_nan},
        {"texel 5, 3", make_texel_nan},
        {"texel 2, 7", make_texel_infinite},
    };
    fixture *f = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_scene *scene = small_scene();
        cases[i].damage(scene);
        fixture_forget_messages(f);
        lobe_result result = lobe_renderer_set_scene(f->renderer, scene);
        assert_failure(f, result, LOBE_ERROR_MALFORMED, cases[i].words);
        // The previous scene is removed nevertheless.
        check_render_failure(f, &(lobe_render_parameters){0}, LOBE_ERROR_INVALID_ARGUMENT,
                             "no scene");
        lobe_scene_destroy(&scene);
    }
    check_it_works(f);
}

/// An image larger than the device allows.
static void images_have_limits(void **state) {
    fixture *f = *state;
    uint32_t limit = lobe_device_describe(f->device)->maximum_image_extent;
    if (limit >= LOBE_IMAGE_MAXIMUM_EXTENT)
        return;
    lobe_scene *scene = small_scene();
    scene->materials[0].base_colour_map =
        scene_add_map(scene, map_image(LOBE_FORMAT_R8_UNORM, limit + 1, 1));
    fixture_forget_messages(f);
    lobe_result result = lobe_renderer_set_scene(f->renderer, scene);
    char words[32];
    snprintf(words, sizeof words, "%u", limit + 1);
    assert_failure(f, result, LOBE_ERROR_LIMIT, words);
    lobe_scene_destroy(&scene);
    check_it_works(f);
}

// ---------------------------------------------------------------------------------------------
// Memory

/// A renderer on a device with little memory draws what fits, fails with one line for what does
/// not, and then draws what fits again.
static void memory_may_run_out(void **state) {
    fixture *shared = *state;
    fixture f = {.host = {.write = shared->host.write, .user = &f}};
    lobe_scene *scene = small_scene();
    f.device = fixture_device(&f, (lobe_device_parameters){.memory_limit = 24u << 20});
    assert_int_equal(lobe_renderer_create(f.device, &f.host, &f.renderer), LOBE_OK);
    check_it_works(&f);
    assert_int_equal(lobe_renderer_set_scene(f.renderer, scene), LOBE_OK);
    lobe_render_parameters parameters = {.width = 4096, .height = 4096};
    check_render_failure(&f, &parameters, LOBE_ERROR_OUT_OF_DEVICE_MEMORY, "memory");
    lobe_frame frame;
    parameters.width = parameters.height = 4;
    assert_int_equal(lobe_renderer_render(f.renderer, &parameters, &frame), LOBE_OK);
    lobe_frame_free(&frame);
    // Maps that do not fit.
    scene->materials[0].base_colour_map =
        scene_add_map(scene, map_image(LOBE_FORMAT_RGBA32_FLOAT, 4096, 1024));
    fixture_forget_messages(&f);
    lobe_result result = lobe_renderer_set_scene(f.renderer, scene);
    assert_failure(&f, result, LOBE_ERROR_OUT_OF_DEVICE_MEMORY, "memory");
    check_it_works(&f);
    lobe_renderer_destroy(&f.renderer);
    lobe_device_destroy(&f.device);
    lobe_scene_destroy(&scene);
}

static void nothing_is_destroyed_twice(void **state) {
    fixture *f = *state;
    lobe_renderer *renderer = NULL;
    lobe_renderer_destroy(NULL);
    lobe_renderer_destroy(&renderer);
    assert_int_equal(lobe_renderer_create(f->device, NULL, &renderer), LOBE_OK);
    lobe_scene *scene = small_scene();
    // The device must survive, and a scene can still be set at the end.
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    lobe_renderer_destroy(&renderer);
    assert_null(renderer);
    lobe_scene_destroy(&scene);
    lobe_frame frame = {0};
    lobe_frame_free(&frame);
    check_it_works(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_is_no_scene),
        cmocka_unit_test(pictures_have_limits),
        cmocka_unit_test(settings_out_of_range_are_refused),
        cmocka_unit_test(broken_scenes_are_refused),
        cmocka_unit_test(images_have_limits),
        cmocka_unit_test(memory_may_run_out),
        cmocka_unit_test(nothing_is_destroyed_twice),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
