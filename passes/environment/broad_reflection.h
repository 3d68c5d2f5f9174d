#ifndef PASSES_ENVIRONMENT_BROAD_REFLECTION_H
#define PASSES_ENVIRONMENT_BROAD_REFLECTION_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// Adds the pass that tabulates what rough microfacets reflect as a lobe and a polynomial over the
/// hemisphere: a retained RGBA32_FLOAT image of BROAD_REFLECTION_SIZE squared and
/// BROAD_REFLECTION_LAYERS layers, over the cosine to the viewer and roughness.
/// shaders/interface/environment/broad_reflection.h says what it holds,
/// shaders/environment/broad_reflection.glsl looks it up. `masking` is as in
/// passes_directional_albedo. `probes` [1, 8]: round lobes that may represent an elongated one. It
/// depends only on these, so the pass runs only once. Call it at most once per frame
/// for each pair of distributions.
lobe_resource passes_broad_reflection(lobe_graph *graph, lobe_distribution distribution,
                                      lobe_distribution masking, uint32_t probes);

#endif
