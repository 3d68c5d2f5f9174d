#ifndef PASSES_ENVIRONMENT_DIRECTIONAL_ALBEDO_H
#define PASSES_ENVIRONMENT_DIRECTIONAL_ALBEDO_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// How shaders sample the table: linearly, clamped to the edge.
extern const lobe_sampler passes_directional_albedo_sampler;

/// Adds the pass that tabulates how much of uniform light a microfacet distribution reflects: a
/// retained RGBA32_FLOAT image of DIRECTIONAL_ALBEDO_SIZE squared, over the cosine to the viewer
/// and roughness. shaders/environment/directional_albedo.comp says what it holds, and
/// shaders/lib/microfacet/directional_albedo.glsl how to look it up. It depends on the distribution
/// alone, so the pass runs in the first frame only. Call it at most once a frame for each
/// distribution.
lobe_resource passes_directional_albedo(lobe_graph *graph, lobe_distribution distribution);

#endif
