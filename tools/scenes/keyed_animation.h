#ifndef TOOLS_SCENES_KEYED_ANIMATION_H
#define TOOLS_SCENES_KEYED_ANIMATION_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/allocator.h>
#include <lobe/animation.h>

typedef struct keyed_channel {
    lobe_channel_path path;
    size_t width; ///< values of a key
} keyed_channel;

/// Gives a rig its only animation: linear channels of the first node, each with `keys` keys at
/// equal intervals from 0 to `period` seconds. Their values are the caller's to fill; the rig owns
/// everything. False: out of memory.
bool keyed_animation_add(lobe_rig *rig, const char *name, double period, size_t keys,
                         const keyed_channel *channels, size_t channel_count,
                         const lobe_allocator *allocator);

#endif
