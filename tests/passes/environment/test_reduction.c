// Levels of the radiance's cube: means by solid angle, each level with the energy of the first.

#include <math.h>

#include "tests/passes/support/environment_reference.h"
#include "tests/reference/light/cube_texel.h"

static void levels_are_means_by_solid_angle(void **state) {
    static const uint32_t sizes[] = {16, 32, 128};
    lobe_environment environment = environment_of_patches(61, 29);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        lobe_environment_maps *maps = make_maps(*state, &environment, sizes[s], false, false);
        host_cube cube = read_cube(maps, LOBE_ENVIRONMENT_RADIANCE);
        for (uint32_t level = 1; level < cube.levels; level++) {
            int width = (int)(sizes[s] >> level);
            for (int face = 0; face < 6; face++)
                for (int texel = 0; texel < width * width; texel++) {
                    double sum[2] = {0};
                    for (int child = 0; child < 4; child++) {
                        int x = 2 * (texel % width) + child % 2,
                            y = 2 * (texel / width) + child / 2;
                        double weight = reference_cube_texel_solid_angle(x, y, 2 * width);
                        sum[0] += weight * cube_texel(&cube, level - 1, face, x, y)[2];
                        sum[1] += weight;
                    }
                    double expected = sum[0] / sum[1];
                    assert_true(fabs(cube_texel(&cube, level, face, texel, 0)[2] - expected) <=
                                4e-7 * expected);
                }
        }
        free_cube(&cube);
        lobe_environment_maps_destroy(&maps);
    }
    lobe_image_free(&environment.image);
}

static void every_level_has_the_same_energy(void **state) {
    lobe_environment environment = environment_of_patches(64, 32);
    environment_texel(&environment, 20, 9)[2] = 1e6f;
    lobe_environment_maps *maps = make_maps(*state, &environment, 64, false, false);
    host_cube cube = read_cube(maps, LOBE_ENVIRONMENT_RADIANCE);
    double first[3], energy[3];
    cube_energy(&cube, 0, first);
    for (uint32_t level = 1; level < cube.levels; level++) {
        cube_energy(&cube, level, energy);
        for (int i = 0; i < 3; i++)
            assert_true(fabs(energy[i] / first[i] - 1) < 5e-7);
    }
    free_cube(&cube);
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

/// Three levels per dispatch as long as there are three.
static void dispatches_are_few(void **state) {
    lobe_environment environment = environment_of_patches(8, 4);
    lobe_environment_maps *maps = make_maps(*state, &environment, 64, false, false);
    const lobe_environment_maps_information *information = lobe_environment_maps_describe(maps);
    assert_int_equal(information->pass_count, 2);
    assert_string_equal(information->passes[1].name, "environment_reduction");
    assert_int_equal(information->passes[1].count, 2);
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_are_means_by_solid_angle),
        cmocka_unit_test(every_level_has_the_same_energy),
        cmocka_unit_test(dispatches_are_few),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
