// Maps that are clamped, on a surface that goes on beyond their edges: from afar, too, it shows the
// texels along the edge there, and not what is further inside.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { TEXELS = 32, BORDER = 4, EXTENT = 24 };

static bool is_border(size_t i) {
    const size_t x = i % TEXELS, y = i / TEXELS;
    return x < BORDER || x >= TEXELS - BORDER || y < BORDER || y >= TEXELS - BORDER;
}

static void set_border(lobe_image *image, const float value[4]) {
    float *texels = image->texels;
    for (size_t i = 0; i < (size_t)TEXELS * TEXELS; i++)
        for (int k = 0; is_border(i) && k < 4; k++)
            texels[4 * i + k] = value[k];
}

/// In the middle third of a surface.
static lobe_texture_use add_clamped(lobe_scene *scene, lobe_image image) {
    lobe_texture_use use = scene_add_map(scene, image);
    use.wrap_u = use.wrap_v = LOBE_SCENE_WRAP_CLAMP;
    use.transform[0][2] = use.transform[1][2] = -1;
    return use;
}

typedef enum label { LABEL_PRINTED, LABEL_EMBOSSED, LABEL_CUT_OUT } label;

/// Bright on dark, bumpy metal on a flat one, or nothing around it.
static lobe_scene *label_scene(label kind, double height) {
    static const float dark[4] = {0.05f, 0.05f, 0.05f, 1}, level[4] = {0.5f, 0.5f, 1, 1},
                       rough[4] = {1, 1, 1, 1}, nothing[4] = {0};
    const bool metal = kind == LABEL_EMBOSSED;
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, metal ? 0.5 : 1, metal);
    if (kind == LABEL_EMBOSSED) {
        lobe_image normals = random_normal_map(TEXELS, TEXELS, 0.4, 51),
                   widths = random_map(TEXELS, TEXELS, 0.5, 0.9, 52);
        set_border(&normals, level);
        set_border(&widths, rough);
        material.normal_map = add_clamped(scene, normals);
        material.metallic_roughness_map = add_clamped(scene, widths);
    } else {
        lobe_image colours = constant_map(TEXELS, TEXELS, 0.8f, 0.7f, 0.6f);
        set_border(&colours, kind == LABEL_CUT_OUT ? nothing : dark);
        material.base_colour_map = add_clamped(scene, colours);
        material.alpha_mask = kind == LABEL_CUT_OUT;
        material.alpha_cutoff = 0.5f;
    }
    scene_add_square(scene, &material, 3, NULL);
    scene_add_sun(scene, (double[]){0.15, 1, 0.1}, 1);
    scene_look_down(scene, height);
    scene_end(scene);
    return scene;
}

static double mean_of(const lobe_image *picture) {
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        sum += (double)pixel_at(picture, i % EXTENT, i / EXTENT)[1];
    return sum;
}

/// From 4 texels a pixel, in a picture of 2 m, to three times as many in one of 6 m. `most`: how
/// far a mean may be from the reference's.
static void check_label(fixture *f, label kind, const char *const *filters, double farthest,
                        double most) {
    for (double height = 2; height <= farthest; height += 2) {
        lobe_scene *scene = label_scene(kind, height);
        picture_request request = {
            .filter = "reference", .width = EXTENT, .height = EXTENT, .samples = 64};
        lobe_frame truth = draw_scene(f, scene, &request);
        for (size_t i = 0; filters[i]; i++) {
            request.filter = filters[i];
            lobe_frame frame = draw_scene(f, scene, &request);
            const double ratio = mean_of(&frame.radiance) / mean_of(&truth.radiance);
            if (!(fabs(ratio - 1) <= most))
                fail_msg("label %d, %s, %g m: %.3g times the reference", kind, filters[i], height,
                         ratio);
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&truth);
        lobe_scene_destroy(&scene);
    }
}

static void colours_end_at_the_edge(void **state) {
    static const char *const filters[] = {"mipmap",      "toksvig",  "lean",    "leadr",
                                          "multi_leadr", "lobes",    "moments", "mixture",
                                          "tan",         "fournier", NULL};
    check_label(*state, LABEL_PRINTED, filters, 6, 0.05);
}

static void lobes_end_at_the_edge(void **state) {
    static const char *const filters[] = {"lean",    "leadr",   "multi_leadr", "lobes",
                                          "moments", "mixture", NULL};
    check_label(*state, LABEL_EMBOSSED, filters, 6, 0.05);
}

static void masks_end_at_the_edge(void **state) {
    static const char *const filters[] = {"mipmap", "lean", "lobes", "moments", NULL};
    check_label(*state, LABEL_CUT_OUT, filters, 4, 0.15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_end_at_the_edge),
        cmocka_unit_test(lobes_end_at_the_edge),
        cmocka_unit_test(masks_end_at_the_edge),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
