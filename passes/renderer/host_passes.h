#ifndef PASSES_RENDERER_HOST_PASSES_H
#define PASSES_RENDERER_HOST_PASSES_H

#include <lobe/renderer.h>

#include "passes/renderer/shading.h"

/// Lets the host add its passes before shading. An image that they write is kept, not cleared.
void passes_host_passes_before(lobe_graph *graph, const lobe_render_host *host,
                               shading_targets *targets);
/// Lets the host add its passes after shading.
void passes_host_passes_after(lobe_graph *graph, const lobe_render_host *host,
                              shading_targets *targets);

#endif
