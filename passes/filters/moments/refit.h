#ifndef PASSES_FILTERS_MOMENTS_REFIT_H
#define PASSES_FILTERS_MOMENTS_REFIT_H

#include "passes/context/filter.h"
#include "passes/filters/moments/partition.h"

/// How bins are fitted to other texels.
typedef struct refit_request {
    bool bright_texels; ///< those of colour maps may exceed one
    bool keeps;         ///< bins that an earlier frame fitted serve this one, if there are any
    bool follows;       ///< the fit goes on from that of an earlier frame, if there is one
} refit_request;

/// Adds the passes that fit a partition to other texels of its material's maps: they keep the
/// number of bins, so that neither memory nor pipelines change. A fit that does not follow another
/// starts from the partition's own bins, if it has any, so that the result depends on it and the
/// texels alone. Returns a retained buffer of struct moment_binning_constants.
lobe_resource passes_moment_refit(const filter_context *context, uint32_t material,
                                  const moment_partition *partition, const refit_request *request);

/// The material's next fit follows none: its partition is another one.
void passes_moment_refit_forget(lobe_graph *graph, uint32_t material);

#endif
