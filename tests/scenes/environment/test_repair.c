// Repair of impossible radiance: negative, NaN and infinite numbers.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes/environment/environment.h"
#include "scenes/environment/repair.h"
#include "tests/engine/support/log_recorder.h"

static lobe_environment *environment_of(lobe_environment_layout layout, uint32_t width,
                                        uint32_t height) {
    lobe_environment *environment;
    assert_int_equal(scenes_environment_allocate("e", NULL, &environment), LOBE_OK);
    environment->layout = layout;
    assert_int_equal(
        lobe_image_allocate(&environment->image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
        LOBE_OK);
    float *texels = environment->image.texels;
    for (size_t i = 0; i < 4 * (size_t)width * height; i++)
        texels[i] = (float)(1 + i / 4);
    return environment;
}

static float *texel(lobe_environment *environment, uint32_t x, uint32_t y) {
    return (float *)environment->image.texels + 4 * ((size_t)y * environment->image.width + x);
}

static void expect_repair(lobe_environment *environment, const char *warning) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(scenes_environment_repair(environment, &recorder.host), LOBE_OK);
    assert_int_equal(recorder.errors, 0);
    assert_int_equal(recorder.warnings, warning != NULL);
    if (warning && !strstr(recorder.last_warning, warning))
        fail_msg("no '%s' in: %s", warning, recorder.last_warning);
    const float *texels = environment->image.texels;
    for (size_t i = 0; i < 4 * (size_t)environment->image.width * environment->image.height; i++)
        assert_true(texels[i] >= 0 && isfinite(texels[i]));
}

static void light_stays_as_it_is(void **state) {
    (void)state;
    lobe_environment *environment = environment_of(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 4, 2);
    texel(environment, 1, 1)[3] = NAN; // ignored
    texel(environment, 2, 1)[0] = 0;
    expect_repair(environment, NULL);
    for (uint32_t i = 0; i < 8; i++) {
        assert_true(texel(environment, i, 0)[0] == (i == 6 ? 0 : (float)(i + 1)));
        assert_true(texel(environment, i, 0)[3] == 1);
    }
    lobe_environment_destroy(&environment);
}

static void each_kind_is_mended_and_counted(void **state) {
    (void)state;
    lobe_environment *environment = environment_of(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 5, 4);
    texel(environment, 0, 0)[0] = -3;
    texel(environment, 3, 1)[0] = -1e-20f;
    texel(environment, 3, 1)[2] = -7; // the same texel
    texel(environment, 1, 1)[1] = NAN;
    texel(environment, 4, 3)[2] = INFINITY;
    texel(environment, 3, 3)[2] = -INFINITY;
    expect_repair(environment, "2 negative, 1 NaN, 2 infinite");
    assert_true(texel(environment, 0, 0)[0] == 0);
    assert_true(texel(environment, 3, 1)[0] == 0 && texel(environment, 3, 1)[2] == 0);
    // Green of the neighbours: 1 2 3, 6 8, 11 12 13.
    assert_true(texel(environment, 1, 1)[1] == 7);
    assert_true(texel(environment, 1, 1)[0] == 7); // unchanged
    // Blue around the corner (4, 3): 14 and 15 above; nothing beside it is finite.
    assert_true(texel(environment, 4, 3)[2] == 14.5f);
    // Around (3, 3): 13, 14, 15 above and 18 on the left, all unrepaired.
    assert_true(texel(environment, 3, 3)[2] == 15);
    lobe_environment_destroy(&environment);
}

static void negative_neighbours_count_as_dark(void **state) {
    (void)state;
    lobe_environment *environment = environment_of(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 3, 1);
    texel(environment, 0, 0)[0] = -100;
    texel(environment, 1, 0)[0] = NAN;
    expect_repair(environment, "1 negative, 1 NaN, 0 infinite");
    assert_true(texel(environment, 1, 0)[0] == 1.5f);
    lobe_environment_destroy(&environment);
}

static void without_a_neighbour_it_is_dark(void **state) {
    (void)state;
    lobe_environment *environment = environment_of(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 3, 3);
    for (uint32_t i = 0; i < 9; i++)
        texel(environment, i, 0)[1] = NAN;
    expect_repair(environment, "0 negative, 9 NaN, 0 infinite");
    for (uint32_t i = 0; i < 9; i++)
        assert_true(texel(environment, i, 0)[1] == 0);
    lobe_environment_destroy(&environment);
    environment = environment_of(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 1, 1);
    texel(environment, 0, 0)[2] = INFINITY;
    expect_repair(environment, "0 negative, 0 NaN, 1 infinite");
    assert_true(texel(environment, 0, 0)[2] == 0);
    lobe_environment_destroy(&environment);
}

// Beyond the edge of a face there is another part of the sphere, or nothing at all.
static void neighbours_are_of_the_same_face(void **state) {
    (void)state;
    lobe_environment *environment = environment_of(LOBE_ENVIRONMENT_CUBE_COLUMN, 2, 12);
    texel(environment, 0, 2)[0] = NAN; // the top left of the second face, next to 6, 7, 8
    expect_repair(environment, "1 NaN");
    assert_true(texel(environment, 0, 2)[0] == 7);
    lobe_environment_destroy(&environment);
    environment = environment_of(LOBE_ENVIRONMENT_CUBE_ROW, 12, 2);
    texel(environment, 2, 0)[0] = NAN; // 4, 15 and 16
    expect_repair(environment, "1 NaN");
    assert_true(fabsf(texel(environment, 2, 0)[0] - 35.0f / 3) < 1e-5f);
    lobe_environment_destroy(&environment);
}

static void empty_parts_of_crosses_are_cleared_unsaid(void **state) {
    (void)state;
    lobe_environment *environment = environment_of(LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 8, 6);
    for (uint32_t i = 0; i < 48; i++) {
        const uint32_t column = i % 8 / 2, row = i / 8 / 2;
        if (row != 1 && column != 1)
            texel(environment, i, 0)[i % 3] = i % 2 ? NAN : -1;
    }
    expect_repair(environment, NULL);
    assert_true(texel(environment, 0, 0)[0] == 0 && texel(environment, 7, 5)[2] == 0);
    assert_true(texel(environment, 2, 0)[0] == 3 && texel(environment, 7, 3)[0] == 32);
    lobe_environment_destroy(&environment);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_stays_as_it_is),
        cmocka_unit_test(each_kind_is_mended_and_counted),
        cmocka_unit_test(negative_neighbours_count_as_dark),
        cmocka_unit_test(without_a_neighbour_it_is_dark),
        cmocka_unit_test(neighbours_are_of_the_same_face),
        cmocka_unit_test(empty_parts_of_crosses_are_cleared_unsaid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
