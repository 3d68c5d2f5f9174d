#ifndef ENGINE_RESOURCE_DISCARDS_H
#define ENGINE_RESOURCE_DISCARDS_H

#include <stdbool.h>
#include <stdint.h>

#include "engine/resource/shared.h"

/// An object that frames in flight may still use.
typedef struct engine_discarded {
    uint64_t until; ///< the ring position that these frames have released when they are done
    engine_object object;
} engine_discarded;

/// What is destroyed once the frames that may use it are done: nobody waits for them. All zero:
/// none.
typedef struct engine_discards {
    engine_discarded *items;
    uint32_t count, capacity;
    uint32_t reserved; ///< objects that have room here, but still live
} engine_discards;

/// Makes room for an object while it is created, so that nothing can fail when it goes. False if
/// out of memory.
bool engine_discards_reserve(lobe_device *device, engine_discards *discards);
/// Gives an object's room back: it went without.
void engine_discards_unreserve(engine_discards *discards);
/// Takes over an object that has room, until its frames have released everything up to `until`.
void engine_discards_add(engine_discards *discards, const engine_object *object, uint64_t until);
/// Destroys the objects whose frames have released everything up to `position`.
void engine_discards_release(lobe_device *device, engine_discards *discards, uint64_t position);
/// Destroys all of them: the frames are done.
void engine_discards_free(lobe_device *device, engine_discards *discards);

#endif
