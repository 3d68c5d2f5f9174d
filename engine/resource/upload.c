#include "engine/resource/upload.h"

#include <string.h>

#include "engine/base/growing_array.h"
#include "engine/device/device.h"

static uint64_t minimum(uint64_t first, uint64_t second) {
    return first < second ? first : second;
}

// ---------------------------------------------------------------------------------------------
// The queue

bool engine_upload_target_create(engine_uploads *queue, engine_upload_state *state) {
    *state = (engine_upload_state){.queue = queue, .created = queue ? queue->ring.next : 0};
    return !queue || engine_discards_reserve(queue->device, &queue->ring.discards);
}

static lobe_result out_of_memory(const engine_uploads *queue, const char *name) {
    return lobe_host_fail(&queue->device->host, LOBE_ERROR_OUT_OF_MEMORY, "'%s': out of memory",
                          name);
}

static bool reserve(engine_uploads *queue) {
    const lobe_allocator *allocator = queue->device->host.allocator;
    const uint64_t needed = (uint64_t)queue->count + 1;
    return engine_array_reserve(allocator, (void **)&queue->copies, &queue->capacity, needed,
                                sizeof *queue->copies) &&
           engine_array_reserve(allocator, (void **)&queue->barriers, &queue->barrier_capacity,
                                needed, sizeof *queue->barriers);
}

/// Of a copy, in bytes of host memory: its content, and what describes it.
static uint64_t cost_of(VkDeviceSize size) {
    return size + sizeof(engine_upload) + sizeof(VkImageMemoryBarrier2);
}

/// Adds a copy, whose content the caller writes; `copy->from` if it is not of zeroes.
static lobe_result add(engine_uploads *queue, const char *name, engine_upload_state *state,
                       engine_upload *copy, bool zeroes) {
    if (!reserve(queue))
        return out_of_memory(queue, name);
    const lobe_result result =
        zeroes ? LOBE_OK
               : engine_staging_ring_reserve(queue->device, &queue->ring, copy->size, &copy->from);
    if (result != LOBE_OK)
        return result;
    copy->again = state->bytes > 0;
    state->bytes += cost_of(copy->size);
    state->last = queue->count;
    queue->copies[queue->count++] = *copy;
    return LOBE_OK;
}

static engine_upload_state *target_of(const engine_upload *copy) {
    if (copy->texture)
        return &copy->texture->uploads;
    return copy->buffer ? &copy->buffer->uploads : NULL;
}

/// Removes the copies to an object, except those from the copy `end` on.
static void remove_before(engine_uploads *queue, engine_upload_state *state, uint32_t end) {
    for (uint32_t i = 0; i < end; i++) {
        engine_upload *copy = &queue->copies[i];
        if (target_of(copy) != state)
            continue;
        state->bytes -= cost_of(copy->size);
        copy->texture = NULL;
        copy->buffer = NULL;
    }
}

/// Removes all copies to an object that will be gone, and shortens the queue where it can.
static void remove_all(engine_uploads *queue, engine_upload_state *state) {
    if (state->bytes > 0)
        remove_before(queue, state, queue->count);
    while (queue->count > 0 && !target_of(&queue->copies[queue->count - 1]))
        queue->count--;
}

void engine_upload_target_destroy(lobe_device *device, engine_upload_state *state,
                                  engine_discarded *object) {
    engine_uploads *queue = state->queue;
    if (queue) {
        remove_all(queue, state);
        engine_staging_ring_discard(device, &queue->ring, state->created, object);
    } else {
        // On failure the device is lost, and has finished too.
        (void)engine_device_wait_all(device);
        engine_discarded_destroy(device, object);
    }
}

bool engine_uploads_take(const engine_uploads *queue, uint64_t size) {
    return queue && queue->ring.end > 0 &&
           queue->ring.end - queue->ring.next + size <= ENGINE_UPLOAD_STEP;
}

// ---------------------------------------------------------------------------------------------
// Textures

static uint64_t bytes_of(const lobe_texture *texture, const lobe_rectangle *part) {
    return (uint64_t)part->width * part->height * lobe_format_size(texture->format);
}

static bool contains(const lobe_rectangle *outer, const lobe_rectangle *inner) {
    return inner->x >= outer->x && inner->y >= outer->y &&
           inner->x + inner->width <= outer->x + outer->width &&
           inner->y + inner->height <= outer->y + outer->height;
}

static void copy_rows(const engine_upload *copy, const lobe_image *image,
                      const lobe_rectangle *part) {
    const size_t texel = lobe_format_size(image->format);
    const size_t left = part->x - copy->part.x, top = part->y - copy->part.y;
    for (size_t y = 0; y < part->height; y++)
        memcpy((char *)copy->from.mapped + ((top + y) * copy->part.width + left) * texel,
               (const char *)image->texels + ((part->y + y) * image->width + part->x) * texel,
               part->width * texel);
}

lobe_result engine_uploads_add_texture(engine_uploads *queue, lobe_texture *texture,
                                       const lobe_image *image, const lobe_rectangle *part) {
    engine_upload_state *state = &texture->uploads;
    const lobe_rectangle whole = {0, 0, texture->width, texture->height};
    if (state->bytes > 0 && contains(&queue->copies[state->last].part, part)) {
        copy_rows(&queue->copies[state->last], image, part);
        return LOBE_OK;
    }
    // Many parts become one: whatever their size, they never need much more memory than twice the
    // texture.
    const bool all = state->bytes > 0 &&
                     state->bytes + cost_of(bytes_of(texture, part)) > bytes_of(texture, &whole);
    engine_upload copy = {.texture = texture, .part = all ? whole : *part};
    copy.size = bytes_of(texture, &copy.part);
    const lobe_result result = add(queue, texture->name, state, &copy, false);
    if (result != LOBE_OK)
        return result;
    if (all)
        remove_before(queue, state, state->last);
    queue->copies[state->last].again &= !all;
    copy_rows(&copy, image, &copy.part);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Buffers

lobe_result engine_uploads_add_buffer(engine_uploads *queue, lobe_buffer *buffer,
                                      VkDeviceSize first, VkDeviceSize size, const void *data) {
    engine_upload_state *state = &buffer->uploads;
    engine_upload copy = {.buffer = buffer, .first = first, .size = size};
    lobe_result result = LOBE_OK;
    if (state->bytes > 0 && queue->copies[state->last].from.mapped)
        copy = queue->copies[state->last];
    else
        result = add(queue, buffer->name, state, &copy, !data);
    if (result == LOBE_OK && data)
        memcpy(copy.from.mapped, data, size);
    return result;
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

uint64_t engine_uploads_commit(engine_uploads *queue) {
    for (uint32_t i = 0; i < queue->count; i++) {
        engine_upload_state *state = target_of(&queue->copies[i]);
        if (state)
            state->bytes = 0;
        if (queue->copies[i].texture)
            queue->copies[i].texture->filled = true;
    }
    queue->count = 0;
    return engine_staging_ring_end_frame(queue->device, &queue->ring);
}

void engine_uploads_release(engine_uploads *queue, uint64_t position) {
    engine_staging_ring_release(queue->device, &queue->ring, position);
}

void engine_uploads_free(engine_uploads *queue) {
    engine_staging_ring_free(queue->device, &queue->ring);
    lobe_release(queue->copies);
    lobe_release(queue->barriers);
    *queue = (engine_uploads){.device = queue->device};
}

// ---------------------------------------------------------------------------------------------
// At once

static lobe_result submit(engine_uploads *queue, const char *name) {
    VkCommandBuffer commands;
    lobe_result result = engine_device_begin_commands(queue->device, name, &commands);
    if (result != LOBE_OK)
        return result;
    engine_uploads_record(queue, commands);
    result = engine_device_finish_commands(queue->device, name, commands);
    if (result == LOBE_OK)
        engine_uploads_release(queue, engine_uploads_commit(queue));
    return result;
}

/// Empties the queue, whether its copies were made or not.
static void close_queue(engine_uploads *queue, engine_upload_state *state) {
    remove_before(queue, state, queue->count);
    engine_uploads_free(queue);
}

lobe_result engine_upload_texture_now(lobe_texture *texture, const lobe_image *image,
                                      const lobe_rectangle *part) {
    engine_uploads queue = {.device = texture->device};
    const lobe_rectangle row = {part->x, part->y, part->width, 1};
    const uint64_t fitting = ENGINE_UPLOAD_STEP / bytes_of(texture, &row);
    const uint32_t rows = (uint32_t)minimum(fitting > 0 ? fitting : 1, part->height);
    lobe_result result = LOBE_OK;
    for (uint32_t done = 0; result == LOBE_OK && done < part->height; done += rows) {
        const lobe_rectangle step = {part->x, part->y + done, part->width,
                                     (uint32_t)minimum(rows, part->height - done)};
        result = engine_uploads_add_texture(&queue, texture, image, &step);
        if (result == LOBE_OK)
            result = submit(&queue, texture->name);
    }
    close_queue(&queue, &texture->uploads);
    return result;
}

lobe_result engine_upload_buffer_now(lobe_buffer *buffer, const void *data) {
    engine_uploads queue = {.device = buffer->device};
    const VkDeviceSize most = data ? ENGINE_UPLOAD_STEP : buffer->size;
    lobe_result result = LOBE_OK;
    for (VkDeviceSize done = 0; result == LOBE_OK && done < buffer->size; done += most) {
        result = engine_uploads_add_buffer(&queue, buffer, done, minimum(most, buffer->size - done),
                                           data ? (const char *)data + done : NULL);
        if (result == LOBE_OK)
            result = submit(&queue, buffer->name);
    }
    close_queue(&queue, &buffer->uploads);
    return result;
}
