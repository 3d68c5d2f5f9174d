#ifndef PASSES_RENDERER_ACCUMULATION_H
#define PASSES_RENDERER_ACCUMULATION_H

#include <lobe/graph.h>

/// Adds the pass that adds a picture of one sample to the sum of samples (both RGBA32_FLOAT).
/// Returns the sum's new version.
lobe_resource passes_accumulation(lobe_graph *graph, lobe_resource radiance, lobe_resource sum,
                                  uint32_t width, uint32_t height);

#endif
