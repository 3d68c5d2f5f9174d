#include "engine/resource/upload.h"

#include "engine/base/growing_array.h"
#include "engine/device/device.h"
#include "engine/resource/shared.h"

// ---------------------------------------------------------------------------------------------
// The queue

/// Bytes of content below which sharing saves next to nothing.
enum { LEAST_SHARED = 4096 };

static uint64_t number_of(const engine_uploads *queue) {
    return queue ? queue->number : 0;
}

bool engine_upload_target_create(lobe_device *device, engine_uploads *queue, uint64_t bytes,
                                 engine_upload_state *state) {
    *state = (engine_upload_state){.queue = queue, .created = queue ? queue->ring.next : 0};
    const bool shares = bytes >= LEAST_SHARED && !(queue && queue->apart);
    if (shares && !(state->shared = engine_shared_create(device, number_of(queue))))
        return false;
    if (!queue || engine_discards_reserve(device, &queue->ring.discards))
        return true;
    lobe_release(state->shared);
    return false;
}

bool engine_upload_target_adopt(lobe_device *device, engine_upload_state *state, engine_stamp stamp,
                                engine_object *object) {
    engine_shared *found =
        state->shared ? engine_shared_find(device, stamp, number_of(state->queue)) : NULL;
    if (!found)
        return false;
    (void)engine_shared_release(device, state->shared);
    state->shared = found;
    *object = found->object;
    return true;
}

void engine_upload_target_offer(lobe_device *device, engine_upload_state *state, engine_stamp stamp,
                                const engine_object *object) {
    if (!state->shared)
        return;
    state->shared->stamp = stamp;
    state->shared->object = *object;
    state->shared->object.shared = state->shared;
    if (state->bytes == 0)
        (void)engine_shared_publish(device, state->shared);
}

/// Whether the ring's memory can go, to be used for something else.
static bool can_be_flushed(const engine_uploads *queue) {
    return queue && queue->ring.memory.size > 0 && engine_uploads_may_submit(queue);
}

/// LOBE_ERROR_OUT_OF_DEVICE_MEMORY is not logged.
static lobe_result try_to_allocate(lobe_device *device, engine_memory_request request,
                                   engine_allocation *allocation) {
    const char *name = request.name;
    request.name = NULL;
    const lobe_result result = engine_memory_allocate(device->memory, &request, allocation);
    if (result == LOBE_OK || result == LOBE_ERROR_OUT_OF_DEVICE_MEMORY)
        return result;
    return lobe_host_fail(&device->host, result, "'%s': %s", name, lobe_result_name(result));
}

lobe_result engine_upload_target_allocate(lobe_device *device, engine_uploads *queue,
                                          const engine_memory_request *request,
                                          engine_allocation *allocation) {
    if (!can_be_flushed(queue))
        return engine_memory_allocate(device->memory, request, allocation);
    lobe_result result = try_to_allocate(device, *request, allocation);
    if (result != LOBE_ERROR_OUT_OF_DEVICE_MEMORY)
        return result;
    result = engine_uploads_flush(queue);
    return result == LOBE_OK ? engine_memory_allocate(device->memory, request, allocation) : result;
}

static engine_upload_state *target_of(const engine_upload *copy) {
    if (copy->texture)
        return &copy->texture->uploads;
    return copy->buffer ? &copy->buffer->uploads : NULL;
}

/// Leaves copies to nothing.
static void remove_copies(engine_uploads *queue, const engine_upload_state *state) {
    for (uint32_t i = 0; i < queue->count; i++)
        if (target_of(&queue->copies[i]) == state)
            queue->copies[i] = (engine_upload){0};
}

void engine_uploads_remove(engine_uploads *queue, engine_upload_state *state) {
    if (state->bytes > 0)
        remove_copies(queue, state);
    state->bytes = 0;
    while (queue->count > 0 && !target_of(&queue->copies[queue->count - 1]))
        queue->count--;
}

void engine_upload_target_destroy(lobe_device *device, engine_upload_state *state,
                                  engine_object *object) {
    engine_uploads *queue = state->queue;
    object->shared = state->shared;
    if (queue) {
        engine_uploads_remove(queue, state);
        engine_staging_ring_discard(device, &queue->ring, state->created, object);
    } else {
        // On failure the device is lost, and has finished too.
        (void)engine_device_wait_all(device);
        engine_object_destroy(device, object);
    }
}

void engine_uploads_redirect(engine_uploads *queue, const void *from, void *to) {
    for (uint32_t i = 0; queue && i < queue->count; i++) {
        engine_upload *copy = &queue->copies[i];
        if (copy->texture == from)
            copy->texture = to;
        else if (copy->buffer == from)
            copy->buffer = to;
    }
}

static bool reserve(engine_uploads *queue) {
    const lobe_allocator *allocator = queue->device->host.allocator;
    const uint64_t needed = (uint64_t)queue->count + 1;
    return engine_array_reserve(allocator, (void **)&queue->copies, &queue->capacity, needed,
                                sizeof *queue->copies) &&
           engine_array_reserve(allocator, (void **)&queue->barriers, &queue->barrier_capacity,
                                needed, sizeof *queue->barriers);
}

static bool is_whole(const engine_upload *copy) {
    if (copy->texture)
        return copy->part.width == copy->texture->width &&
               copy->part.height == copy->texture->height;
    return copy->size == copy->buffer->size;
}

lobe_result engine_uploads_add(engine_uploads *queue, const char *name, engine_upload_state *state,
                               const engine_upload *copy) {
    if (!reserve(queue))
        return lobe_host_fail(&queue->device->host, LOBE_ERROR_OUT_OF_MEMORY, "'%s': out of memory",
                              name);
    if (is_whole(copy))
        engine_uploads_remove(queue, state);
    state->last = queue->count;
    queue->copies[queue->count++] = *copy;
    queue->copies[state->last].again = state->bytes > 0;
    state->bytes += engine_upload_cost(copy->size);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Recording

static void record_barrier(const engine_uploads *queue, VkCommandBuffer commands,
                           const VkMemoryBarrier2 *memory, uint32_t image_count) {
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = 1,
        .pMemoryBarriers = memory,
        .imageMemoryBarrierCount = image_count,
        .pImageMemoryBarriers = queue->barriers,
    };
    queue->device->api.vkCmdPipelineBarrier2(commands, &dependency);
}

/// Between everything else and the copies, or between these and everything else: also for images,
/// which change their layout.
static void record_barriers(engine_uploads *queue, VkCommandBuffer commands,
                            const VkMemoryBarrier2 *memory, bool before) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < queue->count; i++) {
        const lobe_texture *texture = queue->copies[i].texture;
        if (!texture || queue->copies[i].again)
            continue;
        VkImageLayout outside = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        if (before && !texture->filled)
            outside = VK_IMAGE_LAYOUT_UNDEFINED;
        queue->barriers[count++] = (VkImageMemoryBarrier2){
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = memory->srcStageMask,
            .srcAccessMask = memory->srcAccessMask,
            .dstStageMask = memory->dstStageMask,
            .dstAccessMask = memory->dstAccessMask,
            .oldLayout = before ? outside : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            .newLayout = before ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : outside,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = texture->image,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
        };
    }
    record_barrier(queue, commands, memory, count);
}

static void record_texture(const lobe_device *device, VkCommandBuffer commands,
                           const engine_upload *copy) {
    const VkBufferImageCopy region = {
        .bufferOffset = copy->from.offset,
        .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        .imageOffset = {(int32_t)copy->part.x, (int32_t)copy->part.y, 0},
        .imageExtent = {copy->part.width, copy->part.height, 1},
    };
    device->api.vkCmdCopyBufferToImage(commands, copy->from.buffer, copy->texture->image,
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

static void record_buffer(const lobe_device *device, VkCommandBuffer commands,
                          const engine_upload *copy) {
    const VkBufferCopy region = {
        .srcOffset = copy->from.offset, .dstOffset = copy->first, .size = copy->size};
    if (copy->from.buffer)
        device->api.vkCmdCopyBuffer(commands, copy->from.buffer, copy->buffer->buffer, 1, &region);
    else
        device->api.vkCmdFillBuffer(commands, copy->buffer->buffer, 0, VK_WHOLE_SIZE, 0);
}

void engine_uploads_record(engine_uploads *queue, VkCommandBuffer commands) {
    VkMemoryBarrier2 before = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_TRANSFER_BIT,
        .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
    };
    VkMemoryBarrier2 after = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_TRANSFER_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
    };
    if (queue->count == 0)
        return;
    engine_device_begin_label(queue->device, commands, "uploads");
    record_barriers(queue, commands, &before, true);
    for (uint32_t i = 0; i < queue->count; i++) {
        const engine_upload *copy = &queue->copies[i];
        if (copy->again)
            record_barrier(queue, commands, &before, 0);
        if (copy->texture)
            record_texture(queue->device, commands, copy);
        else if (copy->buffer)
            record_buffer(queue->device, commands, copy);
    }
    record_barriers(queue, commands, &after, false);
    engine_device_end_label(queue->device, commands);
}

uint64_t engine_uploads_commit(engine_uploads *queue, bool by_host) {
    for (uint32_t i = 0; i < queue->count; i++) {
        engine_upload_state *state = target_of(&queue->copies[i]);
        if (state)
            state->bytes = 0;
        // What the host submits may come after what others submit.
        if (state && !by_host)
            (void)engine_shared_publish(queue->device, state->shared);
        if (queue->copies[i].texture)
            queue->copies[i].texture->filled = true;
    }
    queue->count = 0;
    const uint64_t end = engine_staging_ring_end_frame(queue->device, &queue->ring);
    if (by_host)
        queue->unsent = end;
    return end;
}

void engine_uploads_release(engine_uploads *queue, uint64_t position) {
    engine_staging_ring_release(queue->device, &queue->ring, position);
}

// ---------------------------------------------------------------------------------------------
// Without a frame

bool engine_uploads_may_submit(const engine_uploads *queue) {
    return queue->unsent <= queue->ring.begin;
}

/// Waits for the last submission, and so for everything before it.
static lobe_result wait_for_own(engine_uploads *queue) {
    if (!queue->own)
        return LOBE_OK;
    const lobe_result result =
        engine_device_finish_commands(queue->device, queue->own, queue->own_value);
    queue->own = VK_NULL_HANDLE;
    engine_uploads_release(queue, queue->own_end);
    return result;
}

lobe_result engine_uploads_submit(engine_uploads *queue) {
    VkCommandBuffer commands;
    lobe_result result = wait_for_own(queue);
    if (result == LOBE_OK)
        result = engine_device_begin_commands(queue->device, "uploads", &commands);
    if (result != LOBE_OK)
        return result;
    engine_uploads_record(queue, commands);
    result = engine_device_submit_commands(queue->device, "uploads", commands, &queue->own_value);
    if (result != LOBE_OK)
        return result;
    queue->own = commands;
    queue->own_end = engine_uploads_commit(queue, false);
    return LOBE_OK;
}

lobe_result engine_uploads_finish(engine_uploads *queue) {
    lobe_result result = wait_for_own(queue);
    const bool busy = queue->count > 0 || queue->ring.begin < queue->ring.next;
    if (result == LOBE_OK && busy)
        result = engine_uploads_submit(queue);
    return result == LOBE_OK ? wait_for_own(queue) : result;
}

lobe_result engine_uploads_flush(engine_uploads *queue) {
    const lobe_result result = engine_uploads_finish(queue);
    if (result == LOBE_OK)
        engine_staging_ring_give_back(queue->device, &queue->ring);
    return result;
}

lobe_result engine_uploads_begin_frame(engine_uploads *queue) {
    queue->unsent = 0;
    const lobe_result result = queue->started ? LOBE_OK : engine_uploads_flush(queue);
    queue->started |= result == LOBE_OK;
    return result;
}

void engine_uploads_free(engine_uploads *queue) {
    (void)wait_for_own(queue);
    engine_staging_ring_free(queue->device, &queue->ring);
    lobe_release(queue->copies);
    lobe_release(queue->barriers);
    *queue = (engine_uploads){.device = queue->device, .number = queue->number};
}
