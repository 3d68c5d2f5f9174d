// Materials whose widths lie on the surface otherwise than their normals do, against many samples
// of each pixel: a relief that repeats eight times over one map of roughness and metal; and one
// that repeats where that map is mirrored.

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIDE = 16, NORMALS = 32, WIDTHS = 128, REPEATS = 8 };

typedef struct width_case {
    const char *filter;
    double tolerance;    ///< of the means of light; what the filter has anyway
    double roughness[2]; ///< of the map's left and right half
    bool mirrored;       ///< both maps are there twice, and the normals are not mirrored
    bool paint;          ///< every other texel of a chessboard is black paint, else all are metal
    bool mixed;          ///< every other texel of a chessboard has the other half's roughness
} width_case;

static void add_maps(lobe_scene *scene, lobe_material *material, const width_case *tested) {
    lobe_image widths = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTHS, WIDTHS),
               colours = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTHS, WIDTHS);
    for (uint32_t i = 0; i < WIDTHS * WIDTHS; i++) {
        const uint32_t x = i % WIDTHS, y = i / WIDTHS;
        const bool odd = (x + y) % 2 != 0, metal = !tested->paint || !odd;
        const bool right = (x >= WIDTHS / 2) != (tested->mixed && odd);
        float *width = (float *)widths.texels + (size_t)4 * i;
        float *colour = (float *)colours.texels + (size_t)4 * i;
        width[1] = (float)tested->roughness[right];
        width[2] = metal ? 1 : 0;
        for (int j = 0; j < 3; j++)
            colour[j] = metal ? 1 - 0.3f * (float)j : 0.02f;
        colour[3] = 1;
    }
    material->normal_map = scene_add_map(scene, random_normal_map(NORMALS, NORMALS, 0.4, 7));
    if (!tested->mirrored)
        material->normal_map.transform[0][0] = material->normal_map.transform[1][1] = REPEATS;
    material->metallic_roughness_map = scene_add_map(scene, widths);
    material->base_colour_map = scene_add_map(scene, colours);
    if (tested->mirrored)
        material->metallic_roughness_map.wrap_u = LOBE_SCENE_WRAP_MIRROR;
    material->metallic_roughness_map.nearest = material->base_colour_map.nearest = true;
}

static lobe_scene *worn_sheet(const width_case *tested) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    add_maps(scene, &material, tested);
    scene_add_square(scene, &material, tested->mirrored ? 2 : 1, NULL);
    scene_look_down(scene, 2);
    scene_add_sun(scene, (double[]){0.1, 1, 0.05}, 1);
    scene_end(scene);
    return scene;
}

/// Sums over the middle of the left and of the right quarter, which no footprint leaves.
static void sum_halves(const lobe_frame *frame, double sums[2][3]) {
    for (int k = 0; k < 6; k++)
        sums[k / 3][k % 3] = 0;
    for (uint32_t y = 2; y < SIDE - 2; y++)
        for (uint32_t x = 0; x < 2; x++)
            for (int k = 0; k < 6; k++)
                sums[k / 3][k % 3] +=
                    (double)pixel_at(&frame->radiance, x + (k < 3 ? 1 : SIDE - 3), y)[k % 3];
}

static void check_case(fixture *f, const width_case *tested) {
    lobe_scene *scene = worn_sheet(tested);
    double sums[2][2][3];
    for (int i = 0; i < 2; i++) {
        const picture_request request = {.filter = i == 0 ? "reference" : tested->filter,
                                         .width = SIDE,
                                         .height = SIDE,
                                         .samples = i == 0 ? 256 : 0};
        lobe_frame frame = draw_scene(f, scene, &request);
        sum_halves(&frame, sums[i]);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
    for (int k = 0; k < 6; k++) {
        const double ratio = sums[1][k / 3][k % 3] / sums[0][k / 3][k % 3];
        if (!(fabs(ratio - 1) < tested->tolerance))
            fail_msg("%s%s, %s side, channel %d: %.3f of the reference", tested->filter,
                     tested->paint ? ", paint" : "", k < 3 ? "left" : "right", k % 3, ratio);
    }
}

/// Read where the relief lies, each half would have the roughness of both.
static void each_place_has_its_own_width(void **state) {
    static const width_case cases[] = {
        {"toksvig", 0.2, {0.45, 0.95}, false, false, false},
        {"lean", 0.2, {0.45, 0.95}, false, false, false},
        {"leadr", 0.03, {0.45, 0.95}, false, false, false},
        {"multi_leadr", 0.03, {0.45, 0.95}, false, false, false},
        {"lobes", 0.2, {0.45, 0.95}, false, false, false},
        {"moments", 0.03, {0.45, 0.95}, false, false, false},
        {"mixture", 0.03, {0.45, 0.95}, false, false, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// As if both were mirrored, the right side would have the roughness beside it.
static void maps_wrap_each_by_itself(void **state) {
    static const width_case cases[] = {{"leadr", 0.05, {0.45, 0.95}, true, false, false},
                                       {"moments", 0.05, {0.45, 0.95}, true, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Of mean colours times mean metal, half of the highlight would be missing.
static void metal_goes_with_colours(void **state) {
    static const width_case cases[] = {{"leadr", 0.03, {0.6, 0.6}, false, true, false},
                                       {"moments", 0.05, {0.6, 0.6}, false, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Broad lobes have more mass in the plane, and so more of a bin's width.
static void broad_lobes_count_by_their_mass(void **state) {
    static const width_case cases[] = {{"moments", 0.3, {0.45, 0.95}, false, false, true},
                                       {"mixture", 0.3, {0.45, 0.95}, false, false, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_place_has_its_own_width),
        cmocka_unit_test(maps_wrap_each_by_itself),
        cmocka_unit_test(metal_goes_with_colours),
        cmocka_unit_test(broad_lobes_count_by_their_mass),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
