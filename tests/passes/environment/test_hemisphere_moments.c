// Moments of light over hemispheres against sums in double precision.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/environment/hemispheres/hemisphere_moments.h"
#include "shaders/interface/environment/hemisphere_moments.h"
#include "tests/reference/light/cube_texel.h"
#include "tests/reference/vector.h"

enum { SIZE = HEMISPHERE_MOMENTS_SIZE, WIDTH = SIZE + 2 };

/// A broad light, a narrow one, and ground: each in a colour of its own.
static void radiance_from(const double d[3], double radiance[3]) {
    const double lamp[3] = {0.36, 0.48, -0.8}, glow[3] = {-0.6, 0, 0.8};
    radiance[0] = 4 * exp(3 * (reference_dot(d, glow) - 1));
    radiance[1] = 40 * exp(60 * (reference_dot(d, lamp) - 1));
    radiance[2] = d[1] < 0 ? 1 : 0.25;
}

// ---------------------------------------------------------------------------------------------
// On the device

/// The cube of that light, each texel the mean of 4x4 points; level 0 alone.
static lobe_resource declare_cube(fixture *f, int size, lobe_texture *faces[6]) {
    lobe_resource cube =
        lobe_graph_image(f->graph, &(lobe_image_description){.name = "cube",
                                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                             .width = (uint32_t)size,
                                                             .height = (uint32_t)size,
                                                             .layers = 6,
                                                             .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "copy");
    for (uint32_t face = 0; face < 6; face++)
        cube = lobe_pass_copy(pass, lobe_graph_import_texture(f->graph, faces[face]),
                              (lobe_range){0, 1, 0, 1}, cube, (lobe_range){0, 1, face, 1});
    return cube;
}

static lobe_texture *upload_face(lobe_device *device, int face, int size) {
    float *texels = calloc((size_t)size * size, 4 * sizeof *texels);
    assert_non_null(texels);
    for (int i = 0; i < size * size; i++) {
        for (int sample = 0; sample < 16; sample++) {
            double direction[3], radiance[3];
            reference_cube_texel_direction(face, 4 * (i % size) + sample % 4,
                                           4 * (i / size) + sample / 4, 4 * size, direction);
            radiance_from(direction, radiance);
            for (int c = 0; c < 3; c++)
                texels[4 * i + c] += (float)(radiance[c] / 16);
        }
    }
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, (uint32_t)size, (uint32_t)size, texels};
    lobe_texture *texture;
    assert_int_equal(
        lobe_texture_create(device, &(lobe_texture_parameters){.image = &image}, &texture),
        LOBE_OK);
    free(texels);
    return texture;
}

typedef struct moment_map {
    float texels[HEMISPHERE_MOMENT_LAYERS][WIDTH][WIDTH][4];
} moment_map;

static moment_map *make_moments(fixture *f, int size) {
    lobe_texture *faces[6];
    for (int face = 0; face < 6; face++)
        faces[face] = upload_face(f->device, face, size);
    lobe_graph_begin(f->graph);
    const irradiance_source source = {declare_cube(f, size, faces), (uint32_t)size, 1, false};
    const environment_means means = passes_environment_means(f->graph, &source);
    lobe_resource moments = passes_hemisphere_moments(f->graph, &means);
    lobe_graph_read_back(f->graph, moments, (lobe_range){0});
    if (lobe_graph_execute(f->graph) != LOBE_OK)
        fail_msg("%s", f->error);
    size_t bytes;
    const void *data = lobe_graph_data(f->graph, moments, &bytes);
    assert_int_equal(bytes, sizeof(moment_map));
    moment_map *map = malloc(bytes);
    assert_non_null(map);
    memcpy(map, data, bytes);
    for (int face = 0; face < 6; face++)
        lobe_texture_destroy(&faces[face]);
    return map;
}

// ---------------------------------------------------------------------------------------------
// In double precision

static const int powers[HEMISPHERE_MOMENTS][3] = {
    {3, 0, 0}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {1, 1, 1}, {1, 0, 2}, {0, 3, 0}, {0, 2, 1},
    {0, 1, 2}, {0, 0, 3}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {0, 1, 1}, {0, 0, 2}};

static double monomial(const int power[3], const double d[3]) {
    double product = 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < power[i]; j++)
            product *= d[i];
    return product;
}

/// By the midpoint rule over latitude and longitude.
static void expected_moments(const double normal[3], double moments[HEMISPHERE_MOMENTS][3]) {
    enum { RINGS = 200, STEPS = 400 };
    memset(moments, 0, sizeof(double[HEMISPHERE_MOMENTS][3]));
    for (int i = 0; i < RINGS * STEPS; i++) {
        double y = (2 * (i / STEPS) + 1.0) / RINGS - 1, angle = 2 * M_PI * (i % STEPS) / STEPS;
        double across = sqrt(1 - y * y), radiance[3];
        double d[3] = {across * cos(angle), y, across * sin(angle)};
        double weight = fmax(reference_dot(normal, d), 0) * 4 * M_PI / (RINGS * STEPS);
        radiance_from(d, radiance);
        for (int m = 0; m < HEMISPHERE_MOMENTS; m++)
            for (int c = 0; c < 3; c++)
                moments[m][c] += weight * monomial(powers[m], d) * radiance[c];
    }
}

/// The unit direction of a texel inside the border.
static void normal_of(int column, int row, double normal[3]) {
    double x = (2 * column - 1.0) / SIZE - 1, y = (2 * row - 1.0) / SIZE - 1;
    double z = 1 - fabs(x) - fabs(y);
    normal[0] = z < 0 ? copysign(1 - fabs(y), x) : x;
    normal[1] = z < 0 ? copysign(1 - fabs(x), y) : y;
    normal[2] = z;
    reference_normalise(normal);
}

/// Of radiance 1 from everywhere.
static double uniform_moment(const int power[3], const double n[3]) {
    const int degree = power[0] + power[1] + power[2];
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        // As x_i^2 times the product of the others.
        if (power[i] < 2)
            continue;
        const int rest[3] = {power[0] - 2 * (i == 0), power[1] - 2 * (i == 1),
                             power[2] - 2 * (i == 2)};
        sum +=
            (power[i] == 3 ? 3 : 1) * (degree == 3 ? 2 * M_PI / 15 : M_PI / 4) * monomial(rest, n);
    }
    return degree == 3 ? sum : sum + M_PI / 4 * monomial(power, n);
}

/// In fractions of the irradiance of a surface that faces the light.
static void moments_are_integrals(void **state) {
    static const int sizes[] = {16, 32, 128};
    static const double tolerance[] = {0.004, 0.001, 0.001};
    static const double facing[3] = {2.07, 4.2, 2.5};
    for (int s = 0; s < 3; s++) {
        moment_map *map = make_moments(*state, sizes[s]);
        double worst = 0;
        for (int i = 0; i < SIZE * SIZE; i += 47) {
            int column = 1 + i % SIZE, row = 1 + i / SIZE;
            double normal[3], expected[HEMISPHERE_MOMENTS][3];
            normal_of(column, row, normal);
            expected_moments(normal, expected);
            for (int m = 0; m < HEMISPHERE_MOMENTS; m++) {
                for (int c = 0; c < 3; c++) {
                    double found =
                        (double)map->texels[4 * c + m / 4][row][column][m % 4] +
                        (double)map->texels[12][row][column][c] * uniform_moment(powers[m], normal);
                    worst = fmax(worst, fabs(found - expected[m][c]) / facing[c]);
                    if (!(fabs(found - expected[m][c]) <= tolerance[s] * facing[c]))
                        fail_msg("faces of %d, texel %d, %d, moment %d, colour %d: %g instead of "
                                 "%g",
                                 sizes[s], column, row, m, c, found, expected[m][c]);
                }
            }
        }
        print_message("# faces of %d: %.5f off\n", sizes[s], worst);
        free(map);
    }
}

/// So that interpolation is continuous where the square's edges meet.
static void the_border_repeats_the_other_side(void **state) {
    moment_map *map = make_moments(*state, 16);
    for (int layer = 0; layer < HEMISPHERE_MOMENT_LAYERS; layer++) {
        for (int i = 0; i < WIDTH; i++) {
            int j = WIDTH - 1 - i;
            for (int k = 0; k < 4; k++) {
                const float(*texels)[WIDTH][4] = map->texels[layer];
                // Corners are those of the opposite corner.
                int across = i == 0 || i == WIDTH - 1 ? WIDTH - 2 : 1;
                int near = i == 0 ? WIDTH - 2 : i == WIDTH - 1 ? 1 : j;
                assert_true(fabsf(texels[0][i][k] - texels[across][near][k]) < 1e-5F);
                assert_true(fabsf(texels[i][0][k] - texels[near][across][k]) < 1e-5F);
            }
        }
    }
    free(map);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_are_integrals),
        cmocka_unit_test(the_border_repeats_the_other_side),
        cmocka_unit_test(validation_is_silent),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
