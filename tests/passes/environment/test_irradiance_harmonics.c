// Irradiance by harmonics against closed forms and against sums in double precision.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/environment/hemispheres/irradiance_harmonics.h"
#include "shaders/interface/environment/irradiance_harmonics.h"
#include "tests/reference/light/cube_texel.h"
#include "tests/reference/light/spherical_harmonics.h"
#include "tests/reference/vector.h"

/// Radiance from a direction.
typedef double (*light_field)(const double direction[3], const double axis[3]);

/// A cube in host memory: RGBA, face by face.
typedef struct host_cube {
    float *texels;
    int size;
} host_cube;

static host_cube cube_allocate(int size) {
    host_cube cube = {calloc((size_t)6 * size * size * 4, sizeof(float)), size};
    assert_non_null(cube.texels);
    return cube;
}

/// Red, green and blue differ by factors, so that channels cannot be mixed up.
static void set_texel(host_cube *cube, int index, double radiance) {
    for (int channel = 0; channel < 3; channel++)
        cube->texels[4 * index + channel] = (float)(radiance * (1 << channel));
}

/// Means over 4x4 samples of each texel.
static host_cube cube_of(int size, light_field light, const double axis[3]) {
    host_cube cube = cube_allocate(size);
    for (int i = 0; i < 6 * size * size; i++) {
        double sum = 0, whole = 0;
        for (int sample = 0; sample < 16; sample++) {
            int x = 4 * (i % size) + sample % 4, y = 4 * (i / size % size) + sample / 4;
            double direction[3];
            reference_cube_texel_direction(i / (size * size), x, y, 4 * size, direction);
            double solid_angle = reference_cube_texel_solid_angle(x, y, 4 * size);
            sum += light(direction, axis) * solid_angle;
            whole += solid_angle;
        }
        set_texel(&cube, i, sum / whole);
    }
    return cube;
}

/// Mean over solid angle of each block of texels.
static host_cube cube_reduced(const host_cube *cube) {
    host_cube half = cube_allocate(cube->size / 2);
    for (int i = 0; i < 6 * half.size * half.size; i++) {
        double sum = 0, whole = 0;
        int x = 2 * (i % half.size), y = 2 * (i / half.size % half.size);
        for (int j = 0; j < 4; j++) {
            int u = x + j % 2, v = y + j / 2;
            double solid_angle = reference_cube_texel_solid_angle(u, v, cube->size);
            size_t index =
                ((size_t)(i / (half.size * half.size)) * cube->size + v) * cube->size + u;
            sum += solid_angle * (double)cube->texels[4 * index];
            whole += solid_angle;
        }
        set_texel(&half, i, sum / whole);
    }
    return half;
}

static lobe_texture *upload_face(lobe_device *device, const host_cube *cube, int face) {
    size_t count = (size_t)4 * cube->size * cube->size;
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, (uint32_t)cube->size, (uint32_t)cube->size,
                        cube->texels + face * count};
    lobe_texture *texture;
    assert_int_equal(
        lobe_texture_create(device, &(lobe_texture_parameters){.image = &image}, &texture),
        LOBE_OK);
    return texture;
}

enum { MAXIMUM_LEVELS = 4 };

/// A cube's levels on the device.
typedef struct device_cube {
    lobe_texture *faces[MAXIMUM_LEVELS][6];
    uint32_t size, levels;
} device_cube;

static device_cube upload(fixture *f, const host_cube *levels, uint32_t count) {
    device_cube cube = {.size = (uint32_t)levels->size, .levels = count};
    for (uint32_t level = 0; level < count; level++)
        for (int face = 0; face < 6; face++)
            cube.faces[level][face] = upload_face(f->device, &levels[level], face);
    return cube;
}

static void release(device_cube *cube) {
    for (uint32_t level = 0; level < cube->levels; level++)
        for (int face = 0; face < 6; face++)
            lobe_texture_destroy(&cube->faces[level][face]);
}

static lobe_resource declare(fixture *f, const device_cube *cube) {
    lobe_resource resource =
        lobe_graph_image(f->graph, &(lobe_image_description){.name = "cube",
                                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                             .width = cube->size,
                                                             .height = cube->size,
                                                             .layers = 6,
                                                             .levels = cube->levels,
                                                             .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "copy");
    for (uint32_t level = 0; level < cube->levels; level++)
        for (uint32_t face = 0; face < 6; face++)
            resource =
                lobe_pass_copy(pass, lobe_graph_import_texture(f->graph, cube->faces[level][face]),
                               (lobe_range){0, 1, 0, 1}, resource, (lobe_range){level, 1, face, 1});
    return resource;
}

typedef struct irradiance_found {
    float coefficients[HARMONICS][4];
    float remainder[HARMONICS_REMAINDER_WIDTH * HARMONICS_REMAINDER_WIDTH][4];
} irradiance_found;

static void copy_data(fixture *f, lobe_resource resource, void *target, size_t expected) {
    size_t size;
    const void *data = lobe_graph_data(f->graph, resource, &size);
    assert_int_equal(size, expected);
    memcpy(target, data, size);
}

/// One frame.
static irradiance_found run(fixture *f, const device_cube *cube, double window) {
    lobe_graph_begin(f->graph);
    const irradiance_source source = {declare(f, cube), cube->size, cube->levels, false};
    const environment_means means = passes_environment_means(f->graph, &source);
    const irradiance_maps maps = passes_irradiance_harmonics(f->graph, source, &means, window);
    lobe_graph_read_back(f->graph, maps.harmonics, (lobe_range){0});
    lobe_graph_read_back(f->graph, maps.remainder, (lobe_range){0});
    if (lobe_graph_execute(f->graph) != LOBE_OK)
        fail_msg("%s", f->error);
    irradiance_found found;
    copy_data(f, maps.harmonics, found.coefficients, sizeof found.coefficients);
    copy_data(f, maps.remainder, found.remainder, sizeof found.remainder);
    return found;
}

static irradiance_found project(fixture *f, const host_cube *cube) {
    device_cube uploaded = upload(f, cube, 1);
    irradiance_found found = run(f, &uploaded, 0);
    release(&uploaded);
    return found;
}

/// All channels, within `tolerance` of the largest coefficient that the light could have.
static void check(const irradiance_found *found, const double expected[REFERENCE_HARMONICS],
                  double tolerance, const char *what) {
    for (int i = 0; i < REFERENCE_HARMONICS; i++) {
        for (int channel = 0; channel < 3; channel++) {
            double value = (double)found->coefficients[i][channel] / (1 << channel);
            if (!(fabs(value - expected[i]) <= tolerance * expected[0]))
                fail_msg("%s: coefficient %d of channel %d is %.9g instead of %.9g", what, i,
                         channel, value, expected[i]);
        }
        assert_true(found->coefficients[i][3] == 0);
    }
}

/// Coefficients of a field that is symmetric about an axis, from its mean against Legendre
/// polynomials: integral over the sphere of L, L cos and L (3 cos^2 - 1)/2.
static void zonal(const double axis[3], const double moments[3],
                  double coefficients[REFERENCE_HARMONICS]) {
    static const double cosine_factor[3] = {M_PI, 2 * M_PI / 3, M_PI / 4};
    for (int degree = 0; degree < 3; degree++)
        for (int order = -degree; order <= degree; order++)
            coefficients[degree * (degree + 1) + order] =
                cosine_factor[degree] * moments[degree] *
                reference_spherical_harmonic(degree, order, axis);
}

static double constant(const double direction[3], const double axis[3]) {
    (void)direction;
    (void)axis;
    return 0.7;
}

static double clamped_cosine(const double direction[3], const double axis[3]) {
    return fmax(reference_dot(direction, axis), 0);
}

static double hemisphere(const double direction[3], const double axis[3]) {
    return reference_dot(direction, axis) > 0;
}

/// A broad light and a narrower one beside it.
static double two_lights(const double direction[3], const double axis[3]) {
    const double other[3] = {axis[1], axis[2], axis[0]};
    return exp(2 * (reference_dot(direction, axis) - 1)) +
           0.5 * exp(8 * (reference_dot(direction, other) - 1));
}

static const double axes[][3] = {{1, 0, 0},     {-1, 0, 0},          {0, 1, 0},
                                 {0, -1, 0},    {0, 0, 1},           {0, 0, -1},
                                 {0.6, 0, 0.8}, {-0.36, 0.48, -0.8}, {0, -0.6, 0.8}};
enum { AXES = sizeof axes / sizeof *axes };

/// Also odd sizes, and one that fits a single group.
static void constant_light_is_constant(void **state) {
    static const int sizes[] = {1, 2, 13, 64};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        host_cube cube = cube_of(sizes[i], constant, axes[0]);
        irradiance_found found = project(*state, &cube);
        double expected[REFERENCE_HARMONICS];
        zonal(axes[0], (double[3]){0.7 * 4 * M_PI, 0, 0}, expected);
        check(&found, expected, 1e-6, "constant");
        free(cube.texels);
    }
}

static void check_field(fixture *f, light_field light, const double moments[3], double tolerance,
                        const char *what) {
    for (int i = 0; i < AXES; i++) {
        host_cube cube = cube_of(32, light, axes[i]);
        irradiance_found found = project(f, &cube);
        double expected[REFERENCE_HARMONICS];
        zonal(axes[i], moments, expected);
        check(&found, expected, tolerance, what);
        free(cube.texels);
    }
}

/// Ramamoorthi, Hanrahan 2001: the clamped cosine's own coefficients.
static void a_cosine_about_any_axis(void **state) {
    check_field(*state, clamped_cosine, (double[3]){M_PI, 2 * M_PI / 3, M_PI / 4}, 5e-4, "cosine");
}

static void half_of_the_sphere(void **state) {
    check_field(*state, hemisphere, (double[3]){2 * M_PI, M_PI, 0}, 2e-3, "hemisphere");
}

static void one_bright_texel(void **state) {
    const int size = 48;
    for (int i = 0; i < 12; i++) {
        host_cube cube = cube_allocate(size);
        // Corners first, then anywhere.
        int face = i % 6, x = i < 6 ? 0 : 7 * i % size, y = i < 6 ? size - 1 : 11 * i % size;
        set_texel(&cube, (face * size + y) * size + x, 1e5);
        double direction[3], expected[REFERENCE_HARMONICS] = {0};
        reference_cube_texel_direction(face, x, y, size, direction);
        reference_add_irradiance(direction, 1e5 * reference_cube_texel_solid_angle(x, y, size),
                                 expected);
        irradiance_found found = project(*state, &cube);
        check(&found, expected, 2e-6, "one texel");
        free(cube.texels);
    }
}

/// Rotating the lights and the normal gives the same irradiance.
static void rotation_changes_nothing(void **state) {
    static const double normals[][3] = {{0, 0, 1}, {0.48, -0.6, 0.64}, {-0.8, 0.6, 0}};
    // Columns: a rotation about (1, 1, 1)/sqrt 3 by 0.7.
    double c = cos(0.7), s = sin(0.7) / sqrt(3), o = (1 - c) / 3;
    const double rotation[3][3] = {
        {c + o, o + s, o - s}, {o - s, c + o, o + s}, {o + s, o - s, c + o}};
    const double *axis = axes[7];
    double turned[3] = {0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            turned[j] += axis[i] * rotation[i][j];
    // The second light's axis is the first's with its coordinates shifted, which is a rotation
    // about the same diagonal: they commute.
    host_cube cubes[2] = {cube_of(32, two_lights, axis), cube_of(32, two_lights, turned)};
    irradiance_found found[2] = {project(*state, &cubes[0]), project(*state, &cubes[1])};
    for (int i = 0; i < 3; i++) {
        double normal[3] = {0}, sums[2];
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                normal[k] += normals[i][j] * rotation[j][k];
        for (int j = 0; j < 2; j++) {
            double coefficients[REFERENCE_HARMONICS];
            for (int k = 0; k < REFERENCE_HARMONICS; k++)
                coefficients[k] = (double)found[j].coefficients[k][0];
            sums[j] = reference_harmonic_sum(coefficients, j ? normal : normals[i]);
        }
        if (!(fabs(sums[0] - sums[1]) <= 2e-4 * sums[0]))
            fail_msg("%g turned is %g", sums[0], sums[1]);
    }
    free(cubes[0].texels);
    free(cubes[1].texels);
}

/// 393216 texels of which one is 1e5 times brighter than the rest.
static void a_sun_does_not_drown_the_sky(void **state) {
    const int size = 256;
    host_cube cube = cube_allocate(size);
    uint64_t random = 91;
    for (int i = 0; i < 6 * size * size; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        set_texel(&cube, i, (double)(random >> 40) / (1 << 24));
    }
    const int sun = (4 * size + 100) * size + 77;
    set_texel(&cube, sun, 0);
    double expected[REFERENCE_HARMONICS], direction[3];
    reference_irradiance_of_cube(cube.texels, size, 0, expected);
    irradiance_found found = project(*state, &cube);
    check(&found, expected, 1e-6, "sky");
    set_texel(&cube, sun, 1e5);
    reference_cube_texel_direction(4, 77, 100, size, direction);
    reference_add_irradiance(direction, 1e5 * reference_cube_texel_solid_angle(77, 100, size),
                             expected);
    found = project(*state, &cube);
    check(&found, expected, 1e-6, "sun");
    free(cube.texels);
}

/// Coefficients from the level that is read against those of level 0, relative to the first: the
/// bounds that the pass's header states.
static double error_of_level(fixture *f, host_cube finest) {
    host_cube levels[MAXIMUM_LEVELS] = {finest};
    uint32_t last = 0;
    for (; levels[last].size > 64; last++)
        levels[last + 1] = cube_reduced(&levels[last]);
    // One more, which must not be read.
    levels[last + 1] = cube_reduced(&levels[last]);
    device_cube uploaded = upload(f, levels, last + 2);
    irradiance_found found = run(f, &uploaded, 0);
    release(&uploaded);
    double exact[REFERENCE_HARMONICS], read[REFERENCE_HARMONICS], worst = 0;
    reference_irradiance_of_cube(levels[0].texels, levels[0].size, 0, exact);
    reference_irradiance_of_cube(levels[last].texels, levels[last].size, 0, read);
    check(&found, read, 1e-6, "level");
    for (int i = 0; i < REFERENCE_HARMONICS; i++)
        worst = fmax(worst, fabs(read[i] - exact[i]) / exact[0]);
    for (uint32_t i = 0; i < last + 2; i++)
        free(levels[i].texels);
    return worst;
}

static void sixty_four_texels_are_enough(void **state) {
    double error = error_of_level(*state, cube_of(128, two_lights, axes[7]));
    print_message("# two lights: %.3g\n", error);
    assert_true(error <= 3e-5);
    // In the corner of a coarser texel, near the middle of a face.
    const int size = 256;
    host_cube sun = cube_allocate(size);
    set_texel(&sun, (4 * size + 128) * size + 128, 1e5);
    error = error_of_level(*state, sun);
    print_message("# sun: %.3g\n", error);
    assert_true(error <= 0.015);
}

/// Root mean square of a light's Laplacian with a window, as a part of that without.
static double laplacian_left(double lambda) {
    double before = 0, after = 0;
    for (int degree = 1; degree < 3; degree++) {
        double factor = degree == 1 ? 2 * M_PI / 3 : M_PI / 4;
        double laplacian = factor * degree * (degree + 1);
        double windowed = laplacian / (1 + lambda * pow(degree * (degree + 1), 2));
        before += (2 * degree + 1) * laplacian * laplacian;
        after += (2 * degree + 1) * windowed * windowed;
    }
    return sqrt(after / before);
}

static void a_window_takes_ringing_out(void **state) {
    assert_true(passes_harmonics_window(0) == 0);
    host_cube cube = cube_of(32, two_lights, axes[7]);
    device_cube uploaded = upload(*state, &cube, 1);
    double exact[REFERENCE_HARMONICS];
    reference_irradiance_of_cube(cube.texels, 32, 0, exact);
    static const double windows[] = {0, 0.1, 0.5, 0.9};
    for (size_t i = 0; i < sizeof windows / sizeof *windows; i++) {
        double lambda = passes_harmonics_window(windows[i]);
        assert_true(fabs(laplacian_left(lambda) - (1 - windows[i])) < 1e-9);
        double expected[REFERENCE_HARMONICS];
        for (int j = 0; j < REFERENCE_HARMONICS; j++)
            expected[j] = exact[j] / (1 + lambda * (j == 0 ? 0 : j < 4 ? 4 : 36));
        irradiance_found found = run(*state, &uploaded, windows[i]);
        check(&found, expected, 1e-6, "window");
    }
    release(&uploaded);
    free(cube.texels);
}

/// The normal of a texel inside the border of the map of what harmonics miss.
static void normal_of_texel(int column, int row, double normal[3]) {
    const double x = (2.0 * column - 1) / HARMONICS_REMAINDER_SIZE - 1;
    const double y = (2.0 * row - 1) / HARMONICS_REMAINDER_SIZE - 1;
    const double z = 1 - fabs(x) - fabs(y);
    const double folded[2] = {copysign(1 - fabs(y), x), copysign(1 - fabs(x), y)};
    const double length =
        sqrt((z < 0 ? folded[0] * folded[0] + folded[1] * folded[1] : x * x + y * y) + z * z);
    normal[0] = (z < 0 ? folded[0] : x) / length;
    normal[1] = (z < 0 ? folded[1] : y) / length;
    normal[2] = z / length;
}

/// Of the cube's texels as lights in the directions of their centres.
static double irradiance_at(const host_cube *cube, const double normal[3]) {
    double sum = 0, whole = 0;
    for (int i = 0; i < 6 * cube->size * cube->size; i++) {
        const int x = i % cube->size, y = i / cube->size % cube->size;
        double direction[3];
        reference_cube_texel_direction(i / (cube->size * cube->size), x, y, cube->size, direction);
        const double part = fmax(reference_dot(normal, direction), 0) *
                            reference_cube_texel_solid_angle(x, y, cube->size);
        sum += part * (double)cube->texels[4 * i];
        whole += part;
    }
    return M_PI * sum / whole;
}

/// Of the light near a normal's horizon, the share from below it.
static double share_below(const host_cube *cube, const double normal[3]) {
    double below = 0, all = 0;
    for (int i = 0; i < 6 * cube->size * cube->size; i++) {
        const int x = i % cube->size, y = i / cube->size % cube->size;
        double direction[3];
        reference_cube_texel_direction(i / (cube->size * cube->size), x, y, cube->size, direction);
        const double height = reference_dot(normal, direction);
        const double part = fmax(1 - fabs(height) / (double)HARMONICS_HORIZON_SINE, 0) *
                            reference_cube_texel_solid_angle(x, y, cube->size) *
                            (double)cube->texels[4 * i];
        below += part * fmin(fmax(0.5 - 20 * height, 0), 1);
        all += part;
    }
    return below / all;
}

/// Harmonics and what they miss are the irradiance. With a window nothing is added to them.
static void the_remainder_is_what_harmonics_miss(void **state) {
    enum { WIDTH = HARMONICS_REMAINDER_WIDTH };
    host_cube cube = cube_of(32, two_lights, axes[6]);
    set_texel(&cube, 2345, 2000); // a lamp
    const irradiance_found found = project(*state, &cube);
    double largest = 0, missed = 0, worst = 0;
    for (int i = 0; i < WIDTH * WIDTH; i += 5) {
        const int column = i % WIDTH, row = i / WIDTH;
        if (column == 0 || row == 0 || column == WIDTH - 1 || row == WIDTH - 1)
            continue;
        double normal[3], coefficients[REFERENCE_HARMONICS];
        normal_of_texel(column, row, normal);
        for (int j = 0; j < REFERENCE_HARMONICS; j++)
            coefficients[j] = (double)found.coefficients[j][0];
        const double expected = irradiance_at(&cube, normal);
        const double harmonics = fmax(reference_harmonic_sum(coefficients, normal), 0);
        const double remainder = (double)found.remainder[i][0];
        assert_float_equal((double)found.remainder[i][3], share_below(&cube, normal), 1e-4);
        largest = fmax(largest, expected);
        missed = fmax(missed, fabs(remainder));
        worst = fmax(worst, fabs(harmonics + remainder - expected));
        for (int c = 1; c < 3; c++)
            assert_true(fabs((double)found.remainder[i][c] - remainder * (1 << c)) <=
                        1e-5 * largest * (1 << c));
    }
    print_message("# harmonics miss %.3g of the peak, with the remainder %.3g\n", missed / largest,
                  worst / largest);
    assert_true(missed > 0.02 * largest);
    assert_true(worst < 1e-5 * largest);
    device_cube uploaded = upload(*state, &cube, 1);
    const irradiance_found windowed = run(*state, &uploaded, 0.5);
    for (int i = 0; i < WIDTH * WIDTH; i++)
        assert_true(windowed.remainder[i][0] == 0 &&
                    windowed.remainder[i][3] == found.remainder[i][3]);
    release(&uploaded);
    free(cube.texels);
}

/// No pass runs again; when rebuilt, all give the same bits.
static void a_still_environment_is_not_added_up_again(void **state) {
    fixture *f = *state;
    host_cube cube = cube_of(48, two_lights, axes[6]);
    device_cube uploaded = upload(f, &cube, 1);
    irradiance_found first = run(f, &uploaded, 0.25);
    irradiance_found kept = run(f, &uploaded, 0.25);
    assert_int_equal(count_passes(f->graph, NULL, LOBE_PASS_RUN), 0);
    lobe_graph_invalidate(f->graph);
    irradiance_found again = run(f, &uploaded, 0.25);
    assert_int_equal(count_passes(f->graph, "irradiance_harmonics", LOBE_PASS_RUN), 1);
    assert_memory_equal(&first, &kept, sizeof first);
    assert_memory_equal(&first, &again, sizeof first);
    release(&uploaded);
    free(cube.texels);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_light_is_constant),
        cmocka_unit_test(a_cosine_about_any_axis),
        cmocka_unit_test(half_of_the_sphere),
        cmocka_unit_test(one_bright_texel),
        cmocka_unit_test(rotation_changes_nothing),
        cmocka_unit_test(a_sun_does_not_drown_the_sky),
        cmocka_unit_test(sixty_four_texels_are_enough),
        cmocka_unit_test(a_window_takes_ringing_out),
        cmocka_unit_test(the_remainder_is_what_harmonics_miss),
        cmocka_unit_test(a_still_environment_is_not_added_up_again),
        cmocka_unit_test(validation_is_silent),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
