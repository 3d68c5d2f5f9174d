#ifndef ENGINE_GRAPH_DECLARE_HOST_H
#define ENGINE_GRAPH_DECLARE_HOST_H

#include "engine/graph/graph.h"

/// Compilation: images of the host must allow what passes do with them.
lobe_result engine_graph_check_host_images(lobe_graph *graph);

/// The layout as Vulkan's, of a resource that may be the host's.
VkImageLayout engine_graph_layout_of(const engine_graph_resource *resource, engine_layout layout);

#endif
