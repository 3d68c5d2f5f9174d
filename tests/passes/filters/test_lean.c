// The filter "lean" through the whole renderer: against double precision, against the base material
// where a footprint has one normal, and in a white furnace.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/passes/support/slope_shading_reference.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/vector.h"

static const double angles[] = {0, 35, 65, 80};

/// One light and one viewer for each pair of angles, in different planes.
static void check_shading(fixture *f, const lobe_material *material, const lobe_image *normals,
                          const char *what) {
    for (int i = 0; i < 16; i += 3) {
        double outgoing[3], incoming[3], expected[3], moments[8];
        slope_plane_direction(angles[i / 4], 0.4, outgoing);
        slope_plane_direction(angles[i % 4], 0.4 + 0.7 * i, incoming);
        lobe_material mapped;
        lobe_scene *scene = slope_plane(material, normals, outgoing, &mapped);
        slope_plane_add_sun(scene, incoming, 1);
        reference_layers texels = slope_moments_of_texels(scene, &mapped);
        reference_mean(&texels, moments);
        reference_layers_free(&texels);
        shade_lean(&mapped, moments, outgoing, incoming, expected);
        float found[3];
        slope_plane_draw(f, scene, "lean", NULL, found);
        for (int j = 0; j < 3; j++) {
            if (!(fabs((double)found[j] - expected[j]) <= 1e-3 * expected[j] + 1e-6))
                fail_msg("%s, from %g to %g degrees, channel %d: %.7g instead of %.7g", what,
                         angles[i % 4], angles[i / 4], j, (double)found[j], expected[j]);
        }
        lobe_scene_destroy(&scene);
    }
}

static void shading_is_that_of_the_moments(void **state) {
    lobe_image rough = random_normal_map(8, 8, 0.7, 261);
    lobe_image leaning = slope_plane_leaning_map(262);
    for (int distribution = 0; distribution < 4; distribution++) {
        lobe_material material = microfacet_material((lobe_distribution)distribution, 0.5, 0.3);
        check_shading(*state, &material, &rough, "microfacets");
        check_shading(*state, &material, &leaning, "leaning microfacets");
    }
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    material.lobe_count = 2;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 15, {0.1f, 0.2f, 0.3f}};
    material.base_colour[1] = 0.5f;
    check_shading(*state, &material, &rough, "lobes");
    check_shading(*state, &material, &leaning, "lobes about leaning normals");
    lobe_image_free(&rough);
    lobe_image_free(&leaning);
}

/// A footprint of one normal reflects as the base material does, wherever that normal points.
static void one_normal_is_the_base_material(void **state) {
    static const float texels[3][3] = {{0.5f, 0.5f, 1}, {0.64f, 0.5f, 0.98f}, {0.3f, 0.74f, 0.92f}};
    static const double roughnesses[] = {0.2, 0.5, 1};
    for (int i = 0; i < 9; i++) {
        lobe_material material =
            microfacet_material(LOBE_DISTRIBUTION_BECKMANN, roughnesses[i % 3], 0.5);
        lobe_image image = constant_map(8, 8, texels[i / 3][0], texels[i / 3][1], texels[i / 3][2]);
        for (int j = 0; j < 16; j++) {
            double outgoing[3], incoming[3];
            slope_plane_direction(angles[j / 4], 0.4, outgoing);
            slope_plane_direction(angles[j % 4], 0.4 + 0.7 * j, incoming);
            lobe_material mapped;
            float found[3], expected[3];
            lobe_scene *scene = slope_plane(&material, &image, outgoing, &mapped);
            slope_plane_add_sun(scene, incoming, 1);
            slope_plane_draw(*state, scene, "lean", NULL, found);
            slope_plane_draw(*state, scene, "direct", NULL, expected);
            for (int k = 0; k < 3; k++) {
                if (!(fabsf(found[k] - expected[k]) <= 1e-3f * expected[k] + 1e-6f))
                    fail_msg("normal %d, roughness %g, from %g to %g degrees: %.7g instead of %.7g",
                             i / 3, roughnesses[i % 3], angles[j % 4], angles[j / 4],
                             (double)found[k], (double)expected[k]);
            }
            lobe_scene_destroy(&scene);
        }
        lobe_image_free(&image);
    }
}

static lobe_material furnace_material(int number) {
    return microfacet_material(LOBE_DISTRIBUTION_BECKMANN, number % 2 ? 0.4 : 0.9, number / 2);
}

/// What flat ground may reflect at most, by material and angle.
static void find_limits(fixture *f, double most[4][4]) {
    lobe_image flat = constant_map(1, 1, 0.5f, 0.5f, 1);
    for (int i = 0; i < 4; i++) {
        const lobe_material material = furnace_material(i);
        for (int j = 0; j < 4; j++)
            most[i][j] = 1.003 * fmax(1, slope_plane_furnace(f, &material, &flat, "reference", NULL,
                                                             angles[j]));
    }
    lobe_image_free(&flat);
}

/// Under uniform light, a rough and tilted surface reflects no more than arrives, or no more than
/// a flat one does: white dielectrics reflect slightly more at grazing angles.
static void no_energy_is_gained(void **state) {
    static const double tilts[] = {0.3, 0.8};
    double most[4][4];
    find_limits(*state, most);
    for (int i = 0; i < 12; i++) {
        const int ground = i % 3, number = i / 3;
        lobe_image image = ground == 2 ? slope_plane_leaning_map(264)
                                       : random_normal_map(8, 8, tilts[ground], 263);
        const lobe_material material = furnace_material(number);
        for (int j = 0; j < 4; j++) {
            const double reflected = slope_plane_furnace(*state, &material, &image, "lean", NULL,
                                                         angles[j]),
                         texels = slope_plane_furnace(*state, &material, &image, "reference", NULL,
                                                      angles[j]);
            if (!(reflected > 0.7 * texels && reflected <= most[number][j]))
                fail_msg("ground %d, material %d, %g degrees: %g of the light comes back, from "
                         "texels %g",
                         ground, number, angles[j], reflected, texels);
        }
        lobe_image_free(&image);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shading_is_that_of_the_moments),
        cmocka_unit_test(one_normal_is_the_base_material),
        cmocka_unit_test(no_energy_is_gained),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
