#ifndef PASSES_FILTERS_MOMENTS_BIN_CHOICE_H
#define PASSES_FILTERS_MOMENTS_BIN_CHOICE_H

#include "passes/filters/moments/mixture_fit.h"

/// Fits the mixture that serves some patches of a material's maps best. `bins`: its number of
/// components [1, MOMENT_MAXIMUM_BINS]; 0: the smallest number that is about as good for the
/// patches as the best. A single component for all lobes if the survey has no samples.
/// False: out of memory.
bool passes_bins_choose(const lobe_scene *scene, const device_material *material,
                        const lobe_survey *survey, uint32_t bins, const lobe_allocator *allocator,
                        plane_mixture *chosen);

#endif
