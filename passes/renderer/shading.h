#ifndef PASSES_RENDERER_SHADING_H
#define PASSES_RENDERER_SHADING_H

#include "passes/context/filter.h"
#include "passes/environment/light.h"

/// What the shading pass draws into. passes_shading_targets_declare declares the images; each
/// shading pass clears them and stores their new versions here.
typedef struct shading_targets {
    uint32_t width, height;
    lobe_resource radiance;     ///< RGBA32_FLOAT: linear RGB radiance, coverage
    lobe_resource depth;        ///< D32_FLOAT
    lobe_resource normal_depth; ///< RGBA32_FLOAT; none without AOVs
    lobe_resource lobes_level;  ///< RG32_FLOAT; none without AOVs
    /// Draw over the contents of radiance and depth instead of clearing them.
    bool keep_radiance, keep_depth;
    /// Leave radiance black where nothing is hit: the picture is later blended over another.
    bool without_background;
} shading_targets;

shading_targets passes_shading_targets_declare(lobe_graph *graph, uint32_t width, uint32_t height,
                                               bool aov);

/// Everything that lights the scene, shared by all shading passes of a frame.
typedef struct shading_light {
    lobe_resource punctual; ///< lights, sorted by type
    environment_light environment;
} shading_light;

shading_light passes_shading_light_prepare(const filter_context *context,
                                           const environment_work *work);

/// Adds a pass that draws all instances with the filter's shader. `appearances`: one per instance.
void passes_shading(const filter_context *context, const filtered_appearance *appearances,
                    const shading_light *light, const shading_sample *sample,
                    shading_targets *targets);

#endif
