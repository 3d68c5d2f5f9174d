#ifndef PASSES_RENDERER_MOTION_MOTION_H
#define PASSES_RENDERER_MOTION_MOTION_H

#include "passes/renderer/shading.h"

/// Where everything was in the previous frame.
typedef struct motion_start {
    const lobe_camera *camera;
    const float (*transforms)[16]; ///< one for each instance of the scene
} motion_start;

/// Checks numbers that a host gave: LOBE_ERROR_INVALID_ARGUMENT, and one line.
lobe_result passes_motion_check(const lobe_render_motion *motion, const lobe_scene *scene,
                                const lobe_host *host);

lobe_resource passes_motion_declare(lobe_graph *graph, uint32_t width, uint32_t height);

/// Adds the pass that draws motion for the surfaces in the targets' depth, after that was drawn.
void passes_motion(const filter_context *context, draw_list *draws, const motion_start *start,
                   shading_targets *targets);

#endif
