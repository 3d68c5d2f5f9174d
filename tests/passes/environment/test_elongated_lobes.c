// Metal with ridges under a lamp, whose lobes are many times as long as broad: a row of round lobes
// and a grid of samples against the exact sum over the environment's texels.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 12, TEXELS = 64 };

/// A small lamp straight above, in a dim room.
static void lamp(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)(0.02 + 100 * exp(200 * (direction[1] - 1)));
}

/// Slopes across the ridges, whose standard deviation is `deviation`, the same in each column.
static lobe_image ridges(double deviation) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, TEXELS, TEXELS);
    float *texel = image.texels;
    for (uint32_t i = 0; i < TEXELS * TEXELS; i++, texel += 4) {
        double slope = deviation * sqrt(2) * sin(2 * M_PI * (i % TEXELS) * 17 / TEXELS + 0.3);
        double length = sqrt(1 + slope * slope);
        texel[0] = (float)(0.5 - 0.5 * slope / length);
        texel[1] = 0.5f;
        texel[2] = (float)(0.5 + 0.5 / length);
        texel[3] = 1;
    }
    return image;
}

/// Seen from the lamp, in a picture as wide as the lobe is long.
static lobe_scene *ridged_plate(double deviation, float roughness) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.distribution = LOBE_DISTRIBUTION_BECKMANN;
    material.roughness = roughness;
    material.metallic = 1;
    material.normal_map = scene_add_map(scene, ridges(deviation));
    scene_add_square(scene, &material, 16, NULL);
    scene_surround(scene, 64, lamp);
    scene->camera = (lobe_camera){
        .eye = {0, 1, 0}, .up = {0, 0, -1}, .vertical_field_of_view = 1.2f, .near_plane = 0.01f};
    scene->has_camera = true;
    scene_end(scene);
    return scene;
}

static lobe_frame draw_plate(fixture *f, const lobe_scene *scene, const char *filter,
                             const char *method, const char *knob) {
    picture_request request = {.filter = filter, .width = EXTENT, .height = EXTENT};
    request.settings[0] = method;
    request.settings[1] = "env_size=16";
    request.settings[2] = knob;
    return draw_scene(f, scene, &request);
}

static double total(const lobe_image *image) {
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        sum += (double)pixel_at(image, i % EXTENT, i / EXTENT)[1];
    return sum;
}

/// Between two maxima of the picture's columns: how much darker it is than both, in parts of one.
static double deepest_gap(const lobe_image *image) {
    double column[EXTENT] = {0}, gap = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        column[i % EXTENT] += (double)pixel_at(image, i % EXTENT, i / EXTENT)[1];
    for (int i = 0; i < EXTENT; i++) {
        double left = 0, right = 0;
        for (int j = 0; j < EXTENT; j++)
            if (j < i)
                left = fmax(left, column[j]);
            else
                right = fmax(right, column[j]);
        gap = fmax(gap, 1 - column[i] / fmin(fmax(left, column[i]), right));
    }
    return gap;
}

/// As Dupuy et al. 2013 do, each sample reads a mean over as far as the next one is away in the
/// direction in which they are furthest apart.
static void samples_do_not_repeat_a_lamp(void **state) {
    lobe_scene *scene = ridged_plate(0.3, 0.1f);
    lobe_frame frame = draw_plate(*state, scene, "leadr", "env=sampled", NULL);
    double gap = deepest_gap(&frame.radiance);
    if (!(gap < 0.1))
        fail_msg("gaps of %g", gap);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

/// A lobe broad enough for the exact sum over few texels.
static void samples_have_the_energy(void **state) {
    lobe_scene *scene = ridged_plate(0.3, 0.2f);
    lobe_frame exact = draw_plate(*state, scene, "leadr", "env=exact", NULL);
    lobe_frame frame = draw_plate(*state, scene, "leadr", "env=sampled", NULL);
    double energy = total(&frame.radiance) / total(&exact.radiance);
    if (!(fabs(energy - 1) < 0.1))
        fail_msg("%g times the exact sum's", energy);
    lobe_frame_free(&frame);
    lobe_frame_free(&exact);
    lobe_scene_destroy(&scene);
}

/// Round lobes as broad as too short a row of them needs to be as long as the lobe would collect
/// the lamp from beside it.
static void rows_let_no_light_through(void **state) {
    static const char *const filters[] = {"lean", "leadr"};
    static const struct {
        const char *probes;
        double error, mean;
    } bounds[] = {{"env_probes=2", 0.37, 0.1}, {"env_probes=4", 0.32, 0.1}};
    lobe_scene *scene = ridged_plate(0.2, 0.3f);
    for (int i = 0; i < 2; i++) {
        lobe_frame exact = draw_plate(*state, scene, filters[i], "env=exact", NULL);
        for (int j = 0; j < 2; j++) {
            lobe_frame frame =
                draw_plate(*state, scene, filters[i], "env=prefiltered", bounds[j].probes);
            double error = relative_l2(&frame.radiance, &exact.radiance);
            double mean = total(&frame.radiance) / total(&exact.radiance);
            if (!(error < bounds[j].error && fabs(mean - 1) < bounds[j].mean))
                fail_msg("%s, %s: error %g, mean %g times the exact sum's", filters[i],
                         bounds[j].probes, error, mean);
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&exact);
    }
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_do_not_repeat_a_lamp),
        cmocka_unit_test(samples_have_the_energy),
        cmocka_unit_test(rows_let_no_light_through),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
