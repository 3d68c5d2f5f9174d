// The built-in environment "sky": how much light it gives, and from where.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include "scenes/environment/direction.h"
#include "scenes/environment/environment.h"
#include "scenes/environment/sky.h"

// The light of a channel from within `cosine` around a direction, and the irradiance from it.
static double light_about(const lobe_environment *environment, int channel, vector3 direction,
                          double cosine, bool projected) {
    const lobe_image *image = &environment->image;
    double sum = 0;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++) {
            double d[3];
            if (!scenes_environment_direction(environment->layout, image->width, image->height,
                                              (double[2]){x + 0.5, y + 0.5}, d))
                continue;
            const double along = vector3_dot((vector3){d[0], d[1], d[2]}, direction);
            if (along < cosine)
                continue;
            const double angle = scenes_environment_solid_angle(
                environment->layout, image->width, image->height, x, y, x + 1.0, y + 1.0);
            sum += (projected ? fmax(along, 0) : 1) * angle *
                   ((const float *)image->texels)[4 * ((size_t)y * image->width + x) + channel];
        }
    }
    return sum;
}

static lobe_environment *black(lobe_environment_layout layout, uint32_t width, uint32_t height) {
    lobe_environment *environment;
    assert_int_equal(scenes_environment_allocate("black", NULL, &environment), LOBE_OK);
    environment->layout = layout;
    assert_int_equal(
        lobe_image_allocate(&environment->image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
        LOBE_OK);
    return environment;
}

static void a_disc_keeps_its_light_at_any_resolution(void **state) {
    (void)state;
    const struct {
        lobe_environment_layout layout;
        uint32_t width, height;
    } shapes[] = {{LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 1, 1},
                  {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 7, 5},
                  {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 64, 32},
                  {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 512, 256},
                  {LOBE_ENVIRONMENT_CUBE_COLUMN, 16, 96},
                  {LOBE_ENVIRONMENT_VERTICAL_CROSS, 192, 256}};
    const vector3 directions[] = {{0.48, 0.6, -0.64}, {0, 1, 0}, {0, 0, -1}, {0, -0.6, 0.8}};
    const double irradiance[3] = {3, 0.5, 1000};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        for (size_t d = 0; d < sizeof directions / sizeof *directions; d++) {
            lobe_environment *environment =
                black(shapes[s].layout, shapes[s].width, shapes[s].height);
            scenes_environment_add_disc(environment, directions[d], 0.00465, irradiance);
            for (int channel = 0; channel < 3; channel++) {
                const double light = light_about(environment, channel, directions[d], -2, false);
                assert_true(fabs(light / irradiance[channel] - 1) < 1e-6);
            }
            lobe_environment_destroy(&environment);
        }
    }
}

// On texels much smaller than itself, the disc is uniform, with its own radius, and dark around it.
static void a_disc_is_even_and_round(void **state) {
    (void)state;
    const vector3 direction = {0, 0, 1};
    const double radius = 0.3;
    lobe_environment *environment = black(LOBE_ENVIRONMENT_CUBE_COLUMN, 64, 384);
    const double angle = 2 * M_PI * (1 - cos(radius));
    scenes_environment_add_disc(environment, direction, radius, (double[3]){angle, angle, angle});
    for (uint32_t y = 0; y < 384; y++) {
        for (uint32_t x = 0; x < 64; x++) {
            double d[3];
            assert_true(scenes_environment_direction(environment->layout, 64, 384,
                                                     (double[2]){x + 0.5, y + 0.5}, d));
            const float found = ((const float *)environment->image.texels)[4 * (y * 64 + x)];
            if (acos(d[2]) < radius - 0.04)
                assert_true(fabsf(found - 1) < 0.15f);
            else if (acos(d[2]) > radius + 0.04)
                assert_true(found == 0);
        }
    }
    lobe_environment_destroy(&environment);
}

static lobe_environment *sky_of(uint32_t width, uint32_t height) {
    lobe_environment *environment;
    assert_int_equal(scenes_environment_sky(width, height, NULL, &environment), LOBE_OK);
    const float *texels = environment->image.texels;
    for (size_t i = 0; i < 4 * (size_t)width * height; i++)
        assert_true(isfinite(texels[i]) && texels[i] >= 0);
    return environment;
}

static double luminance_on(const lobe_environment *environment, vector3 normal) {
    return (0.2126 * light_about(environment, 0, normal, -2, true) +
            0.7152 * light_about(environment, 1, normal, -2, true) +
            0.0722 * light_about(environment, 2, normal, -2, true)) /
           M_PI;
}

static void a_white_level_surface_has_luminance_one(void **state) {
    (void)state;
    lobe_environment *environment = sky_of(512, 256);
    assert_true(fabs(luminance_on(environment, (vector3){0, 1, 0}) - 1) < 0.005);
    // From below, the ground alone.
    const double below = luminance_on(environment, (vector3){0, -1, 0});
    assert_true(fabs(below - 0.2) < 0.005);
    lobe_environment_destroy(&environment);
}

static void the_sun_is_where_it_is_said_to_be(void **state) {
    (void)state;
    lobe_environment *environment = sky_of(512, 256);
    const double height = 40 * M_PI / 180;
    const vector3 sun = {-0.5 * cos(height), sin(height), cos(M_PI / 6) * cos(height)};
    const double disc = light_about(environment, 1, sun, cos(0.02), false);
    const double all = light_about(environment, 1, sun, -2, false);
    assert_true(disc > 0.4 * all); // the sun is brighter than all the rest
    assert_true(luminance_on(environment, sun) > luminance_on(environment, (vector3){0, 1, 0}));
    lobe_environment_destroy(&environment);
}

// Apart from the sun, texels of the sky are means: coarse images give nearly the same light.
static void all_sizes_bring_the_same_light(void **state) {
    (void)state;
    lobe_environment *fine = sky_of(256, 128);
    const double expected = light_about(fine, 1, (vector3){0, 1, 0}, -2, false);
    const uint32_t sizes[][2] = {{64, 32}, {33, 17}, {8, 4}, {1024, 512}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lobe_environment *environment = sky_of(sizes[i][0], sizes[i][1]);
        const double light = light_about(environment, 1, (vector3){0, 1, 0}, -2, false);
        assert_true(fabs(light / expected - 1) < 0.02);
        lobe_environment_destroy(&environment);
    }
    lobe_environment *one = sky_of(1, 1);
    lobe_environment_destroy(&one);
    lobe_environment_destroy(&fine);
}

static void sky_is_opened_by_name(void **state) {
    (void)state;
    lobe_environment *environment;
    assert_int_equal(lobe_environment_open("sky", NULL, &environment), LOBE_OK);
    assert_string_equal(environment->name, "sky");
    assert_int_equal(environment->image.width, 1024);
    assert_int_equal(environment->image.height, 512);
    assert_int_equal(environment->layout, LOBE_ENVIRONMENT_LATITUDE_LONGITUDE);
    assert_true(environment->intensity == 1);
    lobe_environment_destroy(&environment);
    assert_null(environment);
    assert_int_equal(scenes_environment_sky(0, 4, NULL, &environment), LOBE_ERROR_LIMIT);
    assert_null(environment);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disc_keeps_its_light_at_any_resolution),
        cmocka_unit_test(a_disc_is_even_and_round),
        cmocka_unit_test(a_white_level_surface_has_luminance_one),
        cmocka_unit_test(the_sun_is_where_it_is_said_to_be),
        cmocka_unit_test(all_sizes_bring_the_same_light),
        cmocka_unit_test(sky_is_opened_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
