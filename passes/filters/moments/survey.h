#ifndef PASSES_FILTERS_MOMENTS_SURVEY_H
#define PASSES_FILTERS_MOMENTS_SURVEY_H

#include "passes/filters/moments/plane_sample.h"

/// What the partition of a material is made from: the extremes of all lobes of its maps, and a
/// sample of those that its mask keeps.

/// Extremes over all lobes of a material.
typedef struct plane_range {
    double low[2], high[2]; ///< of their places
    double sharpest;        ///< root of the concentration
    double broadest;        ///< variance
    double heaviest;        ///< mass of a texel's lobes (plane_mass in lib/lobe/plane_lobe.glsl)
} plane_range;

enum { SURVEY_TEXELS = 1024 };

typedef struct lobe_survey {
    plane_range range;
    uint32_t count; ///< of samples; 0: the host cannot read a map, and the range is the largest
    plane_sample samples[SURVEY_TEXELS * LOBE_MATERIAL_MAXIMUM_LOBES];
} lobe_survey;

/// Surveys the lobes of a material that has a normal or a width map. Reads all texels once: what
/// few of them have, a sample at regular distances misses, and a map whose period divides the
/// distance, it sees as flat. The result depends on the texels alone. NULL: out of memory. Freed
/// with lobe_release.
lobe_survey *passes_lobe_survey_make(const device_scene *scene, const device_material *material,
                                     const lobe_allocator *allocator);

#endif
