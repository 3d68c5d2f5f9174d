#include "engine/graph/store/store.h"

#include <string.h>

#include "engine/device/vulkan_check.h"

#include <lobe/vulkan.h>

static lobe_result create_image(lobe_device *device, const engine_graph_resource *resource,
                                engine_graph_object *object, VkMemoryRequirements *requirements) {
    engine_image_parameters parameters = {
        .name = resource->name,
        .format = resource->format,
        .width = resource->width,
        .height = resource->height,
        .layers = resource->layers,
        .levels = resource->levels,
        .samples = resource->samples,
        .usage = resource->usage,
        .flags = resource->cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
    };
    return engine_image_create(device, &parameters, &object->image, requirements);
}

lobe_result engine_graph_create_object(lobe_device *device, const engine_graph_resource *resource,
                                       engine_graph_object *object,
                                       VkMemoryRequirements *requirements) {
    if (resource->is_image)
        return create_image(device, resource, object, requirements);
    // Fills write words of four bytes.
    uint64_t size = (resource->size + 3) / 4 * 4;
    return engine_buffer_create(device, resource->name, size, resource->usage, &object->buffer,
                                requirements);
}

lobe_result engine_graph_bind_object(lobe_device *device, const char *name,
                                     const engine_graph_object *object,
                                     const engine_allocation *allocation, uint64_t offset) {
    if (object->image)
        return VULKAN_CHECK(&device->host,
                            device->api.vkBindImageMemory(device->vulkan, object->image,
                                                          allocation->memory,
                                                          allocation->offset + offset),
                            "image '%s'", name);
    return VULKAN_CHECK(&device->host,
                        device->api.vkBindBufferMemory(device->vulkan, object->buffer,
                                                       allocation->memory,
                                                       allocation->offset + offset),
                        "buffer '%s'", name);
}

void engine_graph_free_views(lobe_device *device, engine_graph_object *object) {
    while (object->views) {
        engine_graph_view *view = object->views;
        object->views = view->next;
        device->api.vkDestroyImageView(device->vulkan, view->view, device->callbacks);
        lobe_release(view);
    }
}

void engine_graph_free_object(lobe_device *device, engine_graph_object *object) {
    engine_graph_free_views(device, object);
    device->api.vkDestroyImage(device->vulkan, object->image, device->callbacks);
    device->api.vkDestroyBuffer(device->vulkan, object->buffer, device->callbacks);
    *object = (engine_graph_object){0};
}

static lobe_result add_view(lobe_device *device, const engine_graph_resource *resource,
                            VkImageViewType type, const lobe_range *range) {
    engine_graph_view *added = lobe_allocate(device->host.allocator, 1, sizeof *added);
    if (!added)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "image '%s': out of memory",
                              resource->name);
    engine_view_parameters parameters = {
        .name = resource->name,
        .image = resource->object->image,
        .format = resource->format,
        .type = type,
        .first_level = resource->first_level + range->first_level,
        .level_count = range->level_count,
        .first_layer = resource->first_layer + range->first_layer,
        .layer_count = range->layer_count,
    };
    *added = (engine_graph_view){.type = type, .range = *range};
    lobe_result result = engine_view_create(device, &parameters, &added->view);
    if (result != LOBE_OK) {
        lobe_release(added);
        return result;
    }
    added->next = resource->object->views;
    resource->object->views = added;
    return LOBE_OK;
}

/// The view that came with an imported image; VK_NULL_HANDLE if it has no such view.
static VkImageView given_view(const engine_graph_resource *resource, VkImageViewType type,
                              const lobe_range *range) {
    const lobe_range first = {.level_count = 1, .layer_count = 1};
    bool plain = type == VK_IMAGE_VIEW_TYPE_2D;
    if (resource->texture)
        return plain ? resource->texture->view : resource->texture->array_view;
    if (resource->host && plain && memcmp(range, &first, sizeof first) == 0)
        return resource->host->view;
    return VK_NULL_HANDLE;
}

lobe_result engine_graph_get_view(lobe_device *device, const engine_graph_resource *resource,
                                  VkImageViewType type, const lobe_range *range,
                                  VkImageView *view) {
    *view = given_view(resource, type, range);
    if (*view)
        return LOBE_OK;
    for (const engine_graph_view *known = resource->object->views; known; known = known->next)
        if (known->type == type && memcmp(&known->range, range, sizeof *range) == 0) {
            *view = known->view;
            return LOBE_OK;
        }
    lobe_result result = add_view(device, resource, type, range);
    *view = result == LOBE_OK ? resource->object->views->view : VK_NULL_HANDLE;
    return result;
}
