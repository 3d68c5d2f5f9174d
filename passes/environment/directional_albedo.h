#ifndef PASSES_ENVIRONMENT_DIRECTIONAL_ALBEDO_H
#define PASSES_ENVIRONMENT_DIRECTIONAL_ALBEDO_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// How the table is to be read: between texels, none beyond the edge.
extern const lobe_sampler passes_directional_albedo_sampler;

/// Adds the pass that tabulates how much of even light a microfacet distribution reflects: a
/// retained RGBA32_FLOAT image of DIRECTIONAL_ALBEDO_SIZE squared, over cosine to the viewer and
/// roughness. What it holds is in shaders/environment/directional_albedo.comp, and how to look it
/// up in shaders/lib/microfacet/directional_albedo.glsl. It depends on nothing but the
/// distribution, and so is computed in the first frame only. At most once a frame for each
/// distribution.
lobe_resource passes_directional_albedo(lobe_graph *graph, lobe_distribution distribution);

#endif
