#ifndef PASSES_ENVIRONMENT_PREFILTERING_H
#define PASSES_ENVIRONMENT_PREFILTERING_H

#include "passes/maps/level_reduction.h"

/// What filtered cubes are made from: the radiance, and smaller and smaller smoothed cubes for
/// broader lobes, smoothed so little that the remaining filter can account for it.
typedef struct prefiltering_sources {
    lobe_resource radiance, smoothed;
    uint32_t size, smoothed_levels; ///< texels along a face of the radiance; 0 levels: none
} prefiltering_sources;

/// Texels along a face of a filtered cube's level 0, for a radiance of `size` texels.
uint32_t passes_prefiltered_width(uint32_t size);

/// Adds the passes that smooth level 0 of an environment's cube. `retained`: the result serves
/// several frames.
prefiltering_sources passes_environment_smoothing(lobe_graph *graph, lobe_resource radiance,
                                                  uint32_t size, bool retained);

/// Adds the pass that filters faces of one level of `cube` (six layers) with a von Mises-Fisher
/// lobe of this concentration, less what linear interpolation adds when the cube is sampled.
/// Returns the pass.
lobe_pass *passes_environment_prefiltering(lobe_graph *graph, const prefiltering_sources *sources,
                                           reduced_map *cube, uint32_t level, uint32_t first_face,
                                           uint32_t face_count, double concentration);

#endif
