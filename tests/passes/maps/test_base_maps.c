// Masks that keep some normals and not others: maps of lobes are those of what is kept, in every
// filter.

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 64, WIDTH = 12 };

/// Metal of random slopes in every other column, which stays; the columns beside them are flat. Cut
/// away by a mask or, if it is not `masked`, replaced by copies of what stays.
static lobe_scene *fence(bool masked) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.4, 1);
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.7, 17),
               colours = constant_map(EXTENT, EXTENT, 1, 1, 1);
    float *normal = normals.texels, *colour = colours.texels;
    for (size_t i = 1; i < (size_t)EXTENT * EXTENT; i += 2) {
        for (size_t j = 0; j < 3; j++)
            normal[4 * i + j] = !masked ? normal[4 * (i - 1) + j] : j < 2 ? 0.5f : 1;
        colour[4 * i + 3] = masked ? 0.3f : 1;
    }
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    material.normal_map.nearest = material.base_colour_map.nearest = true;
    material.alpha_mask = masked;
    scene_add_square(scene, &material, 40, NULL);
    scene_add_sun(scene, (double[]){0.6, 1, 0.2}, 3);
    scene_look_from(scene, (double[]){0.1, 1, 0.3}, 0.4);
    scene_end(scene);
    return scene;
}

/// Mean radiance of the pixels that show the surface, and their number.
static double mean_of_shown(fixture *f, bool masked, const picture_request *request,
                            uint32_t *shown) {
    lobe_scene *scene = fence(masked);
    lobe_frame frame = draw_scene(f, scene, request);
    double sum = 0;
    *shown = 0;
    for (uint32_t i = 0; i < WIDTH * WIDTH; i++) {
        const float *pixel = pixel_at(&frame.radiance, i % WIDTH, i / WIDTH);
        sum += (double)pixel[1];
        *shown += pixel[3] > 0;
    }
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return sum / *shown;
}

static void check_filter(fixture *f, const char *filter, const char *setting, const char *other,
                         double bound) {
    const picture_request request = {
        .filter = filter, .settings = {setting, other}, .width = WIDTH, .height = WIDTH};
    uint32_t all, half;
    const double expected = mean_of_shown(f, false, &request, &all);
    const double found = mean_of_shown(f, true, &request, &half);
    assert_int_equal(all, WIDTH * WIDTH);
    assert_in_range(half, 0.4 * all, 0.6 * all);
    if (!(fabs(found - expected) <= bound * expected))
        fail_msg("%s: %.6g instead of %.6g", filter, found, expected);
}

static void what_a_mask_cuts_away_has_no_normals(void **state) {
    check_filter(*state, "mipmap", NULL, NULL, 0.01);
    check_filter(*state, "toksvig", NULL, NULL, 0.01);
    check_filter(*state, "lean", NULL, NULL, 0.01);
    check_filter(*state, "lobes", "subdivision=2", NULL, 0.01);
    check_filter(*state, "moments", "bins=1", NULL, 0.01);
    check_filter(*state, "moments", "bins=1", "colour=bins", 0.01);
    // Components of a fit differ.
    check_filter(*state, "mixture", "components=2", "steps=2", 0.08);
    check_filter(*state, "multi_leadr", "components=2", "steps=2", 0.08);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_mask_cuts_away_has_no_normals),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
