// Filtered maps are means of the surface that shading sees: maps interpolated between texels, with
// their own wrapping, and normals made unit length after that. Against means over many points of
// each texel.

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/maps/parameter_averaging.h"
#include "passes/maps/slope_moments.h"
#include "shaders/interface/slope_moments.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/microfacet/slope_distribution.h"

/// Means over a texel, in the layers of slope_moments, and the mean normal in a third.
enum { MEAN_NORMAL = SLOPE_LAYERS, ALL_LAYERS, POINTS_ACROSS = 24 };

static void add_point(const lobe_material *material, const double normal[3], const double width[4],
                      const reference_layers *means, uint32_t x, uint32_t y) {
    const double part = 1.0 / (POINTS_ACROSS * POINTS_ACROSS);
    double *first = reference_texel(means, x, y, SLOPE_LAYER_FIRST);
    double *second = reference_texel(means, x, y, SLOPE_LAYER_SECOND);
    double *mean = reference_texel(means, x, y, MEAN_NORMAL), slope[2];
    reference_slope_of_normal(normal, slope);
    for (int i = 0; i < 2; i++) {
        first[i] += part * slope[i];
        second[i] += part * slope[i] * slope[i];
    }
    second[2] += part * slope[0] * slope[1];
    first[3] += part / base_lobe_concentration(material, 0, width);
    for (int i = 0; i < 3; i++)
        mean[i] += part * normal[i];
}

/// Of a grid of points in each texel.
static reference_layers surface_of(const lobe_scene *scene, const lobe_material *material) {
    reference_layers means = allocate_lobe_texels(scene, material, ALL_LAYERS);
    const uint32_t columns = means.width * POINTS_ACROSS, rows = means.height * POINTS_ACROSS;
    for (uint32_t i = 0; i < columns * rows; i++) {
        double normal[3], width[4];
        uint32_t column = i % columns, row = i / columns;
        read_surface(scene, material, (column + 0.5) / columns, (row + 0.5) / rows, normal, width);
        add_point(material, normal, width, &means, column / POINTS_ACROSS, row / POINTS_ACROSS);
    }
    return means;
}

/// Level 0 and the last level of a map.
typedef struct map_ends {
    uint32_t width, height, layers; ///< of level 0
    float *first;                   ///< level 0, layer after layer, then the others; to be freed
    float last[4 * SLOPE_LAYERS];
} map_ends;

static map_ends make_map(fixture *f, lobe_scene *scene, const char *name,
                         const lobe_map_kind *kind) {
    pass_run run;
    pass_run_begin(&run, f, scene, name, (const char *[]){"storage=float32", NULL});
    const reduced_map map = passes_lobe_map(&run.context, 0, kind, LOBE_FORMAT_RGBA32_FLOAT);
    float *texels = pass_run_read(&run, &map, LOBE_FORMAT_RGBA32_FLOAT);
    map_ends ends = {
        .width = map.width, .height = map.height, .layers = map.layers, .first = texels};
    const size_t last = (size_t)4 * map.layers;
    const size_t count = passes_reduced_map_bytes(&map, LOBE_FORMAT_RGBA32_FLOAT) / sizeof *texels;
    memcpy(ends.last, texels + count - last, last * sizeof *texels);
    pass_run_end(&run);
    return ends;
}

static lobe_material metal(void) {
    lobe_material material;
    lobe_material_default(&material);
    return material;
}

/// Asserts that a mean is within a part of a scale.
static void check(const char *what, double found, double exact, double scale, double tolerance) {
    if (!(fabs(found - exact) <= tolerance * scale))
        fail_msg("%s: %.6g instead of %.6g", what, found, exact);
}

/// Means over the whole map. Two points a texel are exact for squares of what is interpolated, and
/// off where normals are made unit length after that.
static void means_of_steep_and_gentle_maps(void **state) {
    static const struct {
        double tilt, squares, complement;
    } cases[] = {{0.1, 0.003, 0.01}, {0.4, 0.003, 0.02}, {1, 0.02, 0.05}};
    for (uint32_t i = 0; i < 6; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = metal();
        material.normal_map = scene_add_map(
            scene, random_normal_map(16, i % 2 ? 16 : 11, cases[i / 2].tilt, 501 + i));
        scene_end_with_square(scene, &material);
        reference_layers surface = surface_of(scene, &material);
        double exact[4 * ALL_LAYERS];
        reference_mean(&surface, exact);
        map_ends slopes = make_map(*state, scene, "lean", &passes_slope_moments);
        const double square = exact[4] + exact[5], tolerance = cases[i / 2].squares;
        check("xx", (double)slopes.last[4], exact[4], square, tolerance);
        check("yy", (double)slopes.last[5], exact[5], square, tolerance);
        check("xy", (double)slopes.last[6], exact[6], square, tolerance);
        map_ends means = make_map(*state, scene, "toksvig", &passes_averaged_parameters);
        double found = 0, truth = 0;
        for (int j = 0; j < 3; j++) {
            found += (double)means.last[j] * (double)means.last[j];
            truth += exact[4 * MEAN_NORMAL + j] * exact[4 * MEAN_NORMAL + j];
        }
        check("1 - |mean normal|", 1 - sqrt(found), 1 - sqrt(truth), 1 - sqrt(truth),
              cases[i / 2].complement);
        free(slopes.first);
        free(means.first);
        reference_layers_free(&surface);
        lobe_scene_destroy(&scene);
    }
}

/// The first level's own boxes: the mean slope, and the second moment.
static void first_levels_are_local(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = metal();
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.5, 511));
    scene_end_with_square(scene, &material);
    reference_layers surface = surface_of(scene, &material), boxes = reference_reduce(&surface);
    map_ends slopes = make_map(*state, scene, "lean", &passes_slope_moments);
    const uint32_t count = boxes.width * boxes.height;
    double errors[2] = {0}, squares[2] = {0};
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t layer = 0; layer < 2; layer++) {
            double exact = *reference_texel(&boxes, i % boxes.width, i / boxes.width, layer);
            double error = (double)slopes.first[4 * (layer * count + i)] - exact;
            errors[layer] += error * error;
            squares[layer] += exact * exact;
        }
    }
    double mean = sqrt(errors[0] / squares[0]), square = sqrt(errors[1] / squares[1]);
    print_message("# of a box: mean slope %.3g off, second moment %.3g\n", mean, square);
    assert_true(mean < 0.08 && square < 0.06);
    free(slopes.first);
    reference_layers_free(&boxes);
    reference_layers_free(&surface);
    lobe_scene_destroy(&scene);
}

/// Of four by four texels, much depends on what lies beyond the edges.
static void edges_are_wrapped_as_the_sampler_says(void **state) {
    for (int wrap = LOBE_SCENE_WRAP_REPEAT; wrap <= LOBE_SCENE_WRAP_CLAMP; wrap++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = metal();
        material.normal_map = scene_add_map(scene, random_normal_map(4, 4, 0.4, 521));
        material.normal_map.wrap_u = (lobe_scene_wrap)wrap;
        material.normal_map.wrap_v = LOBE_SCENE_WRAP_CLAMP;
        scene_end_with_square(scene, &material);
        map_ends slopes = make_map(*state, scene, "lean", &passes_slope_moments);
        reference_layers same = surface_of(scene, &material);
        double exact[4 * ALL_LAYERS], other[4 * ALL_LAYERS];
        reference_mean(&same, exact);
        check("xx", (double)slopes.last[4], exact[4], exact[4], 0.04);
        check("yy", (double)slopes.last[5], exact[5], exact[5], 0.04);
        // Mirrored and clamped texels differ from repeated ones, and are themselves alike.
        material.normal_map.wrap_u =
            wrap == LOBE_SCENE_WRAP_REPEAT ? LOBE_SCENE_WRAP_CLAMP : LOBE_SCENE_WRAP_REPEAT;
        reference_layers different = surface_of(scene, &material);
        reference_mean(&different, other);
        assert_true(fabs(other[4] - exact[4]) > 0.1 * exact[4]);
        free(slopes.first);
        reference_layers_free(&same);
        reference_layers_free(&different);
        lobe_scene_destroy(&scene);
    }
}

/// Facets with nothing between them keep all of their variance.
static void texels_that_are_not_interpolated_are_facets(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = metal();
    material.normal_map = scene_add_map(scene, random_normal_map(20, 20, 0.6, 531));
    material.normal_map.nearest = true;
    scene_end_with_square(scene, &material);
    reference_layers texels = slope_moments_of_texels(scene, &material);
    map_ends slopes = make_map(*state, scene, "lean", &passes_slope_moments);
    double exact[4 * SLOPE_LAYERS];
    reference_mean(&texels, exact);
    for (int i = 4; i < 7; i++)
        check("a moment", (double)slopes.last[i], exact[i], exact[4], 1e-5);
    free(slopes.first);
    reference_layers_free(&texels);
    lobe_scene_destroy(&scene);
}

/// Roughness is interpolated too, whether or not the normals are, whose map is coarser.
static void widths_are_interpolated(void **state) {
    for (int nearest = 0; nearest < 2; nearest++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = metal();
        material.normal_map = scene_add_map(scene, random_normal_map(12, 8, 0.2, 541));
        material.normal_map.nearest = nearest;
        material.metallic_roughness_map = scene_add_map(scene, random_map(24, 24, 0.2, 1, 542));
        scene_end_with_square(scene, &material);
        reference_layers surface = surface_of(scene, &material);
        map_ends slopes = make_map(*state, scene, "lean", &passes_slope_moments);
        double exact[4 * ALL_LAYERS];
        reference_mean(&surface, exact);
        check("base variance", (double)slopes.last[3], exact[3], exact[3], 0.015);
        // The points of the finer map are not the best ones for the coarser.
        check("xx", (double)slopes.last[4], exact[4], exact[4], 0.04);
        free(slopes.first);
        reference_layers_free(&surface);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means_of_steep_and_gentle_maps),
        cmocka_unit_test(first_levels_are_local),
        cmocka_unit_test(edges_are_wrapped_as_the_sampler_says),
        cmocka_unit_test(texels_that_are_not_interpolated_are_facets),
        cmocka_unit_test(widths_are_interpolated),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
