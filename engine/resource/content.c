#include "engine/resource/content.h"

#include <string.h>

#include "engine/device/device.h"
#include "engine/resource/upload.h"

static uint64_t minimum(uint64_t first, uint64_t second) {
    return first < second ? first : second;
}

static uint64_t maximum(uint64_t first, uint64_t second) {
    return first > second ? first : second;
}

// ---------------------------------------------------------------------------------------------
// Rows

/// Rows of texels for a texture, or bytes for a buffer.
typedef struct engine_content {
    lobe_device *device;
    const char *name;
    engine_upload_state *state;
    lobe_texture *texture;
    const lobe_image *image;
    lobe_rectangle part;
    lobe_buffer *buffer;
    const char *data; ///< NULL: zeroes
    VkDeviceSize row_size;
    uint64_t row_count;
} engine_content;

static engine_content texture_content(lobe_texture *texture, const lobe_image *image,
                                      const lobe_rectangle *part) {
    return (engine_content){
        .device = texture->device,
        .name = texture->name,
        .state = &texture->uploads,
        .texture = texture,
        .image = image,
        .part = *part,
        .row_size = (VkDeviceSize)part->width * lobe_format_size(texture->format),
        .row_count = part->height,
    };
}

static VkDeviceSize size_of(const engine_content *content) {
    return content->row_count * content->row_size;
}

static bool are_zeroes(const engine_content *content) {
    return content->buffer && !content->data;
}

/// The copy of some rows, without the memory that it is from.
static engine_upload rows_of(const engine_content *content, uint64_t first, uint64_t count) {
    const lobe_rectangle *part = &content->part;
    return (engine_upload){
        .texture = content->texture,
        .part = {part->x, part->y + (uint32_t)first, part->width, (uint32_t)count},
        .buffer = content->buffer,
        .first = first,
        .size = count * content->row_size,
    };
}

static bool contains(const engine_upload *copy, const engine_upload *rows) {
    const lobe_rectangle *outer = &copy->part, *inner = &rows->part;
    if (copy->buffer)
        return copy->from.mapped && rows->first >= copy->first &&
               rows->first + rows->size <= copy->first + copy->size;
    return inner->x >= outer->x && inner->y >= outer->y &&
           inner->x + inner->width <= outer->x + outer->width &&
           inner->y + inner->height <= outer->y + outer->height;
}

static void copy_texels(const engine_upload *copy, const lobe_image *image,
                        const lobe_rectangle *part) {
    const size_t texel = lobe_format_size(image->format);
    const size_t left = part->x - copy->part.x, top = part->y - copy->part.y;
    for (size_t y = 0; y < part->height; y++)
        memcpy((char *)copy->from.mapped + ((top + y) * copy->part.width + left) * texel,
               (const char *)image->texels + ((part->y + y) * image->width + part->x) * texel,
               part->width * texel);
}

/// Puts rows into the memory of a copy that contains them.
static void write_rows(const engine_content *content, const engine_upload *copy,
                       const engine_upload *rows) {
    if (content->texture)
        copy_texels(copy, content->image, &rows->part);
    else
        memcpy((char *)copy->from.mapped + (rows->first - copy->first), content->data + rows->first,
               rows->size);
}

/// Adds a copy of rows from where they have memory now.
static lobe_result add_rows(engine_uploads *queue, const engine_content *content,
                            const engine_upload *rows) {
    const lobe_result result = engine_uploads_add(queue, content->name, content->state, rows);
    if (result == LOBE_OK && !are_zeroes(content))
        write_rows(content, rows, rows);
    return result;
}

// ---------------------------------------------------------------------------------------------
// With the next frame

/// The copy that will be made last, if it contains all of the content; otherwise NULL.
static const engine_upload *find_waiting(const engine_uploads *queue,
                                         const engine_content *content) {
    const engine_upload all = rows_of(content, 0, content->row_count);
    if (content->state->bytes == 0)
        return NULL;
    const engine_upload *last = &queue->copies[content->state->last];
    return contains(last, &all) ? last : NULL;
}

/// Many parts become one: whatever their size, they never need much more memory than twice the
/// texture.
static void widen(engine_content *content) {
    const lobe_texture *texture = content->texture;
    const uint64_t waiting = content->state->bytes;
    if (!texture || waiting == 0)
        return;
    const lobe_rectangle all = {0, 0, texture->width, texture->height};
    const engine_content whole = texture_content(content->texture, content->image, &all);
    if (waiting + engine_upload_cost(size_of(content)) > size_of(&whole))
        *content = whole;
}

/// Whether frames have memory left if the ring grows to two frames of this size.
static bool is_affordable(const lobe_device *device, VkDeviceSize size) {
    lobe_device_memory memory;
    if (size <= ENGINE_CONTENT_MEMORY)
        return true;
    lobe_device_memory_query(device, &memory);
    return 4 * size <= memory.budget_bytes - memory.allocated_bytes;
}

/// LOBE_ERROR_OUT_OF_DEVICE_MEMORY is not logged: there are other ways.
static lobe_result join(engine_uploads *queue, const engine_content *content) {
    engine_upload all = rows_of(content, 0, content->row_count);
    lobe_result result = LOBE_OK;
    if (!are_zeroes(content) && !engine_staging_ring_place(&queue->ring, all.size, &all.from))
        result = is_affordable(queue->device, all.size)
                     ? engine_staging_ring_reserve(queue->device, &queue->ring, all.size, &all.from)
                     : LOBE_ERROR_OUT_OF_DEVICE_MEMORY;
    return result == LOBE_OK ? add_rows(queue, content, &all) : result;
}

// ---------------------------------------------------------------------------------------------
// In steps

/// Half as much, but at least one row; 0: there is nothing smaller.
static VkDeviceSize smaller(const engine_content *content, VkDeviceSize size) {
    return size > content->row_size ? maximum(size / 2, content->row_size) : 0;
}

/// Has the ring hold `wanted` bytes, or as much as there is, but at least one row.
static lobe_result take_memory(engine_uploads *queue, const engine_content *content,
                               VkDeviceSize wanted) {
    lobe_result result = LOBE_ERROR_OUT_OF_DEVICE_MEMORY;
    for (VkDeviceSize size = maximum(wanted, content->row_size);
         result == LOBE_ERROR_OUT_OF_DEVICE_MEMORY && size > 0; size = smaller(content, size))
        result = size <= queue->ring.memory.size
                     ? LOBE_OK
                     : engine_staging_ring_grow(queue->device, &queue->ring, size);
    if (result != LOBE_ERROR_OUT_OF_DEVICE_MEMORY)
        return result;
    return lobe_host_fail(&queue->device->host, result,
                          "'%s': no device memory is left that its content could pass through",
                          content->name);
}

static lobe_result make_room(engine_uploads *queue, engine_upload *rows) {
    if (engine_staging_ring_place(&queue->ring, rows->size, &rows->from))
        return LOBE_OK;
    const lobe_result result = engine_uploads_finish(queue);
    if (result == LOBE_OK)
        (void)engine_staging_ring_place(&queue->ring, rows->size, &rows->from);
    return result;
}

/// How many rows the next submission has room for, if it takes any; 0: it is full.
static uint64_t count_fitting(const engine_uploads *queue, const engine_content *content) {
    const uint64_t half = queue->ring.memory.size / 2 - ENGINE_STAGING_ALIGNMENT;
    const uint64_t step = minimum(ENGINE_CONTENT_STEP, half);
    const uint64_t taken = queue->ring.end - queue->ring.next;
    const uint64_t count = taken < step ? (step - taken) / content->row_size : 0;
    return taken > 0 ? count : maximum(count, 1);
}

static lobe_result add_step(engine_uploads *queue, const engine_content *content,
                            engine_upload *rows) {
    const lobe_result result = make_room(queue, rows);
    return result == LOBE_OK ? add_rows(queue, content, rows) : result;
}

static lobe_result add_steps(engine_uploads *queue, const engine_content *content) {
    lobe_result result = LOBE_OK;
    for (uint64_t done = 0, count; result == LOBE_OK && done < content->row_count; done += count) {
        count = minimum(count_fitting(queue, content), content->row_count - done);
        engine_upload rows = rows_of(content, done, count);
        result = count > 0 ? add_step(queue, content, &rows) : engine_uploads_submit(queue);
    }
    return result;
}

/// The last of the steps, and zeroes, are left for the next submission.
static lobe_result add_in_steps(engine_uploads *queue, const engine_content *content,
                                VkDeviceSize memory) {
    if (are_zeroes(content)) {
        const engine_upload all = rows_of(content, 0, content->row_count);
        return add_rows(queue, content, &all);
    }
    const lobe_result result = take_memory(queue, content, memory);
    return result == LOBE_OK ? add_steps(queue, content) : result;
}

/// From memory that goes again.
static lobe_result write_at_once(const engine_content *content) {
    engine_uploads queue = {.device = content->device};
    lobe_result result =
        add_in_steps(&queue, content, minimum(size_of(content), ENGINE_CONTENT_MEMORY));
    if (result == LOBE_OK)
        result = engine_uploads_finish(&queue);
    engine_uploads_remove(&queue, content->state);
    engine_uploads_free(&queue);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Which way

static lobe_result fail_until_submitted(const engine_content *content) {
    return lobe_host_fail(&content->device->host, LOBE_ERROR_OUT_OF_DEVICE_MEMORY,
                          "'%s': too little device memory for a copy of its content, which cannot "
                          "go in steps before the host has submitted the last frame",
                          content->name);
}

/// What waits for the next frame goes first, and its memory with it.
static lobe_result write_with_less(engine_uploads *queue, const engine_content *content,
                                   bool fresh) {
    lobe_result result = LOBE_OK;
    if (engine_uploads_may_submit(queue))
        result = engine_uploads_flush(queue);
    else if (!fresh)
        result = fail_until_submitted(content);
    return result == LOBE_OK ? write_at_once(content) : result;
}

static lobe_result add(engine_uploads *queue, const engine_content *content, bool fresh) {
    const uint64_t taken = queue->ring.end - queue->ring.next;
    if (!queue->started)
        return add_in_steps(queue, content, ENGINE_CONTENT_MEMORY);
    if (fresh && taken + size_of(content) > ENGINE_CONTENT_OF_FRAME)
        return write_at_once(content);
    const lobe_result result = join(queue, content);
    return result == LOBE_ERROR_OUT_OF_DEVICE_MEMORY ? write_with_less(queue, content, fresh)
                                                     : result;
}

static lobe_result write_content(engine_content *content, bool fresh) {
    engine_uploads *queue = content->state->queue;
    if (!queue)
        return write_at_once(content);
    const engine_upload *waiting = find_waiting(queue, content);
    const engine_upload all = rows_of(content, 0, content->row_count);
    if (waiting) {
        write_rows(content, waiting, &all);
        return LOBE_OK;
    }
    widen(content);
    return add(queue, content, fresh);
}

lobe_result engine_texture_write(lobe_texture *texture, const lobe_image *image,
                                 const lobe_rectangle *part, bool fresh) {
    engine_content content = texture_content(texture, image, part);
    if (!fresh)
        texture->stamp = engine_device_stamp(texture->device);
    return write_content(&content, fresh);
}

lobe_result engine_buffer_write(lobe_buffer *buffer, const void *data, bool fresh) {
    engine_content content = {
        .device = buffer->device,
        .name = buffer->name,
        .state = &buffer->uploads,
        .buffer = buffer,
        .data = data,
        .row_size = 1,
        .row_count = buffer->size,
    };
    if (!fresh)
        buffer->stamp = engine_device_stamp(buffer->device);
    return write_content(&content, fresh);
}
