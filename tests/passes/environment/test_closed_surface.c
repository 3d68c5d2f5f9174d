// Normal maps as closed surfaces (the knob `normal_mapping`): energy under light from everywhere,
// and reciprocity.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/slope_plane.h"

static const char closed[] = "normal_mapping=microfacet";

static void white(const double direction[3], float radiance[3]) {
    (void)direction;
    for (int i = 0; i < 3; i++)
        radiance[i] = 1;
}

static lobe_material white_material(double roughness, double metallic) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = (float)roughness;
    material.metallic = (float)metallic;
    return material;
}

/// A direction from above scene_add_square.
static void direction_at(double degrees, double azimuth, double direction[3]) {
    const double angle = degrees * M_PI / 180;
    direction[0] = sin(angle) * cos(azimuth);
    direction[1] = cos(angle);
    direction[2] = -sin(angle) * sin(azimuth);
}

static bool has_knob(const lobe_filter *filter, const char *name) {
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++)
        if (strcmp(lobe_filter_knob(filter, i)->name, name) == 0)
            return true;
    return false;
}

// ---------------------------------------------------------------------------------------------
// Many texels to a pixel

enum { EXTENT = 16 };

static lobe_scene *bumpy_plane(const lobe_material *material, double slope, double degrees) {
    lobe_scene *scene = scene_begin();
    lobe_material mapped = *material;
    mapped.normal_map = scene_add_map(scene, slope_plane_bumpy_map(64, slope));
    mapped.normal_map.nearest = true;
    scene_add_square(scene, &mapped, 32, NULL);
    double towards[3];
    direction_at(degrees, 0.3, towards);
    scene_look_from(scene, towards, 0.15);
    return scene;
}

static double mean_radiance(fixture *f, const lobe_scene *scene, const char *filter,
                            const char *normal_mapping, uint32_t samples) {
    picture_request request = {.filter = filter,
                               .settings = {normal_mapping, "scattering=multiple", "env_size=16"},
                               .width = EXTENT,
                               .height = EXTENT,
                               .samples = samples};
    lobe_frame frame = draw_scene(f, scene, &request);
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        sum += (double)pixel_at(&frame.radiance, i % EXTENT, i / EXTENT)[1];
    lobe_frame_free(&frame);
    return sum / (EXTENT * EXTENT);
}

/// A filter draws it as bright as the reference does.
static void check_filter(fixture *f, const lobe_scene *scene, const char *filter, double truth,
                         double tolerance, const char *what) {
    const double found = mean_radiance(f, scene, filter, closed, 1);
    if (!(fabs(found - truth) <= tolerance * truth))
        fail_msg("%s, %s: %g instead of %g", filter, what, found, truth);
}

// ---------------------------------------------------------------------------------------------
// White furnace

static void check_furnace(fixture *f, const lobe_material *material, double slope, double degrees) {
    lobe_scene *scene = bumpy_plane(material, slope, degrees);
    scene_surround(scene, 16, white);
    scene_end(scene);
    char what[96];
    snprintf(what, sizeof what, "metallic %g, roughness %g, slopes of %g, %g degrees",
             (double)material->metallic, (double)material->roughness, slope, degrees);
    hold_scene(f, scene);
    const double truth = mean_radiance(f, scene, "reference", closed, 36);
    if (!(fabs(truth - 1) <= 0.03))
        fail_msg("%s: reflects %g of the light", what, truth);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        if (has_knob(filter, "normal_mapping") &&
            strcmp(lobe_filter_name(filter), "reference") != 0)
            check_filter(f, scene, lobe_filter_name(filter), truth, 0.03, what);
    }
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

static void a_closed_white_surface_loses_nothing(void **state) {
    static const double angles[] = {0, 80}, slopes[] = {0.3, 1};
    for (int i = 0; i < 4; i += long_runs() ? 1 : 3) {
        const lobe_material metal = white_material(0.2, 1);
        check_furnace(*state, &metal, slopes[i / 2], angles[i % 2]);
    }
    const lobe_material rough = white_material(0.6, 1), dielectric = white_material(0.8, 0);
    if (long_runs())
        check_furnace(*state, &rough, 0.7, 75);
    check_furnace(*state, &dielectric, 0.7, 75);
}

/// What samples of the environment reflect, and what facets exchange, are all the light together.
static void samples_lose_nothing(void **state) {
    const lobe_material metal = white_material(0.8, 1);
    lobe_scene *scene = bumpy_plane(&metal, 0.4, 40);
    scene_surround(scene, 16, white);
    scene_end(scene);
    for (int i = 0; i < 2; i++) {
        const picture_request request = {.filter = i ? "leadr" : "moments",
                                         .settings = {closed, "scattering=multiple", "env=sampled"},
                                         .width = 1,
                                         .height = 1};
        lobe_frame frame = draw_scene(*state, scene, &request);
        const double found = (double)pixel_at(&frame.radiance, 0, 0)[1];
        if (!(fabs(found - 1) <= 0.06))
            fail_msg("%s: reflects %g of the light", request.filter, found);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

/// However many texels the environment has: lavapipe ends the loops of a shader that takes too
/// many.
static void exact_light_is_all_light(void **state) {
    fixture *f = *state;
    const lobe_material metal = white_material(0.5, 1);
    lobe_scene *scene = bumpy_plane(&metal, 0.7, 50);
    scene_surround(scene, 16, white);
    scene_end(scene);
    const picture_request request = {.filter = "direct",
                                     .settings = {closed, "scattering=multiple", "env=exact"},
                                     .width = 4,
                                     .height = 4};
    lobe_frame frame = draw_scene(f, scene, &request);
    for (uint32_t i = 0; i < 16; i++) {
        const float found = pixel_at(&frame.radiance, i % 4, i / 4)[1];
        if (!(fabsf(found - 1) <= 0.1f))
            fail_msg("texel %u reflects %g of the light", i, (double)found);
    }
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

static void check_refused(fixture *f, const char *filter, const char *setting) {
    const lobe_settings settings =
        settings_of(filter_named(filter), (const char *const[]){setting, "env=exact", NULL});
    const lobe_render_parameters parameters = {
        .filter = filter_named(filter), .settings = &settings, .width = 4, .height = 4};
    lobe_frame frame;
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_render(f->renderer, &parameters, &frame),
                   LOBE_ERROR_UNSUPPORTED, "exact");
}

/// Filters that sum over many facets, or fetch from many places, for each light would need more
/// than a device computes.
static void filters_with_maps_refuse_exact_light(void **state) {
    fixture *f = *state;
    const lobe_material metal = white_material(0.5, 1);
    lobe_scene *scene = bumpy_plane(&metal, 0.7, 50);
    scene_surround(scene, 16, white);
    scene_end(scene);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    check_refused(f, "moments", closed);
    check_refused(f, "moments", "probes=2");
    check_refused(f, "lobes", "probes=16");
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// The surface that classic normal mapping means is darker.
static void a_classic_white_surface_loses_light(void **state) {
    const lobe_material metal = white_material(0.2, 1);
    lobe_scene *scene = bumpy_plane(&metal, 0.7, 75);
    scene_surround(scene, 16, white);
    scene_end(scene);
    const double found = mean_radiance(*state, scene, "reference", "normal_mapping=classic", 16);
    assert_true(found > 0.3 && found < 0.75);
    lobe_scene_destroy(&scene);
}

/// Texels that are all alike reflect the sky with a lobe of their own distribution: of GGX, whose
/// black dielectric shows no light but that of its tails.
static void texels_keep_their_distribution(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = white_material(1, 0);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 0;
    material.normal_map = scene_add_map(scene, constant_map(4, 4, 0.5f, 0.5f, 1));
    scene_add_square(scene, &material, 32, NULL);
    double towards[3];
    direction_at(60, 0.3, towards);
    scene_look_from(scene, towards, 0.15);
    scene_surround(scene, 16, white);
    scene_end(scene);
    const double truth = mean_radiance(*state, scene, "direct", closed, 1);
    check_filter(*state, scene, "leadr", truth, 0.03, "a flat black dielectric");
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Suns

/// Opposite the viewer, at its side, behind it, and above.
static void check_suns(fixture *f, const lobe_material *material, double slope, const char *filter,
                       double tolerance) {
    static const double suns[][2] = {{60, 0.3 + M_PI}, {50, 2}, {70, 0.3}, {5, 0}};
    static const double views[] = {0, 75};
    for (int i = 0; i < 8; i++) {
        lobe_scene *scene = bumpy_plane(material, slope, views[i / 4]);
        double towards[3];
        direction_at(suns[i % 4][0], suns[i % 4][1], towards);
        scene_add_sun(scene, towards, 1);
        scene_end(scene);
        char what[96];
        snprintf(what, sizeof what, "slopes of %g, seen at %g degrees, lit at %g", slope,
                 views[i / 4], suns[i % 4][0]);
        const double truth = mean_radiance(f, scene, "reference", closed, 64);
        check_filter(f, scene, filter, truth, tolerance, what);
        lobe_scene_destroy(&scene);
    }
}

/// The bins of "moments" are Gaussian in the Lambert plane, and steep slopes are not.
static void filters_reflect_suns_as_their_texels_do(void **state) {
    const lobe_material dielectric = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.8, 0);
    const lobe_material metal = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.6, 1);
    const lobe_material beckmann = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 1);
    check_suns(*state, &dielectric, 0.7, "moments", 0.03);
    check_suns(*state, &dielectric, 0.7, "leadr", 0.04);
    check_suns(*state, &metal, 0.4, "moments", 0.06);
    check_suns(*state, &metal, 0.7, "moments", 0.12);
    check_suns(*state, &beckmann, 0.4, "leadr", 0.05);
    check_suns(*state, &beckmann, 0.7, "leadr", 0.05);
    check_suns(*state, &metal, 0.4, "leadr", 0.05);
    check_suns(*state, &metal, 0.7, "leadr", 0.05);
}

// ---------------------------------------------------------------------------------------------
// Reciprocity

/// What a square of one tilted texel reflects of a sun of irradiance one.
static double reflected(fixture *f, const double outgoing[3], const double incoming[3]) {
    lobe_scene *scene = scene_begin();
    lobe_material material = white_material(0.5, 0.5);
    material.normal_map = scene_add_map(scene, constant_map(4, 4, 0.72f, 0.4f, 0.93f));
    scene_add_square(scene, &material, 4, NULL);
    scene_add_sun(scene, incoming, 1);
    scene_look_from(scene, outgoing, 0.1);
    scene_end(scene);
    const picture_request request = {
        .filter = "direct", .settings = {closed}, .width = 1, .height = 1};
    lobe_frame frame = draw_scene(f, scene, &request);
    const double value = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return value;
}

static void light_and_viewer_may_change_places(void **state) {
    static const double angles[][2] = {{0, 60}, {20, 40}, {35, 80}, {85, 10}, {75, 78}};
    for (int i = 0; i < 10; i++) {
        double a[3], b[3];
        direction_at(angles[i % 5][0], 0.2 + i, a);
        direction_at(angles[i % 5][1], 2.9 - i, b);
        const double there = reflected(*state, a, b) / b[1], back = reflected(*state, b, a) / a[1];
        assert_true(there > 0);
        if (!(fabs(there - back) <= 1e-4 * there))
            fail_msg("%g and %g degrees: %.6g there, %.6g back", angles[i % 5][0], angles[i % 5][1],
                     there, back);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_white_surface_loses_nothing),
        cmocka_unit_test(samples_lose_nothing),
        cmocka_unit_test(exact_light_is_all_light),
        cmocka_unit_test(filters_with_maps_refuse_exact_light),
        cmocka_unit_test(a_classic_white_surface_loses_light),
        cmocka_unit_test(texels_keep_their_distribution),
        cmocka_unit_test(filters_reflect_suns_as_their_texels_do),
        cmocka_unit_test(light_and_viewer_may_change_places),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
