// A view that moves or zooms by less and less changes filtered pictures by less and less: nothing
// jumps where a pixel enters the next texel, at a level's edge, or where the number of probes
// changes.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, TEXELS = 256, COARSE = 8, FRAMES = 8 * COARSE + 1 };

static const char *const filters[] = {"toksvig", "lean",     "leadr",   "lobes",      "moments",
                                      "tan",     "fournier", "mixture", "multi_leadr"};

/// Patches of 13 x 17 texels with crooked borders, each with other normals than the ones around:
/// `mixture` evaluates many texels one by one, and blends others.
static lobe_image patches(void) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, TEXELS, TEXELS);
    float *texel = map.texels;
    for (uint32_t i = 0; i < TEXELS * TEXELS; i++, texel += 4) {
        const uint32_t x = i % TEXELS, y = i / TEXELS;
        const uint32_t column = (x + y / 7) / 13, row = (y + x / 9) / 17;
        const double angle = 2.4 * column + 1.1 * row * (row + 3);
        const double side = 0.1 * ((7 * x + 3 * y) % 5) - 0.2;
        const double slopes[2] = {0.5 * cos(angle) + side, 0.5 * sin(angle) - side};
        const double z = 1 / sqrt(slopes[0] * slopes[0] + slopes[1] * slopes[1] + 1);
        for (int k = 0; k < 3; k++)
            texel[k] = (float)(0.5 + 0.5 * z * (k < 2 ? -slopes[k] : 1));
    }
    return map;
}

static lobe_scene *rough_plate(lobe_image normals, const double towards[3], double concentration) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, (float)concentration);
    material.normal_map = scene_add_map(scene, normals);
    scene_add_square(scene, &material, 8, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.1}, 1);
    scene_look_from(scene, towards, 1);
    scene_end(scene);
    return scene;
}

typedef struct view_path {
    double pixels, levels; ///< that the view moves and zooms by over all frames
    double footprint;      ///< texels under a pixel of the first frame
    double most;           ///< change between two frames
} view_path;

static void place_view(lobe_scene *scene, const view_path *path, int frame) {
    const double part = (double)frame / (FRAMES - 1);
    const double texels = EXTENT * path->footprint * pow(2, part * path->levels);
    scene->camera.orthographic_height = (float)(2 * texels / TEXELS);
    for (int i = 0; i < 2; i++)
        scene->camera.shift[i] = (float)(part * path->pixels / EXTENT);
}

/// The largest change between frames that follow each other, and between every `COARSE`th, of the
/// brightest pixel.
typedef struct changes {
    double fine, coarse;
} changes;

static changes follow(fixture *f, lobe_scene *scene, const char *filter, const view_path *path) {
    const picture_request request = {.filter = filter, .width = EXTENT, .height = EXTENT};
    lobe_frame frames[FRAMES];
    changes result = {0};
    double peak = 0;
    for (int i = 0; i < FRAMES; i++) {
        place_view(scene, path, i);
        frames[i] = draw(f, &request);
        const lobe_image *own = &frames[i].radiance;
        peak = fmax(peak, largest_value(own));
        if (i >= 1)
            result.fine = fmax(result.fine, largest_difference(own, &frames[i - 1].radiance));
        if (i >= COARSE && i % COARSE == 0)
            result.coarse =
                fmax(result.coarse, largest_difference(own, &frames[i - COARSE].radiance));
    }
    for (int i = 0; i < FRAMES; i++)
        lobe_frame_free(&frames[i]);
    return (changes){result.fine / peak, result.coarse / peak};
}

/// Steps an eighth as large change the picture by far less, too.
static void does_not_jump(fixture *f, lobe_scene *scene, const char *filter,
                          const view_path *path) {
    const changes found = follow(f, scene, filter, path);
    if (!(found.fine <= path->most + fixture_sampler_error(f) && found.fine <= 0.3 * found.coarse))
        fail_msg("%s: the picture changes by %g of its peak, with steps of an eighth by %g", filter,
                 found.coarse, found.fine);
}

static void no_jumps(fixture *f, const double towards[3], double concentration,
                     const view_path *path) {
    lobe_scene *scene =
        rough_plate(random_normal_map(TEXELS, TEXELS, 0.5, 77), towards, concentration);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++)
        does_not_jump(f, scene, filters[i], path);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static const double above[] = {0, 1, 0}, aside[] = {0.9, 1, 0.5};

/// By more than a texel of the level.
static void a_view_that_moves(void **state) {
    const view_path path = {.pixels = 1.1, .footprint = 7.7, .most = 0.01};
    no_jumps(*state, above, 50, &path);
    no_jumps(*state, aside, 50, &path);
}

static void a_view_that_zooms_past_a_level(void **state) {
    const view_path path = {.levels = 0.5, .footprint = 6.6, .most = 0.02};
    const view_path next = {.levels = 0.5, .footprint = 9.33, .most = 0.02};
    no_jumps(*state, above, 500, &path);
    no_jumps(*state, above, 500, &next);
    no_jumps(*state, aside, 50, &path);
}

static void a_view_that_zooms_past_the_finest_level(void **state) {
    const view_path path = {.levels = 0.5, .footprint = 0.8, .most = 0.08};
    no_jumps(*state, above, 50, &path);
    no_jumps(*state, aside, 50, &path);
}

/// Nor at the edges of what is blended. Where everything is blended, steps are up to 0.038; where
/// nothing is, 0.025.
static void unlike_texels_do_not_jump(void **state) {
    fixture *f = *state;
    const view_path moves = {.pixels = 1.1, .footprint = 7.7, .most = 0.042};
    const view_path zooms = {.levels = 0.5, .footprint = 6.6, .most = 0.06};
    lobe_scene *scene = rough_plate(patches(), above, 50);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    does_not_jump(f, scene, "mixture", &moves);
    does_not_jump(f, scene, "mixture", &zooms);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_view_that_moves),
        cmocka_unit_test(a_view_that_zooms_past_a_level),
        cmocka_unit_test(a_view_that_zooms_past_the_finest_level),
        cmocka_unit_test(unlike_texels_do_not_jump),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
