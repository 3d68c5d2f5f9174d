#include "engine/resource/resource.h"

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/content.h"
#include "engine/resource/upload.h"

static const VkBufferUsageFlags usage =
    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
    VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// vkCmdFillBuffer works in words.
static VkDeviceSize whole_words(VkDeviceSize size) {
    return (size + 3) & ~(VkDeviceSize)3;
}

static lobe_result create_buffer(lobe_buffer *buffer) {
    lobe_device *device = buffer->device;
    engine_memory_request request = {
        .name = buffer->name, .place = ENGINE_MEMORY_DEVICE, .linear = true};
    lobe_result result = engine_buffer_create(device, buffer->name, whole_words(buffer->size),
                                              usage, &buffer->buffer, &request.requirements);
    if (result == LOBE_OK)
        result = engine_upload_target_allocate(device, buffer->uploads.queue, &request,
                                               &buffer->allocation);
    if (result == LOBE_OK)
        result = VULKAN_CHECK(&device->host,
                              device->api.vkBindBufferMemory(device->vulkan, buffer->buffer,
                                                             buffer->allocation.memory,
                                                             buffer->allocation.offset),
                              "buffer '%s'", buffer->name);
    return result;
}

static void free_buffer(lobe_buffer **buffer) {
    if (*buffer)
        lobe_release((*buffer)->name);
    lobe_release(*buffer);
    *buffer = NULL;
}

static bool allocate(lobe_device *device, engine_uploads *queue, const char *name,
                     lobe_buffer **buffer) {
    *buffer = lobe_allocate(device->host.allocator, 1, sizeof **buffer);
    if (*buffer && ((*buffer)->name = lobe_copy_text(device->host.allocator, name)) &&
        engine_upload_target_create(queue, &(*buffer)->uploads))
        return true;
    free_buffer(buffer);
    return false;
}

lobe_result engine_buffer_create_for(lobe_device *device, engine_uploads *queue,
                                     const lobe_buffer_parameters *parameters,
                                     lobe_buffer **buffer) {
    const char *name = parameters->name ? parameters->name : "buffer";
    if (parameters->size == 0)
        return lobe_host_fail(&device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "buffer '%s': a size of 0", name);
    if (!allocate(device, queue, name, buffer))
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "buffer '%s': out of memory",
                              name);
    (*buffer)->device = device;
    (*buffer)->size = parameters->size;
    lobe_result result = create_buffer(*buffer);
    if (result == LOBE_OK)
        result = engine_buffer_write(*buffer, parameters->data, true);
    if (result != LOBE_OK)
        lobe_buffer_destroy(buffer);
    return result;
}

lobe_result lobe_buffer_create(lobe_device *device, const lobe_buffer_parameters *parameters,
                               lobe_buffer **buffer) {
    if (buffer)
        *buffer = NULL;
    if (!device || !parameters || !buffer)
        return lobe_host_fail(device ? &device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_buffer_create: device, parameters and buffer must not be NULL");
    return engine_buffer_create_for(device, NULL, parameters, buffer);
}

lobe_result lobe_buffer_update(lobe_buffer *buffer, const void *data) {
    if (!buffer)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (!data)
        return lobe_host_fail(&buffer->device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "buffer '%s': no data given", buffer->name);
    return engine_buffer_write(buffer, data, false);
}

void lobe_buffer_destroy(lobe_buffer **buffer) {
    if (!buffer || !*buffer)
        return;
    engine_discarded object = {.buffer = (*buffer)->buffer, .allocation = (*buffer)->allocation};
    engine_upload_target_destroy((*buffer)->device, &(*buffer)->uploads, &object);
    free_buffer(buffer);
}
