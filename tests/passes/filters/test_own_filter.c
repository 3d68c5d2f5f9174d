// A filter that exists only in this test, without any change to the library. It draws through the
// ordinary renderer, which prepares its slots when necessary and frees them.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/shader/shaders.h"
#include "passes/context/filter.h"
#include "passes/upload/material_maps.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

extern const engine_shader_code own_filter_shaders[];
extern const size_t own_filter_shaders_count;

enum { EXTENT = 8, MATERIALS = 3 };

// ---------------------------------------------------------------------------------------------
// The filter

/// Specialisation constants of own/filters/own.glsl.
enum { SPECIALISE_SHINES = 100, SPECIALISE_REVERSED = 200 };

/// Its filter_knob_block.
struct own_knobs {
    float padding, gain;
};

/// Calls of the hooks since the last forget_calls().
static struct {
    unsigned prepared[MATERIALS], forgotten, builds;
    lobe_result failing;          ///< what `prepare` returns instead of preparing
    unsigned bindings, constants; ///< how many more than necessary `build` adds
} calls;

static void forget_calls(void) {
    memset(&calls, 0, sizeof calls);
}

/// The mean colour of the material's map.
static lobe_result prepare(const filter_context *context, uint32_t material, void **slot) {
    if (*slot)
        return LOBE_OK;
    if (calls.failing != LOBE_OK)
        return calls.failing;
    const lobe_texture_use *use = &context->scene->scene->materials[material].base_colour_map;
    const lobe_image *image = &context->scene->scene->images[use->image].image;
    float *mean = lobe_allocate(lobe_host_allocator(context->host), 4, sizeof *mean), texel[4];
    if (!mean)
        return LOBE_ERROR_OUT_OF_MEMORY;
    const uint32_t count = image->width * image->height;
    for (uint32_t i = 0; i < count; i++) {
        assert_true(passes_image_texel(image, i % image->width, i / image->width, texel));
        for (int k = 0; k < 4; k++)
            mean[k] += texel[k] / (float)count;
    }
    calls.prepared[material]++;
    *slot = mean;
    return LOBE_OK;
}

static void forget(void *slot) {
    assert_non_null(slot);
    calls.forgotten++;
    lobe_release(slot);
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    (void)instance;
    calls.builds++;
    for (unsigned i = 0; i < calls.bindings; i++)
        passes_appearance_bind(appearance, "one too many", (lobe_resource){0}, (lobe_sampler){0});
    for (unsigned i = 0; i < calls.constants; i++)
        passes_appearance_specialise(appearance, SPECIALISE_SHINES + 1 + i, 0);
    passes_appearance_bind(appearance, "own_block",
                           lobe_graph_upload(context->graph, "mean", prepared, 4 * sizeof(float)),
                           (lobe_sampler){0});
    passes_appearance_specialise(appearance, SPECIALISE_SHINES, 1);
}

static const char *const orders[] = {"rgb", "bgr", NULL};

// Everything that the knobs need in C: one entry each.
static const filter_knob gain_knob = {
    .description = {.name = "gain", .summary = "factor of the picture", .maximum = 4, .initial = 1},
    .feeds = KNOB_FEEDS_FILTER(own_knobs, gain),
};
static const filter_knob order_knob = {
    .description = {.name = "order",
                    .summary = "of the colour's channels",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = orders},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_REVERSED),
    .decides_slots = true,
};
static const filter_knob *const knobs[] = {&gain_knob, &order_knob, NULL};

static const lobe_filter own_filter = {
    .name = "own",
    .summary = "the mean colour of a material",
    .paper = "",
    .shading = "own",
    .knobs = knobs,
    .prepare = prepare,
    .forget = forget,
    .build = build,
};

// ---------------------------------------------------------------------------------------------
// Pictures

/// Two squares with different materials, and a third material that no instance uses. Every material
/// has a normal map that varies, and a base colour map.
static lobe_scene *own_scene(void) {
    lobe_scene *scene = scene_begin();
    for (int i = 0; i < MATERIALS; i++) {
        float half[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, i ? 0.5f : -0.5f, 0, 0, 1};
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
        material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.5, 20 + (uint64_t)i));
        material.base_colour_map = scene_add_map(scene, random_map(5, 3, 0, 1, 30 + (uint64_t)i));
        scene_add_square(scene, &material, 1, half);
    }
    scene->instance_count--;
    scene_add_sun(scene, (double[]){0, 1, 0}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

static lobe_result draw_with(fixture *f, const lobe_filter *filter, const char *assignment,
                             lobe_frame *frame) {
    const lobe_settings settings = settings_of(filter, (const char *[]){assignment, NULL});
    const lobe_render_parameters parameters = {
        .filter = filter, .settings = &settings, .width = EXTENT, .height = EXTENT};
    return lobe_renderer_render(f->renderer, &parameters, frame);
}

static void draw_frame(fixture *f, const lobe_filter *filter) {
    lobe_frame frame;
    if (draw_with(f, filter, NULL, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    lobe_frame_free(&frame);
}

static lobe_scene *start(fixture *f) {
    lobe_scene *scene = own_scene();
    fixture_forget_messages(f);
    forget_calls();
    for (size_t i = 0; i < own_filter_shaders_count; i++) {
        const engine_shader_code *code = &own_filter_shaders[i];
        const lobe_shader shader = {code->name, code->words, code->size};
        assert_int_equal(lobe_device_add_shader(f->device, &shader), LOBE_OK);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    return scene;
}

static void stop(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(scene);
}

static void assert_calls(unsigned first, unsigned second, unsigned forgotten) {
    assert_int_equal(calls.prepared[0], first);
    assert_int_equal(calls.prepared[1], second);
    assert_int_equal(calls.prepared[2], 0); // nothing is drawn with it
    assert_int_equal(calls.forgotten, forgotten);
}

/// Asserts that a pixel of the left or right square is `scale` times its map's mean, whose channels
/// may be reversed.
static void check_pixel(const lobe_frame *frame, const lobe_scene *scene, int square, double scale,
                        bool reversed) {
    const lobe_image *map = &scene->images[scene->materials[square].base_colour_map.image].image;
    const float *found = pixel_at(&frame->radiance, square ? 3 * EXTENT / 4 : EXTENT / 4, 4);
    for (int channel = 0; channel < 3; channel++) {
        double mean = 0;
        for (uint32_t i = 0; i < map->width * map->height; i++)
            mean += ((const float *)
                         map->texels)[(size_t)4 * i + (size_t)(reversed ? 2 - channel : channel)];
        mean /= map->width * map->height;
        if (fabs(found[channel] - scale * mean) > 1e-5)
            fail_msg("square %d, channel %d: %g instead of %g", square, channel,
                     (double)found[channel], scale * mean);
    }
}

static void it_draws_with_its_own_knobs_maps_and_shader(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    const char *const assignments[] = {NULL, "gain=3", "order=bgr"};
    for (int i = 0; i < 3; i++) {
        lobe_frame frame;
        if (draw_with(f, &own_filter, assignments[i], &frame) != LOBE_OK)
            fail_msg("%s", f->error);
        for (int square = 0; square < 2; square++)
            check_pixel(&frame, scene, square, i == 1 ? 6 : 2, i == 2);
        lobe_frame_free(&frame);
    }
    assert_int_equal(calls.builds, 6);
    stop(f, &scene);
    assert_int_equal(f->errors + f->warnings, 0);
}

// ---------------------------------------------------------------------------------------------
// Slots

static void each_material_drawn_is_prepared_once(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    assert_calls(0, 0, 0);
    for (int i = 0; i < 3; i++)
        draw_frame(f, &own_filter);
    assert_calls(1, 1, 0);
    // Another filter in between does not drop what this one keeps.
    draw_frame(f, filter_named("direct"));
    draw_frame(f, filter_named("moments"));
    draw_frame(f, &own_filter);
    assert_calls(1, 1, 0);
    stop(f, &scene);
    assert_calls(1, 1, 2);
}

static void update(fixture *f, const lobe_scene_changes *changes) {
    if (lobe_renderer_update_scene(f->renderer, changes) != LOBE_OK)
        fail_msg("%s", f->error);
}

static void what_changes_is_forgotten_and_nothing_else(void **state) {
    static const uint32_t first = 0, second = 1, map_of_second = 3, map_of_third = 5;
    fixture *f = *state;
    lobe_scene *scene = start(f);
    draw_frame(f, &own_filter);
    update(f, &(lobe_scene_changes){.instances = &second, .instance_count = 1});
    update(f, &(lobe_scene_changes){.meshes = &first, .mesh_count = 1});
    update(f, &(lobe_scene_changes){.images = &map_of_third, .image_count = 1});
    scene->materials[0].base_colour[0] = 0.5f;
    update(f, &(lobe_scene_changes){.materials = &first, .material_count = 1});
    assert_calls(1, 1, 0);
    scene->materials[0].roughness = 0.75f;
    update(f, &(lobe_scene_changes){.materials = &first, .material_count = 1});
    assert_calls(1, 1, 1);
    draw_frame(f, &own_filter);
    assert_calls(2, 1, 1);
    memset(scene->images[map_of_second].image.texels, 0, (size_t)5 * 3 * 16);
    update(f, &(lobe_scene_changes){.images = &map_of_second, .image_count = 1});
    assert_calls(2, 1, 2);
    lobe_frame frame;
    assert_int_equal(draw_with(f, &own_filter, NULL, &frame), LOBE_OK);
    check_pixel(&frame, scene, 0, 2, false);
    check_pixel(&frame, scene, 1, 2, false);
    lobe_frame_free(&frame);
    assert_calls(2, 2, 2);
    stop(f, &scene);
    assert_calls(2, 2, 4);
}

/// Two views that draw one scene with different knobs prepare each material once each.
static void knobs_that_decide_slots_have_their_own(void **state) {
    static const char *const assignments[] = {"order=rgb", "order=bgr", "gain=2"};
    static const uint32_t first = 0;
    fixture *f = *state;
    lobe_scene *scene = start(f);
    for (int i = 0; i < 9; i++) {
        lobe_frame frame;
        assert_int_equal(draw_with(f, &own_filter, assignments[i % 3], &frame), LOBE_OK);
        lobe_frame_free(&frame);
    }
    assert_calls(2, 2, 0);
    scene->materials[0].roughness = 0.75f;
    update(f, &(lobe_scene_changes){.materials = &first, .material_count = 1});
    assert_calls(2, 2, 2);
    draw_frame(f, &own_filter);
    assert_calls(3, 2, 2);
    stop(f, &scene);
    assert_calls(3, 2, 5);
}

static void a_renderer_that_goes_frees_its_slots(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    fixture other = *f;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &other.renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(other.renderer, scene), LOBE_OK);
    draw_frame(&other, &own_filter);
    draw_frame(f, &own_filter);
    assert_calls(2, 2, 0);
    lobe_renderer_destroy(&other.renderer);
    assert_calls(2, 2, 2);
    stop(f, &scene);
    assert_calls(2, 2, 4);
}

// ---------------------------------------------------------------------------------------------
// Failures

static void a_failure_to_prepare_is_the_frames(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    lobe_frame frame;
    calls.failing = LOBE_ERROR_OUT_OF_MEMORY;
    lobe_result result = draw_with(f, &own_filter, NULL, &frame);
    assert_failure(f, result, LOBE_ERROR_OUT_OF_MEMORY, "filter 'own', material");
    assert_int_equal(calls.builds, 0);
    calls.failing = LOBE_OK;
    draw_frame(f, &own_filter);
    assert_calls(1, 1, 0);
    stop(f, &scene);
}

/// Fixed lists that a filter overflows fail the frame; as much as fits is fine.
static void too_much_is_an_error(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    lobe_frame frame;
    calls.bindings = FILTER_MAXIMUM_BINDINGS;
    assert_failure(f, draw_with(f, &own_filter, NULL, &frame), LOBE_ERROR_LIMIT, "'own_block'");
    calls.bindings = 0;
    calls.constants = FILTER_MAXIMUM_SPECIALISATIONS;
    fixture_forget_messages(f);
    assert_failure(f, draw_with(f, &own_filter, NULL, &frame), LOBE_ERROR_LIMIT, "constant 100");
    calls.constants = FILTER_MAXIMUM_SPECIALISATIONS - 1;
    draw_frame(f, &own_filter);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// The library's filters that prepare something

/// `lobes` and `moments`, with hooks that count.
static const lobe_filter *counted;

static lobe_result prepare_counted(const filter_context *context, uint32_t material, void **slot) {
    const void *before = *slot;
    lobe_result result = counted->prepare(context, material, slot);
    calls.prepared[material] += *slot != before;
    return result;
}

static void forget_counted(void *slot) {
    calls.forgotten++;
    counted->forget(slot);
}

static void no_filter_prepares_for_another(void **state) {
    static const char *const names[] = {"lobes", "moments"};
    fixture *f = *state;
    assert_null(filter_named("direct")->prepare);
    for (int i = 0; i < 2; i++) {
        lobe_scene *scene = start(f);
        counted = filter_named(names[i]);
        lobe_filter filter = *counted;
        filter.prepare = prepare_counted;
        filter.forget = forget_counted;
        draw_frame(f, filter_named("direct"));
        assert_calls(0, 0, 0);
        for (int k = 0; k < 3; k++) {
            draw_frame(f, &filter);
            draw_frame(f, filter_named("direct"));
        }
        assert_calls(1, 1, 0);
        stop(f, &scene);
        assert_calls(1, 1, 2);
    }
}

/// A subdivision set by the user needs no choice.
static void lobes_choose_only_what_nobody_set(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    counted = filter_named("lobes");
    lobe_filter filter = *counted;
    filter.prepare = prepare_counted;
    filter.forget = forget_counted;
    const char *const assignments[] = {"subdivision=1", "space=object", "bias=0"};
    for (int i = 0; i < 3; i++) {
        lobe_frame frame;
        if (draw_with(f, &filter, assignments[i], &frame) != LOBE_OK)
            fail_msg("%s", f->error);
        lobe_frame_free(&frame);
        assert_calls(i == 2, i == 2, 0);
    }
    stop(f, &scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_draws_with_its_own_knobs_maps_and_shader),
        cmocka_unit_test(each_material_drawn_is_prepared_once),
        cmocka_unit_test(what_changes_is_forgotten_and_nothing_else),
        cmocka_unit_test(knobs_that_decide_slots_have_their_own),
        cmocka_unit_test(a_renderer_that_goes_frees_its_slots),
        cmocka_unit_test(a_failure_to_prepare_is_the_frames),
        cmocka_unit_test(too_much_is_an_error),
        cmocka_unit_test(no_filter_prepares_for_another),
        cmocka_unit_test(lobes_choose_only_what_nobody_set),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
