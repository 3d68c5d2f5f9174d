// What a mask keeps, in every texel of the first level and on the whole, against counting points of
// the interpolated map.

#include <math.h>
#include <stdlib.h>

#include "passes/maps/colours/mask_coverage.h"
#include "tests/passes/support/mask_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"

typedef struct mask_case {
    mask_pattern pattern;
    uint32_t width, height;
    mask_sampling sampling;
    float alpha, cutoff;
    float vertex_alpha; ///< of one vertex; that of the others is 1. 0: of this one, too
} mask_case;

/// Half floats, and points on a grid: an edge along it is off by half a point in each texel.
static const double bound = 0.03;

static void check_layer(const float *texels, uint32_t layer, double threshold,
                        const reduced_map *map, const lobe_image *image, const mask_case *tested) {
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 0; level < map->levels; level++) {
        const double extent[2] = {(double)image->width / width, (double)image->height / height};
        const float *texel = texels + (size_t)4 * layer * width * height;
        for (uint32_t i = 0; i < width * height; i++, texel += 4) {
            const double corner[2] = {i % width * extent[0], i / width * extent[1]};
            double mean[4];
            // Only the first level and the whole: those between are means.
            if (level > 0 && level + 1 < map->levels)
                continue;
            // Boxes with parts of texels take the same share of all that those texels keep.
            if ((extent[0] != floor(extent[0]) || extent[1] != floor(extent[1])))
                continue;
            mask_mean(image, tested->sampling, threshold, corner, extent, mean);
            for (int channel = 0; channel < 4; channel++)
                if (!(fabs((double)texel[channel] - mean[channel]) <= bound))
                    fail_msg("pattern %d, %ux%u, threshold %g, level %u, texel %u: %g, not %g",
                             tested->pattern, image->width, image->height, threshold, level, i,
                             (double)texel[channel], mean[channel]);
        }
        texels += (size_t)4 * map->layers * width * height;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
}

static void check_map(const float *texels, const reduced_map *map, const pass_run *run,
                      const mask_case *tested) {
    const device_material *material = &run->scene->materials[0];
    const lobe_image *image = &run->scene->scene->images[0].image;
    const bool varies = tested->vertex_alpha > 0;
    assert_int_equal(passes_mask_varies(run->scene, material), varies);
    double least = (double)tested->cutoff / (double)tested->alpha, step = 0;
    if (varies) {
        const struct mask_thresholds thresholds = passes_mask_thresholds(run->scene, material);
        assert_int_equal(map->layers, 1 + (int)thresholds.last_layer);
        assert_true(fabs((double)thresholds.least - least) < 1e-6);
        step = 1 / (double)thresholds.layers_per_alpha;
        const double largest = fmin(least / (double)tested->vertex_alpha, 1);
        assert_true(fabs(least + step * (double)thresholds.last_layer - largest) < 2e-4);
    } else {
        assert_int_equal(map->layers, 1);
    }
    for (uint32_t layer = 0; layer < map->layers; layer++)
        check_layer(texels, layer, least + step * layer, map, image, tested);
}

static void check_case(fixture *f, const mask_case *tested) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.alpha_mask = true;
    material.alpha_cutoff = tested->cutoff;
    material.base_colour[3] = tested->alpha;
    material.base_colour_map =
        scene_add_map(scene, mask_image(tested->pattern, tested->width, tested->height));
    material.base_colour_map.nearest = tested->sampling.nearest;
    if (tested->sampling.clamped)
        material.base_colour_map.wrap_u = material.base_colour_map.wrap_v = LOBE_SCENE_WRAP_CLAMP;
    scene_end_with_square(scene, &material);
    scene->meshes[0].has_colour = true;
    if (tested->vertex_alpha > 0)
        scene->meshes[0].vertices[0].colour[3] = tested->vertex_alpha;
    pass_run run;
    pass_run_begin(&run, f, scene, "mipmap", (const char *[]){NULL});
    const reduced_map map = passes_mask_coverage(&run.context, 0);
    float *found = pass_run_read(&run, &map, LOBE_FORMAT_RGBA16_FLOAT);
    check_map(found, &map, &run, tested);
    free(found);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

static void coverage_is_what_a_count_gives(void **state) {
    static const float cutoffs[] = {0.1f, 0.5f, 0.9f};
    for (int pattern = 0; pattern < MASK_PATTERN_COUNT; pattern++)
        for (int i = 0; i < 6; i++)
            check_case(*state, &(mask_case){.pattern = (mask_pattern)pattern,
                                            .width = 16,
                                            .height = 8,
                                            .sampling = {.nearest = i % 2},
                                            .alpha = 1,
                                            .cutoff = cutoffs[i / 2]});
}

static void sizes_factors_and_edges(void **state) {
    static const mask_case cases[] = {
        {MASK_SMOOTH, 7, 5, {0}, 1, 0.5f, 0},
        {MASK_SMOOTH, 1, 12, {0}, 1, 0.5f, 0},
        {MASK_SMOOTH, 8, 8, {.clamped = true}, 1, 0.5f, 0},
        {MASK_SMOOTH, 16, 16, {0}, 0.5f, 0.3f, 0},
        {MASK_SMOOTH, 16, 16, {.nearest = true}, 0.5f, 0.2f, 0},
        {MASK_DISCS, 16, 16, {0}, 1, 0, 0},
        {MASK_DISCS, 16, 16, {.nearest = true}, 1, 1.5f, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// The last layer keeps what nothing may cut away, an alpha of 1, though its threshold is rounded.
static void vertices_make_several_thresholds(void **state) {
    static const mask_case cases[] = {
        {MASK_SMOOTH, 16, 8, {0}, 1, 0.4f, 0.5f},
        {MASK_SMOOTH, 7, 5, {0}, 0.8f, 0.3f, 0.6f},
        {MASK_CHECKER, 16, 16, {.nearest = true}, 0.7f, 0.5f, 0.01f},
        {MASK_DISCS, 16, 16, {0}, 1, 0.5f, 0.9f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Vertices need no layers where nothing or all is kept, whatever their alpha.
static void thresholds_out_of_reach_need_no_layers(void **state) {
    static const float cutoffs[] = {0, 1.5f};
    for (int i = 0; i < 2; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        material.alpha_mask = true;
        material.alpha_cutoff = cutoffs[i];
        material.base_colour_map = scene_add_map(scene, mask_image(MASK_SMOOTH, 8, 8));
        scene_end_with_square(scene, &material);
        scene->meshes[0].vertices[0].colour[3] = 0;
        pass_run run;
        pass_run_begin(&run, *state, scene, "mipmap", (const char *[]){NULL});
        assert_false(passes_mask_varies(run.scene, &run.scene->materials[0]));
        pass_run_end(&run);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_is_what_a_count_gives),
        cmocka_unit_test(sizes_factors_and_edges),
        cmocka_unit_test(vertices_make_several_thresholds),
        cmocka_unit_test(thresholds_out_of_reach_need_no_layers),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
