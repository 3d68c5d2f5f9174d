#ifndef ENGINE_RESOURCE_CONTENT_H
#define ENGINE_RESOURCE_CONTENT_H

#include <stdbool.h>

#include <lobe/device.h>

#include "engine/resource/staging_ring.h"

/// How content gets to an object. That of a graph's object joins the copies of the graph's next
/// frame: nothing is submitted, nobody waits. It goes in steps, submitted without a frame:
/// - before the first frame, which there is nothing to hold up; many objects share a submission;
/// - where the object belongs to no graph;
/// - where it is new and much, so that staging does not grow with it;
/// - where memory is too short for all of it at once.
/// The last content given counts, whichever way it went.

/// Bytes of content submitted at a time where it goes in steps.
#define ENGINE_CONTENT_STEP ((VkDeviceSize)4 << 20)
/// Bytes of memory for two steps: one is filled while the other is under way.
#define ENGINE_CONTENT_MEMORY (2 * (ENGINE_CONTENT_STEP + ENGINE_STAGING_ALIGNMENT))
/// Maximum number of bytes of new objects that join one frame.
#define ENGINE_CONTENT_OF_FRAME ((VkDeviceSize)16 << 20)

/// Writes a part of an image, whose format and extent are the texture's. `fresh`: the texture is
/// being created. On failure the texture keeps what it has and will have, unless the device failed
/// between two steps. LOBE_ERROR_OUT_OF_DEVICE_MEMORY: there is no memory even for one row, or the
/// host must submit a frame first.
lobe_result engine_texture_write(lobe_texture *texture, const lobe_image *image,
                                 const lobe_rectangle *part, bool fresh);
/// The same for all of a buffer. `data`: NULL: zeroes.
lobe_result engine_buffer_write(lobe_buffer *buffer, const void *data, bool fresh);

#endif
