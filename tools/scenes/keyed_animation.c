#include "tools/scenes/keyed_animation.h"

#include <lobe/allocator.h>

static bool allocate_channel(lobe_animation_channel *channel, const keyed_channel *wanted,
                             size_t keys, const lobe_allocator *allocator) {
    *channel = (lobe_animation_channel){
        .path = wanted->path,
        .interpolation = LOBE_INTERPOLATION_LINEAR,
        .times = lobe_allocate(allocator, keys, sizeof *channel->times),
        .key_count = keys,
        .width = wanted->width,
        .values = lobe_allocate(allocator, keys * wanted->width, sizeof *channel->values),
    };
    return channel->times && channel->values;
}

bool keyed_animation_add(lobe_rig *rig, const char *name, double period, size_t keys,
                         const keyed_channel *channels, size_t channel_count,
                         const lobe_allocator *allocator) {
    lobe_animation *animation = rig->animations =
        lobe_allocate(allocator, 1, sizeof *rig->animations);
    if (!animation)
        return false;
    rig->animation_count = 1;
    animation->name = lobe_copy_text(allocator, name);
    animation->channels = lobe_allocate(allocator, channel_count, sizeof *animation->channels);
    animation->duration = period;
    if (!animation->name || !animation->channels)
        return false;
    animation->channel_count = channel_count;
    for (size_t i = 0; i < channel_count; i++) {
        if (!allocate_channel(&animation->channels[i], &channels[i], keys, allocator))
            return false;
        for (size_t k = 0; k < keys; k++)
            animation->channels[i].times[k] = (float)(period * (double)k / (double)(keys - 1));
    }
    return true;
}
