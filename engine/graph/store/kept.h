#ifndef ENGINE_GRAPH_STORE_KEPT_H
#define ENGINE_GRAPH_STORE_KEPT_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/graph.h>

#include "engine/base/stamp.h"
#include "engine/graph/plan/alias.h"
#include "engine/graph/plan/dependency_graph.h"
#include "engine/pipeline/use.h"
#include "engine/resource/resource.h"
#include "engine/resource/shared.h"
#include "engine/resource/upload.h"

/// What a graph keeps between frames: Vulkan objects, their memory, and stamps of their content.

/// A view of an image, kept as long as the image.
typedef struct engine_graph_view {
    struct engine_graph_view *next;
    VkImageViewType type;
    lobe_range range;
    VkImageView view;
} engine_graph_view;

/// An image or a buffer on the device.
typedef struct engine_graph_object {
    VkImage image;
    VkBuffer buffer;
    engine_graph_view *views;
} engine_graph_object;

/// A retained resource, found again by name and description.
typedef struct engine_graph_retained {
    struct engine_graph_retained *next;
    char *name;
    engine_stamp identity; ///< digest of its description
    VkFlags usage;         ///< that the object was created with
    uint32_t subresource_count;
    engine_stamp *stamps;   ///< of the content of each subresource
    engine_layout *layouts; ///< of each subresource
    bool declared;          ///< in the current frame
    bool lent;              ///< other graphs may find it or hold it: nobody writes it
    bool separate;          ///< was invalidated: this graph's own from then on
    bool permanent;         ///< kept as long as the graph
    bool evolves;           ///< see lobe_buffer_description
    uint32_t settles;
    engine_settling settled; ///< what evolves: see engine_dependency_resource
    size_t rest_offset;
    uint64_t asked;            ///< the number of the late data that say whether it rests; 0: none
    engine_stamp asked_change; ///< `change` when they were asked for
    bool exported;             ///< the host may have it in descriptors of its own
    engine_graph_object object;
    engine_allocation allocation;
    engine_shared *shared; ///< how they find it; NULL: never
} engine_graph_retained;

/// The transient objects and the memory they share; reused while frames need exactly the same.
typedef struct engine_graph_transients {
    engine_stamp plan; ///< digest of everything that decides their placement
    engine_graph_object *objects;
    engine_alias_request *requests;
    uint32_t *blocks; ///< of each object
    uint32_t count;
    engine_allocation *memory; ///< by block
    uint32_t block_count;
    uint64_t shared_bytes, separate_bytes;
} engine_graph_transients;

/// Bytes that a frame reads back for a later one: where they lie in its staging memory.
typedef struct engine_graph_late_data {
    uint64_t number, offset;
} engine_graph_late_data;

/// What a frame needs until the device has finished it.
typedef struct engine_graph_flight {
    bool busy; ///< submitted, or recorded for the host to submit; not known to be finished
    uint64_t submission; ///< value of the device's timeline that ends it; 0: the host submits it
    VkCommandPool command_pool;
    VkCommandBuffer commands; ///< from the pool
    engine_graph_object uploads;
    engine_allocation upload_memory;
    uint64_t upload_size;
    uint64_t copied; ///< position of the graph's uploads where the frame's copies end
    engine_staging read_back;
    engine_graph_late_data *late_data; ///< of the frame last submitted
    uint32_t late_count, late_capacity;
    engine_graph_retained *released;    ///< that the frame after this one did not declare
    engine_graph_transients transients; ///< the frame's, if the one after it needed others
    engine_graph_view *views;           ///< of host images that came without a view
    VkDescriptorPool descriptors;
    uint32_t descriptor_capacity[6]; ///< sets, then descriptors by type
    VkDescriptorSet *sets;           ///< from the pool, in the order of the commands
    uint32_t set_capacity;
    engine_stamp set_plan; ///< digest of their pipelines; NONE: there are no sets
    VkQueryPool timestamps;
    uint32_t timestamp_capacity;
    engine_pipeline_use pipelines; ///< keeps them from the frame's begin to its end
} engine_graph_flight;

typedef struct engine_graph_kept {
    engine_uploads uploads; ///< to the graph's textures and buffers, for the next frame
    engine_graph_retained *retained;
    engine_graph_transients transients;
    engine_graph_flight flights[LOBE_MAXIMUM_FRAMES_IN_FLIGHT];
    uint32_t flight_count;        ///< in use
    engine_graph_flight aside;    ///< of frames between the others, which are waited for
    engine_graph_flight *resumed; ///< by the frame after one aside
    engine_graph_flight *last;    ///< of the frame last submitted; NULL: none was
    uint64_t late_number;         ///< the largest given out
} engine_graph_kept;

#endif
