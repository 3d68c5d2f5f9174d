// The map of slope moments against means in double precision, and what is left of a variance where
// second moments and squared means cancel.

#include <math.h>
#include <stdlib.h>

#include "passes/maps/filtered_maps.h"
#include "passes/maps/slope_moments.h"
#include "shaders/interface/slope_moments.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/map/box_reduction.h"

/// The map of a scene's material, read back: layers within levels. Destroys the scene afterwards.
typedef void (*map_check)(const float *texels, const reduced_map *map,
                          const reference_layers *exact, double tolerance);

static void with_map(fixture *f, lobe_scene *scene, const lobe_material *material,
                     const char *storage, double tolerance, map_check check) {
    scene_end_with_square(scene, material);
    pass_run run;
    pass_run_begin(&run, f, scene, "lean", (const char *[]){storage, NULL});
    const lobe_format format = passes_filtered_map_format(&run.context);
    const reduced_map map = passes_lobe_map(&run.context, 0, &passes_slope_moments, format);
    float *found = pass_run_read(&run, &map, format);
    reference_layers texels = slope_moments_of_texels(scene, material);
    check(found, &map, &texels, tolerance + 8 * fixture_sampler_error(f));
    free(found);
    reference_layers_free(&texels);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

/// Every level and layer.
static void check_all(const float *texel, const reduced_map *map, const reference_layers *texels,
                      double tolerance) {
    assert_int_equal(map->layers, SLOPE_LAYERS);
    check_reduced_levels(map, texel, texels, tolerance, 0);
}

static void odd_sizes_are_averaged_exactly(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 2}, {16, 8}, {67, 45}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
        material.normal_map =
            scene_add_map(scene, random_normal_map(sizes[i][0], sizes[i][1], 1.2, 241 + i));
        with_map(*state, scene, &material, "storage=float32", 2e-5, check_all);
    }
}

/// Maps of different sizes, every distribution, and normals spread inside a texel.
static void widths_are_averaged_as_variances(void **state) {
    for (int distribution = 0; distribution < 4; distribution++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        material.distribution = (lobe_distribution)distribution;
        material.normal_concentration = 200;
        material.normal_scale = 0.7f;
        material.normal_map = scene_add_map(scene, random_normal_map(24, 6, 0.8, 251));
        material.metallic_roughness_map = scene_add_map(scene, random_map(9, 12, 0.1, 1, 252));
        with_map(*state, scene, &material, "storage=float32", 1e-5, check_all);
    }
}

/// Base lobes tilted away from the normal contribute their own slopes, weighted by brightness;
/// those below the horizon count as the steepest slope, and a uniform lobe as kappa = 1.
static void tilted_lobes_give_their_own_slopes(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 30);
    material.lobe_count = 3;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 0, {0.1f, 0.2f, 0.3f}};
    material.lobes[2] = (lobe_base_lobe){{0.8f, 0, -0.6f}, 15, {0.1f, 0.1f, 0.1f}};
    material.normal_map = scene_add_map(scene, random_normal_map(10, 10, 1.2, 253));
    material.width_map = scene_add_map(scene, random_map(20, 5, 0.5, 4, 254));
    with_map(*state, scene, &material, "storage=float32", 1e-5, check_all);
}

/// Texels on the horizon and below it.
static void steep_normals_stay_finite(void **state) {
    static const float normals[4][3] = {
        {1, 0.5f, 0.5f}, {0.5f, 0, 0.25f}, {0.5f, 0.5f, 0}, {0.5f, 1, 0.501f}};
    for (int i = 0; i < 4; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
        material.normal_map =
            scene_add_map(scene, constant_map(4, 4, normals[i][0], normals[i][1], normals[i][2]));
        with_map(*state, scene, &material, "storage=float32", 4e-6, check_all);
        scene = scene_begin();
        material.normal_map =
            scene_add_map(scene, constant_map(4, 4, normals[i][0], normals[i][1], normals[i][2]));
        with_map(*state, scene, &material, "storage=float16", 1e-3, check_all);
    }
}

/// Variance of slopes that the coarsest level leaves, against the exact one, as a part of the
/// variance of base lobes of kappa = 1e4 that it is added to.
static void check_variance(const float *texel, const reduced_map *map,
                           const reference_layers *texels, double tolerance) {
    const float *last = texel;
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 1; level < map->levels; level++) {
        last += (size_t)4 * width * height * SLOPE_LAYERS;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
    double exact[4 * SLOPE_LAYERS];
    reference_mean(texels, exact);
    for (int i = 0; i < 3; i++) {
        int a = i == 1, b = i != 0;
        double found = (double)last[4 + i] - (double)last[a] * (double)last[b];
        double expected = exact[4 + i] - exact[a] * exact[b];
        if (!(fabs(found - expected) <= tolerance * 1e-4))
            fail_msg("moment %d: %.6g instead of %.6g", i, found, expected);
    }
    assert_true(fabs((double)last[3] - exact[3]) <= 1e-3 * exact[3]);
}

/// A tilted plane with little on it, under lobes of kappa = 1e4. In float32 slopes of 1 keep their
/// variance to a fiftieth of the lobes' own. float16 rounds squares of slopes to 5e-4: slopes of
/// 0.1 are good to a tenth.
static void sharp_lobes_survive_cancellation(void **state) {
    static const struct {
        const char *storage;
        double slope, tolerance;
    } cases[] = {{"storage=float32", 1, 0.02}, {"storage=float16", 0.1, 0.1}};
    for (int i = 0; i < 2; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1e4f);
        lobe_image image = random_normal_map(64, 64, 0.02, 255);
        float *texel = image.texels;
        for (int j = 0; j < 64 * 64; j++, texel += 4) {
            double x = 2 * (double)texel[0] - 1, z = 2 * (double)texel[2] - 1;
            double angle = atan(cases[i].slope);
            texel[0] = (float)(0.5 + 0.5 * (x * cos(angle) + z * sin(angle)));
            texel[2] = (float)(0.5 + 0.5 * (z * cos(angle) - x * sin(angle)));
        }
        material.normal_map = scene_add_map(scene, image);
        material.normal_map.nearest = true;
        with_map(*state, scene, &material, cases[i].storage, cases[i].tolerance, check_variance);
    }
}

/// Slopes and their squares of a map of which a mask keeps every third texel, those in the holes
/// being `x`, `y`, `z` as stored.
static float *moments_beside_holes(fixture *f, float x, float y, float z, size_t *count) {
    enum { SIDE = 12 };
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    lobe_image normals = random_normal_map(SIDE, SIDE, 0.05, 171);
    lobe_image colours = map_image(LOBE_FORMAT_RGBA8_UNORM, SIDE, SIDE);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        float *normal = (float *)normals.texels + (size_t)4 * i;
        ((unsigned char *)colours.texels)[(size_t)4 * i + 3] = i % 3 ? 0 : 255;
        if (i % 3) {
            normal[0] = x;
            normal[1] = y;
            normal[2] = z;
        }
    }
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    material.normal_map.nearest = material.base_colour_map.nearest = true;
    material.alpha_mask = true;
    scene_end_with_square(scene, &material);
    pass_run run;
    pass_run_begin(&run, f, scene, "lean", (const char *[]){"storage=float32", NULL});
    const reduced_map map =
        passes_lobe_map(&run.context, 0, &passes_slope_moments, LOBE_FORMAT_RGBA32_FLOAT);
    float *found = pass_run_read(&run, &map, LOBE_FORMAT_RGBA32_FLOAT);
    *count = passes_reduced_map_bytes(&map, LOBE_FORMAT_RGBA32_FLOAT) / sizeof *found;
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
    return found;
}

/// However steep normals are in the holes of a mask, nothing of them is left.
static void holes_are_level(void **state) {
    size_t count;
    float *level = moments_beside_holes(*state, 0.5f, 0.5f, 1, &count);
    float *black = moments_beside_holes(*state, 0, 0, 0, &count);
    for (size_t i = 0; i < count; i++)
        if (level[i] != black[i])
            fail_msg("number %zu: %g beside level holes, %g beside steep ones", i, (double)level[i],
                     (double)black[i]);
    free(level);
    free(black);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(odd_sizes_are_averaged_exactly),
        cmocka_unit_test(widths_are_averaged_as_variances),
        cmocka_unit_test(tilted_lobes_give_their_own_slopes),
        cmocka_unit_test(steep_normals_stay_finite),
        cmocka_unit_test(sharp_lobes_survive_cancellation),
        cmocka_unit_test(holes_are_level),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
