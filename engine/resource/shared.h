#ifndef ENGINE_RESOURCE_SHARED_H
#define ENGINE_RESOURCE_SHARED_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

#include "engine/base/stamp.h"
#include "engine/resource/memory.h"

/// A Vulkan object with its memory and views.
typedef struct engine_object {
    VkImage image;
    VkImageView views[2];
    VkBuffer buffer;
    engine_allocation allocation;
    struct engine_shared *shared; ///< how others find it; NULL: never
} engine_object;

/// Destroys an object that nothing uses any more; one that others hold too, with the last of them.
void engine_object_destroy(lobe_device *device, engine_object *object);

/// An image or buffer that several graphs of a device may hold, found by its content. While several
/// hold it, nobody writes it, and an image stays in SHADER_READ_ONLY_OPTIMAL layout. It can be
/// found once what fills it was submitted: whoever finds it submits later, to the same queue.
typedef struct engine_shared {
    struct engine_shared *next; ///< in its bucket
    engine_stamp stamp;         ///< of the content, format and extent; NONE: not known
    uint64_t creator;           ///< number of the graph that filled it; 0: none
    engine_object object;       ///< its `shared` is this
    uint32_t references;
    bool listed; ///< others can find it
} engine_shared;

/// Those of a device that can be found. Thread-safe.
typedef struct engine_shared_table engine_shared_table;

lobe_result engine_shared_table_create(lobe_device *device, engine_shared_table **table);
/// Nobody may hold anything.
void engine_shared_table_destroy(engine_shared_table **table);

/// Without content so far, held by the caller alone, and not listed. NULL if out of memory.
engine_shared *engine_shared_create(lobe_device *device, uint64_t creator);
/// Lists it, if its content is known and nothing of another graph with this content is listed.
/// Returns whether it is listed. NULL is allowed.
bool engine_shared_publish(lobe_device *device, engine_shared *shared);
/// Finds an object with this content, which the caller holds from then on. NULL if there is none
/// but those that `asker` filled: a graph changes its objects separately.
engine_shared *engine_shared_find(lobe_device *device, engine_stamp stamp, uint64_t asker);
/// The caller is going to write it: nobody finds it any more. False, and nothing changes, if others
/// hold it too. NULL is allowed.
bool engine_shared_claim(lobe_device *device, engine_shared *shared);
/// The caller holds it no longer. Returns whether nobody does; the object is left to the caller.
bool engine_shared_release(lobe_device *device, engine_shared *shared);

#endif
