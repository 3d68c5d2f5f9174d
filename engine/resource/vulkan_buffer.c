#include "engine/resource/resource.h"

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"

lobe_result engine_buffer_create(lobe_device *device, const char *name, VkDeviceSize size,
                                 VkBufferUsageFlags usage, VkBuffer *buffer,
                                 VkMemoryRequirements *requirements) {
    const lobe_host *log = name ? &device->host : NULL;
    *buffer = VK_NULL_HANDLE;
    if (size == 0)
        return lobe_host_fail(log, LOBE_ERROR_LIMIT, "buffer '%s': a size of 0", name);
    if ((usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) && size > device->limits.maxStorageBufferRange)
        return lobe_host_fail(log, LOBE_ERROR_LIMIT,
                              "buffer '%s': %llu bytes are more than the %u the device allows",
                              name, (unsigned long long)size, device->limits.maxStorageBufferRange);
    const VkBufferCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = usage,
    };
    const lobe_result result = VULKAN_CHECK(
        log, device->api.vkCreateBuffer(device->vulkan, &create, device->callbacks, buffer),
        "buffer '%s'", name);
    if (result != LOBE_OK)
        return result;
    device->api.vkGetBufferMemoryRequirements(device->vulkan, *buffer, requirements);
    if (name)
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
        result = VULKAN_CHECK(name ? &device->host : NULL,
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

lobe_result engine_staging_create(lobe_device *device, const char *name, VkDeviceSize size,
                                  engine_memory_place place, engine_staging *staging) {
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                               VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (size <= device->limits.maxStorageBufferRange)
        usage |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    *staging = (engine_staging){.size = size};
    const lobe_result result = engine_buffer_create_placed(device, name, size, usage, place,
                                                           &staging->buffer, &staging->allocation);
    if (result != LOBE_OK)
        *staging = (engine_staging){0};
    staging->mapped = staging->allocation.mapped;
    return result;
}

void engine_staging_destroy(lobe_device *device, engine_staging *staging) {
    engine_buffer_destroy_placed(device, &staging->buffer, &staging->allocation);
    *staging = (engine_staging){0};
}
