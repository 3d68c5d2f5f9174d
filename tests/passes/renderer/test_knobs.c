// Every knob of every filter, at both ends of its range or with each of its choices, gives a finite
// picture that is not empty, and no message of the validation layer. Of choices that change no
// shader, such as sizes, the first and the last are drawn. Filters that share a knob draw its
// values in turn: of five filters, or of all if there are fewer, each draws others. Views are the
// same code in all filters: one draws them all here, and each those that show its own numbers
// below.

#include "tests/passes/support/fixture.h"

#include <stdio.h>
#include <string.h>

#include "passes/context/knob_values.h"
#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

/// A square of each material model, near and far at once.
static lobe_scene *both_models(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 40);
    material.base_colour[0] = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.5, 111));
    material.width_map = scene_add_map(scene, random_map(32, 32, 0.5, 2, 112));
    scene_add_square(scene, &material, 1, NULL);
    lobe_material_default(&material);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.5, 113));
    material.metallic_roughness_map = scene_add_map(scene, random_map(16, 16, 0.1, 1, 114));
    float beside[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.5f, 0.2f, 0, 1};
    scene_add_square(scene, &material, 1, beside);
    scene_look_along(scene);
    scene_end(scene);
    return scene;
}

static void draw_with(fixture *f, const char *filter, const char *assignment) {
    picture_request request = {.filter = filter,
                               .settings = {assignment, NULL},
                               .width = 24,
                               .height = 16,
                               .samples = 2,
                               .outputs = true};
    lobe_frame frame = draw_silently(f, "both models", &request);
    bool view = assignment[0] == 'v';
    if (!all_finite(&frame.radiance) || !all_finite(&frame.normal_depth) ||
        !all_finite(&frame.lobes_level))
        fail_msg("%s, %s: not finite", filter, assignment);
    if (!view && !(largest_value(&frame.radiance) > 0.01))
        fail_msg("%s, %s: black", filter, assignment);
    lobe_frame_free(&frame);
}

/// How many of the first `filter_count` filters have the knob.
static size_t users(size_t filter_count, const filter_knob *knob) {
    size_t count = 0;
    for (size_t i = 0; i < filter_count; i++)
        for (size_t j = 0; j < lobe_filter_knob_count(lobe_filter_get(i)); j++)
            count += passes_filter_knob(lobe_filter_get(i), j) == knob;
    return count;
}

/// The values of a knob in one filter: it draws one of `every`.
typedef struct knob_turns {
    size_t every, next;
} knob_turns;

static void draw_in_turn(fixture *f, const char *filter, const char *assignment,
                         knob_turns *turns) {
    if (turns->next++ % turns->every == 0)
        draw_with(f, filter, assignment);
}

/// The picture of the default is drawn once for all knobs.
static void draw_knob(fixture *f, size_t filter_index, const filter_knob *knob_feed) {
    const char *filter = lobe_filter_name(lobe_filter_get(filter_index));
    const lobe_knob *knob = &knob_feed->description;
    const bool ends = knob_feed->feeds.route == KNOB_HOST && !knob_feed->decides_slots;
    const size_t sharing = users(lobe_filter_count(), knob_feed);
    knob_turns turns = {.every = sharing < 5 || !long_runs() ? sharing : 5,
                        .next = users(filter_index, knob_feed)};
    char assignment[128];
    for (size_t i = 0; knob->choices && knob->choices[i]; i++) {
        if ((double)i == knob->initial || (ends && i > 0 && knob->choices[i + 1]))
            continue;
        snprintf(assignment, sizeof assignment, "%s=%s", knob->name, knob->choices[i]);
        draw_in_turn(f, filter, assignment, &turns);
    }
    for (int i = 0; !knob->choices && i < 2; i++) {
        double end = i ? knob->maximum : knob->minimum;
        if (end == knob->initial)
            continue;
        snprintf(assignment, sizeof assignment, "%s=%g", knob->name, end);
        draw_in_turn(f, filter, assignment, &turns);
    }
}

static void every_knob_draws_at_both_ends(void **state) {
    fixture *f = *state;
    lobe_scene *scene = both_models();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        draw_with(f, lobe_filter_name(filter), "base=exact");
        for (size_t j = 0; j < lobe_filter_knob_count(filter); j++)
            if (i == 0 || strcmp(lobe_filter_knob(filter, j)->name, "view") != 0)
                draw_knob(f, i, passes_filter_knob(filter, j));
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    assert_int_equal(f->errors, 0);
}

/// `fournier`: seven peaks of eight texels, and base lobes; `mixture`: four components of these.
static float most_lobes(const char *filter) {
    return strcmp(filter, "fournier") == 0 ? 60 : strcmp(filter, "mixture") == 0 ? 36 : 15;
}

/// Views show plausible numbers: whole lobes, levels that the maps have.
static void views_show_what_they_say(void **state) {
    fixture *f = *state;
    lobe_scene *scene = both_models();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < lobe_filter_count(); i += long_runs() ? 1 : 3) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        picture_request request = {.filter = filter,
                                   .settings = {"view=radiance", NULL},
                                   .width = 24,
                                   .height = 16,
                                   .samples = 1,
                                   .outputs = true};
        lobe_frame outputs = draw(f, &request);
        request.settings[0] = "view=lobes";
        lobe_frame lobes = draw(f, &request);
        request.settings[0] = "view=level";
        lobe_frame levels = draw(f, &request);
        for (uint32_t j = 0; j < 24 * 16; j++) {
            const float *both = pixel_at(&outputs.lobes_level, j % 24, j / 24);
            const float *lobe = pixel_at(&lobes.radiance, j % 24, j / 24);
            const float *level = pixel_at(&levels.radiance, j % 24, j / 24);
            if (lobe[3] == 0)
                continue;
            assert_true(lobe[0] == both[0] && lobe[1] == both[0] && lobe[2] == both[0]);
            assert_true(level[0] == both[1]);
            assert_true(lobe[0] >= 1 && lobe[0] <= most_lobes(filter) &&
                        lobe[0] == (float)(int)lobe[0]);
            assert_true(level[0] >= 0 && level[0] < 10);
        }
        lobe_frame_free(&outputs);
        lobe_frame_free(&lobes);
        lobe_frame_free(&levels);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_knob_draws_at_both_ends),
        cmocka_unit_test(views_show_what_they_say),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
