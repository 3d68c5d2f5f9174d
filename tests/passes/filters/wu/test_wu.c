// The filter "wu" through the whole renderer: a flat map, energy, reciprocity, and against
// `displaced-reference`.

#include <math.h>
#include <string.h>

#include "tests/long_runs.h"

#include "tests/passes/filters/displaced/kept_reliefs.h"
#include "tests/passes/filters/displaced/relief_plane.h"
#include "tests/passes/filters/displaced/relief_waves.h"
#include "tests/passes/support/slope_plane.h"

static void check(double found, double expected, double bound, const char *what, double angle) {
    if (!(fabs(found - expected) <= bound))
        fail_msg("%s at %g degrees: %g instead of %g", what, angle, found, expected);
}

enum { WIDTH = 32, HEIGHT = 32 };

static double waves(uint32_t column, uint32_t row) {
    const double x = 2 * M_PI * column / WIDTH, y = 2 * M_PI * row / HEIGHT;
    return 4 * sin(x) * cos(2 * y) + 1.5 * sin(3 * x + y);
}

static double steep(uint32_t column, uint32_t row) {
    return 4 * waves(column, row);
}

static double level(uint32_t column, uint32_t row) {
    (void)column;
    (void)row;
    return 2;
}

/// Tables that are made in tenths of a second.
#define SMALL "points=1024", "angular=11", "patches=2"

static double mean_of(const lobe_frame *frame) {
    const uint32_t width = frame->radiance.width, height = frame->radiance.height;
    double sum = 0;
    for (uint32_t i = 0; i < width * height; i++)
        sum += (double)pixel_at(&frame->radiance, i % width, i / width)[1];
    return sum / (width * height);
}

static double draw_mean(fixture *f, lobe_scene *scene, const char *setting) {
    scene_end(scene);
    const picture_request request = {.filter = "wu",
                                     .settings = {SMALL, "env_size=16", setting},
                                     .width = 4,
                                     .height = 4,
                                     .samples = 1};
    lobe_frame frame = draw_scene(f, scene, &request);
    const double mean = mean_of(&frame);
    lobe_frame_free(&frame);
    return mean;
}

/// Many copies of the map in each pixel, so that a filter reads its mean.
static lobe_scene *far_plane(double albedo, lobe_image map, const double outgoing[3]) {
    const lobe_material material = relief_material(albedo);
    return relief_plane(&material, map, outgoing, 40);
}

static double under_sun(fixture *f, const char *setting, double albedo, lobe_image map,
                        const double outgoing[3], const double incoming[3]) {
    lobe_scene *scene = far_plane(albedo, map, outgoing);
    relief_plane_add_sun(scene, incoming, 1);
    const double found = draw_mean(f, scene, setting);
    lobe_scene_destroy(&scene);
    return found;
}

static double reference_under_sun(fixture *f, double albedo, lobe_image map,
                                  const double outgoing[3], const double incoming[3]) {
    lobe_scene *scene = far_plane(albedo, map, outgoing);
    relief_plane_add_sun(scene, incoming, 1);
    const double found = relief_plane_draw(f, scene, "displaced-reference", NULL, 4096);
    lobe_scene_destroy(&scene);
    return found;
}

/// As a diffuse plane, but for the width of the sharpest lobe.
static void a_level_map_is_lambertian(void **state) {
    static const double angles[] = {0, 40, 75};
    for (int i = 0; i < 9; i += 2) {
        double outgoing[3], incoming[3];
        slope_plane_direction(angles[i % 3], 0.3, outgoing);
        slope_plane_direction(angles[i / 3], 2.2, incoming);
        const double found =
            under_sun(*state, NULL, 0.7, relief_map(WIDTH, HEIGHT, level), outgoing, incoming);
        check(found, 0.7 * incoming[2] / M_PI, 3e-3 * incoming[2], "level map", angles[i % 3]);
    }
}

static void light_and_viewer_may_change_places(void **state) {
    for (int i = 0; i < 3; i++) {
        double a[3], b[3];
        slope_plane_direction(70 - 10 * i, 0.4 + i, a);
        slope_plane_direction(5 + 15 * i, 2.9 - i, b);
        const double there = under_sun(*state, NULL, 0.6, relief_map(WIDTH, HEIGHT, steep), a, b),
                     back = under_sun(*state, NULL, 0.6, relief_map(WIDTH, HEIGHT, steep), b, a);
        check(there * a[2], back * b[2], 1e-5 * back, "reciprocity", i);
    }
}

/// Within 0.0065, and with tables of 11 x 11 directions 0.057 less at 70 degrees.
static void white_reliefs_reflect_nearly_all_light(void **state) {
    only_in_long_runs();
    static const double angles[] = {0, 40, 70};
    for (int i = 0; i < 3; i++) {
        double outgoing[3];
        slope_plane_direction(angles[i], 0.7, outgoing);
        lobe_scene *scene = far_plane(1, relief_map(WIDTH, HEIGHT, waves), outgoing);
        relief_plane_add_sky(scene);
        check(draw_mean(*state, scene, "angular=15"), 1, 0.01, "furnace", angles[i]);
        lobe_scene_destroy(&scene);
    }
}

/// Pairs of lights and viewers.
enum { PAIRS = 3 };

static void choose_pair(int i, double outgoing[3], double incoming[3]) {
    static const double angles[PAIRS] = {10, 35, 60};
    slope_plane_direction(angles[i], 0.3 + 0.5 * i, outgoing);
    slope_plane_direction(angles[(i + 1) % PAIRS], 2.2 + 1.1 * i, incoming);
}

/// The mean error over lights and viewers, relative to the mean radiance.
static double error_of(const double found[PAIRS], const double expected[PAIRS]) {
    double error = 0, sum = 0;
    for (int i = 0; i < PAIRS; i++) {
        error += fabs(found[i] - expected[i]);
        sum += expected[i];
    }
    return error / sum;
}

/// Bounds are at least a fifth above what was measured: 0.0091, 0.0111, 0.0032 and 0.0531.
static void means_are_close_to_the_reference(void **state) {
    static const struct {
        relief_height height;
        const char *setting;
        double albedo, bound;
    } cases[] = {
        {waves, NULL, 0.9, 0.011},
        {waves, "ratio=printed", 0.9, 0.0135},
        {waves, NULL, 0.3, 0.011},
        {steep, NULL, 0.9, 0.066},
    };
    double expected[PAIRS], found[PAIRS];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const bool is_new = k == 0 || cases[k].height != cases[k - 1].height ||
                            cases[k].albedo != cases[k - 1].albedo;
        for (int i = 0; i < PAIRS; i++) {
            double outgoing[3], incoming[3];
            choose_pair(i, outgoing, incoming);
            if (is_new)
                expected[i] = reference_under_sun(*state, cases[k].albedo,
                                                  relief_map(WIDTH, HEIGHT, cases[k].height),
                                                  outgoing, incoming);
            found[i] = under_sun(*state, cases[k].setting, cases[k].albedo,
                                 relief_map(WIDTH, HEIGHT, cases[k].height), outgoing, incoming);
        }
        const double error = error_of(found, expected);
        if (!(error <= cases[k].bound))
            fail_msg("case %zu: %.4f", k, error);
    }
}

/// Of slope 1, as wide as two cells.
static double valleys(uint32_t column, uint32_t row) {
    (void)row;
    return fabs((double)(column % 16) - 8);
}

/// Seen and lit across the valleys, by angles from the normal on both sides of it: where each sees
/// a flank of its own, only light between facets is left, and a sun below the table's directions
/// reaches tops alone. Ratios are 0.97, 0.96 and 1.20; they were 0, 0 and 2.95.
static void valleys_are_close_to_the_reference(void **state) {
    static const double angles[][2] = {{50, 50}, {60, 80}, {30, 86}};
    for (int i = 0; i < 3; i++) {
        double outgoing[3], incoming[3];
        slope_plane_direction(angles[i][0], M_PI, outgoing);
        slope_plane_direction(angles[i][1], 0, incoming);
        const double found = under_sun(*state, NULL, 0.9, relief_map(WIDTH, HEIGHT, valleys),
                                       outgoing, incoming),
                     expected = reference_under_sun(*state, 0.9, relief_map(WIDTH, HEIGHT, valleys),
                                                    outgoing, incoming);
        check(found / expected, 1, 0.25, "valleys", angles[i][1]);
    }
}

static double metal_under_sun(fixture *f, const char *filter, const char *setting,
                              const double outgoing[3], const double incoming[3]) {
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.6, 1);
    lobe_scene *scene = relief_plane(&material, relief_map(WIDTH, HEIGHT, waves), outgoing, 40);
    relief_plane_add_sun(scene, incoming, 1);
    const double found = strcmp(filter, "wu") == 0
                             ? draw_mean(f, scene, setting)
                             : relief_plane_draw(f, scene, filter, setting, 8192);
    lobe_scene_destroy(&scene);
    return found;
}

static double error_of_metal(fixture *f, const char *setting) {
    double expected[PAIRS], found[PAIRS];
    for (int i = 0; i < PAIRS; i++) {
        double outgoing[3], incoming[3];
        choose_pair(i, outgoing, incoming);
        expected[i] = metal_under_sun(f, "displaced-reference", setting, outgoing, incoming);
        found[i] = metal_under_sun(f, "wu", setting, outgoing, incoming);
    }
    return error_of(found, expected);
}

/// White metal. Bounds are a fifth above what was measured: 0.051 of what it mirrors once, and
/// 0.162, as the rest is taken for diffuse light.
static void metal_is_close_to_the_reference(void **state) {
    only_in_long_runs();
    const double once = error_of_metal(*state, "bounces=1"), all = error_of_metal(*state, NULL);
    if (!(once <= 0.061 && all <= 0.195))
        fail_msg("once %.4f, all %.4f", once, all);
}

/// Waves are where the reference has them. Bounds are a fifth above what was measured: 0.045, 0.036
/// and 0.042, of a flat carrier 0.171, 0.162 and 0.055.
static void pictures_are_close_to_the_reference(void **state) {
    static const struct {
        uint32_t texels;
        double bound;
    } cases[] = {{8, 0.056}, {16, 0.046}, {64, 0.051}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        relief_waves_check(*state, "wu", (const char *const[]){SMALL, NULL}, cases[i].texels,
                           cases[i].bound);
}

/// Of odd sizes and of one texel; whatever the scale.
static void odd_maps_are_finite(void **state) {
    only_in_long_runs();
    static const uint32_t sizes[][2] = {{1, 1}, {1, 9}, {7, 5}, {3, 64}};
    double outgoing[3], incoming[3];
    slope_plane_direction(50, 0.3, outgoing);
    slope_plane_direction(30, 2.2, incoming);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const double found = under_sun(*state, NULL, 1, relief_map(sizes[i][0], sizes[i][1], steep),
                                       outgoing, incoming);
        assert_true(found > 0 && found < 1);
    }
}

static void every_run_makes_the_same(void **state) {
    fixture *f = *state;
    const char *cache = f->fits_cache;
    f->fits_cache = NULL;
    double outgoing[3], incoming[3];
    slope_plane_direction(50, 0.3, outgoing);
    slope_plane_direction(30, 2.2, incoming);
    double found[2];
    for (int i = 0; i < 2; i++)
        found[i] = under_sun(f, NULL, 0.9, relief_map(WIDTH, HEIGHT, steep), outgoing, incoming);
    f->fits_cache = cache;
    assert_true(found[0] == found[1]);
}

static void maps_that_no_buffer_holds_are_refused(void **state) {
    fixture *f = *state;
    const lobe_material material = relief_material(1);
    lobe_scene *scene = relief_plane(&material, map_image(LOBE_FORMAT_R8_UNORM, 8192, 4096),
                                     (double[]){0, 0, 1}, 4);
    scene_end(scene);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const lobe_settings settings = settings_of(filter_named("wu"), (const char *const[]){NULL});
    const lobe_render_parameters parameters = {
        .filter = filter_named("wu"), .settings = &settings, .width = 8, .height = 8};
    lobe_frame frame = {0};
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_ERROR_LIMIT,
                   "too large for filter 'wu'");
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_map_is_lambertian),
        cmocka_unit_test(light_and_viewer_may_change_places),
        cmocka_unit_test(white_reliefs_reflect_nearly_all_light),
        cmocka_unit_test(means_are_close_to_the_reference),
        cmocka_unit_test(valleys_are_close_to_the_reference),
        cmocka_unit_test(metal_is_close_to_the_reference),
        cmocka_unit_test(pictures_are_close_to_the_reference),
        cmocka_unit_test(odd_maps_are_finite),
        cmocka_unit_test(every_run_makes_the_same),
        cmocka_unit_test(maps_that_no_buffer_holds_are_refused),
    };
    return cmocka_run_group_tests(tests, kept_reliefs_create, kept_reliefs_destroy);
}
