// Filtered cubes that a renderer loads from a cache folder and saves to it: pictures are the same,
// bit for bit, and only cubes that the folder lacks are made.

#include "tests/passes/support/fixture.h"

#include <stdio.h>
#include <unistd.h>

#include <lobe/vulkan.h>

#include "passes/environment/cache/cube_file.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

#define SIZE 4

static void coloured(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)(1 + 0.9 * direction[i]);
}

/// A square of rough metal, lit by lobes of both kinds.
static lobe_scene *metal_square(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = 0.5f;
    material.metallic = 1;
    scene_add_square(scene, &material, 1, NULL);
    scene_surround(scene, 16, coloured);
    scene_look_from(scene, (double[]){0.5, 1, 0.3}, 0.5);
    scene_end(scene);
    return scene;
}

/// Reverses the environment.
static void turn(lobe_scene *scene) {
    float *texels = scene->environment->image.texels;
    size_t count = (size_t)4 * scene->environment->image.width * scene->environment->image.height;
    for (size_t i = 0; i < count / 2; i++) {
        float kept = texels[i];
        texels[i] = texels[count - 1 - i];
        texels[count - 1 - i] = kept;
    }
}

/// A renderer with its own log.
typedef struct drawing {
    log_recorder recorder;
    lobe_renderer *renderer;
    uint32_t parts;
    const char *base; ///< an assignment
    double stops_at;  ///< progress at which the host stops; 0: it does not listen
    double heard;     ///< the last progress
    unsigned calls;
} drawing;

static void start(fixture *f, const lobe_scene *scene, drawing *drawing) {
    *drawing = (struct drawing){.base = "base=exact"};
    log_recorder_start(&drawing->recorder);
    assert_int_equal(lobe_renderer_create(f->device, &drawing->recorder.host, &drawing->renderer),
                     LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(drawing->renderer, scene), LOBE_OK);
}

static bool listen(void *user, double part) {
    drawing *self = user;
    assert_true(part > self->heard && part <= 1);
    self->heard = part;
    self->calls++;
    return part < self->stops_at;
}

static void stop(drawing *drawing) {
    assert_int_equal(drawing->recorder.errors, 0);
    lobe_renderer_destroy(&drawing->renderer);
}

static size_t ran(const drawing *drawing, const char *pass) {
    return count_passes(lobe_renderer_graph(drawing->renderer), pass, LOBE_PASS_RUN);
}

static bool made(const drawing *drawing) {
    return ran(drawing, "environment_prefiltering") > 0;
}

static bool restored(const drawing *drawing) {
    return ran(drawing, "environment_restoring") > 0;
}

static lobe_frame frame_of(drawing *drawing, const char *folder,
                           const lobe_vulkan_submission *submission) {
    const lobe_filter *filter = filter_named("direct");
    lobe_settings settings =
        settings_of(filter, (const char *[]){"env_size=16", drawing->base, NULL});
    lobe_frame frame;
    if (lobe_renderer_render(
            drawing->renderer,
            &(lobe_render_parameters){
                .filter = filter,
                .settings = &settings,
                .width = SIZE,
                .height = SIZE,
                .environment = {.parts = drawing->parts, .cache = folder},
                .host = {.submission = submission,
                         .environment_progress = drawing->stops_at > 0 ? listen : NULL,
                         .user = drawing}},
            &frame) != LOBE_OK)
        fail_msg("%s", drawing->recorder.last_error);
    return frame;
}

static uint64_t picture(drawing *drawing, const char *folder) {
    lobe_frame frame = frame_of(drawing, folder, NULL);
    uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// Drawn by a new renderer without a cache.
static uint64_t plain_picture(fixture *f, const lobe_scene *scene) {
    drawing plain;
    start(f, scene, &plain);
    uint64_t hash = picture(&plain, NULL);
    assert_true(made(&plain));
    stop(&plain);
    return hash;
}

static size_t kept(void) {
    return temporary_folder_count(&test_folder);
}

/// Saved by the first renderer, loaded by the second; neither searches the folder a second time.
static void one_renderer_saves_and_another_loads(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    for (int again = 0; again < 2; again++) {
        drawing drawing;
        start(*state, scene, &drawing);
        assert_true(picture(&drawing, test_folder.path) == expected);
        assert_int_equal(made(&drawing), !again);
        assert_int_equal(restored(&drawing), again);
        assert_int_equal(kept(), 2);
        assert_true(picture(&drawing, test_folder.path) == expected);
        assert_int_equal(ran(&drawing, NULL), 1);
        // Loaded cubes stay after the folder is gone.
        assert_true(picture(&drawing, NULL) == expected);
        assert_int_equal(ran(&drawing, NULL), 1);
        assert_int_equal(drawing.recorder.notices + drawing.recorder.warnings, 0);
        stop(&drawing);
    }
    lobe_scene_destroy(&scene);
}

/// Either of the two files.
static const char *a_kept_file(const lobe_scene *scene) {
    char name[32];
    uint64_t key = passes_cube_file_key(scene->environment, 16, LOBE_ENVIRONMENT_GGX);
    snprintf(name, sizeof name, "%016llx.exr", (unsigned long long)key);
    return temporary_folder_file(&test_folder, name);
}

static void a_damaged_file_is_replaced(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    for (int round = 0; round < 3; round++) {
        drawing drawing;
        start(*state, scene, &drawing);
        assert_true(picture(&drawing, test_folder.path) == expected);
        // Damaged after the first round, whole again after the second.
        assert_int_equal(made(&drawing), round < 2);
        assert_int_equal(drawing.recorder.notices, round == 1);
        assert_int_equal(drawing.recorder.warnings, 0);
        assert_int_equal(kept(), 2);
        if (round == 0)
            assert_int_equal(truncate(a_kept_file(scene), 1000), 0);
        stop(&drawing);
    }
    lobe_scene_destroy(&scene);
}

/// Back and forth: each environment is filtered once, and loaded when it returns.
static void another_environment_is_looked_up(void **state) {
    lobe_scene *scene = metal_square();
    drawing drawing;
    uint64_t expected[2];
    for (int i = 0; i < 2; i++) {
        expected[i] = plain_picture(*state, scene);
        turn(scene);
    }
    assert_true(expected[0] != expected[1]);
    start(*state, scene, &drawing);
    for (int i = 0; i < 4; i++) {
        assert_true(picture(&drawing, test_folder.path) == expected[i % 2]);
        assert_int_equal(made(&drawing), i < 2);
        assert_int_equal(restored(&drawing), i >= 2);
        turn(scene);
        const lobe_scene_changes changes = {.environment = true};
        assert_int_equal(lobe_renderer_update_scene(drawing.renderer, &changes), LOBE_OK);
    }
    assert_int_equal(kept(), 4);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// Saved in the frame that completes them, not before; loaded all at once.
static void parts_are_saved_when_complete(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    for (int again = 0; again < 2; again++) {
        drawing drawing;
        start(*state, scene, &drawing);
        drawing.parts = 3;
        uint64_t hash;
        int frames = 0;
        do {
            assert_int_equal(kept(), again ? 2 : 0);
            hash = picture(&drawing, test_folder.path);
            frames++;
        } while (hash != expected && frames < 20);
        assert_true(again ? frames == 1 : frames > 2 && frames < 20);
        assert_int_equal(kept(), 2);
        stop(&drawing);
    }
    lobe_scene_destroy(&scene);
}

/// The picture is the same, is stopped where the host wants, and maps that are there are not
/// prepared.
static void preparing_reports_its_progress(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    drawing drawing;
    start(*state, scene, &drawing);
    drawing.stops_at = 0.5;
    lobe_frame frame = frame_of(&drawing, test_folder.path, NULL);
    assert_null(frame.radiance.texels);
    assert_int_equal(frame.submissions, 0);
    assert_true(drawing.heard >= 0.5 && drawing.heard < 1 && drawing.calls > 3);
    const unsigned before = drawing.calls;
    drawing =
        (struct drawing){drawing.recorder, drawing.renderer, .base = drawing.base, .stops_at = 2};
    frame = frame_of(&drawing, test_folder.path, NULL);
    assert_true(image_hash(&frame.radiance) == expected);
    assert_int_equal(frame.submissions, drawing.calls + 1);
    assert_true(drawing.heard == 1 && drawing.calls > before / 2);
    assert_int_equal(kept(), 2);
    lobe_frame_free(&frame);
    drawing.calls = 0;
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(drawing.calls, 0);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// One kind of lobes first, then both.
static void cubes_wanted_later_are_added(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    drawing drawing;
    start(*state, scene, &drawing);
    drawing.base = "base=lobe";
    uint64_t as_lobes = picture(&drawing, test_folder.path);
    assert_int_equal(kept(), 1);
    drawing.base = "base=exact";
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(kept(), 2);
    drawing.base = "base=lobe";
    assert_true(picture(&drawing, test_folder.path) == as_lobes);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// If nobody waits for a frame, the next one saves its cubes.
static void submitted_frames_are_saved_by_the_next(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    const lobe_vulkan_submission submission = {0};
    drawing drawing;
    start(*state, scene, &drawing);
    for (size_t files = 0; files <= 2; files += 2) {
        lobe_frame frame = frame_of(&drawing, test_folder.path, &submission);
        assert_int_equal(kept(), files);
        lobe_frame_free(&frame);
    }
    stop(&drawing);
    start(*state, scene, &drawing);
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_true(restored(&drawing));
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

static void an_unwritable_folder_is_warned_of_once(void **state) {
    lobe_scene *scene = metal_square();
    uint64_t expected = plain_picture(*state, scene);
    drawing drawing;
    start(*state, scene, &drawing);
    for (int i = 0; i < 2; i++) {
        assert_true(picture(&drawing, "/nonexistent/folder") == expected);
        assert_int_equal(drawing.recorder.warnings, 1);
    }
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// Methods without filtered cubes neither load nor save.
static void other_methods_do_not_touch_the_folder(void **state) {
    fixture *f = *state;
    lobe_scene *scene = metal_square();
    const lobe_filter *filter = filter_named("direct");
    lobe_settings settings = settings_of(filter, (const char *[]){"env=mip", "env_size=16", NULL});
    lobe_frame frame;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_int_equal(
        lobe_renderer_render(f->renderer,
                             &(lobe_render_parameters){.filter = filter,
                                                       .settings = &settings,
                                                       .width = SIZE,
                                                       .height = SIZE,
                                                       .environment.cache = test_folder.path},
                             &frame),
        LOBE_OK);
    assert_int_equal(kept(), 0);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(one_renderer_saves_and_another_loads),
        IN_TEST_FOLDER(a_damaged_file_is_replaced),
        IN_TEST_FOLDER(another_environment_is_looked_up),
        IN_TEST_FOLDER(parts_are_saved_when_complete),
        IN_TEST_FOLDER(preparing_reports_its_progress),
        IN_TEST_FOLDER(cubes_wanted_later_are_added),
        IN_TEST_FOLDER(submitted_frames_are_saved_by_the_next),
        cmocka_unit_test(an_unwritable_folder_is_warned_of_once),
        IN_TEST_FOLDER(other_methods_do_not_touch_the_folder),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
