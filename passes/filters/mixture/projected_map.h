#ifndef PASSES_FILTERS_MIXTURE_PROJECTED_MAP_H
#define PASSES_FILTERS_MIXTURE_PROJECTED_MAP_H

#include "passes/filters/mixture/mixture_map.h"

/// Builds the mixtures of an instance's material for shaders/filters/mixture/projected.glsl, if
/// maps make its lobes vary. `kind`: of MIXTURE_PLANE_PROJECTED.
/// `prepared`: what the slot holds (passes/filters/mixture/record.h).
void passes_projected_map_build(const filter_context *context, size_t instance,
                                const mixture_kind *kind, const void *prepared,
                                filtered_appearance *appearance);

#endif
