#ifndef LOBE_DEVICE_H
#define LOBE_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A GPU (or a software Vulkan driver) made ready for lobe: its queue, its memory, its shaders
/// and pipelines. Several threads may use one device at once, each with objects of its own
/// (renderers, graphs, textures, buffers): lobe locks what they share. One of them destroys it.
typedef struct lobe_device lobe_device;

typedef enum lobe_device_type {
    LOBE_DEVICE_OTHER,
    LOBE_DEVICE_INTEGRATED_GPU,
    LOBE_DEVICE_DISCRETE_GPU,
    LOBE_DEVICE_VIRTUAL_GPU,
    LOBE_DEVICE_CPU, ///< a software driver such as lavapipe: its timings are those of a CPU
} lobe_device_type;

/// "discrete GPU", "CPU" and so on. Never NULL.
const char *lobe_device_type_name(lobe_device_type type);

struct VkInstance_T;
/// The type of Vulkan's vkGetInstanceProcAddr, without Vulkan's headers.
typedef void (*(*lobe_get_instance_proc_addr)(struct VkInstance_T *instance,
                                              const char *name))(void);

typedef struct lobe_device_parameters {
    /// Which device: an index ("0"), or a part of its name in any case ("llvmpipe", "radeon").
    /// NULL: the best suited, discrete GPU before integrated before virtual before CPU.
    const char *select;
    /// Turn on the Khronos validation layer with synchronisation validation. Its messages go to
    /// the log as errors and are counted. LOBE_ERROR_UNSUPPORTED where the layer is missing.
    bool validation;
    /// File that keeps compiled pipelines between runs; written on destroy, replaced when it
    /// belongs to another driver. NULL: none is read or written.
    const char *pipeline_cache;
    /// Folder of the shader sources, used only by a build with -Dhot_reload=true.
    /// NULL: the source tree that lobe was built from.
    const char *shader_source;
    /// Most bytes of device memory to take; an allocation above fails with
    /// LOBE_ERROR_OUT_OF_DEVICE_MEMORY. 0: no limit but the device's own.
    uint64_t memory_limit;
    /// Where lobe gets Vulkan's functions: the vkGetInstanceProcAddr of the host's loader, for
    /// example one that is linked statically. NULL: that of libvulkan.so.1, loaded when needed.
    lobe_get_instance_proc_addr get_instance_proc_addr;
    /// Copied. NULL: silent. Its allocator serves the device and all that is made on it.
    const lobe_host *host;
} lobe_device_parameters;

/// Creates a device. `parameters` may be NULL for all defaults. On failure `*device` is NULL.
/// Errors: LOBE_ERROR_NO_DEVICE (no Vulkan loader, no device at all, none matches `select`, or the
/// one selected lacks a required feature: the log line names it), LOBE_ERROR_UNSUPPORTED (no
/// validation layer).
lobe_result lobe_device_create(const lobe_device_parameters *parameters, lobe_device **device);

/// Waits for the device, saves the pipeline cache, frees everything and clears the pointer.
/// Textures, buffers and graphs of the device must have been destroyed before. NULL is fine.
void lobe_device_destroy(lobe_device **device);

/// Where the device, and all that is made on it, gets the host's memory: as the log in its
/// parameters says. NULL: the C library's.
const lobe_allocator *lobe_device_allocator(const lobe_device *device);

/// A Vulkan feature lobe knows about.
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
    uint32_t maximum_image_extent; ///< texels
    uint64_t memory_bytes;         ///< size of the largest device-local heap
    double timestamp_period;       ///< nanoseconds a tick; 0 where passes cannot be timed
    bool linear_filter_float32;    ///< RGBA32_FLOAT can be sampled with linear filtering
    const lobe_device_feature *features;
    size_t feature_count;
} lobe_device_information;

/// Facts about the device; lives as long as it.
const lobe_device_information *lobe_device_describe(const lobe_device *device);

/// Lists every Vulkan device of this machine, suited or not, as information that the caller
/// frees with lobe_device_list_free. LOBE_ERROR_NO_DEVICE where there is none. Of `parameters`,
/// which may be NULL, `get_instance_proc_addr` and `host` count.
lobe_result lobe_device_list(const lobe_device_parameters *parameters,
                             lobe_device_information **devices, size_t *count);
void lobe_device_list_free(lobe_device_information **devices, size_t count);

typedef struct lobe_device_memory {
    uint64_t allocated_bytes; ///< taken from Vulkan now, in blocks
    uint64_t used_bytes;      ///< handed out of those blocks now
    uint64_t peak_used_bytes; ///< most ever used at once since creation or the last reset
    uint64_t budget_bytes;    ///< what this process may take, as the driver (or the limit) says
} lobe_device_memory;

void lobe_device_memory_query(const lobe_device *device, lobe_device_memory *memory);
/// Sets the peak to what is used now.
void lobe_device_memory_reset_peak(lobe_device *device);

/// Validation messages (warnings and errors) seen so far; 0 without validation.
uint64_t lobe_device_validation_count(const lobe_device *device);

// ---------------------------------------------------------------------------------------------
// Resources that outlive a frame

/// An image on the device with content given by the host; sampled by passes.
typedef struct lobe_texture lobe_texture;

typedef struct lobe_texture_parameters {
    const char *name;        ///< for dumps and debug labels; copied; NULL: "texture"
    const lobe_image *image; ///< level 0, copied to the device before the call returns
} lobe_texture_parameters;

/// Errors: LOBE_ERROR_LIMIT (larger than the device allows), LOBE_ERROR_OUT_OF_DEVICE_MEMORY,
/// LOBE_ERROR_UNSUPPORTED (the device cannot sample the format).
lobe_result lobe_texture_create(lobe_device *device, const lobe_texture_parameters *parameters,
                                lobe_texture **texture);
/// Whether an image has the format and extent that lobe_texture_update asks for.
bool lobe_texture_takes(const lobe_texture *texture, const lobe_image *image);
/// Replaces the content: same format and extent. Graph passes that read the texture run again.
lobe_result lobe_texture_update(lobe_texture *texture, const lobe_image *image);
/// Waits until the device has finished with it. Clears the pointer; NULL is fine.
void lobe_texture_destroy(lobe_texture **texture);

/// A linear range of device memory with content given by the host: vertices, indices, or any
/// storage or uniform data.
typedef struct lobe_buffer lobe_buffer;

typedef struct lobe_buffer_parameters {
    const char *name; ///< copied; NULL: "buffer"
    size_t size;      ///< bytes, above 0
    const void *data; ///< `size` bytes, copied before the call returns; NULL: zeroes
} lobe_buffer_parameters;

lobe_result lobe_buffer_create(lobe_device *device, const lobe_buffer_parameters *parameters,
                               lobe_buffer **buffer);
/// Replaces all content. Graph passes that read the buffer run again.
lobe_result lobe_buffer_update(lobe_buffer *buffer, const void *data);
void lobe_buffer_destroy(lobe_buffer **buffer);

// ---------------------------------------------------------------------------------------------
// Shaders

/// A shader of the host's, for passes of its own.
typedef struct lobe_shader {
    const char *name;      ///< by which passes call it, for example "outline.frag"
    const uint32_t *words; ///< SPIR-V of one vertex, fragment or compute shader; entry point "main"
    size_t size;           ///< bytes
} lobe_shader;

/// Makes a shader known to the device. Copied. A shader of the same name is replaced, for passes
/// that are declared from now on; one of lobe's own, too. Its bindings are in set 0, see
/// lobe_binding. Errors: LOBE_ERROR_SHADER (not SPIR-V, another stage, another set),
/// LOBE_ERROR_INVALID_ARGUMENT (no name, no words, a part of a word); nothing is replaced then.
lobe_result lobe_device_add_shader(lobe_device *device, const lobe_shader *shader);

#ifdef __cplusplus
}
#endif

#endif
