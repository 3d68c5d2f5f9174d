// The naive filter's map against means in double precision: normals and widths averaged as if they
// were colours; and under a mask, against counts of what it keeps.

#include <math.h>
#include <stdlib.h>

#include "passes/maps/parameter_averaging.h"
#include "tests/passes/support/map_reference.h"
#include "tests/passes/support/mask_reference.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/map/box_reduction.h"

static void check_map(const float *texel, const reduced_map *map, const reference_layers *texels,
                      double sampler_error) {
    reference_layers exact = reference_reduce(texels);
    assert_int_equal(map->width, exact.width);
    assert_int_equal(map->height, exact.height);
    for (uint32_t level = 0; level < map->levels; level++) {
        for (uint32_t i = 0; i < exact.width * exact.height; i++, texel += 4) {
            const double *expected = reference_texel(&exact, i % exact.width, i / exact.width, 0);
            for (int channel = 0; channel < 4; channel++) {
                double bound = channel < 3 ? 2e-6 : 1e-5 * fabs(expected[3]);
                double sampled = sampler_error * fmax(1, fabs(expected[channel]));
                if (!(fabs((double)texel[channel] - expected[channel]) <= bound + sampled))
                    fail_msg("level %u, texel %u, channel %d: %.8g instead of %.8g", level, i,
                             channel, (double)texel[channel], expected[channel]);
            }
        }
        reference_layers next = reference_reduce(&exact);
        reference_layers_free(&exact);
        exact = next;
    }
    reference_layers_free(&exact);
}

static void check_scene(fixture *f, lobe_scene *scene, const lobe_material *material) {
    scene_end_with_square(scene, material);
    pass_run run;
    pass_run_begin(&run, f, scene, "mipmap", (const char *[]){"storage=float32", NULL});
    const reduced_map map =
        passes_lobe_map(&run.context, 0, &passes_averaged_parameters, LOBE_FORMAT_RGBA32_FLOAT);
    float *found = pass_run_read(&run, &map, LOBE_FORMAT_RGBA32_FLOAT);
    reference_layers texels = averaged_parameters_of_texels(scene, material);
    check_map(found, &map, &texels, fixture_sampler_error(f));
    free(found);
    reference_layers_free(&texels);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

static void odd_sizes_are_averaged_exactly(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {2, 2}, {16, 8}, {67, 45}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
        material.normal_map =
            scene_add_map(scene, random_normal_map(sizes[i][0], sizes[i][1], 1, 141 + i));
        check_scene(*state, scene, &material);
    }
}

/// Maps of different sizes, every distribution, and normals that vary inside a texel.
static void widths_are_averaged_as_concentrations(void **state) {
    for (int distribution = 0; distribution < 4; distribution++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        material.distribution = (lobe_distribution)distribution;
        material.normal_concentration = 200;
        material.normal_scale = 0.7f;
        material.normal_map = scene_add_map(scene, random_normal_map(24, 6, 0.8, 151));
        material.metallic_roughness_map = scene_add_map(scene, random_map(9, 12, 0.1, 1, 152));
        check_scene(*state, scene, &material);
    }
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(10, 10, 0.8, 153));
    material.width_map = scene_add_map(scene, random_map(20, 5, 0.5, 4, 154));
    check_scene(*state, scene, &material);
}

// ---------------------------------------------------------------------------------------------
// Masks

enum { MASKED = 16, POINTS_A_SIDE = 24 };

static double alpha_at(const lobe_scene *scene, const lobe_material *material, double u, double v) {
    double colour[4];
    reference_map_value(scene, &material->base_colour_map, u, v, colour);
    return colour[3];
}

/// Adds the part of a square that the mask keeps, (0, 0) to (1, 1) the map: its mean normal times
/// its share, and that.
static void add_kept(const lobe_scene *scene, const lobe_material *material, double u, double v,
                     double side, double kept[4]) {
    for (int i = 0; i < POINTS_A_SIDE * POINTS_A_SIDE; i++) {
        const double x = u + side * (i % POINTS_A_SIDE + 0.5) / POINTS_A_SIDE;
        const double y = v + side * (i / POINTS_A_SIDE + 0.5) / POINTS_A_SIDE; // NOLINT
        double normal[3], width[4];
        if (alpha_at(scene, material, x, y) < (double)material->alpha_cutoff)
            continue;
        read_surface(scene, material, x, y, normal, width);
        for (int axis = 0; axis < 3; axis++)
            kept[axis] += normal[axis] / (POINTS_A_SIDE * POINTS_A_SIDE);
        kept[3] += 1.0 / (POINTS_A_SIDE * POINTS_A_SIDE);
    }
}

/// The root of the mean squared error of mean slopes, and that of mean shares, over all texels.
static void check_kept(const lobe_scene *scene, const lobe_material *material, const float *normals,
                       const float *shares) {
    const uint32_t side = MASKED / 2;
    double squares = 0, error = 0, share_error = 0;
    for (uint32_t i = 0; i < side * side; i++) {
        double kept[4] = {0};
        add_kept(scene, material, i % side / (double)side, i / side / (double)side, 1.0 / side,
                 kept);
        share_error += pow((double)shares[4 * (size_t)i] - kept[3], 2) / (side * side);
        for (int axis = 0; axis < 2; axis++) {
            const double found = (double)normals[4 * (size_t)i + axis];
            error += pow(found - kept[axis], 2);
            squares += pow(kept[axis], 2);
        }
    }
    error = sqrt(error / squares);
    if (!(error < 0.15 && sqrt(share_error) < 0.04))
        fail_msg("cutoff %g: slopes %g, shares %g off", (double)material->alpha_cutoff, error,
                 sqrt(share_error));
}

static void check_mask(fixture *f, uint32_t texels, bool nearest, float cutoff) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.normal_map = scene_add_map(scene, random_normal_map(MASKED, MASKED, 0.6, 161));
    material.base_colour_map = scene_add_map(scene, mask_image(MASK_CHECKER, texels, texels));
    material.normal_map.nearest = material.base_colour_map.nearest = nearest;
    material.alpha_mask = true;
    material.alpha_cutoff = cutoff;
    scene_end_with_square(scene, &material);
    pass_run run;
    pass_run_begin(&run, f, scene, "mipmap", (const char *[]){"storage=float32", NULL});
    const reduced_map map =
        passes_lobe_map(&run.context, 0, &passes_averaged_parameters, LOBE_FORMAT_RGBA32_FLOAT);
    float *found = pass_run_read(&run, &map, LOBE_FORMAT_RGBA32_FLOAT);
    check_kept(scene, &material, found, found + (size_t)4 * map.width * map.height);
    free(found);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

/// What is kept ends where interpolated alpha meets the cutoff, inside texels; also where texels of
/// the mask are smaller than those of the normals.
static void masks_cut_texels(void **state) {
    check_mask(*state, MASKED, false, 0.2f);
    check_mask(*state, MASKED, false, 0.5f);
    check_mask(*state, MASKED, false, 0.8f);
    check_mask(*state, 4 * MASKED, true, 0.5f);
    check_mask(*state, 3 * MASKED, false, 0.5f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(odd_sizes_are_averaged_exactly),
        cmocka_unit_test(widths_are_averaged_as_concentrations),
        cmocka_unit_test(masks_cut_texels),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
