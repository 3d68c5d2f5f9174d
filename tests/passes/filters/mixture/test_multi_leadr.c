// The filter "multi_leadr": against double precision where its components are known, against
// "leadr" where it has one, its energy and its reciprocity.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/passes/support/slope_shading_reference.h"
#include "tests/reference/microfacet/slope_distribution.h"
#include "tests/reference/vector.h"

enum { EXTENT = 8 };

static const leadr_knobs usual = {5, 2.2, 1, false};

// ---------------------------------------------------------------------------------------------
// Known components

/// Rows of texels of one normal each.
typedef struct ground {
    const char *name;
    int count;
    double slopes[4][2];
    int rows[4]; ///< of EXTENT
} ground;

static const ground grounds[] = {
    {"flat", 1, {{0, 0}}, {8}},
    {"two slopes", 2, {{0.5, 0.1}, {-0.7, 0.2}}, {5, 3}},
    {"roofs", 2, {{1.2, 0}, {-1.2, 0}}, {4, 4}},
    {"pyramids and joints", 4, {{0, 0}, {0.9, 0}, {-0.5, 0.8}, {-0.4, -0.9}}, {2, 3, 1, 2}},
    {"leaning", 3, {{0.4, 0.4}, {1.1, 0.2}, {0.3, 1.0}}, {3, 3, 2}},
};

static lobe_image map_of(const ground *g) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    float *texel = map.texels;
    for (int i = 0; i < g->count; i++) {
        double normal[3];
        reference_normal_of_slope(g->slopes[i], normal);
        for (int k = 0; k < g->rows[i] * EXTENT; k++, texel += 4) {
            for (int axis = 0; axis < 3; axis++)
                texel[axis] = (float)(0.5 + 0.5 * normal[axis]);
            texel[3] = 1;
        }
    }
    return map;
}

static void components_of(const ground *g, double variance, slope_component *components) {
    for (int i = 0; i < g->count; i++) {
        const double *s = g->slopes[i];
        const slope_component own = {
            (double)g->rows[i] / EXTENT,
            {s[0], s[1], 1, variance, s[0] * s[0], s[1] * s[1], s[0] * s[1], 0}};
        components[i] = own;
    }
}

static void check_ground(fixture *f, const lobe_material *material, const ground *g,
                         double variance) {
    // What texels mirror is a sum over a few of them.
    const double tolerance = material->model == LOBE_MATERIAL_MICROFACET ? 0.04 : 3e-3;
    lobe_image map = map_of(g);
    slope_component components[4];
    components_of(g, variance, components);
    for (int i = 0; i < 16; i += 3) {
        double outgoing[3], incoming[3], expected[3];
        float found[3];
        slope_plane_pair(i, outgoing, incoming);
        slope_plane_draw_lit(f, material, &map, "multi_leadr", "storage=float32", outgoing,
                             incoming, found);
        shade_multi_leadr(material, &usual, components, g->count, outgoing, incoming, expected);
        for (int k = 0; k < 3; k++)
            if (!(fabs((double)found[k] - expected[k]) <= tolerance * expected[k] + 1e-5))
                fail_msg("%s, from %g to %g degrees, channel %d: %.7g instead of %.7g", g->name,
                         slope_plane_angles[i % 4], slope_plane_angles[i / 4], k, (double)found[k],
                         expected[k]);
    }
    lobe_image_free(&map);
}

static void shading_is_that_of_the_components(void **state) {
    for (size_t i = 0; i < sizeof grounds / sizeof *grounds; i++) {
        const double roughness = 0.6, alpha = roughness * roughness;
        lobe_material facets =
            microfacet_material(LOBE_DISTRIBUTION_BECKMANN, roughness, i % 2 ? 1 : 0);
        check_ground(*state, &facets, &grounds[i], alpha * alpha / 2);
        facets.distribution = LOBE_DISTRIBUTION_GGX;
        check_ground(*state, &facets, &grounds[i], alpha * alpha / 2);
        lobe_material lobes = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
        check_ground(*state, &lobes, &grounds[i], 1.0 / 30);
    }
}

/// Seen from above nothing is hidden, so that how heights of diffuse facets are correlated makes no
/// difference.
static void one_component_is_leadr(void **state) {
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.5, 0.3);
    lobe_image rough = random_normal_map(EXTENT, EXTENT, 0.7, 271);
    const double outgoing[3] = {0, 0, 1};
    for (int i = 0; i < 4; i++) {
        double incoming[3];
        float found[3], expected[3];
        slope_plane_direction(slope_plane_angles[i], 0.9, incoming);
        slope_plane_draw_lit(*state, &material, &rough, "multi_leadr", "components=1", outgoing,
                             incoming, found);
        slope_plane_draw_lit(*state, &material, &rough, "leadr", NULL, outgoing, incoming,
                             expected);
        for (int k = 0; k < 3; k++)
            if (!(fabsf(found[k] - expected[k]) <= 4e-3f * expected[k] + 1e-6f))
                fail_msg("%g degrees: %.7g instead of %.7g", slope_plane_angles[i],
                         (double)found[k], (double)expected[k]);
    }
    lobe_image_free(&rough);
}

/// `height` makes normals of scaled relief.
static void height_scales_relief(void **state) {
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 1);
    ground half = grounds[3];
    for (int i = 0; i < half.count; i++)
        for (int axis = 0; axis < 2; axis++)
            half.slopes[i][axis] *= 0.5;
    lobe_image whole = map_of(&grounds[3]), scaled = map_of(&half);
    for (int i = 1; i < 16; i += 5) {
        double outgoing[3], incoming[3];
        float found[3], expected[3];
        slope_plane_pair(i, outgoing, incoming);
        slope_plane_draw_lit(*state, &material, &whole, "multi_leadr", "height=0.5", outgoing,
                             incoming, found);
        slope_plane_draw_lit(*state, &material, &scaled, "multi_leadr", NULL, outgoing, incoming,
                             expected);
        assert_float_equal(found[1], expected[1], 5e-3f * expected[1] + 1e-5f);
    }
    lobe_image_free(&whole);
    lobe_image_free(&scaled);
}

// ---------------------------------------------------------------------------------------------
// Energy and reciprocity

static double random_number(uint32_t *seed, double low, double high) {
    return low + (high - low) * passes_hashed_number(++*seed);
}

static void random_components(uint32_t *seed, int count, slope_component *components) {
    double whole = 0;
    for (int i = 0; i < count; i++) {
        double *m = components[i].moments;
        const double x = random_number(seed, 0.01, 1), y = random_number(seed, 0.01, 1);
        const double correlation = random_number(seed, -0.95, 0.95);
        whole += components[i].part = random_number(seed, 0.05, 1);
        m[0] = random_number(seed, -1, 1);
        m[1] = random_number(seed, -1, 1);
        m[2] = 1;
        m[3] = 0;
        m[4] = x * x + m[0] * m[0];
        m[5] = y * y + m[1] * m[1];
        m[6] = correlation * x * y + m[0] * m[1];
    }
    for (int i = 0; i < count; i++)
        components[i].part /= whole;
}

/// Of a height above facets that is normally distributed, what is above zero: by the midpoint rule.
static double integrated_area(const slope_component *component, const double direction[3]) {
    const double *m = component->moments;
    const double mean = direction[2] - m[0] * direction[0] - m[1] * direction[1];
    const double variance = (m[4] - m[0] * m[0]) * direction[0] * direction[0] +
                            (m[5] - m[1] * m[1]) * direction[1] * direction[1] +
                            2 * (m[6] - m[0] * m[1]) * direction[0] * direction[1];
    const double deviation = sqrt(fmax(variance, 0)), step = 0.01;
    double sum = 0;
    for (int i = -800; i < 800; i++) {
        const double z = step * (i + 0.5);
        sum += step * exp(-z * z / 2) / sqrt(2 * M_PI) * fmax(mean + deviation * z, 0);
    }
    return sum;
}

/// Dupuy et al. 2013, Eq. 2: what is visible has the projected area of the mean plane.
static void masking_keeps_the_projected_area(void **state) {
    uint32_t seed = 0;
    int checked = 0;
    (void)state;
    while (checked < 1000) {
        const int count = checked % 2 ? 4 : 1;
        slope_component components[4];
        double direction[3], height = 0, visible = 0;
        random_components(&seed, count, components);
        slope_plane_direction(random_number(&seed, 0, 89), random_number(&seed, 0, 6.28),
                              direction);
        for (int i = 0; i < count; i++)
            height += components[i].part * (direction[2] - components[i].moments[0] * direction[0] -
                                            components[i].moments[1] * direction[1]);
        if (height < 0.01)
            continue;
        for (int i = 0; i < count; i++)
            visible += components[i].part * integrated_area(&components[i], direction);
        visible /= multi_leadr_area_ratio(components, count, direction) * height;
        if (!(fabs(visible - 1) < 1e-3))
            fail_msg("case %d: %g of the projected area", checked, visible);
        checked++;
    }
}

static void no_energy_is_gained(void **state) {
    for (size_t i = 0; i < sizeof grounds / sizeof *grounds; i++) {
        lobe_image map = map_of(&grounds[i]);
        for (int k = 0; k < 8; k++) {
            const double roughness = k % 2 ? 0.4 : 0.9;
            lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, roughness, 1);
            for (int c = 0; c < 3; c++)
                material.base_colour[c] = 1;
            const double reflected = slope_plane_furnace(*state, &material, &map, "multi_leadr",
                                                         NULL, slope_plane_angles[k / 2]);
            // What leans away from the viewer is behind its mean plane, and dark.
            const double least = strcmp(grounds[i].name, "leaning") == 0 ? 0 : 0.04;
            if (!(reflected >= least && reflected <= 1.003))
                fail_msg("%s, roughness %g, %g degrees: %g of the light comes back",
                         grounds[i].name, roughness, slope_plane_angles[k / 2], reflected);
        }
        lobe_image_free(&map);
    }
}

/// Over the heights above the mean plane.
static void light_and_viewer_may_change_places(void **state) {
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 0.5);
    for (size_t n = 1; n < sizeof grounds / sizeof *grounds; n++) {
        const ground *g = &grounds[n];
        lobe_image map = map_of(g);
        for (int i = 1; i < 16; i += 5) {
            double a[3], b[3], above_a = 0, above_b = 0;
            float there[3], back[3];
            slope_plane_pair(i, a, b);
            for (int k = 0; k < g->count; k++) {
                const double part = (double)g->rows[k] / EXTENT, *s = g->slopes[k];
                above_a += part * (a[2] - s[0] * a[0] - s[1] * a[1]);
                above_b += part * (b[2] - s[0] * b[0] - s[1] * b[1]);
            }
            if (above_a < 0.05 || above_b < 0.05)
                continue;
            slope_plane_draw_lit(*state, &material, &map, "multi_leadr", NULL, a, b, there);
            slope_plane_draw_lit(*state, &material, &map, "multi_leadr", NULL, b, a, back);
            const double one = (double)there[1] / above_b, other = (double)back[1] / above_a;
            if (!(one > 0 && fabs(one - other) <= 4e-3 * one))
                fail_msg("%s, pair %d: %.6g there, %.6g back", g->name, i, one, other);
        }
        lobe_image_free(&map);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shading_is_that_of_the_components),
        cmocka_unit_test(one_component_is_leadr),
        cmocka_unit_test(height_scales_relief),
        cmocka_unit_test(masking_keeps_the_projected_area),
        cmocka_unit_test(no_energy_is_gained),
        cmocka_unit_test(light_and_viewer_may_change_places),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
