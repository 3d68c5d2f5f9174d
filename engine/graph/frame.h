#ifndef ENGINE_GRAPH_FRAME_H
#define ENGINE_GRAPH_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/graph.h>

#include "engine/base/arena.h"
#include "engine/graph/plan/dependency_graph.h"
#include "engine/graph/store/kept.h"
#include "engine/pipeline/pipeline.h"

/// What is declared in one frame, and what compiling and executing the frame adds to it. All of it
/// is valid until the next lobe_graph_begin; names, constants and commands live in the frame's
/// arena. The dependency graph (plan/) has the same passes and resources under the same indices.

#define ENGINE_MAXIMUM_PUSH_CONSTANTS 128 ///< bytes; what every Vulkan device supports
#define ENGINE_MAXIMUM_UPLOAD         ((size_t)4 << 20)

typedef enum engine_graph_origin {
    ENGINE_GRAPH_TRANSIENT,
    ENGINE_GRAPH_RETAINED,
    ENGINE_GRAPH_TEXTURE,
    ENGINE_GRAPH_BUFFER, ///< imported
    ENGINE_GRAPH_UPLOAD,
    ENGINE_GRAPH_HOST_IMAGE,
    ENGINE_GRAPH_HOST_BUFFER,
} engine_graph_origin;

typedef struct engine_graph_resource {
    const char *name;
    engine_graph_origin origin;
    bool is_image;
    lobe_format format;
    uint32_t width, height, layers, levels, samples;
    uint32_t first_layer, first_level; ///< of the host's image, from which on it is this resource
    uint64_t size;                     ///< buffers: bytes
    VkFlags usage;                     ///< of the image or buffer, united over all passes
    bool cube;                         ///< some shader reads it as a cube
    bool shared;                       ///< other graphs may have its content
    bool permanent;                    ///< kept as long as the graph
    bool evolves;                      ///< see lobe_buffer_description
    uint32_t settles;
    size_t rest_offset;
    uint64_t asked; ///< the number of the late data that say whether it rests; 0: none
    const lobe_texture *texture;
    const lobe_buffer *buffer;
    const lobe_vulkan_image *host;         ///< copy in the arena
    const lobe_vulkan_buffer *host_buffer; ///< copy in the arena
    const void *upload;                    ///< bytes in the arena
    engine_graph_retained *retained;
    engine_graph_object *object; ///< the Vulkan object; NULL: no running pass uses it
    uint64_t offset;             ///< of a buffer's content within the object's
    uint64_t bytes;              ///< of device memory, for the dump
} engine_graph_resource;

/// A binding of a pass, or of one of its commands.
typedef struct engine_graph_binding {
    struct engine_graph_binding *next;
    const char *name;
    lobe_sampler sampler;
    engine_access_kind kind;
    uint32_t access;
    bool known; ///< some shader has a variable of this name
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
    ENGINE_GRAPH_EXPORT,
} engine_graph_command_kind;

typedef struct engine_graph_command {
    struct engine_graph_command *next;
    engine_graph_command_kind kind;
    lobe_dispatch dispatch; ///< names, constants and specialisation are copies in the arena
    lobe_draw draw;
    engine_graph_binding_list bindings; ///< of this command alone
    uint32_t index_access;              ///< draw: of the index buffer, or NONE
    uint32_t indirect_access;           ///< of the buffer with the counts, or NONE
    size_t indirect_offset;             ///< bytes
    char *number;                       ///< dispatch: where in its constants, or NULL
    uint32_t source_access, target_access;
    lobe_rectangle part;         ///< of a copy's source; no texels: all levels and layers
    uint32_t target_x, target_y; ///< where that part goes
    float value[4];
    uint64_t read_back_offset, read_back_size; ///< bytes
    lobe_resource read_back;
    uint64_t late_number; ///< for lobe_graph_late_data; 0: none
    const char *export_shader;

    // Set by compilation, from the shaders
    engine_stamp shader_stamp;
    const engine_pipeline *pipeline;
    uint32_t group_count[3];
    // Set by execution
    VkDescriptorSet set;
    lobe_vulkan_descriptor *exported;
    size_t exported_count;
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
    bool internal; ///< added by the graph itself; left out of reports
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
    ENGINE_GRAPH_PREPARED, ///< it has pipelines, and will not be executed
    ENGINE_GRAPH_SUBMITTED,
    ENGINE_GRAPH_EXECUTED,
} engine_graph_phase;

typedef struct engine_graph_frame {
    engine_graph_phase phase;
    bool aside;         ///< between the others: leaves alone what it does not declare
    lobe_result result; ///< the first failure of this frame
    engine_arena arena;
    engine_dependency_graph dependencies;
    engine_graph_resource *resources;
    lobe_pass **passes;
    uint32_t resource_capacity, pass_capacity;
    uint32_t exported_buffers; ///< declared so far
    lobe_pass nothing;         ///< what lobe_graph_add_pass returns after a failure

    engine_graph_object *imported; ///< by resource, in the arena
    engine_graph_flight *flight;   ///< the one of the graph's flights that this frame uses
    VkCommandBuffer commands;      ///< recorded into: the flight's or the host's

    lobe_graph_report report;
    lobe_pass_report *pass_reports;
    uint32_t report_capacity;
} engine_graph_frame;

/// Width or height of a MIP level, from that of level 0.
static inline uint32_t engine_graph_level_extent(uint32_t extent, uint32_t level) {
    return extent >> level ? extent >> level : 1;
}

#endif
