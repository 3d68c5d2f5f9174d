// The naive filter's map against means in double precision: normals and widths averaged as if they
// were colours.

#include <math.h>
#include <stdlib.h>

#include "passes/maps/parameter_averaging.h"
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(odd_sizes_are_averaged_exactly),
        cmocka_unit_test(widths_are_averaged_as_concentrations),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
