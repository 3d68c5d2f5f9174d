#ifndef PASSES_FILTERS_MOMENTS_BINNING_H
#define PASSES_FILTERS_MOMENTS_BINNING_H

#include "passes/context/filter.h"
#include "passes/filters/moments/partition.h"
#include "passes/maps/moment_map.h"

/// Adds the pass that distributes a material's lobes over bins, and the reduction of what it
/// writes. The material has a normal or width map. `bins`: the partition's constants, or what
/// moment_refit makes of them.
moment_map passes_moment_binning(const filter_context *context, uint32_t material,
                                 const moment_partition *partition, lobe_resource bins,
                                 lobe_format format);

#endif
