// A normal map seen from near to far, interpolated between texels: no distance at which filters
// reflect less or more than the mean of many samples, or sparkle more than at the next one.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 32, TEXELS = 64, TILES = 8, DISTANCES = 9 };

/// Texels under a pixel, the first of them.
static const double nearest_footprint = 0.45;

/// A metal plate with noise on it, in the mirrored light of a sun.
static lobe_scene *plate(double tilt, double footprint) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.distribution = LOBE_DISTRIBUTION_BECKMANN;
    material.roughness = 0.4f;
    material.metallic = 1;
    material.normal_map = scene_add_map(scene, random_normal_map(TEXELS, TEXELS, tilt, 601));
    scene_add_square(scene, &material, TILES, NULL);
    scene_add_sun(scene, (double[]){0.15, 1, 0.1}, 1);
    scene_look_down(scene, 2 * EXTENT * footprint / (TEXELS * TILES));
    scene_end(scene);
    return scene;
}

typedef struct departure {
    double error, mean; ///< relative L2; ratio of the means
} departure;

static departure compare(fixture *f, const lobe_scene *scene, const char *filter,
                         const lobe_image *truth) {
    picture_request request = {.filter = filter, .width = EXTENT, .height = EXTENT};
    lobe_frame frame = draw_scene(f, scene, &request);
    double sums[2] = {0};
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        sums[0] += (double)pixel_at(&frame.radiance, i % EXTENT, i / EXTENT)[1];
        sums[1] += (double)pixel_at(truth, i % EXTENT, i / EXTENT)[1];
    }
    departure result = {relative_l2(&frame.radiance, truth), sums[0] / sums[1]};
    lobe_frame_free(&frame);
    return result;
}

static void check(const char *filter, double footprint, departure found, departure most) {
    if (!(found.error <= most.error && fabs(found.mean - 1) <= most.mean))
        fail_msg("%s, %.2f texels a pixel: error %.3g (at most %.3g), mean %.3g times the truth",
                 filter, footprint, found.error, most.error, found.mean);
}

/// Beckmann lobes, which all filters can represent.
static void zoom_out(fixture *f, double tilt, departure most) {
    static const char *const filters[] = {"toksvig", "lean",    "leadr",
                                          "lobes",   "moments", "mixture"};
    enum { FILTERS = sizeof filters / sizeof *filters };
    double nearer[FILTERS];
    for (int i = 0; i < DISTANCES; i++) {
        const double footprint = nearest_footprint * pow(2, 0.5 * i);
        lobe_scene *scene = plate(tilt, footprint);
        picture_request request = {
            .filter = "reference", .width = EXTENT, .height = EXTENT, .samples = 256};
        lobe_frame truth = draw_scene(f, scene, &request);
        for (int j = 0; j < FILTERS; j++) {
            departure found = compare(f, scene, filters[j], &truth.radiance);
            check(filters[j], footprint, found, most);
            // Nothing brightens or darkens at once.
            assert_true(i == 0 || fabs(found.mean - nearer[j]) <= most.mean / 2);
            nearer[j] = found.mean;
        }
        lobe_frame_free(&truth);
        lobe_scene_destroy(&scene);
    }
}

static void gentle_noise_from_near_to_far(void **state) {
    zoom_out(*state, 0.2, (departure){0.075, 0.02});
}

static void rough_noise_from_near_to_far(void **state) {
    zoom_out(*state, 0.5, (departure){0.2, 0.065});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gentle_noise_from_near_to_far),
        cmocka_unit_test(rough_noise_from_near_to_far),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
