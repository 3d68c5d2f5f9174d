// The filter "tan" against the formulas of Tan et al. 2005 as repaired: what it stores for one
// texel, what interpolation makes of two, and how both shade.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/slope_plane.h"

static const double concentration = 40;

/// A plane of the normals in a row of `count` texels, seen from above as one pixel.
static float draw_row(fixture *f, const double (*normals)[3], uint32_t count,
                      const double half_vector[3], const char *setting) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, count, 1);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++)
            ((float *)map.texels)[4 * i + (uint32_t)k] =
                k < 3 ? (float)(0.5 + 0.5 * normals[i][k]) : 1;
    const double outgoing[3] = {0, 0, 1};
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, (float)concentration);
    lobe_material mapped;
    lobe_scene *scene = slope_plane(&material, &map, outgoing, &mapped);
    lobe_image_free(&map);
    const double z = half_vector[2];
    slope_plane_add_sun(
        scene, (double[]){2 * z * half_vector[0], 2 * z * half_vector[1], 2 * z * z - 1}, 1);
    float colour[3];
    slope_plane_draw(f, scene, "tan", setting, colour);
    lobe_scene_destroy(&scene);
    return colour[0];
}

/// g h_z for a Gaussian about `mean` along x.
static double density(double mean, double variance, const double half_vector[3]) {
    const double x = half_vector[0] - mean, y = half_vector[1];
    return half_vector[2] * exp(-0.5 * (x * x + y * y) / variance) / (2 * M_PI * variance);
}

/// The base lobe, foreshortened: 1 outwards to n_z^2 along the tilt.
static double base_variance(double tilt) {
    const double z = cos(tilt);
    return (0.5 + 0.5 * z * z) / concentration;
}

static const double half_angles[] = {-20, 0, 8, 25, 40};
enum { HALF_VECTORS = sizeof half_angles / sizeof *half_angles };

static void one_normal_is_one_gaussian(void **state) {
    static const double tilts[] = {0, 0.3, 0.7};
    for (int i = 0; i < 3; i++) {
        const double normals[2][3] = {{sin(tilts[i]), 0, cos(tilts[i])},
                                      {sin(tilts[i]), 0, cos(tilts[i])}};
        for (int k = 0; k < HALF_VECTORS; k++) {
            double half_vector[3];
            slope_plane_direction(half_angles[k], 0, half_vector);
            const double expected = density(sin(tilts[i]), base_variance(tilts[i]), half_vector);
            const double found = (double)draw_row(*state, normals, 2, half_vector, NULL);
            if (!(fabs(found - expected) <= 0.01 * expected + 2e-3))
                fail_msg("tilt %g, %g degrees: %g instead of %g", tilts[i], half_angles[k], found,
                         expected);
        }
    }
}

/// Two lobes at +-a in one Gaussian: its variance is theirs and a^2 along x, a^2 / 2 along each
/// axis of a round one. What the paper prints counts a^2 twice, less the variance that it leaves
/// out.
static void one_gaussian_covers_two(void **state) {
    const double a = 0.2, z = sqrt(1 - a * a);
    const double normals[2][3] = {{a, 0, z}, {-a, 0, z}};
    const double variance = base_variance(asin(a)) + 0.5 * a * a;
    for (int k = 0; k < HALF_VECTORS; k++) {
        double half_vector[3];
        slope_plane_direction(half_angles[k], 0, half_vector);
        const double expected = density(0, variance, half_vector);
        const double found = (double)draw_row(*state, normals, 2, half_vector, "components=1");
        if (!(fabs(found - expected) <= 0.01 * expected + 2e-3))
            fail_msg("%g degrees: %g instead of %g", half_angles[k], found, expected);
    }
}

/// With a component for each, the two stay apart.
static void two_components_are_two_gaussians(void **state) {
    const double a = 0.4, z = sqrt(1 - a * a);
    const double normals[2][3] = {{a, 0, z}, {-a, 0, z}};
    for (int k = 0; k < HALF_VECTORS; k++) {
        double half_vector[3];
        slope_plane_direction(half_angles[k], 0, half_vector);
        const double variance = base_variance(asin(a));
        const double expected =
            0.5 * (density(a, variance, half_vector) + density(-a, variance, half_vector));
        const double found = (double)draw_row(*state, normals, 2, half_vector, "components=2");
        if (!(fabs(found - expected) <= 0.02 * expected + 5e-3))
            fail_msg("%g degrees: %g instead of %g", half_angles[k], found, expected);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_normal_is_one_gaussian),
        cmocka_unit_test(one_gaussian_covers_two),
        cmocka_unit_test(two_components_are_two_gaussians),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
