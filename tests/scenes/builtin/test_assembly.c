#include "tests/engine/support/cmocka_all.h"

#include "scenes/builtin/assembly.h"

// The rows of the image run down a plane and its columns to the right: height that grows along them
// must tilt the normal back along the tangent and forward along the bitangent.
static void normal_map_has_y_up(void **state) {
    (void)state;
    uint8_t texel[4];
    scenes_normal_map_store_slope(texel, 0, 0);
    assert_true(texel[0] == 128 && texel[1] == 128 && texel[2] == 255 && texel[3] == 255);
    scenes_normal_map_store_slope(texel, 0.5, 0);
    assert_true(texel[0] < 80 && texel[1] == 128);
    scenes_normal_map_store_slope(texel, 0, 0.5);
    assert_true(texel[0] == 128 && texel[1] > 176);
    scenes_normal_map_store(texel, 3, -4, 12);
    assert_int_equal(texel[0], (int)(127.5 + 127.5 * 3 / 13 + 0.5));
    assert_int_equal(texel[1], (int)(127.5 - 127.5 * 4 / 13 + 0.5));
    assert_int_equal(texel[2], (int)(127.5 + 127.5 * 12 / 13 + 0.5));
    scenes_normal_map_store(texel, -1, 0, 0);
    assert_true(texel[0] == 0 && texel[2] == 128);
    scenes_normal_map_store(texel, 1e-8, 1, 0);
    assert_int_equal(texel[1], 255);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_map_has_y_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
