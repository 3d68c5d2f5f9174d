#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdlib.h>

#include "tools/compare/silhouettes.h"

#define SIZE 24

static float texels[4 * SIZE * SIZE];
static const lobe_image depth = {LOBE_FORMAT_RGBA32_FLOAT, SIZE, SIZE, texels};

static void set_depths(double (*depth_at)(int x, int y)) {
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            texels[4 * (y * SIZE + x)] = (float)depth_at(x, y);
}

static size_t count_part(compare_part part) {
    bool *pixels;
    assert_int_equal(silhouettes_find_part(&depth, part, NULL, &pixels), LOBE_OK);
    size_t count = 0;
    for (int index = 0; index < SIZE * SIZE; index++)
        count += pixels[index];
    free(pixels);
    return count;
}

/// Depths from 1 to 24: a plane seen at about 89 degrees.
static double seen_flat(int x, int y) {
    (void)x;
    return SIZE / (y + 1.0);
}

static void a_plane_has_none(void **state) {
    (void)state;
    set_depths(seen_flat);
    assert_int_equal(count_part(COMPARE_PART_SILHOUETTES), 0);
    assert_int_equal(count_part(COMPARE_PART_INSIDE), SIZE * SIZE);
}

static double ending_at_8(int x, int y) {
    (void)y;
    return x < 8 ? 0.0 : 3.0;
}

static void the_border_to_the_background_is_found(void **state) {
    (void)state;
    set_depths(ending_at_8);
    // Columns 7 and 8 are beside the border; 6 and 9 beside those.
    assert_int_equal(count_part(COMPARE_PART_SILHOUETTES), 4 * SIZE);
    assert_int_equal(count_part(COMPARE_PART_INSIDE), (SIZE - 10) * SIZE);
}

static double stepping_at_12(int x, int y) {
    (void)x;
    return y < 12 ? 2.0 : 4.0;
}

static void one_thing_before_another_is_found(void **state) {
    (void)state;
    set_depths(stepping_at_12);
    assert_int_equal(count_part(COMPARE_PART_SILHOUETTES), 4 * SIZE);
    assert_int_equal(count_part(COMPARE_PART_INSIDE), (SIZE - 4) * SIZE);
}

/// Steps of 1 % of the depth between neighbours are relief.
static double rough(int x, int y) {
    return 5.0 + 0.05 * ((x + y) % 2);
}

static void small_relief_has_none(void **state) {
    (void)state;
    set_depths(rough);
    assert_int_equal(count_part(COMPARE_PART_SILHOUETTES), 0);
}

static double strange(int x, int y) {
    const double values[] = {NAN, INFINITY, -INFINITY, -1.0, 0.0};
    return values[(x + 3 * y) % 5];
}

static void what_is_no_depth_is_background(void **state) {
    (void)state;
    set_depths(strange);
    assert_int_equal(count_part(COMPARE_PART_SILHOUETTES), 0);
    assert_int_equal(count_part(COMPARE_PART_INSIDE), 0);
}

static void all_needs_no_list(void **state) {
    (void)state;
    bool *pixels;
    assert_int_equal(silhouettes_find_part(&depth, COMPARE_PART_ALL, NULL, &pixels), LOBE_OK);
    assert_null(pixels);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_has_none),
        cmocka_unit_test(the_border_to_the_background_is_found),
        cmocka_unit_test(one_thing_before_another_is_found),
        cmocka_unit_test(small_relief_has_none),
        cmocka_unit_test(what_is_no_depth_is_background),
        cmocka_unit_test(all_needs_no_list),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
