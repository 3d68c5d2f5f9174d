#include "engine/resource/resource.h"

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/staging.h"

// ---------------------------------------------------------------------------------------------
// Vulkan's buffers

lobe_result engine_buffer_create(lobe_device *device, const char *name, VkDeviceSize size,
                                 VkBufferUsageFlags usage, VkBuffer *buffer,
                                 VkMemoryRequirements *requirements) {
    *buffer = VK_NULL_HANDLE;
    if (size == 0)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT, "buffer '%s': a size of 0", name);
    if ((usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) && size > device->limits.maxStorageBufferRange)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                              "buffer '%s': %llu bytes are more than the %u the device allows",
                              name, (unsigned long long)size, device->limits.maxStorageBufferRange);
    const VkBufferCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = usage,
    };
    const lobe_result result =
        VULKAN_CHECK(&device->host,
                     device->api.vkCreateBuffer(device->vulkan, &create, device->callbacks, buffer),
                     "buffer '%s'", name);
    if (result != LOBE_OK)
        return result;
    device->api.vkGetBufferMemoryRequirements(device->vulkan, *buffer, requirements);
    engine_device_name(device, VK_OBJECT_TYPE_BUFFER, (uint64_t)*buffer, name);
    return LOBE_OK;
}

lobe_result engine_buffer_create_placed(lobe_device *device, const char *name, VkDeviceSize size,
                                        VkBufferUsageFlags usage, engine_memory_place place,
                                        VkBuffer *buffer, engine_allocation *allocation) {
    *allocation = (engine_allocation){0};
    engine_memory_request request = {.name = name, .place = place, .linear = true};
    lobe_result result =
        engine_buffer_create(device, name, size, usage, buffer, &request.requirements);
    if (result == LOBE_OK)
        result = engine_memory_allocate(device->memory, &request, allocation);
    if (result == LOBE_OK)
        result = VULKAN_CHECK(&device->host,
                              device->api.vkBindBufferMemory(
                                  device->vulkan, *buffer, allocation->memory, allocation->offset),
                              "buffer '%s'", name);
    if (result != LOBE_OK)
        engine_buffer_destroy_placed(device, buffer, allocation);
    return result;
}

void engine_buffer_destroy_placed(lobe_device *device, VkBuffer *buffer,
                                  engine_allocation *allocation) {
    device->api.vkDestroyBuffer(device->vulkan, *buffer, device->callbacks);
    *buffer = VK_NULL_HANDLE;
    engine_memory_free(device->memory, allocation);
}

// ---------------------------------------------------------------------------------------------
// Public

static const VkBufferUsageFlags usage =
    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
    VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// vkCmdFillBuffer works in words.
static VkDeviceSize whole_words(VkDeviceSize size) {
    return (size + 3) & ~(VkDeviceSize)3;
}

lobe_result lobe_buffer_create(lobe_device *device, const lobe_buffer_parameters *parameters,
                               lobe_buffer **buffer) {
    if (buffer)
        *buffer = NULL;
    if (!device || !parameters || !buffer)
        return lobe_host_fail(device ? &device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_buffer_create: device, parameters and buffer must not be NULL");
    const char *name = parameters->name ? parameters->name : "buffer";
    if (parameters->size == 0)
        return lobe_host_fail(&device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "buffer '%s': a size of 0", name);
    *buffer = lobe_allocate(device->host.allocator, 1, sizeof **buffer);
    if (!*buffer || !((*buffer)->name = lobe_copy_text(device->host.allocator, name))) {
        lobe_release(*buffer);
        *buffer = NULL;
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "buffer '%s': out of memory",
                              name);
    }
    (*buffer)->device = device;
    (*buffer)->size = parameters->size;
    (*buffer)->stamp = engine_device_stamp(device);
    lobe_result result = engine_buffer_create_placed(device, name, whole_words(parameters->size),
                                                     usage, ENGINE_MEMORY_DEVICE,
                                                     &(*buffer)->buffer, &(*buffer)->allocation);
    if (result == LOBE_OK)
        result = engine_upload_buffer(device, name, (*buffer)->buffer, parameters->size,
                                      parameters->data);
    if (result != LOBE_OK)
        lobe_buffer_destroy(buffer);
    return result;
}

lobe_result lobe_buffer_update(lobe_buffer *buffer, const void *data) {
    if (!buffer)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (!data)
        return lobe_host_fail(&buffer->device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "buffer '%s': no data given", buffer->name);
    buffer->stamp = engine_device_stamp(buffer->device);
    return engine_upload_buffer(buffer->device, buffer->name, buffer->buffer, buffer->size, data);
}

void lobe_buffer_destroy(lobe_buffer **buffer) {
    if (!buffer || !*buffer)
        return;
    lobe_device *device = (*buffer)->device;
    // On failure the device is lost, and has finished too.
    (void)engine_device_wait_all(device);
    engine_buffer_destroy_placed(device, &(*buffer)->buffer, &(*buffer)->allocation);
    lobe_release((*buffer)->name);
    lobe_release(*buffer);
    *buffer = NULL;
}
