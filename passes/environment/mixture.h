#ifndef PASSES_ENVIRONMENT_MIXTURE_H
#define PASSES_ENVIRONMENT_MIXTURE_H

#include "passes/environment/prefiltering.h"

/// Adds the passes that filter faces of one level of `cube` with GGX lobes, each a mixture of von
/// Mises-Fisher lobes. `lobes` is filtered with those of each level's concentration, `between` with
/// twice that: both must be complete at this level and all coarser ones. Returns the last pass.
lobe_pass *passes_environment_mixture(lobe_graph *graph, const prefiltering_sources *sources,
                                      const reduced_map *lobes, const reduced_map *between,
                                      reduced_map *cube, uint32_t level, uint32_t first_face,
                                      uint32_t face_count);

#endif
