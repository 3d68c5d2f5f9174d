// What rough metal reflects of an environment, seen at one angle: on a sphere errors of
// neighbouring directions cancel, on a plane they do not. One picture has squares of several
// roughnesses, tilted to the viewer by several angles, in eight directions; the sum over all texels
// is the truth.
//
//     test_environment_broad_reflection FILTER TILT SETTING FILE...
//
// prints the same for environments, with normals up to TILT radians off, beside the reference.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { DIRECTIONS = 8, CELL = 4, ANGLES = 3, ROUGHNESSES = 5, ROWS = ANGLES * ROUGHNESSES };

static const double angles[ANGLES] = {45, 60, 75};
static const double roughnesses[ROUGHNESSES] = {0.3, 0.45, 0.6, 0.8, 1};
static const double towards[3] = {0, 0.8, 0.6}, right[3] = {1, 0, 0}, up[3] = {0, 0.6, -0.8};

/// Haze just above the horizon and a lamp: what broad lobes get wrong on one side of a surface is
/// not made good on another.
static void hazy(const double direction[3], float radiance[3]) {
    static const float haze[] = {3, 2, 1.2f}, sky[] = {0.3f, 0.5f, 1},
                       ground[] = {0.1f, 0.08f, 0.06f};
    double lamp = 0.48 * direction[0] + 0.6 * direction[1] - 0.64 * direction[2];
    for (int i = 0; i < 3; i++)
        radiance[i] = (direction[1] > 0.35   ? sky[i]
                       : direction[1] > -0.1 ? haze[i]
                                             : ground[i]) +
                      (float)(20 * exp(20 * (lamp - 1)));
}

// ---------------------------------------------------------------------------------------------
// The squares

/// A square that fills its cell of the picture, with a normal at an angle to the viewer.
static void place_square(int row, int column, float transform[16]) {
    double angle = angles[row / ROUGHNESSES] * M_PI / 180;
    double azimuth = 2 * M_PI * (column + 0.3) / DIRECTIONS;
    double normal[3], along[3], across[3];
    for (int i = 0; i < 3; i++)
        normal[i] =
            cos(angle) * towards[i] + sin(angle) * (cos(azimuth) * right[i] + sin(azimuth) * up[i]);
    for (int i = 0; i < 3; i++)
        along[i] = (towards[i] - cos(angle) * normal[i]) / sin(angle);
    for (int i = 0; i < 3; i++)
        across[i] =
            normal[(i + 1) % 3] * along[(i + 2) % 3] - normal[(i + 2) % 3] * along[(i + 1) % 3];
    memset(transform, 0, 16 * sizeof *transform);
    for (int i = 0; i < 3; i++) {
        transform[i] = (float)(0.7 * across[i]);
        transform[4 + i] = (float)normal[i];
        transform[8 + i] = (float)(0.7 / cos(angle) * along[i]);
        transform[12 + i] = (float)((column - 0.5 * (DIRECTIONS - 1)) * 2 * right[i] -
                                    (row - 0.5 * (ROWS - 1)) * 2 * up[i]);
    }
    transform[15] = 1;
}

static void add_squares(lobe_scene *scene, double metallic, double tilt) {
    lobe_texture_use normals = {.image = -1};
    if (tilt > 0)
        normals = scene_add_map(scene, random_normal_map(64, 64, tilt, 7));
    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < DIRECTIONS; column++) {
            lobe_material material;
            lobe_material_default(&material);
            material.roughness = (float)roughnesses[row % ROUGHNESSES];
            material.metallic = (float)metallic;
            if (tilt > 0)
                material.normal_map = normals;
            float transform[16];
            place_square(row, column, transform);
            scene_add_square(scene, &material, 8, transform);
        }
    }
    scene_look_from(scene, towards, 2 * ROWS);
    for (int i = 0; i < 3; i++)
        scene->camera.eye[i] = (float)(20 * towards[i]);
    scene_end(scene);
}

static lobe_frame draw_by(fixture *f, const lobe_scene *scene, const char *filter,
                          const char *const settings[4]) {
    picture_request request = {.filter = filter,
                               .settings = {settings[0], settings[1], settings[2], settings[3]},
                               .width = CELL * DIRECTIONS,
                               .height = CELL * ROWS,
                               .samples = 64};
    return draw_scene(f, scene, &request);
}

/// The middle of a cell.
static void mean_of_cell(const lobe_frame *frame, int row, int column, double mean[3]) {
    for (int c = 0; c < 3; c++)
        mean[c] = 0;
    for (uint32_t i = 0; i < 4; i++) {
        const float *pixel = pixel_at(&frame->radiance, CELL * (uint32_t)column + 1 + i % 2,
                                      CELL * (uint32_t)row + 1 + i / 2);
        for (int c = 0; c < 3; c++)
            mean[c] += (double)pixel[c] / 4;
    }
}

/// Ratios of one row to the truth, over directions and channels.
typedef struct row_ratio {
    double least, most, mean; ///< mean: of all directions, of the channel that is farthest off
} row_ratio;

static row_ratio compare_row(const lobe_frame *frame, const lobe_frame *truth, int row) {
    row_ratio ratio = {.least = INFINITY, .most = 0, .mean = 1};
    double sums[2][3] = {{0}};
    for (int column = 0; column < DIRECTIONS; column++) {
        double found[3], expected[3];
        mean_of_cell(frame, row, column, found);
        mean_of_cell(truth, row, column, expected);
        for (int c = 0; c < 3; c++) {
            ratio.least = fmin(ratio.least, found[c] / expected[c]);
            ratio.most = fmax(ratio.most, found[c] / expected[c]);
            sums[0][c] += found[c];
            sums[1][c] += expected[c];
        }
    }
    for (int c = 0; c < 3; c++)
        if (fabs(sums[0][c] / sums[1][c] - 1) > fabs(ratio.mean - 1))
            ratio.mean = sums[0][c] / sums[1][c];
    return ratio;
}

static void print_rows(const lobe_frame *frame, const lobe_frame *truth) {
    for (int row = 0; row < ROWS; row++) {
        row_ratio ratio = compare_row(frame, truth, row);
        print_message("#   %2.0f degrees, roughness %.2f: %.2f to %.2f, mean %.3f\n",
                      angles[row / ROUGHNESSES], roughnesses[row % ROUGHNESSES], ratio.least,
                      ratio.most, ratio.mean);
    }
}

// ---------------------------------------------------------------------------------------------
// Tests

static const char *const prefiltered[4] = {"env=prefiltered", "env_size=32"};
static const char *const exact[4] = {"env=exact", "env_size=32"};

static void planes_of_rough_metal_reflect_what_they_should(void **state) {
    // By roughness: every direction, and the mean. Found: 0.08, 0.07, 0.05, 0.03, 0.02; 0.008,
    // 0.014, 0.014, 0.016, 0.003.
    static const double each[ROUGHNESSES] = {0.11, 0.1, 0.08, 0.05, 0.03};
    static const double mean[ROUGHNESSES] = {0.015, 0.02, 0.02, 0.025, 0.012};
    lobe_scene *scene = scene_begin();
    scene_surround(scene, 64, hazy);
    add_squares(scene, 1, 0);
    lobe_frame truth = draw_by(*state, scene, "direct", exact);
    lobe_frame frame = draw_by(*state, scene, "direct", prefiltered);
    print_rows(&frame, &truth);
    for (int row = 0; row < ROWS; row++) {
        const int r = row % ROUGHNESSES;
        row_ratio ratio = compare_row(&frame, &truth, row);
        if (!(ratio.least > 1 - each[r] && ratio.most < 1 + each[r] &&
              fabs(ratio.mean - 1) < mean[r]))
            fail_msg("%g degrees, roughness %g: %.3f to %.3f, mean %.3f", angles[row / ROUGHNESSES],
                     roughnesses[r], ratio.least, ratio.most, ratio.mean);
    }
    lobe_frame_free(&frame);
    lobe_frame_free(&truth);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Measuring

static int argument_count;
static char **arguments;

/// FILTER TILT SETTING FILE...
static void measure(void **state) {
    const char *const settings[4] = {arguments[3], "env_size=64"};
    const char *const truth_settings[4] = {"env=exact", "env_size=64"};
    const double tilt = atof(arguments[2]);
    for (int i = 4; i < argument_count; i++) {
        lobe_scene *scene = scene_begin();
        assert_int_equal(lobe_environment_open(arguments[i], NULL, &scene->environment), LOBE_OK);
        add_squares(scene, 1, tilt);
        lobe_frame truth =
            draw_by(*state, scene, tilt > 0 ? "reference" : "direct", truth_settings);
        lobe_frame frame = draw_by(*state, scene, arguments[1], settings);
        print_message("# %s, %s, %s\n", arguments[i], arguments[1], arguments[3]);
        print_rows(&frame, &truth);
        lobe_frame_free(&frame);
        lobe_frame_free(&truth);
        lobe_scene_destroy(&scene);
    }
}

int main(int count, char **values) {
    argument_count = count;
    arguments = values;
    const struct CMUnitTest measurements[] = {cmocka_unit_test(measure)};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_of_rough_metal_reflect_what_they_should),
        cmocka_unit_test(validation_is_silent),
    };
    return count > 4 ? cmocka_run_group_tests(measurements, fixture_create, fixture_destroy)
                     : cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
