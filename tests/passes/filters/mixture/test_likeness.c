// Where the components of neighbouring texels are alike, what is blended is what single texels
// show; where they are not, `mixture` evaluates them one by one, whatever the map's wrapping.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 64, PICTURE = 20 };

static const double tilted_view[3] = {0.3, 1, 1.6};

static lobe_scene *scene_of(lobe_image normals, lobe_scene_wrap wrap, double tiles) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.4, 1);
    material.normal_map = scene_add_map(scene, normals);
    material.normal_map.nearest = true;
    material.normal_map.wrap_u = material.normal_map.wrap_v = wrap;
    scene_add_square(scene, &material, tiles, NULL);
    scene_look_down(scene, 1.9);
    scene_add_sun(scene, (const double[3]){0.3, 1, 0.2}, 1);
    scene_add_sun(scene, (const double[3]){-0.6, 1, 0.1}, 2);
    scene_end(scene);
    return scene;
}

static void set_normal(lobe_image *map, uint32_t x, uint32_t y, double slope_x, double slope_y) {
    float *texel = (float *)map->texels + 4 * ((size_t)y * map->width + x);
    const double length = sqrt(slope_x * slope_x + slope_y * slope_y + 1);
    texel[0] = (float)(0.5 - 0.5 * slope_x / length);
    texel[1] = (float)(0.5 - 0.5 * slope_y / length);
    texel[2] = (float)(0.5 + 0.5 / length);
    texel[3] = 1;
}

/// The same four normals under every texel of every level.
static lobe_image alike(void) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    for (uint32_t y = 0; y < EXTENT; y++)
        for (uint32_t x = 0; x < EXTENT; x++)
            set_normal(&map, x, y, x % 2 ? 0.4 : -0.1, y % 2 ? 0.3 : -0.3);
    return map;
}

/// Squares of 8 x 8 texels, each with other normals than the ones around.
static lobe_image unlike(void) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    for (uint32_t y = 0; y < EXTENT; y++)
        for (uint32_t x = 0; x < EXTENT; x++) {
            const double angle = 2.4 * (x / 8) + 1.1 * (y / 8) * (y / 8 + 3);
            const double side = x % 2 ? 0.15 : -0.15;
            set_normal(&map, x, y, 0.5 * cos(angle) + side, 0.5 * sin(angle) - side);
        }
    return map;
}

static lobe_image picture_of(fixture *f, const char *blend_error, const char *setting) {
    const picture_request request = {.filter = "mixture",
                                     .settings = {blend_error, setting},
                                     .width = PICTURE,
                                     .height = PICTURE};
    lobe_frame frame = draw(f, &request);
    lobe_image picture = frame.radiance;
    frame.radiance = (lobe_image){0};
    lobe_frame_free(&frame);
    return picture;
}

/// Relative L2 between pictures whose blends may have these errors.
static double distance(fixture *f, const char *one, const char *other, const char *setting) {
    lobe_image a = picture_of(f, one, setting), b = picture_of(f, other, setting);
    assert_true(all_finite(&a) && all_finite(&b));
    const double result = relative_l2(&a, &b);
    lobe_image_free(&a);
    lobe_image_free(&b);
    return result;
}

static void sky(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)fmax(0.1, direction[1] + 0.3 * direction[i]);
}

/// So weights of texels, levels and probes sum to one, under suns and in an environment.
static void alike_texels_are_the_same_blended_or_not(void **state) {
    static const char *const settings[] = {"probes=4", "normal_mapping=microfacet"};
    fixture *f = *state;
    lobe_scene *scene = scene_of(alike(), LOBE_SCENE_WRAP_REPEAT, 2);
    scene_look_from(scene, tilted_view, 1.5);
    scene_surround(scene, 16, sky);
    hold_scene(f, scene);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        const double single = distance(f, "blend_error=0", "blend_error=1", settings[i]);
        print_message("# %s: %.5f\n", settings[i], single);
        assert_true(single < 2e-3);
    }
    lobe_image blended = picture_of(f, "blend_error=0.01", "view=lobes"),
               single = picture_of(f, "blend_error=0", "view=lobes");
    for (uint32_t i = 0; i < PICTURE * PICTURE; i++) {
        const float count = *pixel_at(&blended, i % PICTURE, i / PICTURE);
        assert_true(count <= 4 && *pixel_at(&single, i % PICTURE, i / PICTURE) >= 2 * count);
    }
    lobe_image_free(&blended);
    lobe_image_free(&single);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

static void unlike_texels_are_evaluated_one_by_one(void **state) {
    static const lobe_scene_wrap modes[] = {LOBE_SCENE_WRAP_REPEAT, LOBE_SCENE_WRAP_MIRROR,
                                            LOBE_SCENE_WRAP_CLAMP};
    fixture *f = *state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        lobe_scene *scene = scene_of(unlike(), modes[i], 2.3);
        hold_scene(f, scene);
        const double chosen = distance(f, "blend_error=0.01", "blend_error=0", "bias=0"),
                     blended = distance(f, "blend_error=1", "blend_error=0", "bias=0");
        print_message("# wrap %zu: %.4f chosen, %.4f blended\n", i, chosen, blended);
        assert_true(chosen < 0.02);
        // Beyond the edges of a clamped map, nothing is blended.
        assert_true(blended > (modes[i] == LOBE_SCENE_WRAP_CLAMP ? 0.05 : 0.1));
        hold_scene(f, NULL);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alike_texels_are_the_same_blended_or_not),
        cmocka_unit_test(unlike_texels_are_evaluated_one_by_one),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
