#ifndef ENGINE_RESOURCE_STAGING_RING_H
#define ENGINE_RESOURCE_STAGING_RING_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include "engine/resource/discards.h"
#include "engine/resource/resource.h"

/// Of each part: the largest texel. Each frame takes as much at its end.
#define ENGINE_STAGING_ALIGNMENT 16
/// Frames without content after which the memory goes.
#define ENGINE_STAGING_UNUSED_FRAMES 100

/// Mapped memory that content passes through on its way to the device. A frame releases its part
/// when it is done; where that leaves no room, larger memory takes the place of the former. After
/// many frames that took nothing, there is no memory again.
///
/// Positions only grow: they are also the clock by which frames, and what they use, end. All zero:
/// a ring without memory.
typedef struct engine_staging_ring {
    engine_staging memory;
    uint64_t origin;          ///< the position of the memory's first byte
    uint64_t begin, end;      ///< what the frames in flight and the next one use
    uint64_t next;            ///< where the next frame begins
    uint32_t unused;          ///< frames in a row that took nothing
    engine_discards discards; ///< former memory, and what else these frames use
} engine_staging_ring;

/// A part of the ring, for the next frame.
typedef struct engine_staged {
    VkBuffer buffer;
    VkDeviceSize offset; ///< a multiple of the size of any texel
    void *mapped;
} engine_staged;

/// Takes `size` bytes in a row for the next frame. False if the memory has no room for them.
bool engine_staging_ring_place(engine_staging_ring *ring, VkDeviceSize size, engine_staged *staged);
/// Replaces the memory by at least `size` bytes, all free. On failure the ring is as it was.
/// LOBE_ERROR_OUT_OF_DEVICE_MEMORY is not logged, because callers can do with less; others are.
lobe_result engine_staging_ring_grow(lobe_device *device, engine_staging_ring *ring,
                                     VkDeviceSize size);
/// Takes `size` bytes in a row, from larger memory if need be. Errors: as above.
lobe_result engine_staging_ring_reserve(lobe_device *device, engine_staging_ring *ring,
                                        VkDeviceSize size, engine_staged *staged);
/// Ends the next frame, which is in flight from now on; returns the position at which it ends.
uint64_t engine_staging_ring_end_frame(lobe_device *device, engine_staging_ring *ring);
/// The frames that end at `position` or before are done.
void engine_staging_ring_release(lobe_device *device, engine_staging_ring *ring, uint64_t position);
/// Destroys an object that has room among the discards, and which the next frame does not use, once
/// the frames in flight are done: those that ended after `created`, the position of the next frame
/// when it was created. Neither waits nor allocates.
void engine_staging_ring_discard(lobe_device *device, engine_staging_ring *ring, uint64_t created,
                                 engine_object *object);
/// Has no memory from now on, until somebody reserves some. The next frame must have taken nothing.
void engine_staging_ring_give_back(lobe_device *device, engine_staging_ring *ring);
/// All frames must be done.
void engine_staging_ring_free(lobe_device *device, engine_staging_ring *ring);

#endif
