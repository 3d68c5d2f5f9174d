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
} mask_case;

/// Half floats, and points on a grid: an edge along it is off by half a point in each texel.
static const double bound = 0.03;

static void check_map(const float *texel, const reduced_map *map, const lobe_image *image,
                      const mask_case *tested) {
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 0; level < map->levels; level++) {
        const double extent[2] = {(double)image->width / width, (double)image->height / height};
        for (uint32_t i = 0; i < width * height; i++, texel += 4) {
            const double corner[2] = {i % width * extent[0], i / width * extent[1]};
            double mean[4];
            // Only the first level and the whole: those between are means.
            if (level > 0 && level + 1 < map->levels)
                continue;
            // Boxes with parts of texels take the same share of all that those texels keep.
            if ((extent[0] != floor(extent[0]) || extent[1] != floor(extent[1])))
                continue;
            mask_mean(image, tested->sampling, tested->cutoff / (double)tested->alpha, corner,
                      extent, mean);
            for (int channel = 0; channel < 4; channel++)
                if (!(fabs((double)texel[channel] - mean[channel]) <= bound))
                    fail_msg("pattern %d, %ux%u, cutoff %g, level %u, texel %u: %g, not %g",
                             tested->pattern, image->width, image->height, (double)tested->cutoff,
                             level, i, (double)texel[channel], mean[channel]);
        }
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
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
    pass_run run;
    pass_run_begin(&run, f, scene, "mipmap", (const char *[]){NULL});
    const reduced_map map = passes_mask_coverage(&run.context, 0);
    float *found = pass_run_read(&run, &map, LOBE_FORMAT_RGBA16_FLOAT);
    check_map(found, &map, &scene->images[0].image, tested);
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
        {MASK_SMOOTH, 7, 5, {0}, 1, 0.5f},
        {MASK_SMOOTH, 1, 12, {0}, 1, 0.5f},
        {MASK_SMOOTH, 8, 8, {.clamped = true}, 1, 0.5f},
        {MASK_SMOOTH, 16, 16, {0}, 0.5f, 0.3f},
        {MASK_SMOOTH, 16, 16, {.nearest = true}, 0.5f, 0.2f},
        {MASK_DISCS, 16, 16, {0}, 1, 0},
        {MASK_DISCS, 16, 16, {.nearest = true}, 1, 1.5f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_is_what_a_count_gives),
        cmocka_unit_test(sizes_factors_and_edges),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
