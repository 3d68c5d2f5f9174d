#ifndef ENGINE_GRAPH_RECORD_DESCRIPTOR_H
#define ENGINE_GRAPH_RECORD_DESCRIPTOR_H

#include "engine/graph/graph.h"

/// Execution: gives every command that runs its descriptor set.
lobe_result engine_graph_write_descriptors(lobe_graph *graph);

VkImageLayout engine_graph_vulkan_layout(engine_layout layout);

#endif
