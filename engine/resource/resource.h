#ifndef ENGINE_RESOURCE_H
#define ENGINE_RESOURCE_H

#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

#include "engine/resource/memory.h"

/// What a texture or buffer has in the queue of the graph that it belongs to.
typedef struct engine_upload_state {
    struct engine_uploads *queue; ///< NULL: it belongs to no graph, and is written at once
    uint64_t created;             ///< ring position: frames that end there or before do not use it
    uint64_t bytes;               ///< of host memory that its copies in the queue need; 0: none
    uint32_t last;                ///< of these copies; meaningless without any
    struct engine_shared *shared; ///< how other graphs find it; NULL: never
} engine_upload_state;

/// Between the calls of lobe/device.h the image is in SHADER_READ_ONLY_OPTIMAL layout, its content
/// visible to every later submission (of the graph that it belongs to, to that graph's next frame);
/// code that changes the layout must restore it. Usage: sampled, transfer source and destination.
struct lobe_texture {
    lobe_device *device;
    char *name;
    lobe_format format;
    uint32_t width, height; ///< texels; one level, one layer
    VkImage image;
    VkImageView view;       ///< two-dimensional
    VkImageView array_view; ///< of one layer
    engine_allocation allocation;
    uint64_t stamp; ///< of what it was created with; after an update, an engine_device_stamp
    bool filled;    ///< once; until then, the layout is UNDEFINED
    engine_upload_state uploads;
};

/// Content is visible as that of a texture. Usage: uniform, storage, index, transfer source
/// and destination.
struct lobe_buffer {
    lobe_device *device;
    char *name;
    size_t size; ///< bytes
    VkBuffer buffer;
    engine_allocation allocation;
    uint64_t stamp; ///< as in lobe_texture
    engine_upload_state uploads;
};

/// As lobe_texture_create and lobe_buffer_create, for the graph with this queue (NULL: for none).
lobe_result engine_texture_create_for(lobe_device *device, struct engine_uploads *queue,
                                      const lobe_texture_parameters *parameters,
                                      lobe_texture **texture);
lobe_result engine_buffer_create_for(lobe_device *device, struct engine_uploads *queue,
                                     const lobe_buffer_parameters *parameters,
                                     lobe_buffer **buffer);

// ---------------------------------------------------------------------------------------------
// Building blocks of textures, buffers and the graph's own resources

typedef struct engine_image_parameters {
    const char *name;
    lobe_format format;
    uint32_t width, height;           ///< texels
    uint32_t layers, levels, samples; ///< 0 means 1
    VkImageUsageFlags usage;
    VkImageCreateFlags flags;
} engine_image_parameters;

/// Creates an optimally tiled two-dimensional image (named for debuggers) without memory, and
/// returns its memory requirements. Errors: LOBE_ERROR_LIMIT (extent, levels or layers above what
/// the device allows), LOBE_ERROR_UNSUPPORTED (the device lacks the usage or sample count for the
/// format).
lobe_result engine_image_create(lobe_device *device, const engine_image_parameters *parameters,
                                VkImage *image, VkMemoryRequirements *requirements);

typedef struct engine_view_parameters {
    const char *name;
    VkImage image;
    lobe_format format;
    VkImageViewType type;
    uint32_t first_level, level_count; ///< counts above 0
    uint32_t first_layer, layer_count;
} engine_view_parameters;

lobe_result engine_view_create(lobe_device *device, const engine_view_parameters *parameters,
                               VkImageView *view);

/// Creates a buffer without memory, and returns its memory requirements. `name`, here and below:
/// NULL: errors are not logged.
/// Errors: LOBE_ERROR_LIMIT (size above what the device allows for one storage buffer).
lobe_result engine_buffer_create(lobe_device *device, const char *name, VkDeviceSize size,
                                 VkBufferUsageFlags usage, VkBuffer *buffer,
                                 VkMemoryRequirements *requirements);

/// Creates a buffer bound to its own memory. On failure both are all zero.
lobe_result engine_buffer_create_placed(lobe_device *device, const char *name, VkDeviceSize size,
                                        VkBufferUsageFlags usage, engine_memory_place place,
                                        VkBuffer *buffer, engine_allocation *allocation);
void engine_buffer_destroy_placed(lobe_device *device, VkBuffer *buffer,
                                  engine_allocation *allocation);

/// A buffer in mapped memory, for transfers between host and device. All zero: none.
typedef struct engine_staging {
    VkBuffer buffer;
    void *mapped; ///< coherent: no flush is needed
    VkDeviceSize size;
    engine_allocation allocation;
} engine_staging;

/// `place` is ENGINE_MEMORY_UPLOAD or ENGINE_MEMORY_READ_BACK. Usage: transfer source and
/// destination, and uniform and (up to the device's limit) storage for small uploads that shaders
/// read in place.
lobe_result engine_staging_create(lobe_device *device, const char *name, VkDeviceSize size,
                                  engine_memory_place place, engine_staging *staging);
/// The device must have finished with it. All zero is allowed.
void engine_staging_destroy(lobe_device *device, engine_staging *staging);

#endif
