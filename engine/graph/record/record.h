#ifndef ENGINE_GRAPH_RECORD_H
#define ENGINE_GRAPH_RECORD_H

#include "engine/graph/state.h"

/// Prepares, records and submits the compiled frame (execute.c). `submission` may be NULL: no
/// semaphores of the host, and lobe submits.
lobe_result engine_graph_run(lobe_graph *graph, const lobe_vulkan_submission *submission);
/// Waits for what was submitted, and reads the times (execute.c).
lobe_result engine_graph_finish(lobe_graph *graph);

/// Gives every command that runs its descriptor set (descriptor.c).
lobe_result engine_graph_write_descriptors(lobe_graph *graph);
/// What a binding is to a shader's variable: an image or a buffer (descriptor.c).
lobe_result engine_graph_describe(lobe_graph *graph, const engine_graph_binding *binding,
                                  const engine_shader_binding *variable,
                                  VkDescriptorImageInfo *image, VkDescriptorBufferInfo *buffer);
/// Describes what the frame exports (export.c).
lobe_result engine_graph_describe_exports(lobe_graph *graph);

/// Records one pass (record.c).
lobe_result engine_graph_record_pass(lobe_graph *graph, lobe_pass *pass);

/// Records the barriers before the pass at `position` (barrier.c). `*next` is the first barrier
/// that is not recorded yet.
lobe_result engine_graph_record_barriers(lobe_graph *graph, uint32_t position, uint32_t *next);
/// Makes everything that earlier submissions wrote visible to this frame (barrier.c).
void engine_graph_record_first_barrier(lobe_graph *graph);
/// Makes what was copied for the host visible to it (barrier.c).
void engine_graph_record_last_barrier(lobe_graph *graph);

/// Vulkan's name of a layout, for any resource but a host image at the frame's edges (barrier.c).
VkImageLayout engine_graph_vulkan_layout(engine_layout layout);

/// A range of an image in numbers of the Vulkan image, of which a host may lend a part (barrier.c).
VkImageSubresourceRange engine_graph_vulkan_range(const engine_graph_resource *resource,
                                                  const lobe_range *range);

#endif
