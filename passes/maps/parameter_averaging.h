#ifndef PASSES_MAPS_PARAMETER_AVERAGING_H
#define PASSES_MAPS_PARAMETER_AVERAGING_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// Adds the pass that averages normals and concentrations like colours, and the reduction of what
/// it writes. The material has a normal or width map.
reduced_map passes_parameter_averaging(const filter_context *context, uint32_t material);

/// The `build` of a filter that shades from these maps (shaders/shading/averaged_maps.glsl).
void passes_parameter_averaging_build(const filter_context *context, size_t instance,
                                      const void *prepared, filtered_appearance *appearance);

#endif
