#include "passes/filters/moments/factor_change.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "passes/upload/material_maps.h"

// Within this ratio, as many bins mostly serve as well: docs/concepts.md has errors. Also of metal,
// on which it depends whether bins have colours of their own.
static const float most_ratio = 2;

static bool is_near(float before, float after) {
    const float a = fabsf(before), b = fabsf(after);
    return before == after || (before * after > 0 && a <= most_ratio * b && b <= most_ratio * a);
}

static bool are_near(const struct material_constants *before,
                     const struct material_constants *after) {
    bool near = is_near(before->roughness, after->roughness) &&
                is_near(before->normal_scale, after->normal_scale) &&
                is_near(before->metallic, after->metallic);
    for (int i = 0; i < MATERIAL_MAXIMUM_LOBES; i++)
        near = near && is_near(before->lobe_direction[i][3], after->lobe_direction[i][3]);
    return near;
}

/// Clears what bins do not depend on, or only on whether it is near; `shape`: also what lobes
/// depend on.
static struct material_constants without_factors(const struct material_constants *constants,
                                                 bool shape) {
    struct material_constants rest = *constants;
    passes_map_places_forget(&rest);
    memset(rest.base_colour, 0, sizeof rest.base_colour);
    memset(rest.emissive, 0, sizeof rest.emissive);
    rest.occlusion_strength = rest.largest_colour = rest.metallic = 0;
    if (shape) {
        rest.roughness = rest.normal_scale = 0;
        for (int i = 0; i < MATERIAL_MAXIMUM_LOBES; i++)
            rest.lobe_direction[i][3] = 0;
    }
    return rest;
}

static bool are_equal_without(const struct material_constants *before,
                              const struct material_constants *after, bool shape) {
    const struct material_constants a = without_factors(before, shape),
                                    b = without_factors(after, shape);
    return memcmp(&a, &b, sizeof a) == 0;
}

factor_change passes_factor_change(const struct material_constants *before,
                                   const struct material_constants *after) {
    if (!are_near(before, after) || !are_equal_without(before, after, true))
        return FACTORS_REPLACE_LOBES;
    return are_equal_without(before, after, false) ? FACTORS_KEEP_LOBES : FACTORS_MOVE_LOBES;
}
