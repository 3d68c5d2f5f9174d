// The filter "displaced-reference" through the whole renderer: reliefs whose reflection has a
// closed form, and marching in small steps on the host.

#include <math.h>

#include "tests/long_runs.h"

#include "tests/passes/filters/displaced/relief_plane.h"
#include "tests/passes/support/slope_plane.h"

static double valley(uint32_t column, uint32_t row) {
    (void)row;
    return fabs((double)(column % 16) - 8);
}

static void check(double found, double expected, double bound, const char *what, double angle) {
    if (!(fabs(found - expected) <= bound))
        fail_msg("%s at %g degrees: %g instead of %g", what, angle, found, expected);
}

static double draw_material_under_sky(fixture *f, const lobe_material *material, lobe_image map,
                                      const double outgoing[3], const char *setting,
                                      uint32_t samples) {
    lobe_scene *scene = relief_plane(material, map, outgoing, 40);
    relief_plane_add_sky(scene);
    double found = relief_plane_draw(f, scene, "displaced-reference", setting, samples);
    lobe_scene_destroy(&scene);
    return found;
}

static double draw_under_sky(fixture *f, double albedo, lobe_image map, const double outgoing[3],
                             const char *setting, uint32_t samples) {
    const lobe_material material = relief_material(albedo);
    return draw_material_under_sky(f, &material, map, outgoing, setting, samples);
}

static double draw_under_sun(fixture *f, lobe_image map, const double outgoing[3],
                             const double incoming[3], const char *setting, uint32_t samples) {
    const lobe_material material = relief_material(1);
    lobe_scene *scene = relief_plane(&material, map, outgoing, 40);
    relief_plane_add_sun(scene, incoming, 1);
    double found = relief_plane_draw(f, scene, "displaced-reference", setting, samples);
    lobe_scene_destroy(&scene);
    return found;
}

// ---------------------------------------------------------------------------------------------
// Closed forms

/// The part of diffuse light that a white valley of slope 1 reflects, up to each number of bounces:
/// 1 - pi sqrt(2) / 16, then 0.18864, 0.05861 and 0.01963 more.
static void orders_of_a_valley(void **state) {
    enum { ROWS = 8, COLUMNS = 3, SAMPLES = 8192 };
    static const char *const settings[] = {"bounces=1", "bounces=2", "bounces=3", "bounces=4"};
    static const double expected[] = {0.72232, 0.91096, 0.96957, 0.98920};
    static const double bounds[] = {0.002, 0.004, 0.004, 0.004};
    for (int order = 0; order < 4; order++) {
        double sum = 0;
        for (int i = 0; i < ROWS * COLUMNS; i++) {
            const double sine = sqrt((i / COLUMNS + 0.5) / ROWS);
            double outgoing[3];
            slope_plane_direction(asin(sine) * 180 / M_PI, M_PI / 2 * (i % COLUMNS + 0.5) / COLUMNS,
                                  outgoing);
            sum += draw_under_sky(*state, 1, relief_map(16, 4, valley), outgoing, settings[order],
                                  SAMPLES);
        }
        check(sum / (ROWS * COLUMNS), expected[order], bounds[order], settings[order], 0);
    }
}

/// Seen from the light, across the valley, all that is visible is lit. Each wall of tilt b shows
/// the part min(1, 2 cos b cos t / cos(t - b)).
static void valley_seen_from_the_light(void **state) {
    static const double angles[] = {0, 25, 50, 70, 80};
    for (int i = 0; i < 5; i++) {
        const double t = angles[i] * M_PI / 180, b = M_PI / 4;
        double expected = 0, direction[3];
        for (int side = -1; side <= 1; side += 2) {
            const double cosine = cos(t + side * b);
            if (cosine > 1e-9)
                expected += fmin(1, 2 * cos(b) * cos(t) / cosine) * cosine * cosine;
        }
        expected /= 2 * cos(b) * cos(t) * M_PI;
        slope_plane_direction(angles[i], 0, direction);
        const double found = draw_under_sun(*state, relief_map(16, 4, valley), direction, direction,
                                            "bounces=1", 16384);
        check(found, expected, 0.01 * expected, "valley", angles[i]);
    }
}

enum { PIT_SIDE = 96 };
static const double pit_radius = 40; // of the opening, texels
static const double pit_part = 0.2;  // of the sphere

/// A cap of a sphere whose area is `pit_part` of the sphere's.
static double pit(uint32_t column, uint32_t row) {
    const double x = column - PIT_SIDE / 2.0, y = row - PIT_SIDE / 2.0;
    // Cap of height 2 R F, whose opening has the radius 2 R sqrt(F (1 - F)).
    const double radius = pit_radius / (2 * sqrt(pit_part * (1 - pit_part)));
    const double square = x * x + y * y;
    if (square >= pit_radius * pit_radius)
        return 0;
    return radius * (1 - 2 * pit_part) - sqrt(radius * radius - square);
}

/// Light within a sphere is the same everywhere: a pit reflects rho (1 - F) / (1 - rho F) of the
/// sky to every side, and the plane beside it rho.
static void pits_reflect_the_sky_evenly(void **state) {
    static const double angles[] = {0, 40, 70};
    const double albedo = 0.8, part = M_PI * pit_radius * pit_radius / (PIT_SIDE * PIT_SIDE);
    const double of_pit = albedo * (1 - pit_part) / (1 - albedo * pit_part);
    const double expected = part * of_pit + (1 - part) * albedo;
    for (int i = 0; i < 3; i++) {
        double outgoing[3];
        slope_plane_direction(angles[i], 0.3, outgoing);
        check(draw_under_sky(*state, albedo, relief_map(PIT_SIDE, PIT_SIDE, pit), outgoing, NULL,
                             65536),
              expected, 0.004, "pit", angles[i]);
    }
}

static uint64_t mixed(uint64_t value) {
    value = (value ^ (value >> 31)) * 0x7fb5d329728ea185u;
    value = (value ^ (value >> 27)) * 0x81dadef4bc2dd44du;
    return value ^ (value >> 33);
}

enum { ROUGH_WIDTH = 13, ROUGH_HEIGHT = 9 };

static double rough(uint32_t column, uint32_t row) {
    return 2.5 * (double)(mixed(row * 64 + column + 1) >> 40) / (1 << 24);
}

static void white_reliefs_reflect_all_light(void **state) {
    static const double angles[] = {0, 45, 75};
    for (int i = 0; i < 3; i++) {
        double outgoing[3];
        slope_plane_direction(angles[i], 0.7, outgoing);
        check(draw_under_sky(*state, 1, relief_map(ROUGH_WIDTH, ROUGH_HEIGHT, rough), outgoing,
                             "bounces=64", 131072),
              1, 0.004, "furnace", angles[i]);
    }
}

/// What facets emit makes up for what they absorb.
static void shining_reliefs_vanish_in_a_furnace(void **state) {
    lobe_material material = relief_material(0.6);
    for (int channel = 0; channel < 3; channel++)
        material.emissive[channel] = 0.4F;
    double outgoing[3];
    slope_plane_direction(60, 0.7, outgoing);
    check(draw_material_under_sky(*state, &material, relief_map(ROUGH_WIDTH, ROUGH_HEIGHT, rough),
                                  outgoing, NULL, 16384),
          1, 0.006, "shining furnace", 60);
}

/// Of the whole map, all bounces: with both directions exchanged, radiance times cosine is the
/// same.
static void light_and_viewer_may_change_places(void **state) {
    double a[3], b[3];
    slope_plane_direction(60, 0.4, a);
    slope_plane_direction(25, 2.9, b);
    const double there = draw_under_sun(*state, relief_map(ROUGH_WIDTH, ROUGH_HEIGHT, rough), a, b,
                                        NULL, 65536),
                 back = draw_under_sun(*state, relief_map(ROUGH_WIDTH, ROUGH_HEIGHT, rough), b, a,
                                       NULL, 65536);
    check(there * a[2], back * b[2], 0.015 * back * b[2], "reciprocity", 60);
}

/// A map of more texels than a buffer of 128 MiB has numbers.
static void large_maps_are_read(void **state) {
    only_in_long_runs();
    double outgoing[3];
    slope_plane_direction(40, 1, outgoing);
    const double small = draw_under_sky(*state, 1, relief_map(16, 4, valley), outgoing, "bounces=1",
                                        4096),
                 large = draw_under_sky(*state, 1, relief_map(8192, 4112, valley), outgoing,
                                        "bounces=1", 4096);
    check(large, small, 0.02, "a large map", 40);
}

// ---------------------------------------------------------------------------------------------
// Small steps

typedef struct facet {
    double height, normal[3];
} facet;

static double corner(int column, int row) {
    const int x = ((column % ROUGH_WIDTH) + ROUGH_WIDTH) % ROUGH_WIDTH,
              y = ((row % ROUGH_HEIGHT) + ROUGH_HEIGHT) % ROUGH_HEIGHT;
    return rough((uint32_t)x, (uint32_t)y);
}

/// x along columns, y along rows.
static facet facet_at(double x, double y) {
    const int column = (int)floor(x), row = (int)floor(y);
    const double u = x - column, v = y - row;
    const double a = corner(column, row), b = corner(column + 1, row), c = corner(column, row + 1),
                 d = corner(column + 1, row + 1);
    const double along = u < v ? d - c : b - a, down = u < v ? c - a : d - b;
    const double length = sqrt(1 + along * along + down * down);
    return (facet){a + along * u + down * v, {-along / length, -down / length, 1 / length}};
}

static const double step = 0.01, top = 2.5;

/// One bounce to a viewer from a point of the plane, averaged over the map.
static double march(const double outgoing[3], const double incoming[3]) {
    enum { POINTS = 120 };
    double mean = 0;
    for (uint32_t row = 0; row < ROUGH_HEIGHT; row++)
        for (uint32_t column = 0; column < ROUGH_WIDTH; column++)
            mean += rough(column, row) / (ROUGH_WIDTH * ROUGH_HEIGHT);
    double sum = 0;
    for (int i = 0; i < POINTS * POINTS; i++) {
        double x = (i % POINTS + 0.5) * ROUGH_WIDTH / POINTS;
        double y = (i / POINTS + 0.5) * ROUGH_HEIGHT / POINTS;
        double t = (top - mean) / outgoing[2];
        while (mean + t * outgoing[2] > facet_at(x + t * outgoing[0], y + t * outgoing[1]).height)
            t -= step;
        x += t * outgoing[0];
        y += t * outgoing[1];
        const facet seen = facet_at(x, y);
        double cosine = 0;
        for (int j = 0; j < 3; j++)
            cosine += seen.normal[j] * incoming[j];
        double z = seen.height + 1e-9;
        for (t = 2 * step; cosine > 0 && z + t * incoming[2] < top; t += step)
            if (z + t * incoming[2] < facet_at(x + t * incoming[0], y + t * incoming[1]).height)
                cosine = 0;
        sum += fmax(cosine, 0) / M_PI;
    }
    return sum / (POINTS * POINTS);
}

static void odd_maps_are_those_of_small_steps(void **state) {
    static const double azimuths[] = {0.4, 2.1, 4.6};
    for (int i = 0; i < 3; i++) {
        double outgoing[3], incoming[3];
        slope_plane_direction(60, azimuths[i], outgoing);
        slope_plane_direction(50, azimuths[i] + 1.3, incoming);
        const double found = draw_under_sun(*state, relief_map(ROUGH_WIDTH, ROUGH_HEIGHT, rough),
                                            outgoing, incoming, "bounces=1", 65536);
        const double expected = march((double[]){outgoing[0], -outgoing[1], outgoing[2]},
                                      (double[]){incoming[0], -incoming[1], incoming[2]});
        check(found, expected, 0.02 * expected, "small steps", azimuths[i]);
    }
}

// ---------------------------------------------------------------------------------------------
// Bad maps

static double broken(uint32_t column, uint32_t row) {
    return column + row == 3 ? NAN : 0;
}

static double level(uint32_t column, uint32_t row) {
    (void)column;
    (void)row;
    return 3;
}

static double steep(uint32_t column, uint32_t row) {
    return (column + row) % 2 ? 1e30 : -1e30;
}

static void heights_that_are_no_numbers_are_refused(void **state) {
    fixture *f = *state;
    const lobe_material material = relief_material(1);
    lobe_scene *scene = relief_plane(&material, relief_map(7, 5, broken), (double[]){0, 0, 1}, 4);
    scene_end(scene);
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), LOBE_ERROR_MALFORMED,
                   "not finite");
    lobe_scene_destroy(&scene);
}

/// A single texel is flat; walls without end are black but for their tops.
static void extreme_reliefs(void **state) {
    double direction[3];
    slope_plane_direction(40, 1, direction);
    check(draw_under_sun(*state, relief_map(1, 1, level), direction, direction, NULL, 64),
          direction[2] / M_PI, 1e-4, "one texel", 40);
    const double found =
        draw_under_sun(*state, relief_map(4, 4, steep), direction, direction, NULL, 64);
    assert_true(found >= 0 && found < 0.4);
}

static double no_height(uint32_t column, uint32_t row) {
    (void)column;
    (void)row;
    return 0;
}

/// Leaning lobes lean as they do without a relief. (Mirrored, this one would be almost black.)
static void lobes_lean_as_on_a_plane(void **state) {
    static const double outgoing[] = {0.3, 0.2, 0.9327379}, incoming[] = {-0.2, 0.6, 0.7745967};
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 10);
    material.lobes[0].direction[1] = 0.5f;
    material.lobes[0].direction[2] = 0.8660254f;
    lobe_scene *scene = relief_plane(&material, relief_map(8, 8, no_height), outgoing, 1);
    relief_plane_add_sun(scene, incoming, 1);
    const double expected = relief_plane_draw(*state, scene, "direct", NULL, 64);
    const double found = relief_plane_draw(*state, scene, "displaced-reference", NULL, 64);
    check(found, expected, 1e-4 * expected, "leaning lobe", 30);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_of_a_valley),
        cmocka_unit_test(large_maps_are_read),
        cmocka_unit_test(valley_seen_from_the_light),
        cmocka_unit_test(pits_reflect_the_sky_evenly),
        cmocka_unit_test(white_reliefs_reflect_all_light),
        cmocka_unit_test(shining_reliefs_vanish_in_a_furnace),
        cmocka_unit_test(light_and_viewer_may_change_places),
        cmocka_unit_test(odd_maps_are_those_of_small_steps),
        cmocka_unit_test(heights_that_are_no_numbers_are_refused),
        cmocka_unit_test(extreme_reliefs),
        cmocka_unit_test(lobes_lean_as_on_a_plane),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
