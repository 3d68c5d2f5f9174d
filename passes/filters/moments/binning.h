#ifndef PASSES_FILTERS_MOMENTS_BINNING_H
#define PASSES_FILTERS_MOMENTS_BINNING_H

#include "passes/context/filter.h"
#include "passes/filters/moments/partition.h"
#include "passes/maps/level_reduction.h"

/// A map of lobe moments; its layers are described in shaders/interface/moment_bins.h.
typedef struct moment_map {
    reduced_map map;
    lobe_format format;
    lobe_resource bins; ///< uniform block of struct moment_binning_constants
} moment_map;

/// Adds the pass that distributes a material's lobes over bins, and the reduction of what it
/// writes. The material has a normal or width map. `bins`: the partition's constants, or what
/// moment_refit makes of them.
moment_map passes_moment_binning(const filter_context *context, uint32_t material,
                                 const moment_partition *partition, lobe_resource bins,
                                 lobe_format format);

#endif
