// Sharp and broad lobes under one pixel: the light of `lobes` against many samples of each pixel,
// about where the sharp ones shine and beside that; and of lobes about normals that are spread.

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIDE = 4, TEXELS = 64 };

typedef struct width_case {
    const char *name;
    bool microfacets;
    float factors[2];  ///< of the widths of a chessboard's texels
    double tilts[2];   ///< of their normals, in radians
    double middles[2]; ///< tilts of half vectors, in radians
    const char *subdivision;
    double tolerance;
    double deviation; ///< of slopes, in place of the tilts
} width_case;

/// Slopes at random whose squares are distributed evenly in each part of the map.
static void store_spread_normal(uint32_t texel, double deviation, float *normal) {
    const double part = (texel * 1597u % (TEXELS * TEXELS) + 0.5) / (TEXELS * TEXELS);
    const double slope = deviation * sqrt(-2 * log(part)), angle = 2.4 * texel;
    const double scale = 0.5 / sqrt(1 + slope * slope);
    normal[0] = (float)(0.5 + scale * slope * cos(angle));
    normal[1] = (float)(0.5 + scale * slope * sin(angle));
    normal[2] = (float)(0.5 + scale);
}

static lobe_image chessboard(const width_case *tested, bool normals) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, TEXELS, TEXELS);
    for (uint32_t i = 0; i < TEXELS * TEXELS; i++) {
        const uint32_t odd = (i % TEXELS + i / TEXELS) % 2;
        float *texel = (float *)image.texels + (size_t)4 * i;
        texel[0] = normals ? (float)(0.5 + 0.5 * sin(tested->tilts[odd])) : tested->factors[odd];
        texel[1] = normals ? 0.5f : tested->factors[odd];
        texel[2] = normals ? (float)(0.5 + 0.5 * cos(tested->tilts[odd])) : 1;
        if (normals && tested->deviation > 0)
            store_spread_normal(i, tested->deviation, texel);
    }
    return image;
}

static lobe_scene *square(const width_case *tested, double middle) {
    lobe_scene *scene = scene_begin();
    lobe_material material = tested->microfacets ? microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1)
                                                 : half_vector_material(LOBE_DISTRIBUTION_VMF, 400);
    lobe_texture_use *widths =
        tested->microfacets ? &material.metallic_roughness_map : &material.width_map;
    *widths = scene_add_map(scene, chessboard(tested, false));
    widths->nearest = true;
    if (tested->tilts[0] != tested->tilts[1] || tested->deviation > 0) {
        material.normal_map = scene_add_map(scene, chessboard(tested, true));
        material.normal_map.nearest = true;
    }
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 2);
    scene_add_sun(scene, (double[]){sin(2 * middle), cos(2 * middle), 0}, 1);
    scene_end(scene);
    return scene;
}

static double light(fixture *f, const lobe_scene *scene, const picture_request *request) {
    lobe_frame frame = draw_scene(f, scene, request);
    double sum = 0;
    for (uint32_t i = 0; i < SIDE * SIDE; i++)
        sum += (double)pixel_at(&frame.radiance, i % SIDE, i / SIDE)[0];
    lobe_frame_free(&frame);
    return sum;
}

static void check_case(fixture *f, const width_case *tested) {
    for (int i = 0; i < 2; i++) {
        lobe_scene *scene = square(tested, tested->middles[i]);
        const picture_request reference = {
            .filter = "reference", .width = SIDE, .height = SIDE, .samples = 256};
        const picture_request lobes = {
            .filter = "lobes", .settings = {tested->subdivision}, .width = SIDE, .height = SIDE};
        const double ratio = light(f, scene, &lobes) / light(f, scene, &reference);
        lobe_scene_destroy(&scene);
        if (!(fabs(ratio - 1) < tested->tolerance))
            fail_msg("%s, half vector at %g: %.3f of the reference", tested->name,
                     tested->middles[i], ratio);
    }
}

/// As one lobe of the mean length, a polish beside rough metal would lose its highlight.
static void two_widths_in_one_direction(void **state) {
    static const width_case cases[] = {
        {"metal", true, {0.2f, 0.7f}, {0, 0}, {0.02, 0.4}, "subdivision=auto", 0.05, 0},
        {"half-vector lobes", false, {1, 0.02f}, {0, 0}, {0.02, 0.4}, "subdivision=auto", 0.05, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Each cluster is as sharp as its own base lobes.
static void widths_go_with_directions(void **state) {
    static const width_case cases[] = {
        {"metal", true, {0.2f, 0.6f}, {-0.3, 0.3}, {-0.3, 0.3}, "subdivision=2", 0.1, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// The middle of a lobe as broad as base lobes and normals together would be too high, as GGX has
/// much of its light in its tails.
static void ggx_keeps_its_tails_about_spread_normals(void **state) {
    static const width_case cases[] = {
        {.name = "one width",
         .microfacets = true,
         .factors = {0.45f, 0.45f},
         .middles = {0.02, 0.4},
         .subdivision = "subdivision=0",
         .tolerance = 0.09,
         .deviation = 0.2},
        {.name = "two widths",
         .microfacets = true,
         .factors = {0.3f, 0.7f},
         .middles = {0.02, 0.4},
         .subdivision = "subdivision=0",
         .tolerance = 0.09,
         .deviation = 0.2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_widths_in_one_direction),
        cmocka_unit_test(widths_go_with_directions),
        cmocka_unit_test(ggx_keeps_its_tails_about_spread_normals),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
