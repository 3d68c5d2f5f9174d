// Filtered cubes for lobes of all widths, against sums over all texels in double precision.

#include <math.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "tests/passes/support/environment_reference.h"
#include "tests/reference/light/cube_texel.h"

static const lobe_environment_map filtered[] = {LOBE_ENVIRONMENT_VON_MISES_FISHER,
                                                LOBE_ENVIRONMENT_GGX};
static const reference_lobe lobes[] = {reference_vmf_lobe, reference_ggx_lobe};

static void a_constant_is_kept_at_every_level(void **state) {
    lobe_environment environment = environment_of_colour(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 8, 4,
                                                         (float[3]){0.1f, 1.7f, 12345.678f});
    const float *colour = environment_texel(&environment, 0, 0);
    lobe_environment_maps *maps = make_maps(*state, &environment, 32, true, true);
    for (int map = 0; map < 2; map++) {
        host_cube cube = read_cube(maps, filtered[map]);
        for (uint32_t level = 0; level < cube.levels; level++)
            for (int face = 0; face < 6; face++)
                for (uint32_t texel = 0; texel < (cube.width >> level) * (cube.width >> level);
                     texel++)
                    for (int i = 0; i < 3; i++)
                        assert_true(
                            fabs(cube_texel(&cube, level, face, (int)texel, 0)[i] / colour[i] - 1) <
                            2e-6);
        free_cube(&cube);
    }
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

/// One bright texel on black of a cube of 32 x 32.
static lobe_environment environment_of_texel(int face, uint32_t x, uint32_t y) {
    lobe_environment environment =
        environment_of_colour(LOBE_ENVIRONMENT_CUBE_COLUMN, 32, 192, (float[3]){0, 0, 0});
    double direction[3], position[2];
    reference_cube_texel_direction(face, (int)x, (int)y, 32, direction);
    assert_true(lobe_environment_position(&environment, direction, position));
    environment_texel(&environment, (uint32_t)position[0], (uint32_t)position[1])[0] = 1;
    return environment;
}

static void random_direction(random_sequence *sequence, double direction[3]) {
    double z = scenes_random_between(sequence, -1, 1),
           angle = scenes_random_between(sequence, 0, 2 * M_PI);
    direction[0] = sqrt(1 - z * z) * cos(angle);
    direction[1] = z;
    direction[2] = sqrt(1 - z * z) * sin(angle);
}

/// Uniform in a cap about an axis, 1 - cos r = `height`.
static void random_direction_near(random_sequence *sequence, const double axis[3], double height,
                                  double direction[3]) {
    double aside[3], along = 0, square = 0;
    random_direction(sequence, aside);
    for (int i = 0; i < 3; i++)
        along += aside[i] * axis[i];
    for (int i = 0; i < 3; i++) {
        aside[i] -= along * axis[i];
        square += aside[i] * aside[i];
    }
    double cosine = 1 - scenes_random_between(sequence, 0, height);
    for (int i = 0; i < 3; i++)
        direction[i] = cosine * axis[i] + sqrt((1 - cosine * cosine) / square) * aside[i];
}

typedef struct deviation {
    double squares, of_exact, worst, peak;
} deviation;

static void add_deviation(deviation *d, double value, double exact) {
    d->squares += (value - exact) * (value - exact);
    d->of_exact += exact * exact;
    d->worst = fmax(d->worst, fabs(value - exact));
    d->peak = fmax(d->peak, exact);
}

/// Wherever the lobe is significant, also between texels, where interpolation alone is off by up to
/// 1.1 % of the L2 norm, and 1.6 % for a GGX lobe; more if a face has only two texels per side, or
/// if the lobe's peak is narrower than a texel.
static void check_lobe_of_texel(lobe_environment_maps *maps, int face, uint32_t x, uint32_t y,
                                int map) {
    double centre[3];
    reference_cube_texel_direction(face, (int)x, (int)y, 32, centre);
    double energy = reference_cube_texel_solid_angle((int)x, (int)y, 32);
    host_cube cube = read_cube(maps, filtered[map]);
    for (uint32_t level = 0; level < cube.levels; level++) {
        random_sequence sequence = scenes_random_start(7);
        double concentration = lobe_environment_level_concentration(cube.width, level);
        deviation d = {0};
        for (int i = 0; i < 1500; i++) {
            double direction[3], value[3], square = 0;
            random_direction_near(&sequence, centre, fmin(2, 10 / concentration), direction);
            cube_fetch(&cube, level, direction, value);
            for (int k = 0; k < 3; k++)
                square += (direction[k] - centre[k]) * (direction[k] - centre[k]);
            add_deviation(&d, value[0], energy * lobes[map](square / 2, concentration));
        }
        double share = sqrt(d.squares / d.of_exact);
        bool coarse = cube.width >> level < 4, sharp = map == 1 && level == 0;
        double bound = coarse || sharp ? 0.023 : map == 0 ? 0.014 : 0.02;
        if (!(share < bound && d.worst < 0.06 * d.peak))
            fail_msg("texel (%u, %u) of face %d, cube %d, level %u: off by %g, at worst %g of the "
                     "peak",
                     x, y, face, map, level, share, d.worst / d.peak);
    }
    free_cube(&cube);
}

static void one_texel_becomes_the_lobe(void **state) {
    // In the middle of a face, next to an edge, in a corner, and elsewhere.
    static const uint32_t texels[][3] = {{4, 16, 15}, {0, 31, 14}, {2, 0, 0}, {3, 9, 27}};
    for (size_t i = 0; i < sizeof texels / sizeof *texels; i++) {
        lobe_environment environment =
            environment_of_texel((int)texels[i][0], texels[i][1], texels[i][2]);
        lobe_environment_maps *maps = make_maps(*state, &environment, 32, true, true);
        for (int map = 0; map < 2; map++)
            check_lobe_of_texel(maps, (int)texels[i][0], texels[i][1], texels[i][2], map);
        lobe_environment_maps_destroy(&maps);
        lobe_image_free(&environment.image);
    }
}

static void an_environment_is_filtered_to_a_hundredth(void **state) {
    lobe_environment environment = environment_of_patches(128, 64);
    lobe_environment_maps *maps = make_maps(*state, &environment, 32, true, true);
    host_cube radiance = read_cube(maps, LOBE_ENVIRONMENT_RADIANCE);
    for (int map = 0; map < 2; map++) {
        host_cube cube = read_cube(maps, filtered[map]);
        for (uint32_t level = 0; level < cube.levels; level++) {
            random_sequence sequence = scenes_random_start(11);
            double concentration = lobe_environment_level_concentration(cube.width, level);
            deviation d = {0};
            for (int i = 0; i < 150; i++) {
                double direction[3], value[3], exact[3];
                random_direction(&sequence, direction);
                cube_fetch(&cube, level, direction, value);
                exact_light(&radiance, direction, lobes[map], concentration, exact);
                for (int k = 0; k < 3; k++)
                    add_deviation(&d, value[k], exact[k]);
            }
            if (!(sqrt(d.squares / d.of_exact) < 0.01))
                fail_msg("cube %d, level %u is off by %g", map, level,
                         sqrt(d.squares / d.of_exact));
        }
        free_cube(&cube);
    }
    free_cube(&radiance);
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

/// Texels on both sides of an edge differ by no more than neighbours within a face do.
static void faces_meet_without_a_step(void **state) {
    lobe_environment environment = environment_of_patches(128, 64);
    lobe_environment_maps *maps = make_maps(*state, &environment, 32, true, true);
    for (int map = 0; map < 2; map++) {
        host_cube cube = read_cube(maps, filtered[map]);
        for (uint32_t level = 0; cube.width >> level >= 16; level++) {
            int width = (int)(cube.width >> level);
            double within = 0, across = 0;
            for (int face = 0; face < 6; face++)
                for (int y = 0; y < width; y++) {
                    for (int x = 1; x < width; x++)
                        within = fmax(within, fabs((double)cube_texel(&cube, level, face, x, y)[2] -
                                                   cube_texel(&cube, level, face, x - 1, y)[2]));
                    double inside[3], outside[3], place = (2 * y + 1.0) / width - 1;
                    // The points halfway from the last texel's centre to the edge, and beyond.
                    const double axes[6][3] = {{1, -place, 0}, {-1, -place, 0}, {place, 1, 0},
                                               {place, -1, 0}, {0, -place, 1},  {0, -place, -1}};
                    double a[3], b[3];
                    for (int i = 0; i < 3; i++)
                        a[i] = b[i] = axes[face][i];
                    int axis = face < 2 || face >= 4 ? (face < 2 ? 2 : 0) : 2;
                    a[axis] = 1 - 0.5 / width;
                    b[axis] = 1 + 0.5 / width;
                    cube_fetch(&cube, level, a, inside);
                    cube_fetch(&cube, level, b, outside);
                    across = fmax(across, fabs(inside[2] - outside[2]));
                }
            assert_true(within > 0);
            assert_true(across <= within);
        }
        free_cube(&cube);
    }
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

static void two_runs_give_the_same_bits(void **state) {
    lobe_environment environment = environment_of_patches(64, 32);
    lobe_environment_maps *first = make_maps(*state, &environment, 16, true, true);
    lobe_environment_maps *second = make_maps(*state, &environment, 16, true, true);
    for (int map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        host_cube a = read_cube(first, map), b = read_cube(second, map);
        for (uint32_t level = 0; level < a.levels; level++)
            for (int face = 0; face < 6; face++)
                assert_memory_equal(a.faces[level][face].texels, b.faces[level][face].texels,
                                    (size_t)(a.width >> level) * (a.width >> level) * 16);
        free_cube(&a);
        free_cube(&b);
    }
    lobe_environment_maps_destroy(&first);
    lobe_environment_maps_destroy(&second);
    lobe_image_free(&environment.image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_is_kept_at_every_level),
        cmocka_unit_test(one_texel_becomes_the_lobe),
        cmocka_unit_test(an_environment_is_filtered_to_a_hundredth),
        cmocka_unit_test(faces_meet_without_a_step),
        cmocka_unit_test(two_runs_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
