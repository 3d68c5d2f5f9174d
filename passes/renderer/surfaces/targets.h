#ifndef PASSES_RENDERER_SURFACES_TARGETS_H
#define PASSES_RENDERER_SURFACES_TARGETS_H

#include <lobe/graph.h>

/// What the shading pass draws into. passes_shading_targets_declare declares the images; each
/// shading pass clears them and stores their new versions here.
typedef struct shading_targets {
    uint32_t width, height;
    lobe_resource radiance;     ///< RGBA32_FLOAT: linear RGB radiance, coverage
    lobe_resource depth;        ///< D32_FLOAT
    lobe_resource normal_depth; ///< RGBA32_FLOAT; none without AOVs
    lobe_resource lobes_level;  ///< RG32_FLOAT; none without AOVs
    lobe_resource motion;       ///< RG32_FLOAT; none without motion
    /// Draw over the contents of radiance, depth and motion instead of clearing them.
    bool keep_radiance, keep_depth, keep_motion;
    /// Leave radiance black where nothing is hit: the picture is later blended over another.
    bool without_background;
    /// The radiance's alpha is the depth of what is hit (as in `depth`; above 0) instead of 1.
    bool depth_as_coverage;
} shading_targets;

#endif
