#ifndef PASSES_ENVIRONMENT_REFLECTED_LOBES_H
#define PASSES_ENVIRONMENT_REFLECTED_LOBES_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// Adds the pass that tabulates what microfacets of middling roughness reflect as a sum of lobes: a
/// retained RGBA32_FLOAT image of REFLECTED_LOBES_SIZE squared and REFLECTED_LOBES layers, over the
/// cosine to the viewer and roughness. shaders/interface/environment/reflected_lobes.h says what it
/// holds, shaders/environment/reflected_lobes.glsl looks it up. `masking` is as in
/// passes_directional_albedo. It depends only on these, so the pass runs only once. Call it at most
/// once per frame for each pair of distributions.
lobe_resource passes_reflected_lobes(lobe_graph *graph, lobe_distribution distribution,
                                     lobe_distribution masking);

#endif
