#ifndef PASSES_MAPS_PARAMETER_AVERAGING_H
#define PASSES_MAPS_PARAMETER_AVERAGING_H

#include "passes/context/filter.h"
#include "passes/maps/lobe_map.h"

/// Normals and concentrations, averaged like colours.
extern const lobe_map_kind passes_averaged_parameters;

/// The `build` of a filter that shades from this map (shaders/shading/averaged_maps.glsl).
void passes_parameter_averaging_build(const filter_context *context, size_t instance,
                                      const void *prepared, filtered_appearance *appearance);

#endif
