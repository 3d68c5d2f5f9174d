#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/noise.h"
#include "scenes/material/height_scale.h"

enum { WIDTH = 192, HEIGHT = 96, PERIOD = 8 };

typedef struct relief {
    lobe_image heights, normals;
} relief;

// Noise in 16 bits, as heights and as their normals; the range of the heights spans `scale` of the
// width. Equal seeds give the same noise.
static relief make_relief(double scale, uint32_t height_seed, uint32_t normal_seed) {
    relief made;
    assert_int_equal(
        lobe_image_allocate(&made.heights, LOBE_FORMAT_RGBA16_UNORM, WIDTH, HEIGHT, NULL), LOBE_OK);
    assert_int_equal(
        lobe_image_allocate(&made.normals, LOBE_FORMAT_RGBA8_UNORM, WIDTH, HEIGHT, NULL), LOBE_OK);
    uint16_t *height = made.heights.texels;
    uint8_t *normal = made.normals.texels;
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++, height += 4, normal += 4) {
            double x = (column + 0.5) / 12, y = (row + 0.5) / 12, slope[2];
            height[0] =
                (uint16_t)((0.5 + 0.5 * scenes_noise_gradient(x, y, PERIOD, height_seed, NULL)) *
                           65535);
            scenes_noise_gradient(x, y, PERIOD, normal_seed, slope);
            double per_width = scale * 0.5 * WIDTH / 12;
            scenes_normal_map_store_slope(normal, slope[0] * per_width, slope[1] * per_width);
        }
    return made;
}

static void free_relief(relief *made) {
    lobe_image_free(&made->heights);
    lobe_image_free(&made->normals);
}

static void the_scale_of_a_relief_is_found(void **state) {
    (void)state;
    static const double scales[] = {0.3, 0.1, 0.03, -0.1};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        relief made = make_relief(scales[i], 5, 5);
        float scale = 0;
        assert_true(scenes_height_scale_find(&made.heights, &made.normals, &scale));
        // Differences of neighbours are slightly flatter than the slopes, and normals have eight
        // bits.
        assert_true(fabs(scale / scales[i] - 1) < 0.06);
        free_relief(&made);
    }
}

static void what_does_not_agree_is_refused(void **state) {
    (void)state;
    float scale = 7;
    relief made = make_relief(0.1, 5, 6);
    assert_false(scenes_height_scale_find(&made.heights, &made.normals, &scale));
    made.heights.height = HEIGHT / 2;
    assert_false(scenes_height_scale_find(&made.heights, &made.normals, &scale));
    free_relief(&made);
    made = make_relief(0, 5, 5);
    assert_false(scenes_height_scale_find(&made.heights, &made.normals, &scale));
    assert_true(scale == 7);
    free_relief(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scale_of_a_relief_is_found),
        cmocka_unit_test(what_does_not_agree_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
