// Texels of colour maps as the host reads them: the right one under each texel of the grid, linear,
// with the same alpha whether it is read alone or not.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include "passes/upload/colours/colour_texel.h"

enum { WIDTH = 3, HEIGHT = 2, TEXELS = WIDTH * HEIGHT };

/// A finer grid, whose texels meet those of the image at thirds and halves.
static const lobe_grid grid = {.width = 7, .height = 5};

/// IEC 61966-2-1.
static double decoded(double value) {
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static void check(const lobe_image *image, const double expected[TEXELS][4]) {
    for (uint32_t y = 0; y < grid.height; y++)
        for (uint32_t x = 0; x < grid.width; x++) {
            const double *own = expected[y * HEIGHT / grid.height * WIDTH + x * WIDTH / grid.width];
            float value[4], alpha;
            assert_true(passes_colour_texel(image, &grid, x, y, value));
            assert_true(passes_colour_texel_alpha(image, &grid, x, y, &alpha));
            assert_true(alpha == value[3]);
            for (int i = 0; i < 4; i++)
                if (!(fabs((double)value[i] - own[i]) < 1e-6))
                    fail_msg("%u, %u, channel %d: %g instead of %g", x, y, i, (double)value[i],
                             own[i]);
        }
}

static void texels_are_linear(void **state) {
    unsigned char bytes[TEXELS][4];
    float floats[TEXELS][4];
    double expected[3][TEXELS][4];
    (void)state;
    for (unsigned i = 0; i < TEXELS * 4; i++) {
        bytes[i / 4][i % 4] = (unsigned char)(37 * i + 5);
        floats[i / 4][i % 4] = 0.25f * (float)i;
        const double byte = bytes[i / 4][i % 4] / 255.0;
        expected[0][i / 4][i % 4] = i % 4 < 3 ? decoded(byte) : byte;
        expected[1][i / 4][i % 4] = byte;
        expected[2][i / 4][i % 4] = 0.25 * i;
    }
    lobe_image image = {
        .format = LOBE_FORMAT_RGBA8_SRGB, .width = WIDTH, .height = HEIGHT, .texels = bytes};
    check(&image, expected[0]);
    image.format = LOBE_FORMAT_RGBA8_UNORM;
    check(&image, expected[1]);
    image.format = LOBE_FORMAT_RGBA32_FLOAT;
    image.texels = floats;
    check(&image, expected[2]);
}

static void what_the_host_cannot_read_is_refused(void **state) {
    unsigned char bytes[TEXELS][8] = {{0}};
    float value[4], alpha;
    lobe_image image = {
        .format = LOBE_FORMAT_RGBA16_FLOAT, .width = WIDTH, .height = HEIGHT, .texels = bytes};
    (void)state;
    for (int i = 0; i < 2; i++) {
        assert_false(passes_colour_texel(&image, &grid, 1, 1, value));
        assert_false(passes_colour_texel_alpha(&image, &grid, 1, 1, &alpha));
        image.format = LOBE_FORMAT_RGBA8_SRGB;
        image.texels = NULL;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_are_linear),
        cmocka_unit_test(what_the_host_cannot_read_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
