// The same relief from near to 64 times as far: its mean radiance stays, whether triangles, masking
// or the distribution of slopes hold it.

#include <math.h>

#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { MAP = 256, EXTENT = 64 };

/// Tiles of one metre. The picture shows `tiles` of them across, always whole ones.
static lobe_scene *relief_at(double angle, double tiles) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 0);
    material.height_map =
        scene_add_map(scene, gaussian_heights(MAP, 0.5, 11, &material.height_scale));
    scene_add_square(scene, &material, 400,
                     (float[]){200, 0, 0, 0, 0, 200, 0, 0, 0, 0, 200, 0, 0, 0, 0, 1});
    scene_add_sun(scene, (double[]){0.1, 1, 0.1}, 3);
    scene_end(scene);
    scene->camera = (lobe_camera){.eye = {0, (float)(300 * cos(angle)), (float)(300 * sin(angle))},
                                  .up = {0, 1, 0},
                                  .orthographic_height = (float)tiles,
                                  .near_plane = 1};
    scene->has_camera = true;
    return scene;
}

static double mean_of(fixture *f, double angle, double tiles, const picture_request *request) {
    lobe_scene *scene = relief_at(angle, tiles);
    lobe_frame frame = draw_scene(f, scene, request);
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        assert_true(((const float *)frame.radiance.texels)[4 * i + 3] > 0);
        sum += (double)((const float *)frame.radiance.texels)[4 * i + 1] / (EXTENT * EXTENT);
    }
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return sum;
}

/// The cosine is 1/2: twice as many tiles along the view as across.
static void radiance_stays_over_a_zoom(void **state) {
    fixture *f = *state;
    const double angle = M_PI / 3;
    const picture_request truth = {.filter = "reference",
                                   .settings = {"displacement=geometry"},
                                   .width = EXTENT,
                                   .height = EXTENT,
                                   .samples = 8};
    const picture_request request = {.filter = "leadr",
                                     .settings = {"displacement=geometry", "pixels_per_vertex=8"},
                                     .width = EXTENT,
                                     .height = EXTENT};
    const double expected = mean_of(f, angle, 1, &truth);
    for (double tiles = 1; tiles <= 64; tiles *= 2) {
        const double found = mean_of(f, angle, tiles, &request);
        print_message("# %g tiles: %.4f\n", tiles, found / expected);
        if (fabs(found / expected - 1) > 0.047)
            fail_msg("%g tiles across: %g instead of %g", tiles, found, expected);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(radiance_stays_over_a_zoom)};
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
