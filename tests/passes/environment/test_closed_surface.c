// Normal maps as closed surfaces (the knob `normal_mapping`): energy under light from everywhere,
// and reciprocity.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

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
// White furnace

enum { EXTENT = 24 };

/// Normals up to `tilt` radians from the pole, many texels to a pixel.
static lobe_scene *rough_plane(const lobe_material *material, double tilt, double degrees) {
    lobe_scene *scene = scene_begin();
    lobe_material mapped = *material;
    mapped.normal_map = scene_add_map(scene, random_normal_map(64, 64, tilt, 17));
    scene_add_square(scene, &mapped, 32, NULL);
    scene_surround(scene, 16, white);
    double towards[3];
    direction_at(degrees, 0.3, towards);
    scene_look_from(scene, towards, 0.15);
    scene_end(scene);
    return scene;
}

static double mean_radiance(fixture *f, const lobe_scene *scene, const char *filter,
                            const char *normal_mapping) {
    picture_request request = {.filter = filter,
                               .settings = {normal_mapping, "scattering=multiple", "env_size=16"},
                               .width = EXTENT,
                               .height = EXTENT,
                               .samples = 16};
    lobe_frame frame = draw_scene(f, scene, &request);
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        sum += (double)pixel_at(&frame.radiance, i % EXTENT, i / EXTENT)[1];
    lobe_frame_free(&frame);
    return sum / (EXTENT * EXTENT);
}

/// Filters draw it as bright as the reference does.
static void check_filters(fixture *f, const lobe_scene *scene, double truth, const char *what) {
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        if (!has_knob(filter, "normal_mapping"))
            continue;
        const double found = mean_radiance(f, scene, lobe_filter_name(filter), closed);
        if (!(fabs(found - truth) <= 0.05 * truth))
            fail_msg("%s, %s: %g instead of %g", lobe_filter_name(filter), what, found, truth);
    }
}

static void check_furnace(fixture *f, const lobe_material *material, double tilt, double degrees) {
    lobe_scene *scene = rough_plane(material, tilt, degrees);
    char what[96];
    snprintf(what, sizeof what, "metallic %g, roughness %g, tilt %g, %g degrees",
             (double)material->metallic, (double)material->roughness, tilt, degrees);
    const double truth = mean_radiance(f, scene, "reference", closed);
    if (!(fabs(truth - 1) <= 0.04))
        fail_msg("%s: reflects %g of the light", what, truth);
    check_filters(f, scene, truth, what);
    lobe_scene_destroy(&scene);
}

/// Measured: 0.97 to 1.03.
static void a_closed_white_surface_loses_nothing(void **state) {
    static const double angles[] = {0, 60, 75}, tilts[] = {0.3, 0.9}, roughnesses[] = {0.2, 0.6};
    for (int i = 0; i < 12; i++) {
        const lobe_material metal = white_material(roughnesses[i / 6], 1);
        check_furnace(*state, &metal, tilts[i / 3 % 2], angles[i % 3]);
    }
    for (int i = 0; i < 6; i++) {
        const lobe_material dielectric = white_material(0.8, 0);
        check_furnace(*state, &dielectric, tilts[i / 3], angles[i % 3]);
    }
}

/// The surface that classic normal mapping means is darker.
static void a_classic_white_surface_loses_light(void **state) {
    const lobe_material metal = white_material(0.2, 1);
    lobe_scene *scene = rough_plane(&metal, 0.9, 75);
    const double found = mean_radiance(*state, scene, "reference", "normal_mapping=classic");
    assert_true(found > 0.3 && found < 0.75);
    lobe_scene_destroy(&scene);
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
        cmocka_unit_test(a_classic_white_surface_loses_light),
        cmocka_unit_test(light_and_viewer_may_change_places),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
