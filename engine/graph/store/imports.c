#include "engine/graph/store/store.h"

#include <string.h>

#include <lobe/vulkan.h>

// ---------------------------------------------------------------------------------------------
// Textures and buffers of the graph

lobe_result lobe_graph_create_texture(lobe_graph *graph, const lobe_texture_parameters *parameters,
                                      lobe_texture **texture) {
    if (texture)
        *texture = NULL;
    if (!graph || !parameters || !texture)
        return lobe_host_fail(
            graph ? &graph->device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_graph_create_texture: graph, parameters and texture must not be NULL");
    return engine_texture_create_for(graph->device, &graph->kept.uploads, parameters, texture);
}

lobe_result lobe_graph_create_buffer(lobe_graph *graph, const lobe_buffer_parameters *parameters,
                                     lobe_buffer **buffer) {
    if (buffer)
        *buffer = NULL;
    if (!graph || !parameters || !buffer)
        return lobe_host_fail(
            graph ? &graph->device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_graph_create_buffer: graph, parameters and buffer must not be NULL");
    return engine_buffer_create_for(graph->device, &graph->kept.uploads, parameters, buffer);
}

lobe_result lobe_graph_submit_content(lobe_graph *graph) {
    if (!graph)
        return LOBE_ERROR_INVALID_ARGUMENT;
    engine_uploads *uploads = &graph->kept.uploads;
    return uploads->started || uploads->count == 0 ? LOBE_OK : engine_uploads_submit(uploads);
}

// ---------------------------------------------------------------------------------------------
// Uploads of the frame

static lobe_result reserve_uploads(lobe_graph *graph, uint64_t size) {
    if (size <= graph->frame.flight->upload_size)
        return LOBE_OK;
    engine_buffer_destroy_placed(graph->device, &graph->frame.flight->uploads.buffer,
                                 &graph->frame.flight->upload_memory);
    graph->frame.flight->upload_size = 0;
    VkFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    lobe_result result = engine_buffer_create_placed(
        graph->device, "uploads of the frame", size, usage, ENGINE_MEMORY_UPLOAD,
        &graph->frame.flight->uploads.buffer, &graph->frame.flight->upload_memory);
    if (result == LOBE_OK)
        graph->frame.flight->upload_size = size;
    return result;
}

static uint64_t upload_alignment(const lobe_graph *graph) {
    const VkPhysicalDeviceLimits *limits = &graph->device->limits;
    uint64_t alignment = 16;
    if (limits->minUniformBufferOffsetAlignment > alignment)
        alignment = limits->minUniformBufferOffsetAlignment;
    if (limits->minStorageBufferOffsetAlignment > alignment)
        alignment = limits->minStorageBufferOffsetAlignment;
    return alignment;
}

static lobe_result place_uploads(lobe_graph *graph) {
    uint64_t alignment = upload_alignment(graph), size = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        if (resource->origin != ENGINE_GRAPH_UPLOAD)
            continue;
        resource->offset = size;
        size += (resource->size + alignment - 1) / alignment * alignment;
    }
    lobe_result result = reserve_uploads(graph, size);
    for (uint32_t i = 0; result == LOBE_OK && i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        if (resource->origin != ENGINE_GRAPH_UPLOAD)
            continue;
        resource->object = &graph->frame.flight->uploads;
        memcpy((char *)graph->frame.flight->upload_memory.mapped + resource->offset,
               resource->upload, resource->size);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// All imports

lobe_result engine_graph_place_imports(lobe_graph *graph) {
    uint32_t count = graph->frame.dependencies.resource_count;
    graph->frame.imported =
        engine_arena_allocate(&graph->frame.arena, count * sizeof *graph->frame.imported);
    if (!graph->frame.imported)
        return engine_graph_fail_memory(graph);
    for (uint32_t i = 0; i < count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        if (resource->texture)
            graph->frame.imported[i].image = resource->texture->image;
        else if (resource->buffer)
            graph->frame.imported[i].buffer = resource->buffer->buffer;
        else if (resource->host)
            graph->frame.imported[i].image = resource->host->image;
        else if (resource->host_buffer)
            graph->frame.imported[i].buffer = resource->host_buffer->buffer;
        else
            continue;
        resource->object = &graph->frame.imported[i];
    }
    return place_uploads(graph);
}

void engine_graph_release_imports(lobe_graph *graph) {
    for (uint32_t i = 0; graph->frame.imported && i < graph->frame.dependencies.resource_count; i++)
        while (graph->frame.imported[i].views) {
            engine_graph_view *view = graph->frame.imported[i].views;
            graph->frame.imported[i].views = view->next;
            view->next = graph->frame.flight->views;
            graph->frame.flight->views = view;
        }
    graph->frame.imported = NULL;
}
