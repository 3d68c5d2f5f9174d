// Maps of mixtures and reliefs that a renderer makes part by part, saves to a cache folder and
// loads from it: pictures are the same, bit for bit, and only what the folder lacks is made.

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lobe/file.h>
#include <lobe/fitting.h>
#include <lobe/vulkan.h>

#include "tests/long_runs.h"

#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/passes/support/fixture.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIZE = 8, EXTENT = 32, PARTS = 6 }; // the root, and levels of 16 to 1 texels

/// Metal with bumps, whose colour and roughness vary, so that all maps count.
static lobe_scene *bumpy_square(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.7, 1);
    material.base_colour[1] = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(EXTENT, EXTENT, 0.6, 5));
    material.metallic_roughness_map = scene_add_map(scene, random_map(EXTENT, EXTENT, 0.4, 1, 6));
    material.base_colour_map = scene_add_map(scene, random_map(EXTENT, EXTENT, 0.2, 1, 7));
    scene_add_square(scene, &material, 4, NULL);
    scene_add_sun(scene, (double[]){0.4, 1, 0.2}, 3);
    scene_look_from(scene, (double[]){0.5, 1, 0.3}, 1.5);
    scene_end(scene);
    return scene;
}

/// Reverses the texels of an image.
static void turn(lobe_scene *scene, size_t image) {
    lobe_image *texels = &scene->images[image].image;
    const size_t count = (size_t)texels->width * texels->height;
    float *first = texels->texels, kept[4];
    for (size_t i = 0; i < count / 2; i++) {
        float *a = first + 4 * i, *b = first + 4 * (count - 1 - i);
        memcpy(kept, a, sizeof kept);
        memcpy(a, b, sizeof kept);
        memcpy(b, kept, sizeof kept);
    }
}

/// A renderer with its own log.
typedef struct drawing {
    log_recorder recorder;
    lobe_renderer *renderer;
    const char *filter;
    const char *settings[5]; ///< assignments, ended by NULL
    uint32_t parts;
    double stops_at; ///< progress at which the host stops; 0: it does not listen
    double heard;    ///< the last progress
    unsigned calls;
    uint32_t parts_left; ///< after the last frame
} drawing;

static void start(fixture *f, const lobe_scene *scene, const char *filter, drawing *drawing) {
    *drawing = (struct drawing){.filter = filter};
    log_recorder_start(&drawing->recorder);
    assert_int_equal(lobe_renderer_create(f->device, &drawing->recorder.host, &drawing->renderer),
                     LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(drawing->renderer, scene), LOBE_OK);
}

static void stop(drawing *drawing) {
    assert_int_equal(drawing->recorder.errors, 0);
    lobe_renderer_destroy(&drawing->renderer);
}

static bool listen(void *user, double part) {
    drawing *self = user;
    assert_true(part > self->heard && part <= 1);
    self->heard = part;
    self->calls++;
    return part < self->stops_at;
}

static size_t ran(const drawing *drawing, const char *pass) {
    return count_passes(lobe_renderer_graph(drawing->renderer), pass, LOBE_PASS_RUN);
}

static bool fitted(const drawing *drawing) {
    return ran(drawing, "mixture_samples") + ran(drawing, "mixture_root") +
               ran(drawing, "mixture_fit") + ran(drawing, "mixture_level") >
           0;
}

static bool restored(const drawing *drawing) {
    return ran(drawing, "map_restoring") > 0;
}

static lobe_frame frame_of(drawing *drawing, const char *folder,
                           const lobe_vulkan_submission *submission) {
    const lobe_filter *filter = filter_named(drawing->filter);
    const lobe_settings settings = settings_of(filter, drawing->settings);
    lobe_frame frame;
    if (lobe_renderer_render(drawing->renderer,
                             &(lobe_render_parameters){
                                 .filter = filter,
                                 .settings = &settings,
                                 .width = SIZE,
                                 .height = SIZE,
                                 .fits = {.parts = drawing->parts, .cache = folder},
                                 .host = {.submission = submission,
                                          .fits_progress = drawing->stops_at > 0 ? listen : NULL,
                                          .user = drawing}},
                             &frame) != LOBE_OK)
        fail_msg("%s", drawing->recorder.last_error);
    drawing->parts_left = frame.fit_parts_left;
    return frame;
}

static uint64_t picture(drawing *drawing, const char *folder) {
    lobe_frame frame = frame_of(drawing, folder, NULL);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// Drawn by a new renderer without a cache.
static uint64_t plain_picture(fixture *f, const lobe_scene *scene, const char *filter) {
    drawing plain;
    start(f, scene, filter, &plain);
    const uint64_t hash = picture(&plain, NULL);
    assert_int_equal(plain.parts_left, 0);
    stop(&plain);
    return hash;
}

static size_t kept(void) {
    return temporary_folder_count(&test_folder);
}

static const char *const filters[] = {"mixture", "tan", "fournier", "multi_leadr"};
enum { FILTERS = sizeof filters / sizeof *filters };

/// Saved by the first renderer, loaded by the second; neither fits or copies a second time.
static void one_renderer_saves_and_another_loads(void **state) {
    lobe_scene *scene = bumpy_square();
    for (size_t i = 0; i < FILTERS; i++) {
        const uint64_t expected = plain_picture(*state, scene, filters[i]);
        for (int again = 0; again < 2; again++) {
            drawing drawing;
            start(*state, scene, filters[i], &drawing);
            assert_true(picture(&drawing, test_folder.path) == expected);
            assert_int_equal(fitted(&drawing), !again);
            assert_int_equal(restored(&drawing), again);
            assert_int_equal(kept(), i + 1);
            assert_true(picture(&drawing, test_folder.path) == expected);
            assert_int_equal(ran(&drawing, NULL), 1);
            // What was loaded stays after the folder is gone.
            assert_true(picture(&drawing, NULL) == expected);
            assert_int_equal(ran(&drawing, NULL), 1);
            assert_int_equal(drawing.recorder.notices, 0);
            stop(&drawing);
        }
    }
    lobe_scene_destroy(&scene);
}

static const char *kept_file(void) {
    return temporary_folder_find(&test_folder, ".mixture");
}

/// Shorter, longer, or with another byte: in the name, the version, the key, the layout, the sum,
/// the units, the texels.
static void damage(int kind) {
    static const size_t places[] = {0, 12, 16, 28, 40, 60, 2000};
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(kept_file(), NULL, NULL, &data, &size), LOBE_OK);
    if (kind == 0) {
        assert_int_equal(lobe_file_write(kept_file(), data, 1000, NULL), LOBE_OK);
    } else if (kind == 1) {
        assert_int_equal(lobe_file_write(kept_file(), data, 0, NULL), LOBE_OK);
    } else if (kind == 2) {
        assert_int_equal(lobe_file_write(kept_file(), data, size + 1, NULL), LOBE_OK);
    } else {
        data[places[kind - 3]] ^= 1;
        assert_int_equal(lobe_file_write(kept_file(), data, size, NULL), LOBE_OK);
    }
    lobe_release(data);
}

static void a_damaged_file_is_replaced(void **state) {
    enum { DAMAGES = 10 };
    lobe_scene *scene = bumpy_square();
    const uint64_t expected = plain_picture(*state, scene, "mixture");
    for (int round = 0; round < DAMAGES + 2; round++) {
        drawing drawing;
        start(*state, scene, "mixture", &drawing);
        assert_true(picture(&drawing, test_folder.path) == expected);
        // Damaged after all rounds but the last two.
        const bool is_damaged = round > 0 && round <= DAMAGES;
        assert_int_equal(fitted(&drawing), round <= DAMAGES);
        assert_int_equal(drawing.recorder.notices, is_damaged);
        assert_int_equal(drawing.recorder.warnings, 0);
        assert_int_equal(kept(), 1);
        if (round < DAMAGES)
            damage(round);
        stop(&drawing);
    }
    lobe_scene_destroy(&scene);
}

/// Settings that decide what is fitted have files of their own; others share one.
static void each_setting_has_its_file(void **state) {
    static const struct {
        const char *setting;
        bool own;
    } settings[] = {{"components=3", true}, {"steps=2", true},   {"shape=oval", true},
                    {"colour=mean", true},  {"bias=0.5", false}, {"storage=float32", true},
                    {"base=lobe", true},    {"probes=2", false}};
    lobe_scene *scene = bumpy_square();
    size_t files = 1;
    drawing drawing;
    start(*state, scene, "mixture", &drawing);
    (void)picture(&drawing, test_folder.path);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        drawing.settings[0] = settings[i].setting;
        const uint64_t first = picture(&drawing, test_folder.path);
        files += settings[i].own;
        assert_int_equal(kept(), files);
        struct drawing other;
        start(*state, scene, "mixture", &other);
        other.settings[0] = settings[i].setting;
        assert_true(picture(&other, test_folder.path) == first);
        assert_false(fitted(&other));
        stop(&other);
    }
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// Texels and materials that replace others are fitted, not loaded, and not saved; colours count
/// where components have their own.
static void replaced_texels_are_fitted(void **state) {
    for (uint32_t image = 0; image < 3; image++) {
        lobe_scene *scene = bumpy_square();
        uint64_t expected[2];
        for (int i = 0; i < 2; i++) {
            expected[i] = plain_picture(*state, scene, "mixture");
            turn(scene, image);
        }
        assert_true(expected[0] != expected[1]);
        drawing drawing;
        start(*state, scene, "mixture", &drawing);
        for (int i = 0; i < 3; i++) {
            assert_true(picture(&drawing, test_folder.path) == expected[i % 2]);
            assert_true(fitted(&drawing) == (i > 0 || image == 0));
            assert_int_equal(restored(&drawing), i == 0 && image > 0);
            turn(scene, image);
            const lobe_scene_changes changes = {.images = &image, .image_count = 1};
            assert_int_equal(lobe_renderer_update_scene(drawing.renderer, &changes), LOBE_OK);
        }
        assert_int_equal(kept(), 1);
        stop(&drawing);
        lobe_scene_destroy(&scene);
    }
}

/// Saved then, and loaded at once.
static void parts_are_drawn_when_complete(void **state) {
    lobe_scene *scene = bumpy_square();
    for (size_t i = 0; i < FILTERS; i++) {
        const uint64_t expected = plain_picture(*state, scene, filters[i]);
        for (int again = 0; again < 2; again++) {
            drawing drawing;
            start(*state, scene, filters[i], &drawing);
            drawing.parts = 2;
            for (uint32_t left = again ? 0 : PARTS - 2; left > 0; left -= 2) {
                assert_true(picture(&drawing, test_folder.path) != expected);
                assert_int_equal(drawing.parts_left, left);
                assert_true(fitted(&drawing));
                assert_int_equal(kept(), i);
            }
            assert_true(picture(&drawing, test_folder.path) == expected);
            assert_int_equal(drawing.parts_left, 0);
            assert_int_equal(kept(), i + 1);
            assert_true(picture(&drawing, test_folder.path) == expected);
            assert_int_equal(ran(&drawing, NULL), 1);
            stop(&drawing);
        }
    }
    lobe_scene_destroy(&scene);
}

/// In rows, so that no part takes long: here all levels of texels of 4 to 32 texels of the map, in
/// two parts each.
static void large_levels_are_made_in_parts(void **state) {
    only_in_long_runs();
    enum { LARGE = 1024, LARGE_PARTS = 1 + 5 + 4 * 2 + 1 };
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.7, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(LARGE, LARGE, 0.6, 5));
    scene_add_sun(scene, (double[]){0.4, 1, 0.2}, 3);
    scene_end_with_square(scene, &material);
    const char *const settings[] = {"components=1", "steps=8", NULL};
    uint64_t expected = 0;
    for (uint32_t parts = 0; parts < 2; parts++) {
        drawing drawing;
        start(*state, scene, "mixture", &drawing);
        memcpy(drawing.settings, settings, sizeof settings);
        drawing.parts = parts;
        uint64_t drawn = picture(&drawing, NULL);
        assert_int_equal(drawing.parts_left, parts == 0 ? 0 : LARGE_PARTS - 1);
        for (uint32_t left = drawing.parts_left; left > 0; left--) {
            drawn = picture(&drawing, NULL);
            assert_int_equal(drawing.parts_left, left - 1);
            assert_true(ran(&drawing, "mixture_level") <= 1);
            assert_true(fitted(&drawing));
        }
        assert_true(parts == 0 || drawn == expected);
        expected = drawn;
        stop(&drawing);
    }
    lobe_scene_destroy(&scene);
}

/// The material is drawn unfiltered until then, as by `direct`.
static void incomplete_maps_are_not_drawn(void **state) {
    const picture_request request = {.filter = "direct", .width = SIZE, .height = SIZE};
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.7, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(EXTENT, EXTENT, 0.6, 5));
    scene_add_sun(scene, (double[]){0.4, 1, 0.2}, 3);
    scene_end_with_square(scene, &material);
    lobe_frame expected = draw_scene(*state, scene, &request);
    drawing drawing;
    start(*state, scene, "mixture", &drawing);
    drawing.parts = 1;
    lobe_frame frame = frame_of(&drawing, NULL, NULL);
    assert_true(drawing.parts_left > 0);
    assert_true(relative_l2(&frame.radiance, &expected.radiance) < 1e-4);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// However many frames take them.
static void each_part_runs_once(void **state) {
    lobe_scene *scene = bumpy_square();
    drawing drawing;
    start(*state, scene, "mixture", &drawing);
    drawing.parts = 1;
    size_t samples = 0, roots = 0, levels = 0;
    for (uint32_t left = PARTS; left-- > 0;) {
        (void)picture(&drawing, NULL);
        assert_int_equal(drawing.parts_left, left);
        samples += ran(&drawing, "mixture_samples");
        roots += ran(&drawing, "mixture_root");
        levels += ran(&drawing, "mixture_level");
        assert_int_equal(samples, 1);
        assert_int_equal(roots, 1);
        assert_int_equal(levels, PARTS - 1 - left);
    }
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// The picture is the same, is stopped where the host wants, and goes on from there.
static void progress_is_reported(void **state) {
    lobe_scene *scene = bumpy_square();
    const uint64_t expected = plain_picture(*state, scene, "mixture");
    drawing drawing;
    start(*state, scene, "mixture", &drawing);
    drawing.stops_at = 0.5;
    lobe_frame frame = frame_of(&drawing, test_folder.path, NULL);
    assert_null(frame.radiance.texels);
    assert_true(drawing.heard >= 0.5 && drawing.heard < 1);
    assert_int_equal(drawing.calls, PARTS / 2);
    assert_int_equal(kept(), 0);
    drawing.stops_at = 2;
    drawing.heard = 0;
    drawing.calls = 0;
    frame = frame_of(&drawing, test_folder.path, NULL);
    assert_true(image_hash(&frame.radiance) == expected);
    assert_int_equal(drawing.calls, PARTS - PARTS / 2);
    assert_int_equal(frame.submissions, drawing.calls + 1);
    assert_true(drawing.heard == 1);
    assert_int_equal(kept(), 1);
    lobe_frame_free(&frame);
    drawing.calls = 0;
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(drawing.calls, 0);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// If nobody waits for a frame, the next one saves its map.
static void submitted_frames_are_saved_by_the_next(void **state) {
    lobe_scene *scene = bumpy_square();
    const uint64_t expected = plain_picture(*state, scene, "mixture");
    const lobe_vulkan_submission submission = {0};
    drawing drawing;
    start(*state, scene, "mixture", &drawing);
    for (size_t files = 0; files <= 1; files++) {
        lobe_frame frame = frame_of(&drawing, test_folder.path, &submission);
        assert_int_equal(kept(), files);
        lobe_frame_free(&frame);
    }
    stop(&drawing);
    start(*state, scene, "mixture", &drawing);
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_true(restored(&drawing));
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

static void an_unwritable_folder_is_warned_of_once(void **state) {
    lobe_scene *scene = bumpy_square();
    const uint64_t expected = plain_picture(*state, scene, "mixture");
    drawing drawing;
    start(*state, scene, "mixture", &drawing);
    for (int i = 0; i < 2; i++) {
        assert_true(picture(&drawing, "/nonexistent/folder") == expected);
        assert_int_equal(drawing.recorder.warnings, 1);
    }
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// Maps whose lobes do not vary, and filters that fit nothing, leave the folder alone.
static void nothing_is_saved_where_nothing_is_fitted(void **state) {
    lobe_scene *scene = bumpy_square();
    drawing drawing;
    start(*state, scene, "moments", &drawing);
    (void)picture(&drawing, test_folder.path);
    stop(&drawing);
    lobe_scene_destroy(&scene);
    scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.7, 1);
    scene_end_with_square(scene, &material);
    start(*state, scene, "mixture", &drawing);
    drawing.parts = 1;
    (void)picture(&drawing, test_folder.path);
    assert_int_equal(drawing.parts_left, 0);
    stop(&drawing);
    lobe_scene_destroy(&scene);
    assert_int_equal(kept(), 0);
}

// ---------------------------------------------------------------------------------------------
// Reliefs

enum { RELIEF_WIDTH = 128, RELIEF_HEIGHT = 64, RELIEF_PARTS = 4 }; // of these, two bands

/// Half metal, so that facets mirror, of colours that vary over the relief.
static lobe_scene *relief_square(float red) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.7, 1);
    material.metallic = 0.5f;
    material.base_colour[0] = red;
    material.height_map = scene_add_map(scene, random_map(RELIEF_WIDTH, RELIEF_HEIGHT, 0, 1, 8));
    material.height_scale = 2.0f / RELIEF_WIDTH;
    material.base_colour_map = scene_add_map(scene, random_map(EXTENT, EXTENT, 0.2, 1, 7));
    scene_add_square(scene, &material, 4, NULL);
    scene_add_sun(scene, (double[]){0.4, 1, 0.2}, 3);
    scene_look_from(scene, (double[]){0.5, 1, 0.3}, 1.5);
    scene_end(scene);
    return scene;
}

static void start_relief(fixture *f, const lobe_scene *scene, uint32_t parts, drawing *drawing) {
    start(f, scene, "displaced", drawing);
    drawing->settings[0] = "azimuths=64";
    drawing->parts = parts;
}

static void reliefs_are_kept_and_made_in_parts(void **state) {
    lobe_scene *scene = relief_square(0.8f);
    drawing drawing;
    start_relief(*state, scene, 0, &drawing);
    const uint64_t expected = picture(&drawing, NULL);
    assert_int_equal(ran(&drawing, "facet_transfer"), 2);
    stop(&drawing);
    start_relief(*state, scene, 1, &drawing);
    for (uint32_t left = RELIEF_PARTS; left-- > 0;) {
        assert_int_equal(kept(), 0);
        assert_true((picture(&drawing, test_folder.path) == expected) == (left == 0));
        assert_int_equal(drawing.parts_left, left);
        assert_int_equal(ran(&drawing, "facet_transfer"), left >= 2);
        assert_int_equal(ran(&drawing, "facet_links"), left == 1);
    }
    assert_int_equal(kept(), 1);
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(ran(&drawing, NULL), 1);
    stop(&drawing);
    start_relief(*state, scene, 1, &drawing);
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(ran(&drawing, "facet_transfer") + ran(&drawing, "cell_transfer"), 0);
    assert_true(restored(&drawing));
    assert_true(picture(&drawing, NULL) == expected);
    assert_int_equal(ran(&drawing, NULL), 1);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

enum { MODEL_PARTS = 5 }; // paths, and levels of 16 x 8, 8 x 4, 2 x 1 and 1 x 1 cells

static void start_models(fixture *f, const lobe_scene *scene, uint32_t parts, drawing *drawing) {
    start(f, scene, "wu", drawing);
    drawing->settings[0] = "angular=5";
    drawing->settings[1] = "points=64";
    drawing->settings[2] = "patches=2";
    drawing->parts = parts;
}

static size_t ran_for_models(const drawing *drawing) {
    return ran(drawing, "path_vertices") + ran(drawing, "low_lobes") +
           ran(drawing, "scaling_table") + ran(drawing, "mirror_scaling");
}

/// Each part runs once.
static void models_are_kept_and_made_in_parts(void **state) {
    lobe_scene *scene = relief_square(0.8f);
    drawing drawing;
    start_models(*state, scene, 0, &drawing);
    const uint64_t expected = picture(&drawing, NULL);
    assert_int_equal(ran_for_models(&drawing), 1 + 3 * (MODEL_PARTS - 1));
    stop(&drawing);
    start_models(*state, scene, 1, &drawing);
    for (uint32_t left = MODEL_PARTS; left-- > 0;) {
        assert_int_equal(kept(), 0);
        assert_true((picture(&drawing, test_folder.path) == expected) == (left == 0));
        assert_int_equal(drawing.parts_left, left);
        assert_int_equal(ran_for_models(&drawing), left == MODEL_PARTS - 1 ? 1 : 3);
    }
    assert_int_equal(kept(), 1);
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(ran(&drawing, NULL), 1);
    stop(&drawing);
    start_models(*state, scene, 1, &drawing);
    assert_true(picture(&drawing, test_folder.path) == expected);
    assert_int_equal(ran_for_models(&drawing), 0);
    assert_true(picture(&drawing, NULL) == expected);
    assert_int_equal(ran(&drawing, NULL), 1);
    stop(&drawing);
    lobe_scene_destroy(&scene);
}

/// Heights, their scale and settings have files of their own; colours share one.
static void what_models_are_made_from_has_its_file(void **state) {
    size_t files = 0;
    for (int change = 0; change < 5; change++) {
        lobe_scene *scene = relief_square(change == 4 ? 0.7f : 0.8f);
        if (change == 2)
            turn(scene, 0);
        if (change == 3)
            scene->materials[0].height_scale *= 0.5f;
        drawing drawing;
        start_models(*state, scene, 0, &drawing);
        if (change == 1)
            drawing.settings[3] = "ratio=printed";
        (void)picture(&drawing, test_folder.path);
        files += change < 4;
        assert_int_equal(kept(), files);
        assert_int_equal(ran_for_models(&drawing) > 0, change < 4);
        stop(&drawing);
        lobe_scene_destroy(&scene);
    }
}

/// Heights, their scale, colours, emission and settings have files of their own; what does not
/// matter shares one.
static void what_a_relief_is_made_from_has_its_file(void **state) {
    size_t files = 0;
    for (int change = 0; change < 7; change++) {
        lobe_scene *scene = relief_square(change == 1 ? 0.7f : 0.8f);
        lobe_material *material = &scene->materials[0];
        if (change == 2)
            turn(scene, 0);
        if (change == 3)
            turn(scene, 1);
        if (change == 4)
            material->height_scale *= 0.5f;
        if (change == 5)
            material->emissive[0] = 0.25f;
        if (change == 6)
            material->normal_scale = 0.5f;
        drawing drawing;
        start_relief(*state, scene, 0, &drawing);
        drawing.settings[0] = "azimuths=4";
        (void)picture(&drawing, test_folder.path);
        files += change < 6;
        assert_int_equal(kept(), files);
        assert_true(restored(&drawing) == (change == 6));
        stop(&drawing);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Without drawing

/// Part `part` of `parts`, by a new renderer.
static lobe_result fit(fixture *f, const lobe_scene *scene, drawing *drawing, uint32_t part,
                       uint32_t parts, lobe_fitting_summary *summary) {
    start_relief(f, scene, 0, drawing);
    const lobe_filter *filter = filter_named("displaced");
    const lobe_settings settings = settings_of(filter, drawing->settings);
    drawing->stops_at = 2;
    return lobe_renderer_fit(drawing->renderer,
                             &(lobe_fitting_parameters){.filter = filter,
                                                        .settings = &settings,
                                                        .cache = test_folder.path,
                                                        .part = part,
                                                        .part_count = parts,
                                                        .progress = listen,
                                                        .user = drawing},
                             summary);
}

static void fits(fixture *f, const lobe_scene *scene, uint32_t part, uint32_t parts, uint32_t made,
                 uint32_t found) {
    drawing drawing;
    lobe_fitting_summary summary;
    assert_int_equal(fit(f, scene, &drawing, part, parts, &summary), LOBE_OK);
    assert_int_equal(summary.made, made);
    assert_int_equal(summary.found, found);
    assert_int_equal(summary.unkept, 0);
    assert_true(drawing.heard == (made > 0));
    assert_int_equal(ran(&drawing, "shading"), 0);
    stop(&drawing);
}

/// What a new renderer draws with what the folder has.
static uint64_t restored_picture(fixture *f, const lobe_scene *scene) {
    drawing drawing;
    start_relief(f, scene, 0, &drawing);
    const uint64_t hash = picture(&drawing, test_folder.path);
    assert_true(restored(&drawing));
    assert_int_equal(drawing.recorder.notices, 0);
    stop(&drawing);
    return hash;
}

/// However many parts there are, some of them empty; files of parts are there until then.
static void shares_become_one_map(void **state) {
    enum { BLOCKS = RELIEF_WIDTH * RELIEF_HEIGHT / 64 };
    lobe_scene *scene = relief_square(0.8f);
    drawing drawing;
    start_relief(*state, scene, 0, &drawing);
    const uint64_t expected = picture(&drawing, NULL);
    stop(&drawing);
    fits(*state, scene, 2, 2, 1, 0);
    fits(*state, scene, 2, 2, 0, 1);
    assert_int_equal(kept(), 1);
    fixture_forget_messages(*state);
    assert_failure(*state, fit(*state, scene, &drawing, 0, 2, NULL), LOBE_ERROR_NOT_FOUND,
                   ".relief-1-of-2: part 1 of 2");
    stop(&drawing);
    fits(*state, scene, 1, 2, 1, 0);
    assert_int_equal(kept(), 2);
    fits(*state, scene, 0, 2, 1, 0);
    assert_int_equal(kept(), 1);
    fits(*state, scene, 0, 2, 0, 1);
    fits(*state, scene, 0, 0, 0, 1);
    assert_true(restored_picture(*state, scene) == expected);
    fits(*state, scene, BLOCKS + 1, BLOCKS + 1, 1, 0);
    fits(*state, scene, 1, BLOCKS + 1, 0, 0);
    assert_int_equal(kept(), 2);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(one_renderer_saves_and_another_loads),
        IN_TEST_FOLDER(a_damaged_file_is_replaced),
        IN_TEST_FOLDER(each_setting_has_its_file),
        IN_TEST_FOLDER(replaced_texels_are_fitted),
        IN_TEST_FOLDER(parts_are_drawn_when_complete),
        IN_TEST_FOLDER(large_levels_are_made_in_parts),
        cmocka_unit_test(incomplete_maps_are_not_drawn),
        cmocka_unit_test(each_part_runs_once),
        IN_TEST_FOLDER(progress_is_reported),
        IN_TEST_FOLDER(submitted_frames_are_saved_by_the_next),
        cmocka_unit_test(an_unwritable_folder_is_warned_of_once),
        IN_TEST_FOLDER(nothing_is_saved_where_nothing_is_fitted),
        IN_TEST_FOLDER(reliefs_are_kept_and_made_in_parts),
        IN_TEST_FOLDER(what_a_relief_is_made_from_has_its_file),
        IN_TEST_FOLDER(shares_become_one_map),
        IN_TEST_FOLDER(models_are_kept_and_made_in_parts),
        IN_TEST_FOLDER(what_models_are_made_from_has_its_file),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
