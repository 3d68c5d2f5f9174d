#ifndef PASSES_ENVIRONMENT_REFLECTION_TABLE_H
#define PASSES_ENVIRONMENT_REFLECTION_TABLE_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// Tables of what microfacets reflect, over the cosine to the viewer and roughness. They depend on
/// no map of a scene, so the passes that write them run only once.

/// How shaders sample them: linearly, clamped to the edge.
extern const lobe_sampler passes_reflection_table_sampler;

/// Declares a table for a pass to write: an RGBA32_FLOAT image of `size` squared, kept as long as
/// the graph. `content` and the distributions are its name. `masking`: the distribution whose
/// masking the microfacets have.
lobe_resource passes_reflection_table(lobe_graph *graph, const char *content,
                                      lobe_distribution distribution, lobe_distribution masking,
                                      uint32_t size, uint32_t layers);

#endif
