#include "engine/graph/declare/declare.h"

#include <lobe/vulkan.h>

// ---------------------------------------------------------------------------------------------
// Declaration

static bool is_imported(const lobe_graph *graph, const lobe_vulkan_buffer *buffer) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        const lobe_vulkan_buffer *other = graph->frame.resources[i].host_buffer;
        if (other && other->buffer == buffer->buffer &&
            other->offset < buffer->offset + buffer->size &&
            buffer->offset < other->offset + other->size)
            return true;
    }
    return false;
}

static uint64_t alignment_of(const lobe_graph *graph) {
    const VkPhysicalDeviceLimits *limits = &graph->device->limits;
    return limits->minUniformBufferOffsetAlignment > limits->minStorageBufferOffsetAlignment
               ? limits->minUniformBufferOffsetAlignment
               : limits->minStorageBufferOffsetAlignment;
}

static bool check_buffer(lobe_graph *graph, const lobe_vulkan_buffer *buffer, const char *name) {
    const uint64_t alignment = alignment_of(graph);
    if (!buffer->buffer || buffer->size == 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "host buffer '%s': needs a handle and a size above 0", name);
    else if (buffer->offset % alignment != 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "host buffer '%s': the offset %llu is no multiple of %llu", name,
                        (unsigned long long)buffer->offset, (unsigned long long)alignment);
    else if (is_imported(graph, buffer))
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "host buffer '%s': a part of it is imported twice in one frame", name);
    return graph->frame.result == LOBE_OK;
}

static engine_stamp content_of(const lobe_graph *graph, const lobe_vulkan_buffer *buffer) {
    const uint64_t numbers[] = {ENGINE_GRAPH_HOST_BUFFER, (uint64_t)(uintptr_t)buffer->buffer,
                                buffer->content, buffer->offset, buffer->size};
    return engine_graph_lent_content(graph, buffer->content, numbers, sizeof numbers);
}

lobe_resource lobe_graph_import_host_buffer(lobe_graph *graph, const lobe_vulkan_buffer *buffer) {
    if (!buffer) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "lobe_graph_import_host_buffer: buffer must not be NULL");
        return (lobe_resource){0};
    }
    const char *name = buffer->name ? buffer->name : "host buffer";
    if (!engine_graph_can_declare(graph, name) || !check_buffer(graph, buffer, name))
        return (lobe_resource){0};
    const lobe_vulkan_buffer *kept = engine_arena_copy(&graph->frame.arena, buffer, sizeof *buffer);
    name = engine_arena_copy_text(&graph->frame.arena, name);
    if (!kept || !name) {
        engine_graph_fail_memory(graph);
        return (lobe_resource){0};
    }
    const engine_graph_resource resource = {.name = name,
                                            .origin = ENGINE_GRAPH_HOST_BUFFER,
                                            .layers = 1,
                                            .levels = 1,
                                            .size = buffer->size,
                                            .offset = buffer->offset,
                                            .host_buffer = kept};
    const engine_dependency_resource dependency = {
        .name = name,
        .levels = 1,
        .layers = 1,
        .borrowed = true,
        .identity = content_of(graph, buffer),
        .before = {.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   .access = VK_ACCESS_2_MEMORY_WRITE_BIT,
                   .layout = ENGINE_LAYOUT_LENT},
        .after = engine_graph_returned_state(buffer->final_stages, buffer->final_access)};
    return engine_graph_add_resource(graph, &resource, &dependency);
}

// ---------------------------------------------------------------------------------------------
// Compilation

static const char *missing_usage(VkBufferUsageFlags missing) {
    if (missing & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)
        return "storage";
    if (missing & VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)
        return "uniform";
    if (missing & VK_BUFFER_USAGE_INDEX_BUFFER_BIT)
        return "index";
    if (missing & VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT)
        return "indirect";
    return missing & VK_BUFFER_USAGE_TRANSFER_SRC_BIT ? "transfer source" : "transfer destination";
}

lobe_result engine_graph_check_host_buffers(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        const engine_graph_resource *resource = &graph->frame.resources[i];
        const VkFlags missing =
            resource->host_buffer ? resource->usage & ~resource->host_buffer->usage : 0;
        if (missing)
            return lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                                   "host buffer '%s' was not created with the usage '%s'",
                                   resource->name, missing_usage(missing));
    }
    return LOBE_OK;
}
