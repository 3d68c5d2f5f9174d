#include "engine/resource/discards.h"

#include "engine/base/growing_array.h"
#include "engine/device/device.h"

bool engine_discards_reserve(lobe_device *device, engine_discards *discards) {
    if (!engine_array_reserve(
            device->host.allocator, (void **)&discards->items, &discards->capacity,
            (uint64_t)discards->count + discards->reserved + 1, sizeof *discards->items))
        return false;
    discards->reserved++;
    return true;
}

void engine_discards_unreserve(engine_discards *discards) {
    discards->reserved--;
}

void engine_discards_add(engine_discards *discards, const engine_object *object, uint64_t until) {
    discards->items[discards->count++] = (engine_discarded){until, *object};
    discards->reserved--;
}

void engine_discards_release(lobe_device *device, engine_discards *discards, uint64_t position) {
    uint32_t left = 0;
    for (uint32_t i = 0; i < discards->count; i++)
        if (discards->items[i].until <= position)
            engine_object_destroy(device, &discards->items[i].object);
        else
            discards->items[left++] = discards->items[i];
    discards->count = left;
}

void engine_discards_free(lobe_device *device, engine_discards *discards) {
    engine_discards_release(device, discards, UINT64_MAX);
    lobe_release(discards->items);
    *discards = (engine_discards){0};
}
