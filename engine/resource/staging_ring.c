#include "engine/resource/staging_ring.h"

#include "engine/device/device.h"

enum { MINIMUM = 64 << 10 };

static uint64_t round_up(uint64_t value, uint64_t step) {
    return (value + step - 1) / step * step;
}

static uint64_t largest(uint64_t first, uint64_t second) {
    return first > second ? first : second;
}

bool engine_staging_ring_place(engine_staging_ring *ring, VkDeviceSize size,
                               engine_staged *staged) {
    const uint64_t capacity = ring->memory.size;
    if (size > capacity)
        return false;
    uint64_t used = largest(ring->begin, ring->origin);
    if (used == ring->end)
        used = ring->origin = ring->end; // empty: from the front
    uint64_t first = ring->end - ring->origin;
    if (first % capacity + size > capacity)
        first = round_up(first, capacity);
    if (ring->origin + first + size - used > capacity)
        return false;
    ring->end = ring->origin + first + round_up(size, ENGINE_STAGING_ALIGNMENT);
    staged->buffer = ring->memory.buffer;
    staged->offset = first % capacity;
    staged->mapped = (char *)ring->memory.mapped + staged->offset;
    return true;
}

static engine_object memory_of(const engine_staging_ring *ring) {
    return (engine_object){.buffer = ring->memory.buffer, .allocation = ring->memory.allocation};
}

/// Takes the memory from the device, and room for it when it goes.
static lobe_result take(lobe_device *device, engine_discards *discards, VkDeviceSize size,
                        engine_staging *memory) {
    if (!engine_discards_reserve(device, discards))
        return LOBE_ERROR_OUT_OF_MEMORY;
    const lobe_result result =
        engine_staging_create(device, NULL, size, ENGINE_MEMORY_UPLOAD, memory);
    if (result != LOBE_OK)
        engine_discards_unreserve(discards);
    return result;
}

lobe_result engine_staging_ring_grow(lobe_device *device, engine_staging_ring *ring,
                                     VkDeviceSize size) {
    engine_staging grown;
    const engine_object former = memory_of(ring);
    const lobe_result result = take(device, &ring->discards, round_up(size, MINIMUM), &grown);
    if (result == LOBE_ERROR_OUT_OF_DEVICE_MEMORY)
        return result;
    if (result != LOBE_OK)
        return lobe_host_fail(&device->host, result, "staging ring: %s", lobe_result_name(result));
    engine_device_name(device, VK_OBJECT_TYPE_BUFFER, (uint64_t)grown.buffer, "staging ring");
    if (former.buffer)
        engine_discards_add(&ring->discards, &former, ring->end);
    engine_discards_release(device, &ring->discards, ring->begin);
    ring->memory = grown;
    ring->origin = ring->end;
    return LOBE_OK;
}

lobe_result engine_staging_ring_reserve(lobe_device *device, engine_staging_ring *ring,
                                        VkDeviceSize size, engine_staged *staged) {
    const VkDeviceSize with_end =
        size + ENGINE_STAGING_ALIGNMENT; // so that twice as much holds two frames
    lobe_result result = LOBE_OK;
    while (result == LOBE_OK && !engine_staging_ring_place(ring, size, staged))
        result = engine_staging_ring_grow(device, ring, largest(2 * ring->memory.size, with_end));
    return result;
}

void engine_staging_ring_release(lobe_device *device, engine_staging_ring *ring,
                                 uint64_t position) {
    ring->begin = largest(ring->begin, position);
    engine_discards_release(device, &ring->discards, ring->begin);
}

void engine_staging_ring_discard(lobe_device *device, engine_staging_ring *ring, uint64_t created,
                                 engine_object *object) {
    if (largest(ring->begin, created) < ring->next) {
        engine_discards_add(&ring->discards, object, ring->next);
    } else {
        engine_discards_unreserve(&ring->discards);
        engine_object_destroy(device, object);
    }
}

void engine_staging_ring_give_back(lobe_device *device, engine_staging_ring *ring) {
    engine_object former = memory_of(ring);
    if (former.buffer)
        engine_staging_ring_discard(device, ring, 0, &former);
    ring->memory = (engine_staging){0};
}

uint64_t engine_staging_ring_end_frame(lobe_device *device, engine_staging_ring *ring) {
    ring->unused = ring->end == ring->next ? ring->unused + 1 : 0;
    ring->end += ENGINE_STAGING_ALIGNMENT; // no two frames end at the same position
    ring->next = ring->end;
    if (ring->unused == ENGINE_STAGING_UNUSED_FRAMES)
        engine_staging_ring_give_back(device, ring);
    return ring->end;
}

void engine_staging_ring_free(lobe_device *device, engine_staging_ring *ring) {
    engine_discards_free(device, &ring->discards);
    engine_staging_destroy(device, &ring->memory);
    *ring = (engine_staging_ring){0};
}
