#include "engine/graph/record/record.h"

#include <lobe/vulkan.h>

#include "engine/resource/format.h"

// ---------------------------------------------------------------------------------------------
// Layouts

VkImageLayout engine_graph_vulkan_layout(engine_layout layout) {
    switch (layout) {
    case ENGINE_LAYOUT_GENERAL:
        return VK_IMAGE_LAYOUT_GENERAL;
    case ENGINE_LAYOUT_SAMPLED:
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case ENGINE_LAYOUT_COLOUR:
        return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case ENGINE_LAYOUT_DEPTH:
        return VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    case ENGINE_LAYOUT_COPY_SOURCE:
        return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case ENGINE_LAYOUT_COPY_TARGET:
        return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    default:
        return VK_IMAGE_LAYOUT_UNDEFINED;
    }
}

/// Vulkan's name of a layout, including those of host images before and after the frame.
static VkImageLayout layout_of(const engine_graph_resource *resource, engine_layout layout) {
    if (layout == ENGINE_LAYOUT_LENT)
        return resource->host->layout;
    if (layout != ENGINE_LAYOUT_RETURNED)
        return engine_graph_vulkan_layout(layout);
    return resource->host->final_layout ? resource->host->final_layout : VK_IMAGE_LAYOUT_GENERAL;
}

VkImageSubresourceRange engine_graph_vulkan_range(const engine_graph_resource *resource,
                                                  const lobe_range *range) {
    return (VkImageSubresourceRange){
        .aspectMask = engine_format_aspect(resource->format),
        .baseMipLevel = resource->first_level + range->first_level,
        .levelCount = range->level_count,
        .baseArrayLayer = resource->first_layer + range->first_layer,
        .layerCount = range->layer_count,
    };
}

// ---------------------------------------------------------------------------------------------
// Barriers

typedef struct barrier_batch {
    VkImageMemoryBarrier2 *images;
    VkBufferMemoryBarrier2 *buffers;
    VkMemoryBarrier2 memory;
    uint32_t image_count, buffer_count, memory_count;
} barrier_batch;

static void record_memory_barrier(const lobe_graph *graph, const VkMemoryBarrier2 *barrier) {
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .memoryBarrierCount = 1,
                                         .pMemoryBarriers = barrier};
    graph->device->api.vkCmdPipelineBarrier2(graph->frame.commands, &dependency);
}

void engine_graph_record_first_barrier(lobe_graph *graph) {
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
    };
    record_memory_barrier(graph, &barrier);
}

void engine_graph_record_last_barrier(lobe_graph *graph) {
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT,
    };
    record_memory_barrier(graph, &barrier);
}

/// Content from an earlier frame has no stage in this frame to wait for; its transition then waits
/// for everything, so that it follows the barrier at the start of the frame. The same holds for
/// memory that an earlier frame may still be using; there, waiting for the stages of the next use
/// is enough.
static VkPipelineStageFlags2 source_stages(const engine_dependency_barrier *barrier) {
    if (barrier->from.stages != 0)
        return barrier->from.stages;
    return barrier->from.layout == ENGINE_LAYOUT_UNDEFINED ? barrier->to.stages
                                                           : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
}

static void add_image(const lobe_graph *graph, const engine_dependency_barrier *barrier,
                      barrier_batch *batch) {
    const engine_graph_resource *resource = &graph->frame.resources[barrier->resource];
    batch->images[batch->image_count++] = (VkImageMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = source_stages(barrier),
        .srcAccessMask = barrier->from.access,
        .dstStageMask = barrier->to.stages,
        .dstAccessMask = barrier->to.access,
        .oldLayout = layout_of(resource, barrier->from.layout),
        .newLayout = layout_of(resource, barrier->to.layout),
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = resource->object->image,
        .subresourceRange = engine_graph_vulkan_range(resource, &barrier->range),
    };
}

static void add_buffer(const lobe_graph *graph, const engine_dependency_barrier *barrier,
                       barrier_batch *batch) {
    const engine_graph_resource *resource = &graph->frame.resources[barrier->resource];
    batch->buffers[batch->buffer_count++] = (VkBufferMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
        .srcStageMask = barrier->from.stages,
        .srcAccessMask = barrier->from.access,
        .dstStageMask = barrier->to.stages,
        .dstAccessMask = barrier->to.access,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .buffer = resource->object->buffer,
        .offset = resource->offset,
        .size = resource->size,
    };
}

static void add_memory(const engine_dependency_barrier *barrier, barrier_batch *batch) {
    batch->memory = (VkMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = barrier->from.stages,
        .srcAccessMask = barrier->from.access,
        .dstStageMask = barrier->to.stages,
        .dstAccessMask = barrier->to.access,
    };
    batch->memory_count = 1;
}

static void add_barrier(const lobe_graph *graph, const engine_dependency_barrier *barrier,
                        barrier_batch *batch) {
    if (barrier->resource == ENGINE_DEPENDENCY_NONE)
        add_memory(barrier, batch);
    else if (graph->frame.resources[barrier->resource].is_image)
        add_image(graph, barrier, batch);
    else
        add_buffer(graph, barrier, batch);
}

static void record_batch(const lobe_graph *graph, const barrier_batch *batch) {
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = batch->memory_count,
        .pMemoryBarriers = &batch->memory,
        .bufferMemoryBarrierCount = batch->buffer_count,
        .pBufferMemoryBarriers = batch->buffers,
        .imageMemoryBarrierCount = batch->image_count,
        .pImageMemoryBarriers = batch->images,
    };
    graph->device->api.vkCmdPipelineBarrier2(graph->frame.commands, &dependency);
}

lobe_result engine_graph_record_barriers(lobe_graph *graph, uint32_t position, uint32_t *next) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    uint32_t first = *next;
    while (*next < dependencies->barrier_count &&
           dependencies->barriers[*next].position == position)
        (*next)++;
    uint32_t count = *next - first;
    if (count == 0)
        return LOBE_OK;
    barrier_batch batch = {
        .images = engine_arena_allocate(&graph->frame.arena, count * sizeof *batch.images),
        .buffers = engine_arena_allocate(&graph->frame.arena, count * sizeof *batch.buffers)};
    if (!batch.images || !batch.buffers)
        return engine_graph_fail_memory(graph);
    for (uint32_t i = first; i < *next; i++)
        add_barrier(graph, &dependencies->barriers[i], &batch);
    record_batch(graph, &batch);
    return LOBE_OK;
}
