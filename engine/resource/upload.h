#ifndef ENGINE_RESOURCE_UPLOAD_H
#define ENGINE_RESOURCE_UPLOAD_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

#include "engine/base/stamp.h"
#include "engine/resource/resource.h"
#include "engine/resource/staging_ring.h"

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

/// Of a copy, in bytes of host memory: its content, and what describes it.
static inline uint64_t engine_upload_cost(VkDeviceSize size) {
    return size + sizeof(engine_upload) + sizeof(VkImageMemoryBarrier2);
}

/// Copies that the next frame of a graph, or the next submission, makes before anything else. The
/// content is in the ring already; the caller's memory is not needed. All zero but the device:
/// none.
typedef struct engine_uploads {
    lobe_device *device;
    engine_staging_ring ring;
    engine_upload *copies;
    VkImageMemoryBarrier2 *barriers; ///< room for recording
    uint32_t count, capacity, barrier_capacity;
    uint64_t number;     ///< an engine_device_stamp; 0: of no graph
    bool started;        ///< a frame has begun
    bool apart;          ///< see lobe_graph_keep_apart
    uint64_t unsent;     ///< ring position: a frame that ends there may not be submitted yet
    VkCommandBuffer own; ///< the last submission without a frame, not waited for; or NULL
    uint64_t own_value, own_end; ///< of the device's timeline, and its position in the ring
} engine_uploads;

/// Prepares a new object, of the graph with this queue (NULL: of none) and for this many bytes of
/// content, for the functions below. False if out of memory.
bool engine_upload_target_create(lobe_device *device, engine_uploads *queue, uint64_t bytes,
                                 engine_upload_state *state);
/// Takes what another graph has with this content in place of an object of its own. False if there
/// is nothing.
bool engine_upload_target_adopt(lobe_device *device, engine_upload_state *state, engine_stamp stamp,
                                engine_object *object);
/// Lets other graphs take the object once all of its content was submitted.
void engine_upload_target_offer(lobe_device *device, engine_upload_state *state, engine_stamp stamp,
                                const engine_object *object);
/// Allocates its memory. Where too little is left, the queue is flushed, and its memory helps out.
lobe_result engine_upload_target_allocate(lobe_device *device, engine_uploads *queue,
                                          const engine_memory_request *request,
                                          engine_allocation *allocation);
/// Removes the copies to an object, and destroys it when the frames that may use it are done: at
/// once if there are none. Waits for them if it belongs to no graph.
void engine_upload_target_destroy(lobe_device *device, engine_upload_state *state,
                                  engine_object *object);

/// Adds a copy to the object with this state, whose content is in the ring, or will be when the
/// copies are made. Earlier copies to the object go where this one is to all of it.
lobe_result engine_uploads_add(engine_uploads *queue, const char *name, engine_upload_state *state,
                               const engine_upload *copy);
/// Removes all copies to an object.
void engine_uploads_remove(engine_uploads *queue, engine_upload_state *state);
/// Makes the copies to a texture or buffer to another one. The queue may be NULL.
void engine_uploads_redirect(engine_uploads *queue, const void *from, void *to);

/// Records the copies, after everything before and before everything after.
void engine_uploads_record(engine_uploads *queue, VkCommandBuffer commands);
/// The recorded copies will be made: empties the queue. `by_host`: the host submits them, by the
/// beginning of the next frame. Returns the position to release when they have been made.
uint64_t engine_uploads_commit(engine_uploads *queue, bool by_host);
/// The copies committed at `position` or before are done.
void engine_uploads_release(engine_uploads *queue, uint64_t position);

/// Whether copies can go without a frame: only after all that the host was to submit, whose copies
/// would otherwise come later, from memory that is no longer theirs.
bool engine_uploads_may_submit(const engine_uploads *queue);
/// Submits the copies without a frame, after waiting for the last such submission: while one is
/// under way, the next is filled.
lobe_result engine_uploads_submit(engine_uploads *queue);
/// Submits the copies, if there are any, and waits for them and all frames before: all of the ring
/// is free.
lobe_result engine_uploads_finish(engine_uploads *queue);
/// The same, and gives the ring's memory back.
lobe_result engine_uploads_flush(engine_uploads *queue);
/// A frame begins. What came before the first one is flushed, so that this frame can have the
/// memory that it went through.
lobe_result engine_uploads_begin_frame(engine_uploads *queue);

/// All frames must be done; copies in the queue are dropped.
void engine_uploads_free(engine_uploads *queue);

#endif
