#ifndef ENGINE_GRAPH_H
#define ENGINE_GRAPH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/graph.h>

#include "engine/base/arena.h"
#include "engine/device/device.h"
#include "engine/graph/plan/alias.h"
#include "engine/graph/plan/dependency_graph.h"
#include "engine/pipeline/pipeline.h"
#include "engine/resource/memory.h"
#include "engine/resource/resource.h"

/// What the parts of the render graph share. What was declared lives in `arena` until the next
/// begin; the dependency graph holds the same passes and resources under the same indices.

#define ENGINE_MAXIMUM_PUSH_CONSTANTS 128 ///< bytes; what Vulkan guarantees
#define ENGINE_MAXIMUM_UPLOAD         ((size_t)4 << 20)

// ---------------------------------------------------------------------------------------------
// On the device

/// A view made of an image, kept as long as the image.
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

/// What is kept from frame to frame under a name.
typedef struct engine_graph_retained {
    struct engine_graph_retained *next;
    char *name;
    engine_stamp identity; ///< of its description
    VkFlags usage;         ///< it was made for
    uint32_t subresource_count;
    engine_stamp *stamps;   ///< of what each subresource holds
    engine_layout *layouts; ///< each subresource is in
    bool declared;          ///< in this frame
    engine_graph_object object;
    engine_allocation allocation;
} engine_graph_retained;

/// Transient objects and the memory they share, kept while frames need the very same ones.
typedef struct engine_graph_transients {
    engine_stamp plan; ///< of all that decides their placement
    engine_graph_object *objects;
    engine_alias_request *requests;
    uint32_t *blocks; ///< of each object
    uint32_t count;
    engine_allocation *memory; ///< by block
    uint32_t block_count;
    uint64_t shared_bytes, separate_bytes;
} engine_graph_transients;

// ---------------------------------------------------------------------------------------------
// Declared in this frame

typedef enum engine_graph_origin {
    ENGINE_GRAPH_TRANSIENT,
    ENGINE_GRAPH_RETAINED,
    ENGINE_GRAPH_TEXTURE,
    ENGINE_GRAPH_BUFFER, ///< imported
    ENGINE_GRAPH_UPLOAD,
    ENGINE_GRAPH_HOST_IMAGE,
} engine_graph_origin;

typedef struct engine_graph_resource {
    const char *name;
    engine_graph_origin origin;
    bool is_image;
    lobe_format format;
    uint32_t width, height, layers, levels, samples;
    uint64_t size; ///< buffers: bytes
    VkFlags usage; ///< of the image or buffer, by all passes
    bool cube;     ///< some shader reads it as a cube
    const lobe_texture *texture;
    const lobe_buffer *buffer;
    const lobe_vulkan_image *host; ///< in the arena
    const void *upload;            ///< bytes, in the arena
    engine_graph_retained *retained;
    engine_graph_object *object; ///< where it is on the device; NULL: nothing that runs uses it
    uint64_t offset;             ///< of a buffer's content within the object's
    uint64_t bytes;              ///< of device memory, for the dump
} engine_graph_resource;

/// A binding as a pass or one of its commands declared it.
typedef struct engine_graph_binding {
    struct engine_graph_binding *next;
    const char *name;
    lobe_sampler sampler;
    engine_access_kind kind;
    uint32_t access;
    bool known; ///< some shader has the name
} engine_graph_binding;

typedef struct engine_graph_binding_list {
    engine_graph_binding *first, *last;
} engine_graph_binding_list;

typedef enum engine_graph_command_kind {
    ENGINE_GRAPH_DISPATCH,
    ENGINE_GRAPH_DRAW,
    ENGINE_GRAPH_COPY,
    ENGINE_GRAPH_FILL,
    ENGINE_GRAPH_READ_BACK,
} engine_graph_command_kind;

typedef struct engine_graph_command {
    struct engine_graph_command *next;
    engine_graph_command_kind kind;
    lobe_dispatch dispatch; ///< texts, constants and specialisation in the arena
    lobe_draw draw;
    engine_graph_binding_list bindings; ///< of this command alone
    uint32_t index_access;              ///< draw: of the index buffer, or NONE
    uint32_t source_access, target_access;
    float value[4];
    uint64_t read_back_offset, read_back_size; ///< bytes
    lobe_resource read_back;

    // From the shaders
    engine_stamp shader_stamp;
    const engine_pipeline *pipeline;
    uint32_t group_count[3];
    VkDescriptorSet set;
} engine_graph_command;

typedef struct engine_graph_attachment {
    uint32_t access; ///< NONE: there is no such attachment
    lobe_load load;
    float clear[4];
} engine_graph_attachment;

struct lobe_pass {
    lobe_graph *graph;
    uint32_t index;
    lobe_pass_kind kind;
    const char *name;
    bool internal; ///< made by the graph itself; not reported
    engine_graph_binding_list bindings;
    engine_graph_command *first_command, *last_command;
    engine_graph_attachment colour[ENGINE_MAXIMUM_COLOUR_ATTACHMENTS];
    engine_graph_attachment resolve[ENGINE_MAXIMUM_COLOUR_ATTACHMENTS];
    engine_graph_attachment depth;
    VkExtent2D extent; ///< of the attachments
    uint32_t samples;
    double milliseconds;
    uint64_t read_bytes, written_bytes;
};

typedef enum engine_graph_phase {
    ENGINE_GRAPH_DECLARING,
    ENGINE_GRAPH_COMPILED,
    ENGINE_GRAPH_SUBMITTED,
    ENGINE_GRAPH_EXECUTED,
} engine_graph_phase;

/// What a frame needs until the device has finished it.
typedef struct engine_graph_flight {
    bool busy;           ///< given to the device or the host, and not known to be finished
    uint64_t submission; ///< value of the device's timeline that ends it; 0: the host submits it
    VkCommandPool command_pool;
    VkCommandBuffer commands; ///< of the pool
    engine_graph_object uploads;
    engine_allocation upload_memory;
    uint64_t upload_size;
    engine_staging read_back;
    engine_graph_view *views; ///< of images of the host that came without
    VkDescriptorPool descriptors;
    uint32_t descriptor_capacity[5]; ///< sets, then by type
    VkDescriptorSet *sets;           ///< of the pool, in the order of the commands
    uint32_t set_capacity;
    engine_stamp set_plan; ///< of their layouts; NONE: there are no sets
    VkQueryPool timestamps;
    uint32_t timestamp_capacity;
} engine_graph_flight;

struct lobe_graph {
    lobe_device *device;
    engine_graph_phase phase;
    lobe_result result; ///< the first failure of this frame
    engine_arena arena;
    engine_dependency_graph dependencies;
    engine_graph_resource *resources;
    lobe_pass **passes;
    uint32_t resource_capacity, pass_capacity;
    lobe_pass nothing; ///< what add_pass gives after a failure

    engine_graph_retained *retained;
    engine_graph_transients transients;
    engine_graph_object *imported; ///< of this frame, by resource
    engine_graph_flight flights[LOBE_MAXIMUM_FRAMES_IN_FLIGHT];
    uint32_t flight_count;       ///< of those in use
    engine_graph_flight *flight; ///< of this frame
    VkCommandBuffer commands;    ///< recorded into: the flight's or the host's

    lobe_graph_report report;
    lobe_pass_report *pass_reports;
    uint32_t report_capacity;
};

// ---------------------------------------------------------------------------------------------
// Failures (graph.c)

/// lobe_graph_fail for a failure that was logged where it was found.
lobe_result engine_graph_propagate(lobe_graph *graph, lobe_result result);
/// The same for what the dependency graph found.
lobe_result engine_graph_fail_dependency(lobe_graph *graph);
lobe_result engine_graph_fail_memory(lobe_graph *graph);

#endif
