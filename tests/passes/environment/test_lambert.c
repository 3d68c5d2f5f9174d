// Diffuse light that bumps gather of lamps, above and below the surface, against a sum over their
// normals and over directions.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/vector.h"

/// Unit directions and radiances, by environment; radiance 0 ends a list.
typedef struct lamp {
    double direction[3], radiance;
} lamp;

static const lamp high_and_low[] = {{{0.48, 0.64, 0.6}, 4}, {{-0.6, -0.48, 0.64}, 6}, {{0}, 0}};
static const lamp at_the_horizon[] = {
    {{0.8, 0, 0.6}, 5}, {{-0.64, 0.2, -0.741889}, 8}, {{0.1, 0.98, 0.171756}, 4}, {{0}, 0}};
static const lamp below[] = {{{0.6, -0.75, -0.278388}, 9}, {{0}, 0}};

static const lamp *const surroundings[] = {high_and_low, at_the_horizon, below};
enum { SURROUNDINGS = sizeof surroundings / sizeof *surroundings };

/// Of which surroundings `shine` is the radiance.
static const lamp *lamps;

static void shine(const double direction[3], float radiance[3]) {
    double sum = 0.05;
    for (const lamp *one = lamps; one->radiance > 0; one++)
        sum += one->radiance * exp(60 * (reference_dot(direction, one->direction) - 1));
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)sum;
}

enum { SIDE = 32, TEXELS = SIDE * SIDE };

/// Normals of waves in eight directions, in the tangent frame.
typedef struct bumps {
    double normals[TEXELS][3];
} bumps;

/// Slopes of this root mean square along each axis.
static bumps bumps_of(double slope) {
    static const int waves[][2] = {{3, 0}, {0, 3}, {2, 2},  {2, -2},
                                   {1, 3}, {3, 1}, {-1, 3}, {3, -1}};
    enum { WAVES = sizeof waves / sizeof *waves };
    bumps found;
    for (int i = 0; i < TEXELS; i++) {
        double slopes[2] = {0, 0};
        for (int k = 0; k < WAVES; k++) {
            const double phase =
                2 * M_PI * (waves[k][0] * (i % SIDE) + waves[k][1] * (i / SIDE)) / SIDE;
            const double part = slope * cos(phase + 2.4 * k * k) / sqrt(WAVES / 4.0) /
                                hypot(waves[k][0], waves[k][1]);
            for (int axis = 0; axis < 2; axis++)
                slopes[axis] += part * waves[k][axis];
        }
        const double length = sqrt(1 + slopes[0] * slopes[0] + slopes[1] * slopes[1]);
        for (int axis = 0; axis < 3; axis++)
            found.normals[i][axis] = (axis < 2 ? -slopes[axis] : 1) / length;
    }
    return found;
}

static lobe_image normal_map(const bumps *bumps) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, SIDE, SIDE);
    for (int i = 0; i < TEXELS; i++)
        for (int axis = 0; axis < 3; axis++)
            ((float *)map.texels)[4 * i + axis] = (float)(0.5 + 0.5 * bumps->normals[i][axis]);
    return map;
}

/// Of white bumps: light from above the surface, by directions of equal solid angles.
static double expected_radiance(const bumps *bumps) {
    enum { DIRECTIONS = 4096 };
    double sum = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        const double up = (i + 0.5) / DIRECTIONS, azimuth = i * M_PI * (3 - sqrt(5)),
                     across = sqrt(1 - up * up);
        const double direction[3] = {across * cos(azimuth), up, across * sin(azimuth)};
        const double tangent[3] = {direction[0], -direction[2], direction[1]};
        float radiance[3];
        shine(direction, radiance);
        for (int k = 0; k < TEXELS; k++)
            sum += (double)radiance[0] * fmax(reference_dot(bumps->normals[k], tangent), 0);
    }
    return 2 * sum / DIRECTIONS / TEXELS;
}

/// Of one pixel, straight from above, that sees all bumps.
static double draw_bumps(fixture *f, const bumps *bumps, const char *filter, const char *method) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    for (int i = 0; i < 3; i++) {
        material.base_colour[i] = 1;
        material.lobes[0].colour[i] = 0;
    }
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, normal_map(bumps));
    scene_add_square(scene, &material, 16, NULL);
    scene_surround(scene, 128, shine);
    scene_look_down(scene, 0.5);
    scene_end(scene);
    const picture_request request = {.filter = filter,
                                     .settings = {method, "env_size=64"},
                                     .width = 1,
                                     .height = 1,
                                     .samples = 4096};
    lobe_frame frame = draw_scene(f, scene, &request);
    const double radiance = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return radiance;
}

/// Over all surroundings, for slopes of root mean square 0.3 and 0.6: relative L2.
static void check_bumps(fixture *f, const char *filter, const char *method, double bound) {
    double error = 0, whole = 0;
    for (int i = 0; i < 2 * SURROUNDINGS; i++) {
        lamps = surroundings[i / 2];
        const bumps bumps = bumps_of(i % 2 ? 0.6 : 0.3);
        const double expected = expected_radiance(&bumps);
        const double found = draw_bumps(f, &bumps, filter, method);
        print_message("# %s, %s: %.4f instead of %.4f\n", filter, method, found, expected);
        // Where it is dark, too: each counts as much.
        error += (found / expected - 1) * (found / expected - 1);
        whole += 1;
    }
    if (!(sqrt(error / whole) < bound))
        fail_msg("%s, %s: %g off", filter, method, sqrt(error / whole));
}

/// Found: up to 0.015. (`leadr` that lets light from below in is 0.085 off.)
static void bumps_are_lit_from_above_only(void **state) {
    check_bumps(*state, "reference", "env=exact", 0.03);
    check_bumps(*state, "lobes", "env=prefiltered", 0.03);
    check_bumps(*state, "leadr", "env=prefiltered", 0.03);
    if (long_runs()) {
        check_bumps(*state, "leadr", "env=sampled", 0.03);
        check_bumps(*state, "moments", "env=prefiltered", 0.03);
        check_bumps(*state, "multi_leadr", "env=prefiltered", 0.03);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(bumps_are_lit_from_above_only)};
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
