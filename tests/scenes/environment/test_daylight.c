// The sky's formulae, at points with independently known values.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "scenes/environment/daylight.h"

static vector3 from_angles(double height, double turn) {
    return (vector3){cos(height) * sin(turn), sin(height), cos(height) * cos(turn)};
}

// Straight up, the distribution is 1: Preetham et al. 1999, appendix A.2, computed by hand for a
// turbidity of 3 and the sun 30 degrees from the zenith.
static void the_zenith_is_as_printed(void **state) {
    (void)state;
    const double angle = M_PI / 6;
    const daylight light = scenes_daylight_of(from_angles(M_PI / 2 - angle, 0.3), 3);
    const double luminance =
        (4.0453 * 3 - 4.9710) * tan((4.0 / 9 - 3.0 / 120) * (M_PI - 2 * angle)) - 0.2155 * 3 +
        2.4192;
    double rgb[3];
    scenes_daylight_sky(&light, (vector3){0, 1, 0}, rgb);
    assert_true(fabs(scenes_daylight_luminance(rgb) / luminance - 1) < 1e-3);
    assert_true(rgb[2] > rgb[1] && rgb[1] > rgb[0]); // blue
}

// A clear noon has 80 to 110 klx from the sun and 10 to 30 klx from the sky; the ratio of blue to
// red falls as the sun sets.
static void illuminance_is_that_of_a_clear_day(void **state) {
    (void)state;
    double redness = 0;
    for (int degrees = 80; degrees >= 10; degrees -= 10) {
        const daylight light = scenes_daylight_of(from_angles(degrees * M_PI / 180, 1), 2.5);
        const double *sun = light.sun_irradiance;
        double ground[3];
        scenes_daylight_ground_irradiance(&light, ground);
        const double direct = scenes_daylight_luminance(sun);
        const double sky = scenes_daylight_luminance(ground) - direct * light.sun.y;
        if (degrees >= 60) {
            assert_true(direct > 80 && direct < 110);
            assert_true(sky > 10 && sky < 30);
        }
        assert_true(sky > 0);
        assert_true(sun[0] / sun[2] > redness);
        redness = sun[0] / sun[2];
    }
}

static void the_sky_is_brightest_by_the_sun(void **state) {
    (void)state;
    const vector3 sun = from_angles(0.7, 2);
    const daylight light = scenes_daylight_of(sun, 3);
    double nearest[3], rgb[3];
    scenes_daylight_sky(&light, sun, nearest);
    for (int i = 1; i < 12; i++) {
        scenes_daylight_sky(&light, from_angles(0.7, 2 + 0.25 * i), rgb);
        assert_true(scenes_daylight_luminance(rgb) < scenes_daylight_luminance(nearest));
        for (int c = 0; c < 3; c++)
            assert_true(rgb[c] >= 0 && isfinite(rgb[c]));
    }
}

static void the_sky_turns_with_the_sun(void **state) {
    (void)state;
    const daylight a = scenes_daylight_of(from_angles(0.7, 0), 3),
                   b = scenes_daylight_of(from_angles(0.7, 1), 3);
    double left[3], right[3];
    for (int i = 0; i < 10; i++) {
        scenes_daylight_sky(&a, from_angles(0.12 * i, 0.4 * i), left);
        scenes_daylight_sky(&b, from_angles(0.12 * i, 0.4 * i + 1), right);
        for (int c = 0; c < 3; c++)
            assert_true(fabs(left[c] - right[c]) < 1e-9);
    }
}

static void nothing_is_infinite_at_the_edges(void **state) {
    (void)state;
    const vector3 suns[] = {{0, 1, 0}, from_angles(0.01, 0)};
    for (int i = 0; i < 2; i++) {
        const daylight light = scenes_daylight_of(suns[i], i ? 2 : 10);
        const vector3 directions[] = {{0, 1, 0}, {1, 0, 0}, {0, -1, 0}, suns[i]};
        for (int k = 0; k < 4; k++) {
            double rgb[3];
            scenes_daylight_sky(&light, directions[k], rgb);
            for (int c = 0; c < 3; c++)
                assert_true(rgb[c] >= 0 && rgb[c] < 1e3);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_zenith_is_as_printed),
        cmocka_unit_test(illuminance_is_that_of_a_clear_day),
        cmocka_unit_test(the_sky_is_brightest_by_the_sun),
        cmocka_unit_test(the_sky_turns_with_the_sun),
        cmocka_unit_test(nothing_is_infinite_at_the_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
