// Grooves from near, where a pixel sees less than a texel: normals turn across them alone, also
// inside a pixel, so that each lobe is long that way.

#include "tests/passes/support/fixture.h"

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIZE = 24, TEXELS = 64, TILES = 2 };

/// Grooves along the second axis.
static lobe_image groove_map(void) {
    lobe_image random = random_normal_map(TEXELS, 1, 0.3, 571);
    lobe_image grooves = map_image(LOBE_FORMAT_RGBA32_FLOAT, TEXELS, TEXELS);
    float *texel = grooves.texels;
    for (uint32_t i = 0; i < TEXELS * TEXELS; i++, texel += 4) {
        texel[0] = ((const float *)random.texels)[(size_t)4 * (i % TEXELS)];
        texel[1] = 0.5f;
        texel[2] = texel[3] = 1;
    }
    lobe_image_free(&random);
    return grooves;
}

/// The sun is mirrored in the grooves' highlight, or beside it.
static lobe_scene *near_scene(const lobe_material *own, bool beside) {
    lobe_scene *scene = scene_begin();
    lobe_material material = *own;
    material.normal_map = scene_add_map(scene, groove_map());
    scene_add_square(scene, &material, TILES, NULL);
    scene_add_sun(scene, beside ? (double[]){0, 1, 0.5} : (double[]){0.4, 1, 0}, 3);
    scene_look_down(scene, 0.4);
    scene_end(scene);
    return scene;
}

static lobe_image picture_of(fixture *f, const lobe_scene *scene, const char *filter) {
    const picture_request request = {
        .filter = filter, .width = SIZE, .height = SIZE, .samples = 64};
    lobe_frame frame = draw_scene(f, scene, &request);
    lobe_image radiance = frame.radiance;
    frame.radiance = (lobe_image){0};
    lobe_frame_free(&frame);
    return radiance;
}

static void check(fixture *f, const char *filter, const lobe_material *material, bool beside,
                  double tolerance) {
    lobe_scene *scene = near_scene(material, beside);
    hold_scene(f, scene);
    lobe_image truth = picture_of(f, scene, "reference"), found = picture_of(f, scene, filter);
    const double error = relative_l2(&found, &truth);
    if (!(error < tolerance))
        fail_msg("%s, %s the highlight: error %g", filter, beside ? "beside" : "in", error);
    lobe_image_free(&truth);
    lobe_image_free(&found);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

/// With lobes as long across the grooves as along them, errors are 2.4 and 0.8 beside the
/// highlight.
static void grooves_shine_to_two_sides_alone(void **state) {
    const lobe_material metal = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.2, 1),
                        lobes = half_vector_material(LOBE_DISTRIBUTION_VMF, 120);
    static const char *const filters[] = {"leadr", "lobes", "moments"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++)
        for (int beside = 0; beside < 2; beside++)
            check(*state, filters[i], &metal, beside, beside ? 0.45 : 0.25);
    for (int beside = 0; beside < 2; beside++)
        check(*state, "moments", &lobes, beside, 0.06);
    // Aslant to the grooves.
    lobe_material tilted = lobes;
    tilted.lobes[0] = (lobe_base_lobe){{0.2f, -0.1f, 0.975f}, 120, {1, 1, 1}};
    for (int beside = 0; beside < 2; beside++)
        check(*state, "moments", &tilted, beside, 0.1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grooves_shine_to_two_sides_alone),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
