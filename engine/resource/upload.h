#ifndef ENGINE_RESOURCE_UPLOAD_H
#define ENGINE_RESOURCE_UPLOAD_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

#include "engine/resource/resource.h"
#include "engine/resource/staging_ring.h"

/// Maximum number of bytes of mapped memory that content of a new object, or of one without a
/// graph, uses at a time. Larger content takes several steps, so that a large texture does not need
/// twice its size.
#define ENGINE_UPLOAD_STEP ((VkDeviceSize)16 << 20)

/// A copy to a texture or a buffer; to neither: the object is gone.
typedef struct engine_upload {
    lobe_texture *texture;
    lobe_rectangle part; ///< of the texture
    lobe_buffer *buffer;
    VkDeviceSize first; ///< byte of the buffer
    VkDeviceSize size;  ///< bytes
    engine_staged from; ///< without a buffer: zeroes
    bool again;         ///< an earlier copy in the queue is to the same object
} engine_upload;

/// Copies that the next frame of a graph, or the next submission, makes before anything else. The
/// content is in the ring already; the caller's memory is not needed. All zero but the device:
/// none.
typedef struct engine_uploads {
    lobe_device *device;
    engine_staging_ring ring;
    engine_upload *copies;
    VkImageMemoryBarrier2 *barriers; ///< room for recording
    uint32_t count, capacity, barrier_capacity;
} engine_uploads;

/// Prepares a new object, of the graph with this queue (NULL: of none), for
/// engine_upload_target_destroy. False if out of memory.
bool engine_upload_target_create(engine_uploads *queue, engine_upload_state *state);

/// Whether content of a new object joins the queue: not before the first frame, when there is
/// nothing yet that waiting could hold up, and not where that would make the ring large.
bool engine_uploads_take(const engine_uploads *queue, uint64_t size);
/// Adds a part of an image to the queue; in place of what that part has there already. The format
/// and extents must be the texture's. On failure the texture keeps what it has and will have.
lobe_result engine_uploads_add_texture(engine_uploads *queue, lobe_texture *texture,
                                       const lobe_image *image, const lobe_rectangle *part);
/// The same for a range of a buffer: all of it, if the buffer has something in the queue already.
/// `data`: `size` bytes; NULL: zeroes.
lobe_result engine_uploads_add_buffer(engine_uploads *queue, lobe_buffer *buffer,
                                      VkDeviceSize first, VkDeviceSize size, const void *data);
/// Removes the copies to an object, and destroys it when the frames that may use it are done: at
/// once if there are none. Waits for them if it belongs to no graph.
void engine_upload_target_destroy(lobe_device *device, engine_upload_state *state,
                                  engine_discarded *object);

/// Records the copies, after everything before and before everything after.
void engine_uploads_record(engine_uploads *queue, VkCommandBuffer commands);
/// The recorded copies will be made: empties the queue. Returns the position to release when they
/// have been.
uint64_t engine_uploads_commit(engine_uploads *queue);
/// The copies committed at `position` or before are done.
void engine_uploads_release(engine_uploads *queue, uint64_t position);
/// All frames must be done; copies in the queue are dropped.
void engine_uploads_free(engine_uploads *queue);

/// Writes a part of a texture, or all of a buffer (NULL: zeroes), in submissions of its own, and
/// waits for them.
lobe_result engine_upload_texture_now(lobe_texture *texture, const lobe_image *image,
                                      const lobe_rectangle *part);
lobe_result engine_upload_buffer_now(lobe_buffer *buffer, const void *data);

#endif
