#include "engine/graph/record/record.h"

#include <string.h>

#include "engine/graph/store/store.h"
#include "engine/resource/format.h"

static const engine_dependency_access *access_at(const lobe_graph *graph, uint32_t access) {
    return &graph->frame.dependencies.accesses[access];
}

static engine_graph_resource *resource_at(const lobe_graph *graph, uint32_t access) {
    return &graph->frame.resources[access_at(graph, access)->resource];
}

// ---------------------------------------------------------------------------------------------
// Dispatches and draws

/// `before`: the pass's previous command, or NULL; what it bound is still bound.
static void bind_command(lobe_graph *graph, const engine_graph_command *command,
                         const engine_graph_command *before, const void *constants,
                         size_t constants_size) {
    const engine_pipeline *pipeline = command->pipeline;
    const bool bound = before && before->pipeline == pipeline;
    if (!bound)
        graph->device->api.vkCmdBindPipeline(graph->frame.commands, pipeline->bind_point,
                                             pipeline->pipeline);
    if (!bound || before->set != command->set)
        graph->device->api.vkCmdBindDescriptorSets(graph->frame.commands, pipeline->bind_point,
                                                   pipeline->layout, 0, 1, &command->set, 0, NULL);
    if (constants_size > 0)
        graph->device->api.vkCmdPushConstants(graph->frame.commands, pipeline->layout,
                                              pipeline->push_constant_stages, 0,
                                              (uint32_t)constants_size, constants);
}

static void record_dispatch(lobe_graph *graph, const engine_graph_command *command,
                            const engine_graph_command *before) {
    bind_command(graph, command, before, command->dispatch.constants,
                 command->dispatch.constants_size);
    if (command->indirect_access != ENGINE_DEPENDENCY_NONE) {
        const engine_graph_resource *arguments = resource_at(graph, command->indirect_access);
        graph->device->api.vkCmdDispatchIndirect(graph->frame.commands, arguments->object->buffer,
                                                 arguments->offset + command->indirect_offset);
        return;
    }
    graph->device->api.vkCmdDispatch(graph->frame.commands, command->group_count[0],
                                     command->group_count[1], command->group_count[2]);
}

static void draw_with_own_counts(lobe_graph *graph, const engine_graph_command *command) {
    const lobe_draw *draw = &command->draw;
    if (command->index_access == ENGINE_DEPENDENCY_NONE)
        graph->device->api.vkCmdDraw(graph->frame.commands, draw->index_count, draw->instance_count,
                                     draw->first_index, 0);
    else
        graph->device->api.vkCmdDrawIndexed(graph->frame.commands, draw->index_count,
                                            draw->instance_count, draw->first_index, 0, 0);
}

static void draw_indirectly(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *arguments = resource_at(graph, command->indirect_access);
    const VkBuffer buffer = arguments->object->buffer;
    const VkDeviceSize offset = arguments->offset + command->indirect_offset;
    const uint32_t stride = sizeof(lobe_draw_arguments);
    if (command->index_access == ENGINE_DEPENDENCY_NONE)
        graph->device->api.vkCmdDrawIndirect(graph->frame.commands, buffer, offset, 1, stride);
    else
        graph->device->api.vkCmdDrawIndexedIndirect(graph->frame.commands, buffer, offset, 1,
                                                    stride);
}

static void record_draw(lobe_graph *graph, const engine_graph_command *command,
                        const engine_graph_command *before) {
    bind_command(graph, command, before, command->draw.constants, command->draw.constants_size);
    if (command->index_access != ENGINE_DEPENDENCY_NONE) {
        const engine_graph_resource *indices = resource_at(graph, command->index_access);
        graph->device->api.vkCmdBindIndexBuffer(graph->frame.commands, indices->object->buffer,
                                                indices->offset, VK_INDEX_TYPE_UINT32);
    }
    if (command->indirect_access != ENGINE_DEPENDENCY_NONE)
        draw_indirectly(graph, command);
    else
        draw_with_own_counts(graph, command);
}

// ---------------------------------------------------------------------------------------------
// Attachments

static VkAttachmentLoadOp load_of(lobe_load load) {
    switch (load) {
    case LOBE_LOAD_KEEP:
        return VK_ATTACHMENT_LOAD_OP_LOAD;
    case LOBE_LOAD_DISCARD:
        return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    default:
        return VK_ATTACHMENT_LOAD_OP_CLEAR;
    }
}

/// What nothing reads after this pass need not be stored.
static VkAttachmentStoreOp store_of(const lobe_graph *graph, const lobe_pass *pass,
                                    uint32_t access) {
    uint32_t index = access_at(graph, access)->resource;
    bool last = graph->frame.resources[index].origin == ENGINE_GRAPH_TRANSIENT &&
                graph->frame.dependencies.resources[index].last_position ==
                    graph->frame.dependencies.passes[pass->index].position;
    return last ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
}

static lobe_result attachment_view(lobe_graph *graph, uint32_t access, VkImageView *view) {
    return engine_graph_get_view(graph->device, resource_at(graph, access), VK_IMAGE_VIEW_TYPE_2D,
                                 &access_at(graph, access)->range, view);
}

static lobe_result describe_attachment(lobe_graph *graph, const lobe_pass *pass,
                                       const engine_graph_attachment *attachment,
                                       VkRenderingAttachmentInfo *information) {
    *information = (VkRenderingAttachmentInfo){
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
    };
    if (attachment->access == ENGINE_DEPENDENCY_NONE)
        return LOBE_OK;
    information->imageLayout =
        engine_graph_vulkan_layout(access_at(graph, attachment->access)->state.layout);
    information->loadOp = load_of(attachment->load);
    information->storeOp = store_of(graph, pass, attachment->access);
    // Depth and the first colour channel share the same bytes of the clear value.
    memcpy(information->clearValue.color.float32, attachment->clear, sizeof attachment->clear);
    return attachment_view(graph, attachment->access, &information->imageView);
}

static lobe_result describe_resolve(lobe_graph *graph, const engine_graph_attachment *resolve,
                                    VkRenderingAttachmentInfo *information) {
    if (resolve->access == ENGINE_DEPENDENCY_NONE)
        return LOBE_OK;
    information->resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    information->resolveImageLayout =
        engine_graph_vulkan_layout(access_at(graph, resolve->access)->state.layout);
    return attachment_view(graph, resolve->access, &information->resolveImageView);
}

static uint32_t colour_count(const lobe_pass *pass) {
    uint32_t count = ENGINE_MAXIMUM_COLOUR_ATTACHMENTS;
    while (count > 0 && pass->colour[count - 1].access == ENGINE_DEPENDENCY_NONE)
        count--;
    return count;
}

static lobe_result begin_rendering(lobe_graph *graph, const lobe_pass *pass) {
    VkRenderingAttachmentInfo colours[ENGINE_MAXIMUM_COLOUR_ATTACHMENTS], depth;
    lobe_result result = describe_attachment(graph, pass, &pass->depth, &depth);
    for (uint32_t i = 0; result == LOBE_OK && i < colour_count(pass); i++) {
        result = describe_attachment(graph, pass, &pass->colour[i], &colours[i]);
        if (result == LOBE_OK)
            result = describe_resolve(graph, &pass->resolve[i], &colours[i]);
    }
    if (result != LOBE_OK)
        return result;
    const VkRenderingInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = {.extent = pass->extent},
        .layerCount = 1,
        .colorAttachmentCount = colour_count(pass),
        .pColorAttachments = colours,
        .pDepthAttachment = depth.imageView ? &depth : NULL,
    };
    graph->device->api.vkCmdBeginRendering(graph->frame.commands, &rendering);
    return LOBE_OK;
}

static lobe_result record_raster(lobe_graph *graph, const lobe_pass *pass) {
    lobe_result result = begin_rendering(graph, pass);
    if (result != LOBE_OK)
        return result;
    const VkViewport viewport = {
        .width = (float)pass->extent.width, .height = (float)pass->extent.height, .maxDepth = 1};
    const VkRect2D scissor = {.extent = pass->extent};
    graph->device->api.vkCmdSetViewport(graph->frame.commands, 0, 1, &viewport);
    graph->device->api.vkCmdSetScissor(graph->frame.commands, 0, 1, &scissor);
    for (const engine_graph_command *command = pass->first_command, *before = NULL; command;
         before = command, command = command->next)
        record_draw(graph, command, before);
    graph->device->api.vkCmdEndRendering(graph->frame.commands);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Transfers

static VkExtent3D level_extent(const engine_graph_resource *image, uint32_t level) {
    return (VkExtent3D){engine_graph_level_extent(image->width, level),
                        engine_graph_level_extent(image->height, level), 1};
}

static VkImageSubresourceLayers layers_of(const engine_graph_resource *image,
                                          const lobe_range *range, uint32_t n) {
    return (VkImageSubresourceLayers){engine_format_aspect(image->format),
                                      image->first_level + range->first_level + n,
                                      image->first_layer + range->first_layer, range->layer_count};
}

static void copy_images(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *source = resource_at(graph, command->source_access);
    const engine_graph_resource *target = resource_at(graph, command->target_access);
    const engine_dependency_access *from = access_at(graph, command->source_access);
    const engine_dependency_access *to = access_at(graph, command->target_access);
    const lobe_rectangle *part = &command->part;
    for (uint32_t i = 0; i < from->range.level_count; i++) {
        const VkImageCopy copy = {
            .srcSubresource = layers_of(source, &from->range, i),
            .srcOffset = {(int32_t)part->x, (int32_t)part->y, 0},
            .dstSubresource = layers_of(target, &to->range, i),
            .dstOffset = {(int32_t)command->target_x, (int32_t)command->target_y, 0},
            .extent = part->width > 0 ? (VkExtent3D){part->width, part->height, 1}
                                      : level_extent(source, from->range.first_level + i)};
        graph->device->api.vkCmdCopyImage(graph->frame.commands, source->object->image,
                                          engine_graph_vulkan_layout(from->state.layout),
                                          target->object->image,
                                          engine_graph_vulkan_layout(to->state.layout), 1, &copy);
    }
}

static void record_copy(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *source = resource_at(graph, command->source_access);
    const engine_graph_resource *target = resource_at(graph, command->target_access);
    if (source->is_image) {
        copy_images(graph, command);
        return;
    }
    const VkBufferCopy copy = {
        .srcOffset = source->offset, .dstOffset = target->offset, .size = source->size};
    graph->device->api.vkCmdCopyBuffer(graph->frame.commands, source->object->buffer,
                                       target->object->buffer, 1, &copy);
}

static void fill_image(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *target = resource_at(graph, command->target_access);
    const engine_dependency_access *access = access_at(graph, command->target_access);
    const VkImageSubresourceRange range = engine_graph_vulkan_range(target, &access->range);
    VkImageLayout layout = engine_graph_vulkan_layout(access->state.layout);
    VkClearColorValue colour;
    memcpy(colour.float32, command->value, sizeof colour.float32);
    const VkClearDepthStencilValue depth = {.depth = command->value[0]};
    if (range.aspectMask == VK_IMAGE_ASPECT_DEPTH_BIT)
        graph->device->api.vkCmdClearDepthStencilImage(graph->frame.commands, target->object->image,
                                                       layout, &depth, 1, &range);
    else
        graph->device->api.vkCmdClearColorImage(graph->frame.commands, target->object->image,
                                                layout, &colour, 1, &range);
}

static void record_fill(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *target = resource_at(graph, command->target_access);
    uint32_t bits;
    if (target->is_image) {
        fill_image(graph, command);
        return;
    }
    memcpy(&bits, command->value, sizeof bits);
    graph->device->api.vkCmdFillBuffer(graph->frame.commands, target->object->buffer,
                                       target->offset, target->size / 4 * 4, bits);
}

static void read_back_image(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *source = resource_at(graph, command->source_access);
    const engine_dependency_access *access = access_at(graph, command->source_access);
    VkDeviceSize offset = command->read_back_offset;
    for (uint32_t i = 0; i < access->range.level_count; i++) {
        VkExtent3D extent = level_extent(source, access->range.first_level + i);
        const VkBufferImageCopy copy = {.bufferOffset = offset,
                                        .imageSubresource = layers_of(source, &access->range, i),
                                        .imageExtent = extent};
        graph->device->api.vkCmdCopyImageToBuffer(graph->frame.commands, source->object->image,
                                                  engine_graph_vulkan_layout(access->state.layout),
                                                  graph->frame.flight->read_back.buffer, 1, &copy);
        offset += (VkDeviceSize)extent.width * extent.height * access->range.layer_count *
                  lobe_format_size(source->format);
    }
}

static void record_read_back(lobe_graph *graph, const engine_graph_command *command) {
    const engine_graph_resource *source = resource_at(graph, command->source_access);
    if (source->is_image) {
        read_back_image(graph, command);
        return;
    }
    const VkBufferCopy copy = {.srcOffset = source->offset,
                               .dstOffset = command->read_back_offset,
                               .size = command->read_back_size};
    graph->device->api.vkCmdCopyBuffer(graph->frame.commands, source->object->buffer,
                                       graph->frame.flight->read_back.buffer, 1, &copy);
}

// ---------------------------------------------------------------------------------------------

static void record_command(lobe_graph *graph, const engine_graph_command *command,
                           const engine_graph_command *before) {
    switch (command->kind) {
    case ENGINE_GRAPH_DISPATCH:
        record_dispatch(graph, command, before);
        break;
    case ENGINE_GRAPH_COPY:
        record_copy(graph, command);
        break;
    case ENGINE_GRAPH_FILL:
        record_fill(graph, command);
        break;
    case ENGINE_GRAPH_READ_BACK:
        record_read_back(graph, command);
        break;
    case ENGINE_GRAPH_DRAW:
        break; // needs attachments: record_raster
    case ENGINE_GRAPH_EXPORT:
        break; // barriers are all that is needed
    }
}

lobe_result engine_graph_record_pass(lobe_graph *graph, lobe_pass *pass) {
    lobe_result result = LOBE_OK;
    engine_device_begin_label(graph->device, graph->frame.commands, pass->name);
    if (pass->kind == LOBE_PASS_RASTER)
        result = record_raster(graph, pass);
    else
        for (const engine_graph_command *command = pass->first_command, *before = NULL; command;
             before = command, command = command->next)
            record_command(graph, command, before);
    engine_device_end_label(graph->device, graph->frame.commands);
    return result;
}
