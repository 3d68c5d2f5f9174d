#include "engine/resource/resource.h"

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/content.h"
#include "engine/resource/shared.h"
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

static bool allocate(lobe_device *device, engine_uploads *queue, const char *name, size_t size,
                     lobe_buffer **buffer) {
    *buffer = lobe_allocate(device->host.allocator, 1, sizeof **buffer);
    if (*buffer && ((*buffer)->name = lobe_copy_text(device->host.allocator, name)) &&
        engine_upload_target_create(device, queue, size, &(*buffer)->uploads))
        return true;
    free_buffer(buffer);
    return false;
}

static engine_object object_of(const lobe_buffer *buffer) {
    return (engine_object){.buffer = buffer->buffer, .allocation = buffer->allocation};
}

/// Takes the buffer of another graph that has the same content.
static bool adopt(lobe_buffer *buffer) {
    engine_object object;
    if (!engine_upload_target_adopt(buffer->device, &buffer->uploads, buffer->stamp, &object))
        return false;
    buffer->buffer = object.buffer;
    buffer->allocation = object.allocation;
    return true;
}

static lobe_result make(lobe_buffer *buffer, const void *data) {
    lobe_result result = create_buffer(buffer);
    if (result == LOBE_OK)
        result = engine_buffer_write(buffer, data, true);
    const engine_object object = object_of(buffer);
    if (result == LOBE_OK)
        engine_upload_target_offer(buffer->device, &buffer->uploads, buffer->stamp, &object);
    return result;
}

/// Without data, a buffer is told from all others.
static engine_stamp stamp_of(lobe_device *device, const lobe_buffer_parameters *parameters) {
    const engine_stamp stamp = engine_stamp_text(ENGINE_STAMP_NONE, "buffer");
    return parameters->data ? engine_stamp_bytes(stamp, parameters->data, parameters->size)
                            : engine_device_stamp(device);
}

lobe_result engine_buffer_create_for(lobe_device *device, engine_uploads *queue,
                                     const lobe_buffer_parameters *parameters,
                                     lobe_buffer **buffer) {
    const char *name = parameters->name ? parameters->name : "buffer";
    if (parameters->size == 0)
        return lobe_host_fail(&device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "buffer '%s': a size of 0", name);
    if (!allocate(device, queue, name, parameters->size, buffer))
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "buffer '%s': out of memory",
                              name);
    (*buffer)->device = device;
    (*buffer)->size = parameters->size;
    (*buffer)->stamp = stamp_of(device, parameters);
    const lobe_result result = adopt(*buffer) ? LOBE_OK : make(*buffer, parameters->data);
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

/// Others keep the present buffer.
static lobe_result replace(lobe_buffer *buffer, const void *data) {
    const lobe_buffer former = *buffer;
    const lobe_buffer_parameters parameters = {
        .name = buffer->name, .size = buffer->size, .data = data};
    lobe_buffer *made;
    const lobe_result result =
        engine_buffer_create_for(buffer->device, buffer->uploads.queue, &parameters, &made);
    if (result != LOBE_OK)
        return result;
    engine_uploads_redirect(buffer->uploads.queue, made, buffer);
    *buffer = *made;
    *made = former;
    lobe_buffer_destroy(&made);
    return LOBE_OK;
}

lobe_result lobe_buffer_update(lobe_buffer *buffer, const void *data) {
    if (!buffer)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (!data)
        return lobe_host_fail(&buffer->device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "buffer '%s': no data given", buffer->name);
    return engine_shared_claim(buffer->device, buffer->uploads.shared)
               ? engine_buffer_write(buffer, data, false)
               : replace(buffer, data);
}

void lobe_buffer_destroy(lobe_buffer **buffer) {
    if (!buffer || !*buffer)
        return;
    engine_object object = object_of(*buffer);
    engine_upload_target_destroy((*buffer)->device, &(*buffer)->uploads, &object);
    free_buffer(buffer);
}
