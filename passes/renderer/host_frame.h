#ifndef PASSES_RENDERER_HOST_FRAME_H
#define PASSES_RENDERER_HOST_FRAME_H

#include <lobe/renderer.h>

#include "passes/renderer/shading.h"

/// What a host has a part in: its images, its passes, its submission.

/// Whether images are delivered in host memory.
bool passes_host_frame_delivers(const lobe_render_parameters *parameters);

/// Brings the images of the host's target into the graph; `imported` is all zero without one.
/// LOBE_ERROR_INVALID_ARGUMENT: no radiance, or another extent than asked for. What else is wrong
/// with an image stays in the graph.
lobe_result passes_host_frame_import(lobe_graph *graph, const lobe_render_parameters *parameters,
                                     const lobe_host *host, shading_targets *imported);
/// Puts them in the place of those declared.
void passes_host_frame_replace(const shading_targets *imported, shading_targets *targets);

/// Lets the host add its passes.
void passes_host_frame_before(lobe_graph *graph, const lobe_render_parameters *parameters,
                              shading_targets *targets);
void passes_host_frame_after(lobe_graph *graph, const lobe_render_parameters *parameters,
                             shading_targets *targets);

/// Executes the graph, or submits it as the host wants it.
lobe_result passes_host_frame_run(lobe_graph *graph, const lobe_render_parameters *parameters);

#endif
