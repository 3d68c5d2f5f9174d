// Colours over a footprint: the mean of linear values, whatever the image's format, at the level
// that the pixel needs.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIZE = 32 };

/// IEC 61966-2-1: the sRGB curve.
static double linear_from_srgb(uint8_t value) {
    double x = value / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

static lobe_image random_bytes(lobe_format format, uint64_t seed) {
    lobe_image image = map_image(format, SIZE, SIZE);
    random_sequence sequence = scenes_random_start(seed);
    for (int i = 0; i < SIZE * SIZE * 4; i++)
        ((uint8_t *)image.texels)[i] = (uint8_t)(scenes_random_bits(&sequence) >> 24);
    return image;
}

/// Mean of a square of texels, with its upper left corner and side.
static double mean_of(const lobe_image *image, uint32_t x, uint32_t y, uint32_t side, int channel) {
    double sum = 0;
    for (uint32_t i = 0; i < side * side; i++) {
        size_t texel = (size_t)(y + i / side) * image->width + x + i % side;
        uint8_t value = ((const uint8_t *)image->texels)[4 * texel + (size_t)channel];
        sum += image->format == LOBE_FORMAT_RGBA8_SRGB ? linear_from_srgb(value) : value / 255.0;
    }
    return sum / (side * side);
}

/// A matt square under a light that makes white 1, with a map of its colour or of its own light.
static lobe_scene *coloured_scene(lobe_format format, bool emissive) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    lobe_texture_use use = scene_add_map(scene, random_bytes(format, 161));
    memset(material.lobes[0].colour, 0, sizeof material.lobes[0].colour);
    for (int i = 0; i < 3; i++) {
        material.base_colour[i] = emissive ? 0 : 1;
        material.emissive[i] = emissive ? 1 : 0;
    }
    *(emissive ? &material.emissive_map : &material.base_colour_map) = use;
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0, 1, 0}, M_PI);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// Pictures of 16, 8, ... 1 pixels show levels 1, 2, ... 5, at their texels' centres.
static void check_colours(fixture *f, const char *filter, lobe_format format, bool emissive) {
    lobe_scene *scene = coloured_scene(format, emissive);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (uint32_t extent = SIZE; extent >= 1; extent /= 2) {
        picture_request request = {
            .filter = filter, .settings = {NULL}, .width = extent, .height = extent};
        lobe_frame frame = draw(f, &request);
        for (uint32_t i = 0; i < extent * extent; i++) {
            uint32_t x = i % extent, y = i / extent, side = SIZE / extent;
            const float *pixel = pixel_at(&frame.radiance, x, y);
            for (int channel = 0; channel < 3; channel++) {
                double mean = mean_of(&scene->images[0].image, x * side, y * side, side, channel);
                if (!(fabs((double)pixel[channel] - mean) <= 2e-3 + fixture_sampler_error(f)))
                    fail_msg("%s, %ux%u pixels: %g instead of %g", filter, extent, extent,
                             (double)pixel[channel], mean);
            }
        }
        lobe_frame_free(&frame);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void colours_are_means_of_linear_values(void **state) {
    static const char *const filters[] = {"mipmap", "lobes"};
    for (int i = 0; i < 2; i++) {
        check_colours(*state, filters[i], LOBE_FORMAT_RGBA8_SRGB, false);
        check_colours(*state, filters[i], LOBE_FORMAT_RGBA8_UNORM, false);
        check_colours(*state, filters[i], LOBE_FORMAT_RGBA8_SRGB, true);
    }
}

/// One pixel that sees a strip of 8 by 1 texels: one probe per texel gives its mean, a single probe
/// blurs across it.
static void probes_follow_the_longer_axis(void **state) {
    fixture *f = *state;
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    lobe_image image = random_bytes(LOBE_FORMAT_RGBA8_UNORM, 162);
    memset(material.lobes[0].colour, 0, sizeof material.lobes[0].colour);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 1;
    // Level 1 of a map of which each texel is doubled has the texels themselves.
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        uint32_t x = i % SIZE & ~1u, y = i / SIZE & ~1u;
        memcpy((uint8_t *)image.texels + 4 * i, (uint8_t *)image.texels + 4 * (y * SIZE + x), 4);
    }
    material.base_colour_map = scene_add_map(scene, image);
    material.base_colour_map.transform[0][0] = 16.0f / SIZE;
    material.base_colour_map.transform[1][1] = 2.0f / SIZE;
    material.base_colour_map.transform[1][2] = 8.0f / SIZE;
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0, 1, 0}, M_PI);
    scene_look_down(scene, 2);
    scene_end(scene);
    double exact = 0;
    for (uint32_t i = 0; i < 16; i += 2)
        exact += mean_of(&scene->images[0].image, i, 8, 2, 0) / 8;
    picture_request request = {
        .filter = "mipmap", .settings = {"probes=8", NULL}, .width = 1, .height = 1};
    lobe_frame sharp = draw_scene(f, scene, &request);
    assert_true(fabs((double)pixel_at(&sharp.radiance, 0, 0)[0] - exact) < 2e-3);
    request.settings[0] = "probes=1";
    lobe_frame blurred = draw_scene(f, scene, &request);
    assert_true(fabs((double)pixel_at(&blurred.radiance, 0, 0)[0] - exact) > 1e-2);
    lobe_frame_free(&sharp);
    lobe_frame_free(&blurred);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_are_means_of_linear_values),
        cmocka_unit_test(probes_follow_the_longer_axis),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
