// Misuse of the renderer: exact error codes, one line that says why, nothing delivered, and a
// renderer that still works.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/resource/resource.h"
#include "scenes/scene/scene.h"
#include "tests/passes/support/misuse.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

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
    parameters = (lobe_render_parameters){.width = 640};
    check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, "640x0");
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

static const uint32_t first = 0;
static const lobe_scene_changes first_image = {.images = &first, .image_count = 1};

/// A map of 9 MiB, too large to have two of them.
static lobe_scene *large_map_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(768, 768, 0.4, 90));
    scene_end_with_square(scene, &material);
    return scene;
}

static void change_map(lobe_scene *scene, uint32_t width, uint32_t height, uint64_t seed) {
    lobe_image_free(&scene->images[0].image);
    scene->images[0].image = random_normal_map(width, height, 0.4, seed);
}

static uint64_t picture(const fixture *f, lobe_renderer *renderer) {
    lobe_frame frame;
    const lobe_render_parameters parameters = {
        .filter = filter_named("direct"), .width = 8, .height = 8};
    if (lobe_renderer_render(renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// Of a renderer that has all memory it needs, and never saw another scene.
static uint64_t fresh_picture(const fixture *f, const lobe_scene *scene) {
    lobe_renderer *renderer;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    const uint64_t hash = picture(f, renderer);
    lobe_renderer_destroy(&renderer);
    return hash;
}

/// A renderer on a device with little memory, after a picture.
static void open_scarce(fixture *f, fixture *shared, const lobe_scene *scene) {
    *f = (fixture){.host = {.write = shared->host.write, .user = f}};
    f->device =
        fixture_device(f, (lobe_device_parameters){.memory_limit = 16u << 20, .validation = true});
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &f->renderer), LOBE_OK);
    if (lobe_renderer_set_scene(f->renderer, scene) != LOBE_OK)
        fail_msg("%s", f->error);
    assert_true(picture(f, f->renderer) == fresh_picture(shared, scene));
}

static void close_scarce(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_device_validation_count(f->device), 0);
    lobe_renderer_destroy(&f->renderer);
    lobe_device_destroy(&f->device);
    lobe_scene_destroy(scene);
}

static void updates_need_little_memory(void **state) {
    fixture f, *shared = *state;
    lobe_scene *scene = large_map_scene();
    open_scarce(&f, shared, scene);
    for (uint64_t n = 0; n < 3; n++) {
        change_map(scene, 768, 768, 100 + n);
        if (lobe_renderer_update_scene(f.renderer, &first_image) != LOBE_OK)
            fail_msg("%s", f.error);
        assert_true(picture(&f, f.renderer) == fresh_picture(shared, scene));
    }
    close_scarce(&f, &scene);
}

/// Takes what memory is left, in pieces as small as content passes through.
static size_t occupy(lobe_device *device, engine_staging staging[], size_t most) {
    size_t count = 0;
    for (VkDeviceSize size = 1 << 20; size >= 1 << 10 && count < most;)
        if (engine_staging_create(device, NULL, size, ENGINE_MEMORY_UPLOAD, &staging[count]) ==
            LOBE_OK)
            count++;
        else
            size /= 2;
    return count;
}

/// The scene remains where only texels could not be written.
static void a_failed_update_leaves_the_scene(void **state) {
    fixture f, *shared = *state;
    engine_staging occupied[64];
    lobe_scene *scene = large_map_scene();
    open_scarce(&f, shared, scene);
    const uint64_t before = picture(&f, f.renderer);
    size_t count = occupy(f.device, occupied, 64);
    change_map(scene, 768, 768, 100);
    fixture_forget_messages(&f);
    assert_failure(&f, lobe_renderer_update_scene(f.renderer, &first_image),
                   LOBE_ERROR_OUT_OF_DEVICE_MEMORY, "no device memory is left");
    assert_true(picture(&f, f.renderer) == before);
    while (count > 0)
        engine_staging_destroy(f.device, &occupied[--count]);
    assert_int_equal(lobe_renderer_update_scene(f.renderer, &first_image), LOBE_OK);
    assert_true(picture(&f, f.renderer) == fresh_picture(shared, scene));
    // There is no memory for a map of another extent, and its former texture is gone.
    change_map(scene, 1024, 1536, 101);
    fixture_forget_messages(&f);
    assert_failure(&f, lobe_renderer_update_scene(f.renderer, &first_image),
                   LOBE_ERROR_OUT_OF_DEVICE_MEMORY, "memory");
    check_render_failure(&f, &(lobe_render_parameters){0}, LOBE_ERROR_INVALID_ARGUMENT, "no scene");
    close_scarce(&f, &scene);
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
        cmocka_unit_test(images_have_limits),
        cmocka_unit_test(memory_may_run_out),
        cmocka_unit_test(updates_need_little_memory),
        cmocka_unit_test(a_failed_update_leaves_the_scene),
        cmocka_unit_test(nothing_is_destroyed_twice),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
