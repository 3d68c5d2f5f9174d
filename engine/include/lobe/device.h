#ifndef LOBE_DEVICE_H
#define LOBE_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A GPU (or a software Vulkan driver) with lobe's queue, memory, shaders and pipelines. Several
/// threads may use one device at once, each with its own objects (renderers, graphs, textures,
/// buffers): lobe locks what they share. Only one thread may destroy it.
typedef struct lobe_device lobe_device;

typedef enum lobe_device_type {
    LOBE_DEVICE_OTHER,
    LOBE_DEVICE_INTEGRATED_GPU,
    LOBE_DEVICE_DISCRETE_GPU,
    LOBE_DEVICE_VIRTUAL_GPU,
    LOBE_DEVICE_CPU, ///< a software driver such as lavapipe; its timings are CPU timings
} lobe_device_type;

/// "discrete GPU", "CPU" and so on. Never NULL.
LOBE_API const char *lobe_device_type_name(lobe_device_type type);

struct VkInstance_T;
/// The type of Vulkan's vkGetInstanceProcAddr, without Vulkan's headers.
typedef void (*(*lobe_get_instance_proc_addr)(struct VkInstance_T *instance,
                                              const char *name))(void);

typedef struct lobe_device_parameters {
    /// Which device: an index ("0"), or a part of its name in any case ("llvmpipe", "radeon").
    /// NULL: the most suitable one; discrete GPUs come before integrated, virtual and CPU devices.
    const char *select;
    /// Enable the Khronos validation layer with synchronisation validation. Its messages are logged
    /// as errors and counted. LOBE_ERROR_UNSUPPORTED if the layer is missing.
    bool validation;
    /// File that stores compiled pipelines between runs; written on destroy, replaced if it belongs
    /// to another driver. NULL: no file is read or written. (Filtered environments have a cache of
    /// their own, see lobe_render_environment.)
    const char *pipeline_cache;
    /// Folder of the shader sources, used only by a build with -Dhot_reload=true.
    /// NULL: the source tree that lobe was built from.
    const char *shader_source;
    /// Largest number of bytes of device memory to allocate; beyond it, allocations fail with
    /// LOBE_ERROR_OUT_OF_DEVICE_MEMORY. 0: only the device's own limit.
    uint64_t memory_limit;
    /// Where lobe gets Vulkan's functions from: the vkGetInstanceProcAddr of the host's loader, for
    /// example of one that is linked statically. NULL: that of libvulkan.so.1, which lobe loads.
    lobe_get_instance_proc_addr get_instance_proc_addr;
    /// Copied. NULL: silent. Its allocator is used for the device and everything created on it.
    const lobe_host *host;
} lobe_device_parameters;

/// Creates a device. `parameters` may be NULL for all defaults. On failure `*device` is NULL.
/// Errors: LOBE_ERROR_NO_DEVICE (there is no Vulkan loader or no device, none matches `select`, or
/// the selected one lacks a required feature, which the log names), LOBE_ERROR_UNSUPPORTED (no
/// validation layer).
LOBE_API lobe_result lobe_device_create(const lobe_device_parameters *parameters,
                                        lobe_device **device);

/// Waits for the device, saves the pipeline cache, frees everything and clears the pointer.
/// Textures, buffers and graphs of the device must have been destroyed before. NULL is allowed.
LOBE_API void lobe_device_destroy(lobe_device **device);

/// The allocator of the host in the device's parameters, used for the device and everything created
/// on it. NULL: the C library's.
LOBE_API const lobe_allocator *lobe_device_allocator(const lobe_device *device);

/// A Vulkan feature that lobe knows about.
typedef struct lobe_device_feature {
    const char *name; ///< Vulkan's own name, for example "synchronization2"
    const char *use;  ///< what lobe does with it
    bool required;    ///< lobe does not start without it
    bool present;
} lobe_device_feature;

typedef struct lobe_device_information {
    char name[256];
    char driver[512]; ///< driver name and version, for example "llvmpipe Mesa 22.3.6 (LLVM 15)"
    lobe_device_type type;
    uint32_t vulkan_major, vulkan_minor, vulkan_patch;
    uint32_t maximum_image_extent;   ///< texels
    uint32_t maximum_colour_outputs; ///< of a raster pass: at least 4
    uint64_t memory_bytes;           ///< size of the largest device-local heap
    double timestamp_period;         ///< nanoseconds per tick; 0 if passes cannot be timed
    bool linear_filter_float32;      ///< RGBA32_FLOAT can be sampled with linear filtering
    const lobe_device_feature *features;
    size_t feature_count;
} lobe_device_information;

/// A description of the device; valid as long as the device exists.
LOBE_API const lobe_device_information *lobe_device_describe(const lobe_device *device);

/// Lists every Vulkan device of this machine, suitable or not. Free the list with
/// lobe_device_list_free. LOBE_ERROR_NO_DEVICE if there is none. Of `parameters`, which may be
/// NULL, only `get_instance_proc_addr` and `host` are used.
LOBE_API lobe_result lobe_device_list(const lobe_device_parameters *parameters,
                                      lobe_device_information **devices, size_t *count);
LOBE_API void lobe_device_list_free(lobe_device_information **devices, size_t count);

typedef struct lobe_device_memory {
    uint64_t allocated_bytes; ///< currently allocated from Vulkan, in blocks
    uint64_t used_bytes;      ///< currently used within those blocks
    uint64_t peak_used_bytes; ///< maximum of used_bytes since creation or the last reset
    uint64_t budget_bytes;    ///< what this process may allocate, from the driver or the limit
} lobe_device_memory;

LOBE_API void lobe_device_memory_query(const lobe_device *device, lobe_device_memory *memory);
/// Sets the peak to what is currently used.
LOBE_API void lobe_device_memory_reset_peak(lobe_device *device);

/// Validation messages (warnings and errors) seen so far; 0 without validation.
LOBE_API uint64_t lobe_device_validation_count(const lobe_device *device);

// ---------------------------------------------------------------------------------------------
// Resources that outlive a frame

/// An image on the device with content from the host; sampled by passes.
typedef struct lobe_texture lobe_texture;

typedef struct lobe_texture_parameters {
    const char *name;        ///< for dumps and debug labels; copied; NULL: "texture"
    const lobe_image *image; ///< level 0, copied to the device before the call returns
} lobe_texture_parameters;

/// Errors: LOBE_ERROR_LIMIT (above the device's limits), LOBE_ERROR_OUT_OF_DEVICE_MEMORY,
/// LOBE_ERROR_UNSUPPORTED (the device cannot sample the format).
LOBE_API lobe_result lobe_texture_create(lobe_device *device,
                                         const lobe_texture_parameters *parameters,
                                         lobe_texture **texture);
/// Whether an image has the format and extent that lobe_texture_update requires.
LOBE_API bool lobe_texture_takes(const lobe_texture *texture, const lobe_image *image);
/// Replaces the content; same format and extent. Graph passes that read the texture run again.
LOBE_API lobe_result lobe_texture_update(lobe_texture *texture, const lobe_image *image);
/// The same where only a part of the image differs from the content: the rest is not read, as a
/// rule. NULL: all of it. LOBE_ERROR_INVALID_ARGUMENT: the part has no texels, or lies outside.
LOBE_API lobe_result lobe_texture_update_part(lobe_texture *texture, const lobe_image *image,
                                              const lobe_rectangle *part);
/// Waits until the device has finished with the texture, unless that is a graph's. Clears the
/// pointer; NULL is allowed.
LOBE_API void lobe_texture_destroy(lobe_texture **texture);

/// A linear range of device memory with content from the host: vertices, indices, or any storage or
/// uniform data.
typedef struct lobe_buffer lobe_buffer;

typedef struct lobe_buffer_parameters {
    const char *name; ///< copied; NULL: "buffer"
    size_t size;      ///< bytes, above 0
    const void *data; ///< `size` bytes, copied before the call returns; NULL: zeroes
} lobe_buffer_parameters;

LOBE_API lobe_result lobe_buffer_create(lobe_device *device,
                                        const lobe_buffer_parameters *parameters,
                                        lobe_buffer **buffer);
/// Replaces the whole content. Graph passes that read the buffer run again.
LOBE_API lobe_result lobe_buffer_update(lobe_buffer *buffer, const void *data);
LOBE_API void lobe_buffer_destroy(lobe_buffer **buffer);

// ---------------------------------------------------------------------------------------------
// Shaders

/// A shader of the host, for its own passes.
typedef struct lobe_shader {
    const char *name;      ///< that passes use, for example "outline.frag"
    const uint32_t *words; ///< SPIR-V of one vertex, fragment or compute shader; entry point "main"
    size_t size;           ///< bytes
} lobe_shader;

/// Adds a shader to the device; copied. Replaces a shader of the same name, even one of lobe's own,
/// for passes that are declared from now on. Its bindings must be in set 0, see lobe_binding.
/// Errors: LOBE_ERROR_SHADER (not SPIR-V, another stage, another set), LOBE_ERROR_INVALID_ARGUMENT
/// (no name, no words, `size` not a multiple of 4); nothing is replaced then.
LOBE_API lobe_result lobe_device_add_shader(lobe_device *device, const lobe_shader *shader);

#ifdef __cplusplus
}
#endif

#endif
