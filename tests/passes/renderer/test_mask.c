// Masked surfaces: as much of them is seen from afar as from near, in every filter; and materials
// without a mask pay nothing.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include <lobe/filter.h>

#include "tests/passes/support/mask_reference.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

/// A prime number of pixels, so that they are in step with no map.
enum { MAP = 32, EXTENT = 131 };

typedef struct mask_scene {
    mask_pattern pattern;
    bool nearest;
    float cutoff;
    double tiles;        ///< how often the map repeats
    double vertex_alpha; ///< 0: the mesh has no colours
    bool to_opaque;      ///< that alpha is of the left edge, and 1 of the right one
} mask_scene;

static lobe_scene *masked_square(const mask_scene *wanted) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    memset(material.lobes[0].colour, 0, sizeof material.lobes[0].colour);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 1;
    material.double_sided = material.alpha_mask = true;
    material.alpha_cutoff = wanted->cutoff;
    material.base_colour_map = scene_add_map(scene, mask_image(wanted->pattern, MAP, MAP));
    material.base_colour_map.nearest = wanted->nearest;
    scene_add_square(scene, &material, wanted->tiles, NULL);
    lobe_mesh *mesh = &scene->meshes[0];
    mesh->has_colour = wanted->vertex_alpha > 0;
    for (size_t i = 0; mesh->has_colour && i < mesh->vertex_count; i++)
        mesh->vertices[i].colour[3] = wanted->to_opaque && mesh->vertices[i].position[0] > 0
                                          ? 1
                                          : (float)wanted->vertex_alpha;
    scene_add_sun(scene, (double[]){0, 1, 0}, M_PI);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

static void mean_of_picture(const lobe_image *picture, double mean[3]) {
    memset(mean, 0, 3 * sizeof *mean);
    for (uint32_t i = 0; i < picture->width * picture->height; i++)
        for (int channel = 0; channel < 3; channel++)
            mean[channel] += (double)((const float *)picture->texels)[4 * i + (uint32_t)channel] /
                             (picture->width * picture->height);
}

/// The square fills the picture and the light makes white 1: the picture's mean is that of what the
/// mask keeps. Within 5 %, where chance leaves 1 % of a coverage of a third.
static void check_mean(fixture *f, const char *filter, const mask_scene *wanted,
                       const double exact[4]) {
    lobe_scene *scene = masked_square(wanted);
    picture_request request = {.filter = filter, .width = EXTENT, .height = EXTENT};
    lobe_frame frame = draw_scene(f, scene, &request);
    double mean[3];
    mean_of_picture(&frame.radiance, mean);
    for (int channel = 0; channel < 3; channel++)
        if (!(fabs(mean[channel] - exact[channel]) <= 0.05 * exact[channel] + 0.002))
            fail_msg("%s, pattern %d%s, cutoff %g, %g tiles, channel %d: %g instead of %g", filter,
                     wanted->pattern, wanted->nearest ? " (nearest)" : "", (double)wanted->cutoff,
                     wanted->tiles, channel, mean[channel], exact[channel]);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

/// `filter`: NULL: all filters. Distances from less than a texel to a pixel to more than the whole
/// map in one.
static void check_distances(fixture *f, const char *filter, mask_scene wanted) {
    static const double distances[] = {3, 5, 10, 96};
    lobe_image image = mask_image(wanted.pattern, MAP, MAP);
    double factor = wanted.vertex_alpha > 0 ? wanted.vertex_alpha : 1;
    double exact[4];
    mask_mean(&image, (mask_sampling){.nearest = wanted.nearest}, wanted.cutoff / factor,
              (double[]){0, 0}, (double[]){MAP, MAP}, exact);
    lobe_image_free(&image);
    for (int distance = 0; distance < 4; distance++) {
        wanted.tiles = distances[distance];
        for (size_t i = 0; i < lobe_filter_count(); i++) {
            const char *name = lobe_filter_name(lobe_filter_get(i));
            if (filter ? strcmp(name, filter) == 0 : strcmp(name, "direct") != 0)
                check_mean(f, name, &wanted, exact);
        }
    }
}

static void coverage_is_kept_at_every_distance(void **state) {
    static const float cutoffs[] = {0.1f, 0.5f, 0.9f};
    for (int pattern = 0; pattern < MASK_PATTERN_COUNT; pattern++)
        for (int i = 0; i < 6; i++)
            check_distances(*state, "mipmap",
                            (mask_scene){.pattern = (mask_pattern)pattern,
                                         .nearest = i % 2,
                                         .cutoff = cutoffs[i / 2]});
}

static void every_filter_keeps_coverage(void **state) {
    check_distances(*state, NULL, (mask_scene){.pattern = MASK_DISCS, .cutoff = 0.6f});
}

/// The colours of vertices multiply alpha before it meets the cutoff.
static void vertices_thin_the_mask(void **state) {
    check_distances(*state, "mipmap",
                    (mask_scene){.pattern = MASK_SMOOTH, .cutoff = 0.3f, .vertex_alpha = 0.6});
    check_distances(*state, "mipmap",
                    (mask_scene){.pattern = MASK_SMOOTH, .cutoff = 0.7f, .vertex_alpha = 0.6});
}

/// The mean of a quarter of the picture's columns.
static double mean_of_quarter(const lobe_image *picture, uint32_t quarter) {
    const uint32_t first = quarter * EXTENT / 4, last = (quarter + 1) * EXTENT / 4;
    double sum = 0;
    for (uint32_t y = 0; y < EXTENT; y++)
        for (uint32_t x = first; x < last; x++)
            sum += (double)((const float *)picture->texels)[4 * (y * EXTENT + x)];
    return sum / (EXTENT * (last - first));
}

/// Where a mesh fades, each part of it keeps its own share.
static void vertices_thin_the_mask_in_places(void **state) {
    enum { STRIPS = 3 };
    const mask_scene wanted = {MASK_SMOOTH, false, 0.4f, 10, 0.5, true};
    lobe_image image = mask_image(wanted.pattern, MAP, MAP);
    lobe_scene *scene = masked_square(&wanted);
    picture_request request = {.filter = "mipmap", .width = EXTENT, .height = EXTENT};
    lobe_frame frame = draw_scene(*state, scene, &request);
    for (uint32_t quarter = 0; quarter < 4; quarter++) {
        double expected = 0;
        for (uint32_t i = 0; i < STRIPS; i++) {
            const double alpha = 0.5 + 0.5 * (quarter + (i + 0.5) / STRIPS) / 4;
            double mean[4];
            mask_mean(&image, (mask_sampling){0}, (double)wanted.cutoff / alpha, (double[]){0, 0},
                      (double[]){MAP, MAP}, mean);
            expected += mean[0] / STRIPS;
        }
        const double found = mean_of_quarter(&frame.radiance, quarter);
        if (!(fabs(found - expected) <= 0.05 * expected + 0.003))
            fail_msg("quarter %u: %g, not %g", quarter, found, expected);
    }
    lobe_frame_free(&frame);
    lobe_image_free(&image);
    lobe_scene_destroy(&scene);
}

/// Near, the edge is the base material's: sharp, at the same pixels.
static void near_edges_are_sharp(void **state) {
    lobe_scene *scene = masked_square(&(mask_scene){MASK_DISCS, false, 0.5f, 1, 0, false});
    picture_request request = {.filter = "direct", .width = EXTENT, .height = EXTENT};
    lobe_frame direct = draw_scene(*state, scene, &request);
    request.filter = "lobes";
    lobe_frame filtered = draw_scene(*state, scene, &request);
    assert_true(largest_difference(&filtered.radiance, &direct.radiance) < 1e-5);
    lobe_frame_free(&direct);
    lobe_frame_free(&filtered);
    lobe_scene_destroy(&scene);
}

/// The dither is fixed to the picture: a still camera sees the same pixels in each frame, and a
/// new renderer as well. From below, the same coverage.
static void pictures_do_not_flicker(void **state) {
    fixture *f = *state;
    const mask_scene wanted = {MASK_SMOOTH, false, 0.5f, 10, 0, false};
    lobe_scene *scene = masked_square(&wanted);
    picture_request request = {.filter = "lobes", .width = EXTENT, .height = EXTENT};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame first = draw(f, &request), second = draw(f, &request);
    lobe_frame third = draw_scene(f, scene, &request);
    assert_int_equal(image_hash(&first.radiance), image_hash(&second.radiance));
    assert_int_equal(image_hash(&first.radiance), image_hash(&third.radiance));
    double front[3], back[3];
    mean_of_picture(&first.radiance, front);
    scene->lights[0].direction[1] = 1;
    scene_look_from(scene, (double[]){0, -1, 0}, 2);
    lobe_frame below = draw_scene(f, scene, &request);
    mean_of_picture(&below.radiance, back);
    assert_true(front[0] > 0 && fabs(back[0] - front[0]) <= 0.02);
    lobe_frame_free(&first);
    lobe_frame_free(&second);
    lobe_frame_free(&third);
    lobe_frame_free(&below);
    lobe_scene_destroy(&scene);
}

/// Of a map with a single row: pixels are longer than its texels, but no wider, and so see level 0.
static lobe_scene *square_with_slanted_holes(double slope) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 1;
    material.roughness = 0.3f;
    material.double_sided = material.alpha_mask = true;
    lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, MAP, 1);
    lobe_image colours = map_image(LOBE_FORMAT_RGBA8_UNORM, MAP, 1);
    for (uint32_t i = 0; i < MAP; i++) {
        const bool kept = i % 7 < 3;
        const double length = sqrt(1 + slope * slope);
        float *normal = (float *)normals.texels + (size_t)4 * i;
        normal[0] = kept ? 0.5f : (float)(0.5 + 0.5 * slope / length);
        normal[1] = 0.5f;
        normal[2] = kept ? 1 : (float)(0.5 + 0.5 / length);
        for (int channel = 0; channel < 4; channel++)
            ((unsigned char *)colours.texels)[4 * i + (uint32_t)channel] = kept ? 255 : 0;
    }
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    material.normal_map.nearest = material.base_colour_map.nearest = true;
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.1}, M_PI);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// What a mask cuts away does not show where pixels show a part of the surface, although it may lie
/// at their centres. The facets in the holes would mirror the light.
static void holes_lend_no_normals(void **state) {
    static const char *const filters[] = {"toksvig", "lean", "moments"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        const char *filter = filters[i];
        double means[2][3];
        for (int k = 0; k < 2; k++) {
            lobe_scene *scene = square_with_slanted_holes(k == 0 ? 0 : 0.15);
            picture_request request = {.filter = filter, .width = 23, .height = 17};
            lobe_frame frame = draw_scene(*state, scene, &request);
            mean_of_picture(&frame.radiance, means[k]);
            lobe_frame_free(&frame);
            lobe_scene_destroy(&scene);
        }
        if (!(means[0][0] > 0 && fabs(means[1][0] / means[0][0] - 1) < 0.02))
            fail_msg("%s: %g with other normals in the holes, %g without", filter, means[1][0],
                     means[0][0]);
    }
}

/// Of a chequered map, for half of the texels.
static void set_alpha(lobe_image *colours, unsigned char alpha) {
    for (uint32_t i = 0; i < 256; i++)
        ((unsigned char *)colours->texels)[4 * i + 3] = (i + i / 16) % 2 ? 255 : alpha;
}

/// White and rough, with slight waves; half of its area has this alpha.
static lobe_scene *square_with_waves(bool masked, unsigned char alpha) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 0;
    material.double_sided = true;
    material.alpha_mask = masked;
    lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, 16, 16);
    lobe_image colours = map_image(LOBE_FORMAT_RGBA8_SRGB, 16, 16);
    for (uint32_t i = 0; i < 256; i++) {
        float *normal = (float *)normals.texels + (size_t)4 * i;
        normal[0] = 0.5f + 0.05f * (float)sin(M_PI / 8 * (i % 16));
        normal[1] = 0.5f;
        normal[2] = 1;
        memset((unsigned char *)colours.texels + (size_t)4 * i, 255, 4);
    }
    set_alpha(&colours, alpha);
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    material.normal_map.nearest = material.base_colour_map.nearest = true;
    scene_add_square(scene, &material, 40, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.1}, M_PI);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// Makes every other two of 16 columns gold, and black paint of the rest; of either, the mask keeps
/// half. `texels`: along each side of the map of colours.
static void add_gold_columns(lobe_scene *scene, bool masked, uint32_t texels) {
    lobe_image metal = map_image(LOBE_FORMAT_RGBA8_UNORM, 16, 16);
    lobe_image colours = map_image(LOBE_FORMAT_RGBA8_SRGB, texels, texels);
    for (uint32_t i = 0; i < 256; i++)
        memcpy((unsigned char *)metal.texels + (size_t)4 * i,
               (unsigned char[]){0, 255, i % 4 < 2 ? 255 : 0, 255}, 4);
    for (uint32_t i = 0; i < texels * texels; i++) {
        const uint32_t x = i % texels, y = i / texels;
        const unsigned char alpha = masked && (x + y) % 2 == 0 ? 0 : 255;
        memcpy((unsigned char *)colours.texels + (size_t)4 * i,
               x * 16 / texels % 4 < 2 ? (unsigned char[]){255, 180, 60, alpha}
                                       : (unsigned char[]){0, 0, 0, alpha},
               4);
    }
    lobe_material *material = &scene->materials[0];
    material->metallic = 1;
    material->metallic_roughness_map = scene_add_map(scene, metal);
    material->base_colour_map = scene_add_map(scene, colours);
    material->metallic_roughness_map.nearest = material->base_colour_map.nearest = true;
}

/// What is cut away is missing once: pixels that are kept are as bright as without the mask.
/// `gold`: texels along each side of the map of colours, 0: all is white.
static void check_brightness(fixture *f, const char *filter, uint32_t gold) {
    double means[2][3];
    for (int masked = 0; masked < 2; masked++) {
        lobe_scene *scene = square_with_waves(masked, 0);
        if (gold > 0)
            add_gold_columns(scene, masked, gold);
        picture_request request = {.filter = filter, .width = 32, .height = 32};
        lobe_frame frame = draw_scene(f, scene, &request);
        mean_of_picture(&frame.radiance, means[masked]);
        lobe_frame_free(&frame);
        lobe_scene_destroy(&scene);
    }
    for (int channel = 0; channel < 3; channel++)
        if (!(means[0][channel] > 0 && fabs(means[1][channel] / means[0][channel] - 0.5) < 0.02))
            fail_msg("%s, %u texels of gold: %g with a mask of half, %g without", filter, gold,
                     means[1][channel], means[0][channel]);
}

static void kept_pixels_are_as_bright(void **state) {
    check_brightness(*state, "tan", 0);
    check_brightness(*state, "fournier", 0);
}

/// Also where metal and paint have colours of their own: the product of mean colour and mean share
/// of metal is a quarter of the gold.
static void kept_metal_is_as_bright(void **state) {
    static const char *const filters[] = {"mipmap", "toksvig", "lean", "leadr", "lobes", "moments"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++)
        check_brightness(*state, filters[i], 16);
    check_brightness(*state, "leadr", 32);
    check_brightness(*state, "moments", 32);
}

static size_t times_run(const lobe_frame *frame, const char *name) {
    size_t count = 0;
    for (size_t i = 0; i < frame->pass_count; i++)
        count += strcmp(frame->passes[i].name, name) == 0;
    return count;
}

static void coverage_is_built_once_and_only_for_masks(void **state) {
    fixture *f = *state;
    for (int masked = 0; masked < 2; masked++) {
        lobe_scene *scene = masked_square(&(mask_scene){MASK_SMOOTH, false, 0.5f, 10, 0, false});
        scene->materials[0].alpha_mask = masked;
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        picture_request request = {.filter = "lobes", .width = 8, .height = 8};
        for (int i = 0; i < 2; i++) {
            lobe_frame frame = draw(f, &request);
            assert_int_equal(times_run(&frame, "mask_coverage"), masked && i == 0);
            lobe_frame_free(&frame);
        }
        // Another cutoff is another map.
        scene->materials[0].alpha_cutoff = 0.4f;
        assert_int_equal(lobe_renderer_update_scene(
                             f->renderer, &(lobe_scene_changes){.materials = (uint32_t[]){0},
                                                                .material_count = 1}),
                         LOBE_OK);
        lobe_frame frame = draw(f, &request);
        assert_int_equal(times_run(&frame, "mask_coverage"), masked);
        lobe_frame_free(&frame);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

static void change_alpha(fixture *f, lobe_scene *scene, unsigned char alpha) {
    const uint32_t image = (uint32_t)scene->materials[0].base_colour_map.image;
    set_alpha(&scene->images[image].image, alpha);
    assert_int_equal(lobe_renderer_update_scene(
                         f->renderer, &(lobe_scene_changes){.images = &image, .image_count = 1}),
                     LOBE_OK);
}

static void check_equal(const lobe_frame *frame, const lobe_frame *expected) {
    assert_memory_equal(frame->radiance.texels, expected->radiance.texels,
                        (size_t)16 * frame->radiance.width * frame->radiance.height);
}

/// A mask that keeps all costs nothing and changes nothing, until its texels, its cutoff or its
/// vertices cut something away.
static void masks_that_keep_all_are_as_none(void **state) {
    fixture *f = *state;
    static const char *const filters[] = {"mipmap", "lobes", "moments"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        picture_request request = {.filter = filters[i], .width = 16, .height = 16};
        lobe_scene *scene = square_with_waves(false, 128);
        lobe_frame expected = draw_scene(f, scene, &request);
        lobe_scene_destroy(&scene);
        scene = square_with_waves(true, 128);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        static const unsigned char alphas[] = {128, 127, 200};
        for (int k = 0; k < 3; k++) {
            if (k > 0)
                change_alpha(f, scene, alphas[k]);
            lobe_frame frame = draw(f, &request);
            assert_int_equal(times_run(&frame, "mask_coverage"), alphas[k] < 128);
            if (alphas[k] >= 128)
                check_equal(&frame, &expected);
            lobe_frame_free(&frame);
        }
        scene->materials[0].base_colour[3] = 0.6f;
        assert_int_equal(lobe_renderer_update_scene(
                             f->renderer, &(lobe_scene_changes){.materials = (uint32_t[]){0},
                                                                .material_count = 1}),
                         LOBE_OK);
        lobe_frame frame = draw(f, &request);
        assert_int_equal(times_run(&frame, "mask_coverage"), 1);
        lobe_frame_free(&frame);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
        lobe_frame_free(&expected);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_is_kept_at_every_distance),
        cmocka_unit_test(every_filter_keeps_coverage),
        cmocka_unit_test(vertices_thin_the_mask),
        cmocka_unit_test(vertices_thin_the_mask_in_places),
        cmocka_unit_test(near_edges_are_sharp),
        cmocka_unit_test(pictures_do_not_flicker),
        cmocka_unit_test(holes_lend_no_normals),
        cmocka_unit_test(kept_pixels_are_as_bright),
        cmocka_unit_test(kept_metal_is_as_bright),
        cmocka_unit_test(coverage_is_built_once_and_only_for_masks),
        cmocka_unit_test(masks_that_keep_all_are_as_none),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
