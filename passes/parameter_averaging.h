#ifndef PASSES_PARAMETER_AVERAGING_H
#define PASSES_PARAMETER_AVERAGING_H

#include "passes/filter.h"
#include "passes/level_reduction.h"

/// Adds the pass that averages normals and concentrations like colours, and the reduction of what
/// it writes: the map of the naive filter. The material has a normal or width map.
reduced_map parameter_averaging(const filter_context *context, uint32_t material);

#endif
