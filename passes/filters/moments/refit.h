#ifndef PASSES_FILTERS_MOMENTS_REFIT_H
#define PASSES_FILTERS_MOMENTS_REFIT_H

#include "passes/context/filter.h"
#include "passes/filters/moments/partition.h"

/// Adds the passes that fit a partition to other texels of its material's maps: they keep the
/// number of bins, so that neither memory nor pipelines change, and start from the partition's own
/// bins, so that the result depends on it and the texels alone. Returns a retained buffer of struct
/// moment_binning_constants. The host must have been able to read the first texels.
/// `bright_texels`: those of colour maps may exceed one.
lobe_resource passes_moment_refit(const filter_context *context, uint32_t material,
                                  const moment_partition *partition, bool bright_texels);

#endif
