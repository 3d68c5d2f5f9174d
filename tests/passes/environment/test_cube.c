// The radiance's cube: its texels match the image, and no energy is lost.

#include <math.h>
#include <string.h>

#include "tests/passes/support/environment_reference.h"
#include "tests/reference/light/cube_texel.h"

static host_cube cube_of(fixture *f, const lobe_environment *environment, uint32_t size) {
    lobe_environment_maps *maps = make_maps(f, environment, size, false, false);
    host_cube cube = read_cube(maps, LOBE_ENVIRONMENT_RADIANCE);
    lobe_environment_maps_destroy(&maps);
    return cube;
}

typedef struct shape {
    lobe_environment_layout layout;
    uint32_t width, height;
} shape;

static const shape shapes[] = {
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 64, 32},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 7, 5},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 1, 1},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 256, 128}, // poles by environment_poles
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 512, 256}, // by way of a finer cube
    {LOBE_ENVIRONMENT_CUBE_COLUMN, 16, 96},
    {LOBE_ENVIRONMENT_CUBE_ROW, 900, 150}, // by way of a finer cube
    {LOBE_ENVIRONMENT_CUBE_ROW, 42, 7},
    {LOBE_ENVIRONMENT_VERTICAL_CROSS, 96, 128},
    {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 84, 63},
};

static void a_constant_stays_exactly_what_it_is(void **state) {
    const float colour[3] = {0.1f, 1.7f, 12345.678f};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        lobe_environment environment =
            environment_of_colour(shapes[i].layout, shapes[i].width, shapes[i].height, colour);
        host_cube cube = cube_of(*state, &environment, 16);
        assert_int_equal(cube.levels, 5);
        for (uint32_t level = 0; level < cube.levels; level++)
            for (int face = 0; face < 6; face++)
                for (int texel = 0; texel < (16 >> level) * (16 >> level); texel++) {
                    const float *value = cube_texel(&cube, level, face, texel, 0);
                    assert_memory_equal(value, colour, sizeof colour);
                    assert_true(value[3] == 1);
                }
        free_cube(&cube);
        lobe_image_free(&environment.image);
    }
}

/// A cube of the image's own size copies its texels, wherever the layout places them.
static void faces_of_the_same_size_are_copied(void **state) {
    static const shape exact[] = {
        {LOBE_ENVIRONMENT_CUBE_COLUMN, 16, 96},
        {LOBE_ENVIRONMENT_CUBE_ROW, 96, 16},
        {LOBE_ENVIRONMENT_VERTICAL_CROSS, 48, 64},
        {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 64, 48},
    };
    for (size_t i = 0; i < sizeof exact / sizeof *exact; i++) {
        lobe_environment environment = environment_of_colour(exact[i].layout, exact[i].width,
                                                             exact[i].height, (float[3]){0, 0, 0});
        for (uint32_t y = 0; y < exact[i].height; y++)
            for (uint32_t x = 0; x < exact[i].width; x++)
                environment_texel(&environment, x, y)[0] = (float)(1 + y * exact[i].width + x);
        host_cube cube = cube_of(*state, &environment, 16);
        for (int face = 0; face < 6; face++)
            for (int y = 0; y < 16; y++)
                for (int x = 0; x < 16; x++) {
                    double direction[3], position[2];
                    reference_cube_texel_direction(face, x, y, 16, direction);
                    assert_true(lobe_environment_position(&environment, direction, position));
                    assert_true(cube_texel(&cube, 0, face, x, y)[0] ==
                                environment_texel(&environment, (uint32_t)position[0],
                                                  (uint32_t)position[1])[0]);
                }
        free_cube(&cube);
        lobe_image_free(&environment.image);
    }
}

/// Where the image changes slowly, a texel equals the image in its direction.
static void directions_are_those_of_the_image(void **state) {
    uint32_t width = 128, height = 64;
    lobe_environment environment = environment_of_colour(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, width,
                                                         height, (float[3]){0, 0, 0});
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            double longitude = M_PI - 2 * M_PI * (x + 0.5) / width;
            double from_top = M_PI * (y + 0.5) / height;
            float *texel = environment_texel(&environment, x, y);
            texel[0] = (float)(2 + sin(longitude) * sin(from_top));
            texel[1] = (float)(2 + cos(from_top));
            texel[2] = (float)(2 + cos(longitude) * sin(from_top));
        }
    host_cube cube = cube_of(*state, &environment, 64);
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < 64; y++)
            for (int x = 0; x < 64; x++) {
                double direction[3];
                reference_cube_texel_direction(face, x, y, 64, direction);
                // Next to the poles rows are hardly interpolated, so that none gains energy.
                bool near_pole = hypot(direction[0], direction[2]) < 8 * M_PI / height + 0.1;
                for (int i = 0; i < 3; i++)
                    assert_true(fabs(cube_texel(&cube, 0, face, x, y)[i] - 2 - direction[i]) <
                                (near_pole ? 0.5 * M_PI / height : 2e-3));
            }
    free_cube(&cube);
    lobe_image_free(&environment.image);
}

static double row_solid_angle(uint32_t row, uint32_t width, uint32_t height) {
    return 2 * M_PI / width * (cos(M_PI * row / height) - cos(M_PI * (row + 1) / height));
}

/// Two texels of 1e5 over surroundings of 1, at each place of an image of `height` rows.
static void check_suns(fixture *f, uint32_t height, uint32_t size, const uint32_t (*places)[2],
                       size_t count, double most) {
    const uint32_t width = 2 * height;
    lobe_environment environment = environment_of_colour(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, width,
                                                         height, (float[3]){1, 1, 1});
    for (size_t i = 0; i < count; i++) {
        uint32_t x = places[i][0], y = places[i][1];
        float *sun[2] = {environment_texel(&environment, x, y),
                         environment_texel(&environment, (x + 1) % width, y)};
        sun[0][1] = sun[1][1] = 1e5f;
        host_cube cube = cube_of(f, &environment, size);
        double energy[3], expected = 2 * (1e5 - 1) * row_solid_angle(y, width, height);
        cube_energy(&cube, 0, energy);
        if (!(fabs((energy[1] - energy[0]) / expected - 1) < most))
            fail_msg("a sun at (%u, %u) has %g of its energy", x, y,
                     (energy[1] - energy[0]) / expected);
        free_cube(&cube);
        sun[0][1] = sun[1][1] = 1;
    }
    lobe_image_free(&environment.image);
}

/// In the open, on an edge of the cube, at a corner, at the seam of the image, at and near the
/// poles; and ten rows from these, where the number of subsamples changes most.
static void a_small_sun_keeps_its_energy(void **state) {
    static const uint32_t places[][2] = {
        {18, 46}, {64, 64}, {79, 64}, {80, 39},   {255, 50},  {13, 0},  {127, 1},
        {200, 2}, {150, 4}, {77, 7},  {222, 127}, {100, 126}, {166, 6}, {50, 119},
    };
    static const uint32_t between[][2] = {{77, 10}, {20, 9}, {20, 10}, {20, 12}};
    check_suns(*state, 128, 32, places, sizeof places / sizeof *places, 5e-3);
    check_suns(*state, 128, 32, between, sizeof between / sizeof *between, 1.2e-2);
}

/// A texel of the cube is a small part of a row.
static void a_sun_of_a_small_image_keeps_its_energy(void **state) {
    static const uint32_t places[][2] = {{3, 0}, {15, 1}, {6, 2}, {0, 4}, {9, 6}, {12, 7}};
    check_suns(*state, 8, 64, places, sizeof places / sizeof *places, 2e-3);
    check_suns(*state, 2, 64, (const uint32_t[][2]){{0, 0}, {3, 1}}, 2, 2e-3);
}

/// Of many columns and rows for each texel of the cube: at the poles by environment_poles, and by
/// way of a finer cube.
static void a_sun_of_a_fine_image_keeps_its_energy(void **state) {
    static const uint32_t places[][2] = {{135, 0}, {643, 0}, {643, 1}, {135, 3}, {643, 508}};
    check_suns(*state, 512, 64, places, sizeof places / sizeof *places, 5e-3);
    check_suns(*state, 512, 16, places, 3, 5e-3);
}

/// Texel for texel, after a quarter turn about +Y: +X comes from +Z, -Z from +X and so on.
static void a_turned_image_gives_a_turned_cube(void **state) {
    const uint32_t width = 128, height = 64;
    lobe_environment environment = environment_of_patches(width, height);
    lobe_environment turned = environment_of_colour(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, width,
                                                    height, (float[3]){0, 0, 0});
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            memcpy(environment_texel(&turned, (x + 3 * width / 4) % width, y),
                   environment_texel(&environment, x, y), 4 * sizeof(float));
    host_cube before = cube_of(*state, &environment, 32), after = cube_of(*state, &turned, 32);
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < 32; y++)
            for (int x = 0; x < 32; x++) {
                double direction[3], place[2];
                reference_cube_texel_direction(face, x, y, 32, direction);
                const double source[3] = {-direction[2], direction[1], direction[0]};
                int from = reference_cube_face(source, place);
                const float *expected =
                    cube_texel(&before, 0, from, (int)(32 * place[0]), (int)(32 * place[1]));
                for (int i = 0; i < 3; i++)
                    assert_true(fabs(cube_texel(&after, 0, face, x, y)[i] - expected[i]) <
                                2e-3 * (1 + expected[i]));
            }
    free_cube(&before);
    free_cube(&after);
    lobe_image_free(&environment.image);
    lobe_image_free(&turned.image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_stays_exactly_what_it_is),
        cmocka_unit_test(faces_of_the_same_size_are_copied),
        cmocka_unit_test(directions_are_those_of_the_image),
        cmocka_unit_test(a_small_sun_keeps_its_energy),
        cmocka_unit_test(a_sun_of_a_small_image_keeps_its_energy),
        cmocka_unit_test(a_sun_of_a_fine_image_keeps_its_energy),
        cmocka_unit_test(a_turned_image_gives_a_turned_cube),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
