// The filter "fournier": peaks of a texel against the formula of a Phong peak, and pixels between
// texels and levels against the sums of these.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/slope_plane.h"

/// (s + 1) / (2 pi) <n, h>^s.
static double phong_peak(const double normal[3], double exponent, const double half_vector[3]) {
    double cosine = 0;
    for (int i = 0; i < 3; i++)
        cosine += normal[i] * half_vector[i];
    return (exponent + 1) / (2 * M_PI) * pow(fmax(cosine, 0), exponent);
}

static void point_sun(lobe_scene *scene, const double half_vector[3], double intensity) {
    const double z = half_vector[2];
    slope_plane_add_sun(scene,
                        (double[]){2 * z * half_vector[0], 2 * z * half_vector[1], 2 * z * z - 1},
                        intensity);
}

static void set_normal(lobe_image *map, uint32_t texel, const double normal[3]) {
    for (uint32_t k = 0; k < 4; k++)
        ((float *)map->texels)[4 * texel + k] = k < 3 ? (float)(0.5 + 0.5 * normal[k]) : 1;
}

// ---------------------------------------------------------------------------------------------
// One texel

/// A plane of the normals in a row of `count` texels, seen from above as one pixel.
static double draw_row(fixture *f, const double (*normals)[3], uint32_t count, float exponent,
                       const double half_vector[3]) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, count, 1);
    for (uint32_t i = 0; i < count; i++)
        set_normal(&map, i, normals[i]);
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, exponent), mapped;
    lobe_scene *scene = slope_plane(&material, &map, (double[]){0, 0, 1}, &mapped);
    lobe_image_free(&map);
    point_sun(scene, half_vector, 1);
    float colour[3];
    slope_plane_draw(f, scene, "fournier", NULL, colour);
    lobe_scene_destroy(&scene);
    return (double)colour[0];
}

/// At the pole and around it, alike or up to 0.5 radians away.
static void check_row(fixture *f, uint32_t count, double tilt, float exponent, double tolerance) {
    double normals[7][3];
    for (uint32_t i = 0; i < count; i++)
        slope_plane_direction(tilt * (count > 2 && i == 0 ? 0 : 180 / M_PI),
                              count > 2 ? i * M_PI / 3 : 0.4, normals[i]);
    for (int k = 0; k < 4; k++) {
        double half_vector[3], expected = 0;
        slope_plane_direction(13 * k, 0.5, half_vector);
        for (uint32_t i = 0; i < count; i++)
            expected += phong_peak(normals[i], (double)exponent, half_vector) / count;
        const double found = draw_row(f, normals, count, exponent, half_vector);
        if (!(fabs(found - expected) <= tolerance * expected + 1e-4))
            fail_msg("%u normals, tilt %g, %d degrees: %g instead of %g", count, tilt, 13 * k,
                     found, expected);
    }
}

static void lobes_of_blinn_phong_stay_as_they_are(void **state) {
    check_row(*state, 2, 0, 30, 1e-3);
    check_row(*state, 2, 0.3, 30, 1e-3);
    check_row(*state, 2, 0.8, 60, 1e-3);
}

static void seven_normals_are_seven_peaks(void **state) {
    check_row(*state, 7, 0.5, 200, 0.01);
}

/// Over half vectors up to 40 degrees, about which the lobes spread by 8.
static void peaks_have_the_mass_of_lobes(void **state) {
    enum { SIDE = 28 };
    const double step = 2 * 0.7 / SIDE;
    lobe_image map = slope_plane_bumpy_map(8, 0.1);
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 100), mapped;
    lobe_scene *scene = slope_plane(&material, &map, (double[]){0, 0, 1}, &mapped);
    lobe_image_free(&map);
    for (int i = 0; i < SIDE * SIDE; i++) {
        // Equal areas of the Lambert plane.
        const double x = (i % SIDE + 0.5) * step - 0.7, y = (i / SIDE + 0.5) * step - 0.7;
        const double square = x * x + y * y, factor = sqrt(1 - square / 4);
        if (square < 0.7 * 0.7)
            point_sun(scene, (double[]){x * factor, y * factor, 1 - square / 2}, step * step);
    }
    float colour[3];
    slope_plane_draw(*state, scene, "fournier", NULL, colour);
    lobe_scene_destroy(&scene);
    assert_float_equal(colour[0], 1, 0.003);
}

// ---------------------------------------------------------------------------------------------
// Between texels

/// Texels of 0.25 m, of which those of level 1 are at +-0.25 and +-0.75 along x and z.
static lobe_scene *floor_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 60);
    material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.6, 231));
    material.normal_map.nearest = true;
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 1);
    scene_add_sun(scene, (const double[]){0.4, 1, -0.1}, 1);
    scene_end(scene);
    return scene;
}

/// What a pixel sees of the floor that is as wide as texels of `level`.
static double draw_at(fixture *f, lobe_scene *scene, const char *filter, double x, double z,
                      double level) {
    scene->camera.eye[0] = scene->camera.target[0] = (float)x;
    scene->camera.eye[2] = scene->camera.target[2] = (float)z;
    scene->camera.orthographic_height = (float)(0.25 * exp2(level));
    lobe_frame frame = draw_scene(
        f, scene,
        &(picture_request){.filter = filter, .settings = {"bias=0"}, .width = 1, .height = 1});
    const double value = (double)*pixel_at(&frame.radiance, 0, 0);
    lobe_frame_free(&frame);
    return value;
}

/// The difference between a pixel, at a quarter along x and half along z between four texels of
/// level 1, and the weighted sum of these texels' own pixels, relative to the sum.
static double difference_between_texels(fixture *f, lobe_scene *scene, const char *filter) {
    double sum = 0;
    for (int i = 0; i < 4; i++)
        sum += 0.5 * (i % 2 ? 0.25 : 0.75) *
               draw_at(f, scene, filter, i % 2 ? 0.25 : -0.25, i / 2 ? 0.25 : -0.25, 1);
    return fabs(draw_at(f, scene, filter, -0.125, 0, 1) - sum) / sum;
}

/// One Gaussian between two is none of these.
static void between_texels_are_their_weighted_sums(void **state) {
    lobe_scene *scene = floor_scene();
    const double found = difference_between_texels(*state, scene, "fournier"),
                 blended = difference_between_texels(*state, scene, "tan");
    print_message("# apart from the sum by %g, tan by %g\n", found, blended);
    assert_true(found < 1e-4 && blended > 0.01);
    lobe_scene_destroy(&scene);
}

static void between_levels_are_their_weighted_sums(void **state) {
    lobe_scene *scene = floor_scene();
    double at[5];
    static const double levels[] = {1, 2, 1.25, 2 - 1e-3, 2 + 1e-3};
    for (int i = 0; i < 5; i++)
        at[i] = draw_at(*state, scene, "fournier", 0.1, -0.3, levels[i]);
    assert_float_equal(at[2], 0.75 * at[0] + 0.25 * at[1], 1e-4 * at[0]);
    assert_true(fabs(at[0] - at[1]) > 0.05 * at[1]);
    assert_float_equal(at[3], at[1], 2e-3 * fmax(at[0], at[1]));
    assert_float_equal(at[4], at[1], 2e-3 * fmax(at[0], at[1]));
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobes_of_blinn_phong_stay_as_they_are),
        cmocka_unit_test(seven_normals_are_seven_peaks),
        cmocka_unit_test(peaks_have_the_mass_of_lobes),
        cmocka_unit_test(between_texels_are_their_weighted_sums),
        cmocka_unit_test(between_levels_are_their_weighted_sums),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
