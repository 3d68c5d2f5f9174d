// The filter "leadr" through the whole renderer: against double precision, in the limits where it
// is a known model, its energy and its reciprocity.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/passes/support/slope_shading_reference.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/vector.h"

static const leadr_knobs usual = {5, 2.2, 1, false};

// ---------------------------------------------------------------------------------------------
// Against double precision

static void moments_of(const lobe_material *material, const lobe_image *normals,
                       double moments[8]) {
    lobe_material mapped;
    lobe_scene *scene = slope_plane(material, normals, (double[]){0, 0, 1}, &mapped);
    reference_layers texels = slope_moments_of_texels(scene, &mapped);
    reference_mean(&texels, moments);
    reference_layers_free(&texels);
    lobe_scene_destroy(&scene);
}

/// What texels mirror is a sum over a few of them, found to be up to 4 % off the integral, and 7 %
/// for slopes of 1.4; all else is exact.
static void check_shading(fixture *f, const lobe_material *material, const lobe_image *normals,
                          const leadr_knobs *knobs, const char *setting, const char *what) {
    const bool sums = material->model == LOBE_MATERIAL_MICROFACET && !knobs->flat;
    const double tolerance = !sums ? 1e-3 : knobs->height > 1 ? 0.08 : 0.04;
    double moments[8];
    moments_of(material, normals, moments);
    for (int i = 0; i < 16; i += 3) {
        double outgoing[3], incoming[3], expected[3];
        float found[3];
        slope_plane_pair(i, outgoing, incoming);
        slope_plane_draw_lit(f, material, normals, "leadr", setting, outgoing, incoming, found);
        shade_leadr(material, knobs, moments, outgoing, incoming, expected);
        for (int j = 0; j < 3; j++) {
            if (!(fabs((double)found[j] - expected[j]) <= tolerance * expected[j] + 1e-6))
                fail_msg("%s, from %g to %g degrees, channel %d: %.7g instead of %.7g", what,
                         slope_plane_angles[i % 4], slope_plane_angles[i / 4], j, (double)found[j],
                         expected[j]);
        }
    }
}

static lobe_material two_lobes(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    material.lobe_count = 2;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 15, {0.1f, 0.2f, 0.3f}};
    material.base_colour[1] = 0.5f;
    return material;
}

static void shading_is_that_of_the_moments(void **state) {
    lobe_image rough = random_normal_map(8, 8, 0.7, 271), leaning = slope_plane_leaning_map(272);
    for (int distribution = 0; distribution < 4; distribution++) {
        lobe_material material = microfacet_material((lobe_distribution)distribution, 0.5, 0.3);
        check_shading(*state, &material, &rough, &usual, NULL, "microfacets");
        check_shading(*state, &material, &leaning, &usual, NULL, "leaning microfacets");
    }
    lobe_material material = two_lobes();
    check_shading(*state, &material, &rough, &usual, NULL, "lobes");
    check_shading(*state, &material, &leaning, &usual, NULL, "lobes about leaning normals");
    lobe_image_free(&rough);
    lobe_image_free(&leaning);
}

static void knobs_do_what_they_say(void **state) {
    static const struct {
        const char *setting;
        leadr_knobs knobs;
    } cases[] = {
        {"grid=3", {3, 1.4, 1, false}},   {"grid=7", {7, 2.6, 1, false}},
        {"height=0", {5, 2.2, 0, false}}, {"height=0.5", {5, 2.2, 0.5, false}},
        {"height=4", {5, 2.2, 4, false}}, {"base_plane=surface", {5, 2.2, 1, true}},
    };
    lobe_image leaning = slope_plane_leaning_map(273);
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.5, 0.3);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_shading(*state, &material, &leaning, &cases[i].knobs, cases[i].setting,
                      cases[i].setting);
    lobe_image_free(&leaning);
}

/// With more lights than are gathered at once, each has its own facets.
static void lights_add_up(void **state) {
    enum { LIGHTS = 7 };
    lobe_image rough = random_normal_map(8, 8, 0.7, 274);
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.7, 0), mapped;
    double outgoing[3], incoming[3], sum[3] = {0}, moments[8];
    slope_plane_direction(50, 0.4, outgoing);
    moments_of(&material, &rough, moments);
    lobe_scene *scene = slope_plane(&material, &rough, outgoing, &mapped);
    for (int i = 0; i < LIGHTS; i++) {
        double radiance[3];
        slope_plane_direction(10.0 * i, 1.1 * i, incoming);
        slope_plane_add_sun(scene, incoming, 1 + i);
        shade_leadr(&material, &usual, moments, outgoing, incoming, radiance);
        for (int j = 0; j < 3; j++)
            sum[j] += radiance[j] * (1 + i);
    }
    float found[3];
    slope_plane_draw(*state, scene, "leadr", NULL, found);
    for (int j = 0; j < 3; j++)
        assert_true(fabs((double)found[j] - sum[j]) <= 1e-3 * sum[j]);
    lobe_scene_destroy(&scene);
    lobe_image_free(&rough);
}

// ---------------------------------------------------------------------------------------------
// Limits

/// Largest difference from `direct` over 16 pairs of directions, relative to the value, or to the
/// largest value where that is dark.
static double difference_to_direct(fixture *f, const lobe_material *material,
                                   const float texel[3]) {
    lobe_image image = constant_map(8, 8, texel[0], texel[1], texel[2]);
    double worst = 0;
    float largest = 0, pairs[16][2][3];
    for (int i = 0; i < 16; i += 3) {
        double outgoing[3], incoming[3];
        slope_plane_pair(i, outgoing, incoming);
        slope_plane_draw_lit(f, material, &image, "leadr", NULL, outgoing, incoming, pairs[i][0]);
        slope_plane_draw_lit(f, material, &image, "direct", NULL, outgoing, incoming, pairs[i][1]);
        largest = fmaxf(largest, pairs[i][1][1]);
    }
    for (int i = 0; i < 16; i += 3)
        worst = fmax(worst, fabs((double)pairs[i][0][1] - (double)pairs[i][1][1]) /
                                fmax((double)pairs[i][1][1], 1e-3 * (double)largest));
    lobe_image_free(&image);
    return worst;
}

static const float flat[3] = {0.5f, 0.5f, 1}, tilted[3] = {0.64f, 0.5f, 0.98f};

/// Known limits: without relief, Beckmann microfacets with height-correlated masking, and
/// Lambert.
static void a_flat_footprint_is_the_base_material(void **state) {
    static const double roughnesses[] = {0.2, 0.5, 1};
    for (int i = 0; i < 3; i++) {
        lobe_material material =
            microfacet_material(LOBE_DISTRIBUTION_BECKMANN, roughnesses[i], 0.5);
        double difference = difference_to_direct(*state, &material, flat);
        if (!(difference <= 1e-3))
            fail_msg("roughness %g: %.4g apart", roughnesses[i], difference);
    }
}

/// Facets without a specular part are those of the texel, unmasked, however it is tilted.
static void tilted_lambert_is_lambert(void **state) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    for (int i = 0; i < 3; i++) {
        material.lobes[0].colour[i] = 0;
        material.base_colour[i] = 0.8f;
    }
    assert_true(difference_to_direct(*state, &material, tilted) <= 1e-3);
}

/// Lights about the mirror direction of a leaning normal, up to two widths of the lobe apart from
/// it; the largest difference of `leadr` from `direct` there, as a part of the peak.
static double difference_about_mirror(fixture *f, double roughness, double view) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, roughness, 1);
    lobe_image image = constant_map(8, 8, tilted[0], tilted[1], tilted[2]);
    const double alpha = roughness * roughness, axes[2][3] = {{0.96, 0, -0.28}, {0, 1, 0}};
    double worst = 0, peak = 0;
    for (int i = 0; i < 9; i++) {
        double normal[3] = {0.28, 0, 0.96}, outgoing[3], incoming[3];
        for (int j = 0; j < 3; j++)
            normal[j] += alpha * ((i % 3 - 1) * axes[0][j] + (i / 3 - 1) * axes[1][j]);
        reference_normalise(normal);
        slope_plane_direction(view, 0.4, outgoing);
        double cosine = reference_dot(normal, outgoing);
        for (int j = 0; j < 3; j++)
            incoming[j] = 2 * cosine * normal[j] - outgoing[j];
        if (incoming[2] < 0.1)
            continue;
        float found[3], expected[3];
        slope_plane_draw_lit(f, &material, &image, "leadr", NULL, outgoing, incoming, found);
        slope_plane_draw_lit(f, &material, &image, "direct", NULL, outgoing, incoming, expected);
        worst = fmax(worst, fabs((double)found[1] - (double)expected[1]));
        peak = fmax(peak, (double)expected[1]);
    }
    lobe_image_free(&image);
    return worst / peak;
}

/// A Gaussian over the surface's plane is not one over a leaning plane, and Smith's masking of a
/// height field not that of a turned one: they agree if the lobe is so narrow that one plane's
/// slopes are the other's to first order. The difference is proportional to the lobe's width.
static void a_narrow_lobe_on_a_tilted_plane_is_the_base_material(void **state) {
    static const double roughnesses[] = {0.05, 0.1, 0.2, 0.4};
    for (int i = 0; i < 8; i++) {
        double roughness = roughnesses[i / 2];
        double difference = difference_about_mirror(*state, roughness, i % 2 ? 65 : 10);
        if (!(difference <= fmax(0.24 * roughness * roughness, 1e-3)))
            fail_msg("roughness %g: %.4g of the peak apart", roughness, difference);
    }
}

/// Oren, Nayar, 1994, Generalization of Lambert's Reflectance Model, qualitative model, without
/// its interreflections, of Gaussian facets in V-shaped cavities. Smith's surface has the same
/// facets in other places: the two are close except at grazing angles.
static double oren_nayar(double sigma, const double outgoing[3], const double incoming[3]) {
    double square = sigma * sigma;
    double a = 1 - 0.5 * square / (square + 0.33), b = 0.45 * square / (square + 0.09);
    double planar = outgoing[0] * incoming[0] + outgoing[1] * incoming[1];
    // cos(phi_i - phi_o) sin(alpha) tan(beta), alpha the larger angle.
    double product = fmax(planar, 0) / fmax(incoming[2], outgoing[2]);
    return incoming[2] / M_PI * (a + b * product);
}

static void rough_lambert_is_oren_nayar(void **state) {
    (void)state;
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    for (int i = 0; i < 3; i++) {
        material.lobes[0].colour[i] = 0;
        material.base_colour[i] = 1;
    }
    for (int i = 0; i < 24; i++) {
        double outgoing[3], incoming[3], radiance[3], sigma = 0.1 * (1 + i / 8);
        slope_plane_direction(i % 2 ? 30 : 60, 0, outgoing);
        slope_plane_direction(i / 2 % 2 ? 10 : 40, i / 4 % 2 ? M_PI : 0, incoming);
        const double moments[8] = {0, 0, 1, 1e-6, sigma * sigma, sigma * sigma, 0, 0};
        shade_leadr(&material, &usual, moments, outgoing, incoming, radiance);
        double expected = oren_nayar(sigma, outgoing, incoming);
        if (!(fabs(radiance[1] - expected) <= (0.01 + 0.4 * sigma * sigma) * expected * 2))
            fail_msg("sigma %g, case %d: %.5g instead of %.5g", sigma, i, radiance[1], expected);
    }
}

/// Seen along the light, rough ground is brighter than Lambert's at grazing angles; against it,
/// darker.
static void rough_lambert_looks_back(void **state) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 40);
    for (int i = 0; i < 3; i++) {
        material.lobes[0].colour[i] = 0;
        material.base_colour[i] = 1;
    }
    lobe_image rough = random_normal_map(16, 16, 0.7, 275);
    double lambert = cos(M_PI / 3) / M_PI, outgoing[3], incoming[3];
    float back[3], forth[3];
    slope_plane_direction(60, 0.4, incoming);
    slope_plane_direction(60, 0.4, outgoing);
    slope_plane_draw_lit(*state, &material, &rough, "leadr", NULL, outgoing, incoming, back);
    slope_plane_direction(60, 0.4 + M_PI, outgoing);
    slope_plane_draw_lit(*state, &material, &rough, "leadr", NULL, outgoing, incoming, forth);
    assert_true((double)back[1] > 1.05 * lambert && (double)forth[1] < 0.8 * lambert);
    lobe_image_free(&rough);
}

// ---------------------------------------------------------------------------------------------
// Energy and reciprocity

/// Under uniform light, white dielectrics reflect slightly more than all of it at grazing angles,
/// because the half vector determines what the layer below keeps: a flat surface does the same.
static void no_energy_is_gained(void **state) {
    static const double tilts[] = {0.3, 0.8};
    lobe_image flat = constant_map(1, 1, 0.5f, 0.5f, 1);
    for (int i = 0; i < 12; i++) {
        lobe_image image =
            i % 3 == 2 ? slope_plane_leaning_map(276) : random_normal_map(8, 8, tilts[i % 3], 277);
        lobe_material material =
            microfacet_material(LOBE_DISTRIBUTION_BECKMANN, i % 2 ? 0.4 : 0.9, i < 6 ? 1 : 0);
        for (int j = 0; j < 4; j++) {
            double reflected = slope_plane_furnace(*state, &material, &image, "leadr", NULL,
                                                   slope_plane_angles[j]);
            double most = 1.003;
            if (i >= 6)
                most = 1.01 * fmax(1, slope_plane_furnace(*state, &material, &flat, "reference",
                                                          NULL, slope_plane_angles[j]));
            if (!(reflected > 0.2 && reflected <= most))
                fail_msg("ground %d, material %d, %g degrees: %g of the light comes back", i % 3,
                         i / 3, slope_plane_angles[j], reflected);
        }
        lobe_image_free(&image);
    }
    lobe_image_free(&flat);
}

/// Both parts, over the cosine to the mean normal (or, the same for both, the height above it).
static void light_and_viewer_may_change_places(void **state) {
    lobe_image grounds[2] = {random_normal_map(8, 8, 0.7, 278), slope_plane_leaning_map(279)};
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 0.5);
    for (int i = 0; i < 32; i += 5) {
        double a[3], b[3], moments[8];
        float there[3], back[3];
        const lobe_image *ground = &grounds[i / 16];
        slope_plane_pair(i % 16, a, b);
        moments_of(&material, ground, moments);
        double above_a = a[2] - moments[0] * a[0] - moments[1] * a[1];
        double above_b = b[2] - moments[0] * b[0] - moments[1] * b[1];
        if (above_a < 0.02 || above_b < 0.02)
            continue;
        slope_plane_draw_lit(*state, &material, ground, "leadr", NULL, a, b, there);
        slope_plane_draw_lit(*state, &material, ground, "leadr", NULL, b, a, back);
        double one = (double)there[1] / above_b, other = (double)back[1] / above_a;
        if (!(one > 0 && fabs(one - other) <= 2e-3 * one))
            fail_msg("ground %d, pair %d: %.6g there, %.6g back", i / 16, i % 16, one, other);
    }
    lobe_image_free(&grounds[0]);
    lobe_image_free(&grounds[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shading_is_that_of_the_moments),
        cmocka_unit_test(knobs_do_what_they_say),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(a_flat_footprint_is_the_base_material),
        cmocka_unit_test(tilted_lambert_is_lambert),
        cmocka_unit_test(a_narrow_lobe_on_a_tilted_plane_is_the_base_material),
        cmocka_unit_test(rough_lambert_is_oren_nayar),
        cmocka_unit_test(rough_lambert_looks_back),
        cmocka_unit_test(no_energy_is_gained),
        cmocka_unit_test(light_and_viewer_may_change_places),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
