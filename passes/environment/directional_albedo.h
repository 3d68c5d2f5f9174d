#ifndef PASSES_ENVIRONMENT_DIRECTIONAL_ALBEDO_H
#define PASSES_ENVIRONMENT_DIRECTIONAL_ALBEDO_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// Adds the pass that tabulates how much of uniform light a microfacet distribution reflects: a
/// retained RGBA32_FLOAT image of DIRECTIONAL_ALBEDO_SIZE squared, over the cosine to the viewer
/// and roughness. shaders/environment/directional_albedo.comp describes its contents, and
/// shaders/lib/microfacet/directional_albedo.glsl looks it up.
/// `masking` says whose masking and shadowing it has, usually its own. It depends only on these
/// two, so the pass runs only once. Call it at most once per frame for each pair.
lobe_resource passes_directional_albedo(lobe_graph *graph, lobe_distribution distribution,
                                        lobe_distribution masking);

#endif
