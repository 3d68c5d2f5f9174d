// How a knob's value reaches the shader: through the one entry that names its constant or uniform.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include <lobe/vulkan.h>

#include "engine/graph/state.h"
#include "engine/shader/shader.h"
#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/filtered_maps.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

// ---------------------------------------------------------------------------------------------
// What GLSL says: SPIR-V specification 1.6, sections 2.3 (layout of a module) and 3.42
// (instructions)

enum {
    OP_SPEC_CONSTANT_TRUE = 48,
    OP_SPEC_CONSTANT_FALSE = 49,
    OP_SPEC_CONSTANT = 50,
    OP_DECORATE = 71,
    DECORATION_SPEC_ID = 1,
    HEADER_WORDS = 5,
};

/// The result of the instruction that a constant of a shader is; 0: the shader does not have it.
static uint32_t find_constant(const engine_shader_code *code, uint32_t id) {
    for (size_t i = HEADER_WORDS; i < code->size / 4; i += code->words[i] >> 16) {
        const uint32_t *word = &code->words[i];
        if ((word[0] & 0xffff) == OP_DECORATE && word[2] == DECORATION_SPEC_ID && word[3] == id)
            return word[1];
    }
    return 0;
}

/// The default of a constant in GLSL; false where the shader does not have it.
static bool glsl_default(const engine_shader_code *code, uint32_t id, uint32_t *value) {
    const uint32_t result = find_constant(code, id);
    for (size_t i = HEADER_WORDS; result && i < code->size / 4; i += code->words[i] >> 16) {
        const uint32_t *word = &code->words[i];
        const uint32_t operation = word[0] & 0xffff;
        if (operation < OP_SPEC_CONSTANT_TRUE || operation > OP_SPEC_CONSTANT || word[2] != result)
            continue;
        *value = operation == OP_SPEC_CONSTANT ? word[3] : operation == OP_SPEC_CONSTANT_TRUE;
        return true;
    }
    return false;
}

/// Defaults in GLSL are those of the knobs, so that neither misleads a reader.
static void defaults_are_the_same_in_glsl(void **state) {
    (void)state;
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const filter_knob *knob;
        for (size_t j = 0; (knob = passes_filter_knob(lobe_filter_get(i), j)); j++) {
            size_t shaders = 0;
            for (size_t k = 0; k < engine_embedded_shaders_count; k++) {
                const engine_shader_code *code = &engine_embedded_shaders[k];
                uint32_t value;
                if (knob->feeds.route != KNOB_CONSTANT ||
                    !glsl_default(code, knob->feeds.place, &value))
                    continue;
                shaders++;
                if (value != knob->description.initial)
                    fail_msg("%s: default of %s is %u, and %g for users", code->name,
                             knob->description.name, value, knob->description.initial);
            }
            if (knob->feeds.route == KNOB_CONSTANT && shaders == 0)
                fail_msg("no shader has the constant that %s feeds", knob->description.name);
        }
    }
}

/// Constants are whole numbers, uniforms are not.
static void choices_are_constants_and_numbers_are_uniforms(void **state) {
    (void)state;
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const filter_knob *knob;
        for (size_t j = 0; (knob = passes_filter_knob(lobe_filter_get(i), j)); j++) {
            const bool number = knob->description.kind == LOBE_KNOB_NUMBER;
            const knob_route route = knob->feeds.route;
            if (route != KNOB_HOST)
                assert_int_equal(route == KNOB_CONSTANT, !number);
            if (route == KNOB_SHARED_NUMBER || route == KNOB_FILTER_NUMBER)
                assert_true(knob->feeds.place % 4 == 0 && knob->feeds.place < KNOB_BLOCK_SIZE);
            // Else a slider would fill the renderer with slots.
            if (knob->decides_slots) {
                assert_int_not_equal(knob->description.kind, LOBE_KNOB_NUMBER);
                assert_true(knob->description.maximum - knob->description.minimum < 16);
            }
        }
    }
}

/// Otherwise a misspelt feature would count as present, and a required one is never missing.
static void knobs_need_features_that_devices_may_lack(void **state) {
    (void)state;
    size_t count, needed = 0;
    const lobe_device_feature *features = lobe_vulkan_feature_list(&count);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const filter_knob *knob;
        for (size_t j = 0; (knob = passes_filter_knob(lobe_filter_get(i), j)); j++)
            for (size_t k = 0; knob->needs && k <= count; k++) {
                assert_true(k < count);
                if (strcmp(features[k].name, knob->needs) != 0)
                    continue;
                assert_false(features[k].required);
                needed++;
                break;
            }
    }
    assert_true(needed > 0);
}

// ---------------------------------------------------------------------------------------------
// What a draw receives

/// The value of a constant in the first draw of the last frame's shading pass.
static uint32_t drawn_with(fixture *f, uint32_t id) {
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    uint32_t value = 0;
    size_t count = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++) {
        if (strcmp(graph->frame.passes[i]->name, "shading") != 0)
            continue;
        const lobe_draw *drawn = &graph->frame.passes[i]->first_command->draw;
        for (size_t j = 0; j < drawn->specialisation_count; j++) {
            if (drawn->specialisation[j].id == id) {
                value = drawn->specialisation[j].bits;
                count++;
            }
        }
    }
    if (count != 1)
        fail_msg("constant %u is set %zu times", id, count);
    return value;
}

static lobe_scene *mapped_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.4, 21));
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 4);
    scene_end(scene);
    return scene;
}

/// Draws with `filter`, with all settings at their defaults except one.
static void draw_with(fixture *f, const lobe_filter *filter, size_t knob, double value) {
    lobe_settings settings;
    lobe_settings_default(filter, &settings);
    settings.values[knob] = value;
    const lobe_render_parameters parameters = {
        .filter = filter, .settings = &settings, .width = 4, .height = 4, .reference.samples = 1};
    lobe_frame frame;
    if (lobe_renderer_render(f->renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s, %s=%g: %s", lobe_filter_name(filter), lobe_filter_knob(filter, knob)->name,
                 value, f->error);
    lobe_frame_free(&frame);
}

static void every_choice_reaches_its_constant(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        const filter_knob *knob;
        for (size_t j = 0; (knob = passes_filter_knob(filter, j)); j++) {
            if (knob->feeds.route != KNOB_CONSTANT)
                continue;
            draw_with(f, filter, j, knob->description.maximum);
            assert_int_equal(drawn_with(f, knob->feeds.place), knob->description.maximum);
            draw_with(f, filter, j, knob->description.minimum);
            assert_int_equal(drawn_with(f, knob->feeds.place), knob->description.minimum);
        }
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// What C reads

/// A filter without a knob uses the knob's default.
static void c_reads_a_knob_by_its_entry(void **state) {
    (void)state;
    const lobe_filter *lobes = filter_named("lobes"), *direct = filter_named("direct");
    const lobe_settings settings =
        settings_of(lobes, (const char *[]){"probes=7", "bias=1.5", "base=lobe", NULL});
    const filter_context context = {.filter = lobes, .settings = &settings};
    assert_int_equal(passes_knob_choice(&context, &passes_knob_probes), 7);
    assert_true(passes_knob_value(&context, &passes_knob_bias) == 1.5);
    assert_int_equal(passes_knob_choice(&context, &passes_knob_base), 1);
    assert_int_equal(passes_knob_choice(&context, &passes_knob_environment), 2);
    const filter_context other = {.filter = direct, .settings = &settings};
    assert_int_equal(passes_knob_choice(&other, &passes_knob_probes), 1);
    assert_true(passes_knob_value(&other, &passes_knob_bias) == -0.5);
    // The reference has its own entry for this one, which is read under the same name.
    const lobe_filter *reference = filter_named("reference");
    const lobe_settings exact = settings_of(reference, (const char *[]){NULL});
    const filter_context truth = {.filter = reference, .settings = &exact};
    assert_int_equal(passes_knob_choice(&truth, &passes_knob_environment), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_the_same_in_glsl),
        cmocka_unit_test(choices_are_constants_and_numbers_are_uniforms),
        cmocka_unit_test(knobs_need_features_that_devices_may_lack),
        cmocka_unit_test(every_choice_reaches_its_constant),
        cmocka_unit_test(c_reads_a_knob_by_its_entry),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
