#ifndef ENGINE_GRAPH_STORE_OBJECT_H
#define ENGINE_GRAPH_STORE_OBJECT_H

#include "engine/graph/graph.h"

/// Creates what the resource describes, without memory.
lobe_result engine_graph_create_object(lobe_device *device, const engine_graph_resource *resource,
                                       engine_graph_object *object,
                                       VkMemoryRequirements *requirements);
/// Puts it into `allocation`, `offset` bytes from its start.
lobe_result engine_graph_bind_object(lobe_device *device, const char *name,
                                     const engine_graph_object *object,
                                     const engine_allocation *allocation, uint64_t offset);
void engine_graph_free_views(lobe_device *device, engine_graph_object *object);
/// Frees views, image and buffer, not memory.
void engine_graph_free_object(lobe_device *device, engine_graph_object *object);

/// The view of these levels and layers, made at the first call.
lobe_result engine_graph_view_of(lobe_device *device, const engine_graph_resource *resource,
                                 VkImageViewType type, const lobe_range *range, VkImageView *view);

#endif
