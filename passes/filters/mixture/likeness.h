#ifndef PASSES_FILTERS_MIXTURE_LIKENESS_H
#define PASSES_FILTERS_MIXTURE_LIKENESS_H

#include "passes/filters/mixture/mixture_map.h"

/// Adds the passes that find where texels of a mixture's map, in the Lambert plane, have components
/// too unlike those of neighbours, or of the next level's around them, for shading to blend them.
/// `tolerance`: the squared error of a blend halfway, in parts of what is blended. Result: an image
/// of the map's size and levels (see mixture_likeness_constants).
lobe_resource passes_mixture_likeness(const filter_context *context, uint32_t material,
                                      const mixture_kind *kind, const moment_map *mixture,
                                      float tolerance);

#endif
