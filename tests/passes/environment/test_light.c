// Light from an environment through the whole renderer: every filter with every method, against the
// exact sum over the environment's texels.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static const char *const methods[] = {"env=exact", "env=mip", "env=prefiltered", "env=sampled"};
enum { EXACT, MIP, PREFILTERED, SAMPLED, METHODS };

static void grey(double value, float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)value;
}

// ---------------------------------------------------------------------------------------------
// Environments

static void white(const double direction[3], float radiance[3]) {
    (void)direction;
    grey(1, radiance);
}

/// Smooth, of different colours from different sides.
static void coloured(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] =
            (float)(1 + 0.9 * direction[i] + 0.5 * direction[(i + 1) % 3] * direction[(i + 1) % 3]);
}

/// A broad window high up on one side of a dim room.
static void window(const double direction[3], float radiance[3]) {
    double cosine = (0.6 * direction[0] + 0.7 * direction[1] + 0.4 * direction[2]) / sqrt(1.01);
    grey(0.2 + 8 * exp(12 * (cosine - 1)), radiance);
    radiance[2] *= 0.5f;
}

/// Bright below the horizon, dark above.
static void ground(const double direction[3], float radiance[3]) {
    grey(direction[1] < -0.05 ? 1 : 0, radiance);
}

/// A ring of lamps above the horizon, brightest on one side, and a lamp below it on another.
static void lamps(const double direction[3], float radiance[3]) {
    const double ring = 20 * pow(direction[1] - 0.35, 2), below = direction[1] + 0.45;
    const double aside = direction[0] + direction[2];
    grey(0.1 + (3 + 2 * direction[0]) * exp(-5 * ring) +
             (aside < 0 ? 4 * aside * aside * exp(-100 * below * below) : 0),
         radiance);
}

// ---------------------------------------------------------------------------------------------
// Scenes: a square lit only by an environment

static lobe_material metal(float roughness) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = roughness;
    material.metallic = 1;
    return material;
}

static lobe_material white_lambert(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    for (int i = 0; i < 3; i++) {
        material.base_colour[i] = 1;
        material.lobes[0].colour[i] = 0;
    }
    return material;
}

static lobe_scene *square_in(environment_radiance radiance, const lobe_material *material,
                             const double towards[3]) {
    lobe_scene *scene = scene_begin();
    scene_add_square(scene, material, 1, NULL);
    scene_surround(scene, 32, radiance);
    scene_look_from(scene, towards, 0.5);
    scene_end(scene);
    return scene;
}

/// With normals tilted by up to `tilt` radians, four texels across a pixel.
static lobe_scene *rough_square_in(environment_radiance radiance, const lobe_material *material,
                                   double tilt) {
    lobe_scene *scene = scene_begin();
    lobe_material mapped = *material;
    mapped.normal_map = scene_add_map(scene, random_normal_map(16, 16, tilt, 11));
    scene_add_square(scene, &mapped, 8, NULL);
    scene_surround(scene, 32, radiance);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 2);
    scene_end(scene);
    return scene;
}

static lobe_frame draw_by(fixture *f, const lobe_scene *scene, const char *filter,
                          const char *method, const char *knob, uint32_t size) {
    picture_request request = {.filter = filter, .width = size, .height = size, .samples = 64};
    request.settings[0] = method;
    request.settings[1] = "env_size=16";
    request.settings[2] = knob;
    return draw_scene(f, scene, &request);
}

static double draw_pixel(fixture *f, const lobe_scene *scene, const char *filter,
                         const char *method, const char *knob) {
    lobe_frame frame = draw_by(f, scene, filter, method, knob, 1);
    double value = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    return value;
}

static const double aslant[3] = {0.5, 1, 0.3};

// ---------------------------------------------------------------------------------------------
// Energy

static void a_white_room_leaves_lambert_white(void **state) {
    static const char *const filters[] = {"direct", "leadr", "reference"};
    const lobe_material material = white_lambert();
    lobe_scene *scene = square_in(white, &material, aslant);
    hold_scene(*state, scene);
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        const char *filter = filters[i];
        for (int method = 0; method < METHODS; method++) {
            double found = draw_pixel(*state, scene, filter, methods[method], NULL);
            // The reference takes 64 random samples; the sum over 16 texels per side is also a
            // quadrature.
            bool chance = method == EXACT && strcmp(filter, "reference") == 0;
            if (!(fabs(found - 1) < (chance ? 0.05 : 5e-3)))
                fail_msg("%s, %s: %g", filter, methods[method], found);
        }
    }
    hold_scene(*state, NULL);
    lobe_scene_destroy(&scene);
}

/// Microfacets lose what the exact sum loses, and nothing with multiple scattering.
static void check_metal(fixture *f, float roughness) {
    lobe_material material = metal(roughness);
    lobe_scene *scene = square_in(white, &material, aslant);
    hold_scene(f, scene);
    double exact = draw_pixel(f, scene, "direct", methods[EXACT], NULL);
    if (!(exact > 0.3 && exact < 1.02))
        fail_msg("roughness %g: %g of all light", (double)roughness, exact);
    for (int method = PREFILTERED; method < METHODS; method++) {
        double found = draw_pixel(f, scene, "direct", methods[method], NULL);
        if (!(fabs(found - exact) < (method == SAMPLED ? 0.06 : 0.02)))
            fail_msg("roughness %g, %s: %g instead of %g", (double)roughness, methods[method],
                     found, exact);
    }
    double all = draw_pixel(f, scene, "direct", methods[EXACT], "scattering=multiple");
    assert_float_equal(all, 1, 0.02);
    all = draw_pixel(f, scene, "direct", methods[PREFILTERED], "scattering=multiple");
    assert_float_equal(all, 1, 0.02);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

static void a_white_room_shows_what_metal_reflects(void **state) {
    only_in_long_runs();
    check_metal(*state, 0.45f);
    check_metal(*state, 0.7f);
    check_metal(*state, 0.95f);
}

// ---------------------------------------------------------------------------------------------
// Methods against the exact sum

typedef struct bound {
    const char *filter;
    double relative_l2[METHODS];
} bound;

static void check_methods(fixture *f, const lobe_scene *scene, const char *what,
                          const bound *bounds) {
    hold_scene(f, scene);
    for (int i = 0; bounds[i].filter; i++) {
        lobe_frame exact = draw_by(f, scene, bounds[i].filter, methods[EXACT], NULL, 4);
        assert_true(all_finite(&exact.radiance) && largest_value(&exact.radiance) > 0);
        for (int method = MIP; method < METHODS; method++) {
            lobe_frame frame = draw_by(f, scene, bounds[i].filter, methods[method], NULL, 4);
            double error = relative_l2(&frame.radiance, &exact.radiance);
            if (!(error <= bounds[i].relative_l2[method]))
                fail_msg("%s, %s, %s: relative error %g", what, bounds[i].filter, methods[method],
                         error);
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&exact);
    }
    hold_scene(f, NULL);
}

static void microfacets_agree_with_the_exact_sum(void **state) {
    only_in_long_runs();
    static const bound bounds[] = {
        {"direct", {0, 0.15, 0.09, 0.11}},  {"toksvig", {0, 0.15, 0.09, 0.11}},
        {"leadr", {0, 0.15, 0.09, 0.11}},   {"lobes", {0, 0.15, 0.09, 0.11}},
        {"moments", {0, 0.15, 0.09, 0.11}}, {NULL, {0}},
    };
    lobe_material material = metal(0.5f);
    material.metallic = 0.5f;
    lobe_scene *scene = rough_square_in(window, &material, 0.4);
    check_methods(*state, scene, "microfacets", bounds);
    lobe_scene_destroy(&scene);
}

static void half_vector_lobes_agree_with_the_exact_sum(void **state) {
    static const bound bounds[] = {
        {"direct", {0, 0.2, 0.12, 0.12}},
        {"lean", {0, 0.2, 0.15, 0.12}},
        {"moments", {0, 0.2, 0.12, 0.12}},
        {"fournier", {0, 0.2, 0.12, 0.12}},
        {NULL, {0}},
    };
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 0.3f;
    lobe_scene *scene = rough_square_in(window, &material, 0.4);
    check_methods(*state, scene, "half-vector lobes", bounds);
    lobe_scene_destroy(&scene);
}

/// Loops over all texels of a large cube would be cut short by some drivers.
static void large_cubes_are_summed_up_whole(void **state) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    lobe_scene *scene = square_in(window, &material, aslant);
    double small = draw_pixel(*state, scene, "direct", methods[EXACT], NULL);
    double large = draw_pixel(*state, scene, "direct", methods[EXACT], "env_size=256");
    if (!(fabs(large - small) < 0.02 * small))
        fail_msg("%g with faces of 16, %g of 256", small, large);
    lobe_scene_destroy(&scene);
}

/// No lobe represents what they reflect; but what goes below the horizon is not visible.
static void steep_slopes_lose_what_goes_below(void **state) {
    static const bound bounds[] = {{"lean", {0, 0.3, 0.2, 0.2}}, {NULL, {0}}};
    const lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    lobe_scene *scene = rough_square_in(window, &material, 1.2);
    check_methods(*state, scene, "steep slopes", bounds);
    lobe_scene_destroy(&scene);
}

/// A lamp low above one side.
static void low_lamp(const double direction[3], float radiance[3]) {
    grey(0.1 + 30 * exp(40 * (0.9 * direction[0] + 0.43 * direction[1] - 1)), radiance);
}

static double mean_of(fixture *f, const lobe_scene *scene, const char *filter) {
    enum { SIZE = 8 };
    lobe_frame frame = draw_by(f, scene, filter, methods[PREFILTERED], NULL, SIZE);
    double sum = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        sum += (double)pixel_at(&frame.radiance, i % SIZE, i / SIZE)[1];
    lobe_frame_free(&frame);
    return sum / (SIZE * SIZE);
}

/// Lobes this rough share one bin, however much their normals vary. Found: 1.03 to 1.06; for bins
/// that reflect as one lobe, 0.92 below the lamp.
static void steep_rough_metal_reflects_what_it_should(void **state) {
    static const char *const filters[] = {"moments", "mixture"};
    static const environment_radiance skies[] = {window, coloured, low_lamp};
    const lobe_material material = metal(1);
    for (size_t i = 0; i < sizeof skies / sizeof *skies; i++) {
        lobe_scene *scene = rough_square_in(skies[i], &material, 1.2);
        const double expected = mean_of(*state, scene, "reference");
        for (size_t k = 0; k < sizeof filters / sizeof *filters; k++) {
            const double found = mean_of(*state, scene, filters[k]);
            if (!(fabs(found - expected) <= 0.07 * expected))
                fail_msg("%s under sky %zu: %g instead of %g", filters[k], i, found, expected);
        }
        lobe_scene_destroy(&scene);
    }
}

/// A small lamp straight above.
static void lamp(const double direction[3], float radiance[3]) {
    grey(0.01 + 500 * exp(1000 * (direction[1] - 1)), radiance);
}

/// Seen from above, in a picture that shows its reflection and the surroundings.
static lobe_scene *lobe_below_lamp(float kappa) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, kappa);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 0;
    scene_add_square(scene, &material, 1, NULL);
    scene_surround(scene, 128, lamp);
    scene->camera = (lobe_camera){
        .eye = {0, 1, 0}, .up = {0, 0, -1}, .vertical_field_of_view = 0.5f, .near_plane = 0.01f};
    scene->has_camera = true;
    scene_end(scene);
    return scene;
}

static lobe_frame draw_below_lamp(fixture *f, const lobe_scene *scene, const char *method,
                                  const char *levels) {
    picture_request request = {
        .filter = "direct", .settings = {method, "env_size=64", levels}, .width = 12, .height = 12};
    return draw_scene(f, scene, &request);
}

/// Between two levels, a blend of two cubes is nearer to the lobe than one of two levels. Lobes of
/// half vectors are four times as concentrated as those of directions: here half way between
/// levels.
static void blended_levels_are_nearer(void **state) {
    static const char *const levels[] = {"env_levels=trilinear", "env_levels=blended"};
    for (float kappa = 512; kappa >= 128; kappa /= 4) {
        lobe_scene *scene = lobe_below_lamp(kappa);
        hold_scene(*state, scene);
        lobe_frame exact = draw_below_lamp(*state, scene, methods[EXACT], NULL);
        double off[2];
        for (int i = 0; i < 2; i++) {
            lobe_frame frame = draw_below_lamp(*state, scene, methods[PREFILTERED], levels[i]);
            off[i] = relative_l2(&frame.radiance, &exact.radiance);
            lobe_frame_free(&frame);
        }
        print_message("# kappa %g: %.4f, blended %.4f\n", (double)kappa, off[0], off[1]);
        if (!(off[1] < 0.4 * off[0]))
            fail_msg("kappa %g: %g off, %g blended", (double)kappa, off[0], off[1]);
        lobe_frame_free(&exact);
        hold_scene(*state, NULL);
        lobe_scene_destroy(&scene);
    }
}

/// The mean of the reference's random samples is the exact sum.
static void the_reference_is_unbiased(void **state) {
    static const lobe_distribution distributions[] = {
        LOBE_DISTRIBUTION_GGX, LOBE_DISTRIBUTION_BECKMANN, LOBE_DISTRIBUTION_BLINN_PHONG,
        LOBE_DISTRIBUTION_VMF};
    for (int i = 0; i < 8; i++) {
        lobe_material material = i < 4 ? metal(0.5f) : half_vector_material(0, i < 6 ? 30 : 6);
        material.distribution = distributions[i < 4 ? i : 2 + i % 2];
        material.metallic = 0.6f;
        lobe_scene *scene = square_in(window, &material, aslant);
        lobe_frame exact = draw_by(*state, scene, "direct", methods[EXACT], NULL, 1);
        picture_request request = {.filter = "reference",
                                   .settings = {"env_size=16"},
                                   .width = 4,
                                   .height = 4,
                                   .samples = 256};
        lobe_frame frame = draw_scene(*state, scene, &request);
        for (int channel = 0; channel < 3; channel++) {
            double sum = 0, wanted = (double)pixel_at(&exact.radiance, 0, 0)[channel];
            for (uint32_t pixel = 0; pixel < 16; pixel++)
                sum += (double)pixel_at(&frame.radiance, pixel % 4, pixel / 4)[channel] / 16;
            // 4096 samples; with an orthographic camera all pixels are equal. Within 0.6 %: the
            // exact sum puts a texel's light into its centre.
            if (!(fabs(sum - wanted) <= 0.015 * wanted))
                fail_msg("material %d, channel %d: %g instead of %g", i, channel, sum, wanted);
        }
        lobe_frame_free(&exact);
        lobe_frame_free(&frame);
        lobe_scene_destroy(&scene);
    }
}

/// A mirror, the broadest and the sharpest lobes, steep normals: never more light than the
/// environment has, and never NaN.
static void extreme_lobes_stay_finite(void **state) {
    only_in_long_runs();
    static const char *const filters[] = {"lobes", "moments"};
    static const float widths[] = {0, 1, 1e6f};
    for (int i = 0; i < 5; i++) {
        bool microfacets = i < 2;
        lobe_material material = microfacets
                                     ? metal((float)i)
                                     : half_vector_material(LOBE_DISTRIBUTION_VMF, widths[i - 2]);
        lobe_scene *scene = scene_begin();
        material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 1.5, 3));
        scene_add_square(scene, &material, 4, NULL);
        scene_surround(scene, 16, white);
        scene_look_from(scene, (double[]){1, 0.15, 0}, 0.3);
        scene_end(scene);
        hold_scene(*state, scene);
        for (int filter = 0; filter < 2; filter++) {
            for (int method = PREFILTERED; method < METHODS; method++) {
                lobe_frame frame =
                    draw_by(*state, scene, filters[filter], methods[method], NULL, 4);
                // Half-vector lobes reflect up to four times what they see.
                double most = microfacets ? 1.1 : 4.1;
                if (!all_finite(&frame.radiance) || largest_value(&frame.radiance) > most)
                    fail_msg("material %d, %s, %s: up to %g", i, filters[filter], methods[method],
                             largest_value(&frame.radiance));
                lobe_frame_free(&frame);
            }
        }
        hold_scene(*state, NULL);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Knobs

static void turned_a_quarter(const double direction[3], float radiance[3]) {
    coloured((double[]){-direction[2], direction[1], direction[0]}, radiance);
}

/// Rotating the environment equals drawing a rotated one.
static void rotation_turns_the_environment(void **state) {
    static const float quarter[3][3] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    lobe_material material = metal(0.4f);
    lobe_scene *turned = square_in(coloured, &material, aslant);
    memcpy(turned->environment->world_from_environment, quarter, sizeof quarter);
    turned->environment->intensity = 2;
    lobe_scene *drawn = square_in(turned_a_quarter, &material, aslant);
    for (int method = 0; method < METHODS; method++) {
        lobe_frame a = draw_by(*state, turned, "direct", methods[method], NULL, 1);
        lobe_frame b = draw_by(*state, drawn, "direct", methods[method], NULL, 1);
        for (uint32_t i = 0; i < 3; i++) {
            double expected = 2 * (double)pixel_at(&b.radiance, 0, 0)[i];
            assert_float_equal(pixel_at(&a.radiance, 0, 0)[i], expected, 2e-3 * expected);
        }
        lobe_frame_free(&a);
        lobe_frame_free(&b);
    }
    lobe_scene_destroy(&turned);
    lobe_scene_destroy(&drawn);
}

/// Seen at a flat angle, a broad lobe reaches far below the horizon.
static void nothing_comes_from_below_the_horizon(void **state) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    lobe_scene *scene = square_in(ground, &material, (double[]){1, 0.2, 0});
    hold_scene(*state, scene);
    double ignored = draw_pixel(*state, scene, "direct", methods[PREFILTERED], "horizon=ignored");
    double clipped = draw_pixel(*state, scene, "direct", methods[PREFILTERED], "horizon=clipped");
    double faded = draw_pixel(*state, scene, "direct", methods[PREFILTERED], "horizon=faded");
    double exact = draw_pixel(*state, scene, "direct", methods[EXACT], NULL);
    hold_scene(*state, NULL);
    assert_true(exact < 1e-3);
    assert_true(clipped < 0.4 * ignored && faded < 0.8 * ignored && clipped < faded);
    lobe_scene_destroy(&scene);
}

/// Of a white square whose normals all lean by `tilt` to one side, and are alike.
static double draw_leaning(fixture *f, double tilt, double azimuth, const char *method) {
    const double x = sin(tilt) * cos(azimuth), y = sin(tilt) * sin(azimuth);
    lobe_scene *scene = scene_begin();
    lobe_material material = white_lambert();
    material.normal_map =
        scene_add_map(scene, constant_map(4, 4, (float)(0.5 + 0.5 * x), (float)(0.5 + 0.5 * y),
                                          (float)(0.5 + 0.5 * cos(tilt))));
    scene_add_square(scene, &material, 1, NULL);
    scene_surround(scene, 64, lamps);
    scene_look_down(scene, 0.5);
    scene_end(scene);
    picture_request request = {
        .filter = "direct", .width = 1, .height = 1, .settings = {method, "env_size=64"}};
    lobe_frame frame = draw_scene(f, scene, &request);
    const double value = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return value;
}

/// Lamps above a surface's horizon light its tilted normals, and lamps below do not, although nine
/// harmonics hardly tell one from the other (with these alone, the error is 0.10).
static void tilted_normals_are_lit_from_above_only(void **state) {
    for (int method = PREFILTERED; method < METHODS; method++) {
        double error = 0, whole = 0;
        for (int i = 0; i < 12; i++) {
            const double tilt = i < 6 ? 0.5 : 0.9, azimuth = M_PI / 3 * i;
            const double exact = draw_leaning(*state, tilt, azimuth, methods[EXACT]);
            const double found = draw_leaning(*state, tilt, azimuth, methods[method]);
            error += (found - exact) * (found - exact);
            whole += exact * exact;
        }
        print_message("# %s: relative L2 %.3g\n", methods[method], sqrt(error / whole));
        assert_true(sqrt(error / whole) < 0.05);
    }
}

static void occlusion_takes_its_part(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = metal(0.5f);
    scene_add_square(scene, &material, 1, NULL);
    scene_surround(scene, 16, coloured);
    scene_look_down(scene, 0.5);
    scene_end(scene);
    double all = draw_pixel(*state, scene, "lobes", methods[PREFILTERED], NULL);
    scene->materials[0].occlusion_map = scene_add_map(scene, constant_map(4, 4, 0.25f, 1, 1));
    scene->materials[0].occlusion_strength = 0.8f;
    hold_scene(*state, scene);
    for (size_t i = 0; i < lobe_filter_count(); i += long_runs() ? 1 : 3) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        double part = draw_pixel(*state, scene, filter, methods[PREFILTERED], NULL);
        assert_float_equal(part, 0.4 * all, 0.01 * all);
    }
    hold_scene(*state, NULL);
    lobe_scene_destroy(&scene);
}

static void the_background_shows_the_environment(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = metal(0.5f);
    scene_add_square(scene, &material, 1, NULL);
    scene_surround(scene, 32, coloured);
    // Away from the square, upwards.
    scene->camera = (lobe_camera){.eye = {0, 1, 0},
                                  .target = {0.3f, 2, 0.4f},
                                  .up = {0, 0, 1},
                                  .vertical_field_of_view = 0.2f,
                                  .near_plane = 0.01f};
    scene->has_camera = true;
    scene->environment_visible = true;
    scene_end(scene);
    float expected[3];
    double length = sqrt(0.09 + 1 + 0.16);
    coloured((double[]){0.3 / length, 1 / length, 0.4 / length}, expected);
    static const char *const filters[] = {"lobes", "reference"};
    for (int i = 0; i < 2; i++) {
        picture_request request = {.filter = filters[i],
                                   .settings = {"env_size=64"},
                                   .width = 3,
                                   .height = 3,
                                   .samples = 4,
                                   .outputs = true};
        lobe_frame frame = draw_scene(*state, scene, &request);
        const float *pixel = pixel_at(&frame.radiance, 1, 1);
        for (int j = 0; j < 3; j++)
            assert_float_equal(pixel[j], expected[j], 0.02 * (double)expected[j]);
        assert_true(pixel[3] == 0);
        assert_true(pixel_at(&frame.normal_depth, 1, 1)[3] == 0);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Only what the scene requires

static void methods_make_only_their_own_maps(void **state) {
    fixture *f = *state;
    lobe_material material = metal(0.5f);
    lobe_scene *scene = square_in(coloured, &material, aslant);
    static const struct {
        const char *method, *pass;
        bool runs;
    } cases[] = {
        {"env=mip", "environment_prefiltering", false},
        {"env=exact", "irradiance_harmonics", false},
        {"env=exact", "environment_reduction", false},
        {"env=mip", "environment_reduction", true},
        {"env=prefiltered", "environment_prefiltering", true},
        {"env=sampled", "irradiance_harmonics", true},
        {"env=sampled", "environment_prefiltering", false},
        {"env=prefiltered", "directional_albedo", true},
        {"env=exact", "directional_albedo", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (int again = 0; again < 2; again++) {
            picture_request request = {.filter = "direct",
                                       .settings = {cases[i].method, "env_size=16"},
                                       .width = 1,
                                       .height = 1};
            lobe_frame frame = draw(f, &request);
            size_t ran =
                count_passes(lobe_renderer_graph(f->renderer), cases[i].pass, LOBE_PASS_RUN);
            // Existing maps are not rebuilt.
            if ((ran > 0) != (cases[i].runs && !again))
                fail_msg("%s: %s ran %zu times in frame %d", cases[i].method, cases[i].pass, ran,
                         again);
            lobe_frame_free(&frame);
        }
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Bumps make microfacets rougher only where a filter averages normals into widths.
static void smooth_bumpy_metal_is_not_lit_as_rough(void **state) {
    static const struct {
        const char *filter;
        float roughness;
        bool rough;
    } cases[] = {
        {"direct", 0.3f, false}, {"mipmap", 0.3f, false}, {"moments", 0.3f, false},
        {"lean", 0.3f, false},   {"lobes", 0.3f, false},  {"mixture", 0.3f, false},
        {"tan", 0.3f, false},    {"leadr", 0.3f, true},   {"toksvig", 0.3f, true},
        {"direct", 0.8f, true},  {"moments", 0.8f, true},
    };
    fixture *f = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const lobe_material material = metal(cases[i].roughness);
        lobe_scene *scene = rough_square_in(coloured, &material, 0.5);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        picture_request request = {
            .filter = cases[i].filter, .settings = {"env_size=16"}, .width = 1, .height = 1};
        lobe_frame frame = draw(f, &request);
        const size_t ran =
            count_passes(lobe_renderer_graph(f->renderer), "hemisphere_moments", LOBE_PASS_RUN);
        if ((ran > 0) != cases[i].rough)
            fail_msg("%s, roughness %g: moments of hemispheres were made %zu times",
                     cases[i].filter, (double)cases[i].roughness, ran);
        lobe_frame_free(&frame);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

/// One part of the work per frame: lit by the plain MIP chain at first, by the previous environment
/// while the next is prepared, and finally as if all parts had been done at once.
static void maps_are_made_part_by_part(void **state) {
    fixture *f = *state;
    lobe_material material = metal(0.5f);
    lobe_scene *scene = square_in(coloured, &material, aslant);
    double chain = draw_pixel(f, scene, "direct", methods[MIP], NULL);
    double whole = draw_pixel(f, scene, "direct", methods[PREFILTERED], NULL);
    assert_true(fabs(chain - whole) > 1e-3);
    lobe_settings settings = settings_of(
        filter_named("direct"), (const char *[]){methods[PREFILTERED], "env_size=16", NULL});
    lobe_render_parameters parameters = {.filter = filter_named("direct"),
                                         .settings = &settings,
                                         .width = 1,
                                         .height = 1,
                                         .environment.parts = 3};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    double former = chain, next = whole;
    for (int content = 0; content < 2; content++) {
        int frames = 0, waiting = 0;
        for (double found = former; fabs(found - next) > 1e-5 * next && frames < 40; frames++) {
            lobe_frame frame;
            assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
            found = (double)pixel_at(&frame.radiance, 0, 0)[1];
            waiting += fabs(found - former) < 1e-5 * former;
            assert_int_equal(frame.environment_parts_left > 0, fabs(found - next) > 1e-5 * next);
            lobe_frame_free(&frame);
        }
        print_message("# %d frames, %d waiting\n", frames, waiting);
        if (!(frames > 3 && frames < 40 && waiting == frames - 1))
            fail_msg("%d of %d frames showed the former maps", waiting, frames);
        // Twice as bright.
        float *texels = scene->environment->image.texels;
        for (size_t i = 0; i < (size_t)64 * 32 * 4; i++)
            texels[i] *= 2;
        const lobe_scene_changes changes = {.environment = true};
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        former = next;
        next *= 2;
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void bad_environments_are_refused(void **state) {
    fixture *f = *state;
    lobe_material material = metal(0.5f);
    for (int fault = 0; fault < 4; fault++) {
        lobe_scene *scene = square_in(coloured, &material, aslant);
        if (fault == 0)
            ((float *)scene->environment->image.texels)[9] = NAN;
        if (fault == 1)
            ((float *)scene->environment->image.texels)[4] = -1;
        if (fault == 2)
            scene->environment->intensity = INFINITY;
        if (fault == 3)
            scene->environment->world_from_environment[1][1] = 2;
        fixture_forget_messages(f);
        lobe_result result = lobe_renderer_set_scene(f->renderer, scene);
        assert_failure(f, result, LOBE_ERROR_MALFORMED, "environment 'environment'");
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_white_room_leaves_lambert_white),
        cmocka_unit_test(a_white_room_shows_what_metal_reflects),
        cmocka_unit_test(microfacets_agree_with_the_exact_sum),
        cmocka_unit_test(half_vector_lobes_agree_with_the_exact_sum),
        cmocka_unit_test(large_cubes_are_summed_up_whole),
        cmocka_unit_test(steep_slopes_lose_what_goes_below),
        cmocka_unit_test(steep_rough_metal_reflects_what_it_should),
        cmocka_unit_test(blended_levels_are_nearer),
        cmocka_unit_test(the_reference_is_unbiased),
        cmocka_unit_test(extreme_lobes_stay_finite),
        cmocka_unit_test(rotation_turns_the_environment),
        cmocka_unit_test(nothing_comes_from_below_the_horizon),
        cmocka_unit_test(tilted_normals_are_lit_from_above_only),
        cmocka_unit_test(occlusion_takes_its_part),
        cmocka_unit_test(the_background_shows_the_environment),
        cmocka_unit_test(methods_make_only_their_own_maps),
        cmocka_unit_test(smooth_bumpy_metal_is_not_lit_as_rough),
        cmocka_unit_test(maps_are_made_part_by_part),
        cmocka_unit_test(bad_environments_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
