// Sharp and broad lobes under one pixel: the light of `lobes` against many samples of each pixel,
// about where the sharp ones shine and beside that; and of lobes about normals that are spread, and
// of those whose colours differ.

#include <math.h>
#include <string.h>

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
    double deviation;    ///< of slopes, in place of the tilts
    bool coloured;       ///< the texels have the next two; else all are white metal
    float colours[2][3]; ///< base colour
    float metals[2];
} width_case;

typedef enum chessboard_map { WIDTHS, NORMALS, COLOURS } chessboard_map;

/// Slopes at random whose squares are distributed evenly in each part of the map.
static void store_spread_normal(uint32_t texel, double deviation, float *normal) {
    const double part = (texel * 1597u % (TEXELS * TEXELS) + 0.5) / (TEXELS * TEXELS);
    const double slope = deviation * sqrt(-2 * log(part)), angle = 2.4 * texel;
    const double scale = 0.5 / sqrt(1 + slope * slope);
    normal[0] = (float)(0.5 + scale * slope * cos(angle));
    normal[1] = (float)(0.5 + scale * slope * sin(angle));
    normal[2] = (float)(0.5 + scale);
}

static void store_normal(const width_case *tested, uint32_t i, uint32_t odd, float *texel) {
    if (tested->deviation > 0) {
        store_spread_normal(i, tested->deviation, texel);
        return;
    }
    texel[0] = (float)(0.5 + 0.5 * sin(tested->tilts[odd]));
    texel[1] = 0.5f;
    texel[2] = (float)(0.5 + 0.5 * cos(tested->tilts[odd]));
}

static lobe_image chessboard(const width_case *tested, chessboard_map map) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, TEXELS, TEXELS);
    for (uint32_t i = 0; i < TEXELS * TEXELS; i++) {
        const uint32_t odd = (i % TEXELS + i / TEXELS) % 2;
        float *texel = (float *)image.texels + (size_t)4 * i;
        if (map == NORMALS) {
            store_normal(tested, i, odd, texel);
        } else if (map == COLOURS) {
            memcpy(texel, tested->colours[odd], sizeof tested->colours[odd]);
        } else {
            texel[0] = texel[1] = tested->factors[odd];
            texel[2] = tested->coloured ? tested->metals[odd] : 1;
        }
    }
    return image;
}

static lobe_scene *square(const width_case *tested, double middle) {
    lobe_scene *scene = scene_begin();
    lobe_material material = tested->microfacets ? microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1)
                                                 : half_vector_material(LOBE_DISTRIBUTION_VMF, 400);
    lobe_texture_use *widths =
        tested->microfacets ? &material.metallic_roughness_map : &material.width_map;
    *widths = scene_add_map(scene, chessboard(tested, WIDTHS));
    widths->nearest = true;
    if (tested->tilts[0] != tested->tilts[1] || tested->deviation > 0) {
        material.normal_map = scene_add_map(scene, chessboard(tested, NORMALS));
        material.normal_map.nearest = true;
    }
    if (tested->coloured) {
        material.base_colour_map = scene_add_map(scene, chessboard(tested, COLOURS));
        material.base_colour_map.nearest = true;
    }
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 2);
    scene_add_sun(scene, (double[]){sin(2 * middle), cos(2 * middle), 0}, 1);
    scene_end(scene);
    return scene;
}

static void light(fixture *f, const lobe_scene *scene, const picture_request *request,
                  double sums[3]) {
    lobe_frame frame = draw_scene(f, scene, request);
    for (int c = 0; c < 3; c++) {
        sums[c] = 0;
        for (uint32_t i = 0; i < SIDE * SIDE; i++)
            sums[c] += (double)pixel_at(&frame.radiance, i % SIDE, i / SIDE)[c];
    }
    lobe_frame_free(&frame);
}

static void check_case(fixture *f, const width_case *tested) {
    for (int i = 0; i < 2; i++) {
        lobe_scene *scene = square(tested, tested->middles[i]);
        const picture_request reference = {
            .filter = "reference", .width = SIDE, .height = SIDE, .samples = 256};
        const picture_request lobes = {
            .filter = "lobes", .settings = {tested->subdivision}, .width = SIDE, .height = SIDE};
        double drawn[3], truth[3];
        light(f, scene, &lobes, drawn);
        light(f, scene, &reference, truth);
        lobe_scene_destroy(&scene);
        for (int c = 0; c < 3; c++)
            if (!(fabs(drawn[c] / truth[c] - 1) < tested->tolerance))
                fail_msg("%s, half vector at %g, channel %d: %.3f of the reference", tested->name,
                         tested->middles[i], c, drawn[c] / truth[c]);
    }
}

/// As one lobe of the mean length, a polish beside rough metal would lose its highlight.
static void two_widths_in_one_direction(void **state) {
    static const width_case cases[] = {
        {.name = "metal",
         .microfacets = true,
         .factors = {0.2f, 0.7f},
         .middles = {0.02, 0.4},
         .subdivision = "subdivision=auto",
         .tolerance = 0.05},
        {.name = "half-vector lobes",
         .factors = {1, 0.02f},
         .middles = {0.02, 0.4},
         .subdivision = "subdivision=auto",
         .tolerance = 0.05},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Each cluster is as sharp as its own base lobes.
static void widths_go_with_directions(void **state) {
    static const width_case cases[] = {
        {.name = "metal",
         .microfacets = true,
         .factors = {0.2f, 0.6f},
         .tilts = {-0.3, 0.3},
         .middles = {-0.3, 0.3},
         .subdivision = "subdivision=2",
         .tolerance = 0.1},
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

/// In the mean colour of both, the highlight of a lacquer beside gold would be golden.
static void each_width_has_its_colour(void **state) {
    static const width_case cases[] = {
        {.name = "lacquer beside gold",
         .microfacets = true,
         .factors = {0.2f, 0.7f},
         .middles = {0.02, 0.4},
         .subdivision = "subdivision=0",
         .tolerance = 0.05,
         .coloured = true,
         .colours = {{0.01f, 0.02f, 0.01f}, {1, 0.7f, 0.3f}},
         .metals = {0, 1}},
        {.name = "rust on polished steel",
         .microfacets = true,
         .factors = {0.25f, 0.8f},
         .middles = {0.02, 0.4},
         .subdivision = "subdivision=0",
         .tolerance = 0.07,
         .coloured = true,
         .colours = {{0.6f, 0.6f, 0.65f}, {0.5f, 0.12f, 0.04f}},
         .metals = {1, 1}},
        {.name = "copper and brass about spread normals",
         .microfacets = true,
         .factors = {0.25f, 0.7f},
         .middles = {0.02, 0.5},
         .subdivision = "subdivision=0",
         .tolerance = 0.1,
         .deviation = 0.1,
         .coloured = true,
         .colours = {{0.95f, 0.4f, 0.2f}, {0.3f, 0.5f, 0.1f}},
         .metals = {1, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

static size_t filtered_bytes(fixture *f, const width_case *tested) {
    lobe_scene *scene = square(tested, 0.02);
    const picture_request request = {
        .filter = "lobes", .settings = {"subdivision=0"}, .width = SIDE, .height = SIDE};
    lobe_frame frame = draw_scene(f, scene, &request);
    const size_t bytes = frame.filtered_bytes;
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return bytes;
}

/// Widths of one hue are drawn in the footprint's mean colour, and take no layer more.
static void colours_cost_nothing_where_widths_have_none(void **state) {
    static const width_case grey = {.name = "grey",
                                    .microfacets = true,
                                    .factors = {0.2f, 0.7f},
                                    .coloured = true,
                                    .colours = {{0.9f, 0.9f, 0.9f}, {0.2f, 0.2f, 0.2f}},
                                    .metals = {1, 1}};
    width_case coloured = grey;
    coloured.colours[0][2] = 0.3f;
    // A layer of 32 by 32 texels, of four floats, and its coarser levels.
    const size_t layer = (1024 + 256 + 64 + 16 + 4 + 1) * 16;
    assert_int_equal(filtered_bytes(*state, &coloured), filtered_bytes(*state, &grey) + layer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_widths_in_one_direction),
        cmocka_unit_test(widths_go_with_directions),
        cmocka_unit_test(ggx_keeps_its_tails_about_spread_normals),
        cmocka_unit_test(each_width_has_its_colour),
        cmocka_unit_test(colours_cost_nothing_where_widths_have_none),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
