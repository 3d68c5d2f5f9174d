#ifndef LOBE_VULKAN_H
#define LOBE_VULKAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/allocator.h>
#include <lobe/api.h>
#include <lobe/device.h>
#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// lobe inside a program that uses Vulkan itself, with that program's device, images and
/// semaphores. This is the only header of lobe that includes Vulkan; lobe/lobe.h does not include
/// it.
///
/// lobe refers to no function of Vulkan by name: it gets them from the host's vkGetInstanceProcAddr
/// or, if the host gives none, from that of libvulkan.so.1, which it loads. Instance, device and
/// queue must come from that same loader. A host that links a loader statically must therefore give
/// its vkGetInstanceProcAddr; one that links libvulkan, or loads it as volk does, need not. Layers
/// see lobe's calls as they see the host's.

// ---------------------------------------------------------------------------------------------
// What lobe needs of a device

/// The Vulkan version that instance and device must support, and that VkApplicationInfo must
/// request.
#define LOBE_VULKAN_API_VERSION VK_API_VERSION_1_3

/// See "Devices".
typedef struct lobe_vulkan_device lobe_vulkan_device;

/// Features in the form that device creation takes.
typedef struct lobe_vulkan_features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan11Features vulkan_1_1;
    VkPhysicalDeviceVulkan12Features vulkan_1_2;
    VkPhysicalDeviceVulkan13Features vulkan_1_3;
} lobe_vulkan_features;

/// The features that lobe requires (`required`) or uses if present; `present` is always false here.
/// Static storage.
LOBE_API const lobe_device_feature *lobe_vulkan_feature_list(size_t *count);

/// Of a lobe_vulkan_device, the functions below read only `get_instance_proc_addr`, `instance` and
/// `physical_device`: the device need not exist yet.

/// Enables every feature of that list that the device has, in structures chained for
/// VkDeviceCreateInfo.pNext (`features->core` is the first). A host may enable further features in
/// them, and may append its own structures to `features->vulkan_1_3.pNext`. The structures point to
/// each other and must not be moved.
LOBE_API void lobe_vulkan_features_fill(const lobe_vulkan_device *host,
                                        lobe_vulkan_features *features);

/// A device extension that lobe uses.
typedef struct lobe_vulkan_extension {
    const char *name;
    const char *use; ///< what lobe does with it
    bool required;
} lobe_vulkan_extension;

/// Static storage. At present, all of them are optional.
LOBE_API const lobe_vulkan_extension *lobe_vulkan_extension_list(size_t *count);

/// Largest number of names that lobe_vulkan_extensions_fill returns.
#define LOBE_VULKAN_MAXIMUM_EXTENSIONS 4
/// The names of those extensions that the device has, for
/// VkDeviceCreateInfo.ppEnabledExtensionNames; returns their number. The names have static storage.
/// Returns 0 if out of memory; `allocator` (NULL: the C library's) is used during the call only.
LOBE_API uint32_t lobe_vulkan_extensions_fill(const lobe_vulkan_device *host,
                                              const lobe_allocator *allocator,
                                              const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS]);

/// The first queue family that lobe can use: one with both graphics and compute. UINT32_MAX if the
/// device has none.
LOBE_API uint32_t lobe_vulkan_queue_family(const lobe_vulkan_device *host);

/// Describes what lobe requires and a device lacks, one requirement per line: "feature
/// synchronization2 (barriers of the render graph)". `enabled`: what the host enabled or is going
/// to enable, as for lobe_vulkan_device; NULL: everything the device supports. Returns the number
/// of missing requirements; 0: lobe can use the device. `text` is cut to `size` bytes including the
/// terminating zero, and may be NULL if `size` is 0.
LOBE_API size_t lobe_vulkan_missing(const lobe_vulkan_device *host,
                                    const VkPhysicalDeviceFeatures2 *enabled, char *text,
                                    size_t size);

// ---------------------------------------------------------------------------------------------
// Devices

/// A device and the queue that lobe submits to.
struct lobe_vulkan_device {
    /// The loader that all handles come from. NULL: libvulkan.so.1.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance; ///< created for LOBE_VULKAN_API_VERSION or later
    VkPhysicalDevice physical_device;
    VkDevice device;
    uint32_t queue_family; ///< with graphics and compute; images and buffers of lobe belong to it
    VkQueue queue;         ///< of that family
    /// What was enabled when the device was created: the structures of VkDeviceCreateInfo; if it
    /// used pEnabledFeatures, those in `features`. Everything lobe requires must be enabled.
    /// Structures of other extensions are ignored. Needed during the call only.
    const VkPhysicalDeviceFeatures2 *features;
    const char *const *extensions; ///< enabled device extensions; needed during the call only
    uint32_t extension_count;
    bool debug_utils; ///< the instance has VK_EXT_debug_utils: lobe names its objects and passes
    /// Host memory for the driver, for every Vulkan object that lobe creates; called from any
    /// thread that calls lobe. Copied. NULL: the driver's own. lobe's own structures come from the
    /// allocator of the host in the parameters.
    const VkAllocationCallbacks *allocation_callbacks;
    /// Called around each use of the queue, so that host and lobe can share it: nobody else may use
    /// the queue in between. Called from any thread that calls lobe, never nested, and not held
    /// while lobe waits for the device (unless a submission failed). Set both or neither; NULL: the
    /// host never uses the queue during a call to lobe.
    void (*lock_queue)(void *user);
    void (*unlock_queue)(void *user);
    void *user; ///< passed to both
};

/// Creates a lobe device on a device of the host. lobe_device_destroy waits for lobe's submissions
/// and frees lobe's objects; instance, device and queue stay the host's and must live until then.
/// `parameters` may be NULL; its `select`, `validation` and `get_instance_proc_addr` must be empty,
/// as these are the host's choice.
/// Validation messages go to the host's messenger; lobe_device_validation_count stays 0.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (a handle or the features are missing, only one of the
/// callbacks is set), LOBE_ERROR_NO_DEVICE (the log says what the device or its loader lacks).
LOBE_API lobe_result lobe_vulkan_import_device(const lobe_vulkan_device *import,
                                               const lobe_device_parameters *parameters,
                                               lobe_device **device);

/// The handles of any lobe device, for a host that creates images on it or submits to its queue.
/// `features` and `extensions` are empty; the host must call `lock_queue` and `unlock_queue` with
/// `user` around its use of the queue. Everything belongs to the device and is valid as long as the
/// device exists.
LOBE_API void lobe_vulkan_export_device(lobe_device *device, lobe_vulkan_device *handles);

// ---------------------------------------------------------------------------------------------
// Images

/// An image of the host that a frame draws into or reads: see lobe_graph_import_image and
/// lobe_render_target. It must live until the device has finished the frame, and belong to the
/// queue family of the lobe device (or use concurrent sharing).
struct lobe_vulkan_image {
    const char *name;        ///< for errors, dumps and labels; copied; NULL: "host image"
    VkImage image;           ///< two-dimensional, one sample per texel
    VkFormat format;         ///< one that lobe_vulkan_format knows
    uint32_t width, height;  ///< texels of the level `first_level`
    uint32_t layers, levels; ///< how many of them frames use; 0 means 1
    /// From which on: a frame may draw into a layer of an array, such as one eye's, or into a level
    /// of a MIP chain. The layouts below are those of the part that is used; the rest of the image
    /// is left alone. One frame may import several parts of an image that have nothing in common.
    uint32_t first_layer, first_level;
    VkImageUsageFlags usage; ///< those it was created with; must allow what passes do with it
    /// Its layout when the frame starts. UNDEFINED: its content is not needed. The host's earlier
    /// work on the image must be ordered before the frame: by the submission's semaphores, or by
    /// coming earlier in the queue or in the command buffer, in which case lobe waits for all of
    /// it.
    VkImageLayout layout;
    /// Its layout after the frame (UNDEFINED: GENERAL), and the stages and kinds of access in which
    /// the host uses it next. Stages of 0: all stages and accesses.
    VkImageLayout final_layout;
    VkPipelineStageFlags2 final_stages;
    VkAccessFlags2 final_access;
    /// A two-dimensional view of the first level of the first layer, in the image's format and with
    /// all its usages; must live as long as the image. VK_NULL_HANDLE: lobe creates one in every
    /// frame.
    VkImageView view;
    /// Which content the image has when the frame starts: a number that the host changes whenever
    /// the host or a frame has written to the image, or another image may have taken over its
    /// handle. While it stays the same, what lobe made of the content is kept and not made again.
    /// 0: the content may be another one in every frame.
    uint64_t content;
};

/// A buffer of the host that a frame reads or writes: see lobe_graph_import_host_buffer. It must
/// live until the device has finished the frame, and belong to the queue family of the lobe device
/// (or use concurrent sharing). The host's earlier work on it must be ordered before the frame as
/// for images.
struct lobe_vulkan_buffer {
    const char *name; ///< for errors, dumps and labels; copied; NULL: "host buffer"
    VkBuffer buffer;
    /// Bytes; the offset is a multiple of 256, or of what the device requires of storage and
    /// uniform buffers.
    VkDeviceSize offset, size;
    VkBufferUsageFlags usage; ///< those it was created with; must allow what passes do with it
    /// The stages and kinds of access in which the host uses it next. Stages of 0: all stages and
    /// accesses.
    VkPipelineStageFlags2 final_stages;
    VkAccessFlags2 final_access;
    uint64_t content; ///< which content the range has when the frame starts: as of an image
};

/// lobe's equivalent of a format; LOBE_FORMAT_NONE if there is none.
LOBE_API lobe_format lobe_vulkan_format(VkFormat format);

// ---------------------------------------------------------------------------------------------
// Descriptors

/// A resource that a shader of the host reads, for its VkWriteDescriptorSet: see lobe_pass_export
/// and lobe_graph_exported.
struct lobe_vulkan_descriptor {
    uint32_t binding; ///< of the variable in lobe's shader
    VkDescriptorType type;
    VkDescriptorImageInfo image;   ///< of a COMBINED_IMAGE_SAMPLER: with the sampler that fits it
    VkDescriptorBufferInfo buffer; ///< of a UNIFORM_BUFFER or STORAGE_BUFFER
};

// ---------------------------------------------------------------------------------------------
// Submission

/// A semaphore that the queue waits for, or signals.
typedef struct lobe_vulkan_semaphore {
    VkSemaphore semaphore;
    uint64_t value;               ///< of a timeline semaphore; ignored for a binary one
    VkPipelineStageFlags2 stages; ///< that wait, or that must have finished; 0: all
} lobe_vulkan_semaphore;

/// Largest number of semaphores that one submission can wait for, and that it can signal.
#define LOBE_VULKAN_MAXIMUM_SEMAPHORES 8

/// How a frame is submitted, see lobe_graph_submit. All zero: lobe submits it to the device's
/// queue, without semaphores.
struct lobe_vulkan_submission {
    const lobe_vulkan_semaphore *waits;
    const lobe_vulkan_semaphore *signals;
    uint32_t wait_count, signal_count;
    /// If set, lobe records the frame into this command buffer, and the host submits it. It must be
    /// a primary command buffer of the lobe device's queue family, in the recording state and
    /// outside a render pass instance; there must be no semaphores then. Bound pipelines,
    /// descriptors and dynamic state are lost. The host submits it to lobe's queue, exactly once,
    /// before it begins the next frame of the same graph and before it changes textures or buffers
    /// that the frame reads (those of the graph itself it may change at once). lobe cannot wait for
    /// such frames: with N in flight, the one recorded N frames ago must have finished before the
    /// next begins.
    VkCommandBuffer commands;
};

#ifdef __cplusplus
}
#endif

#endif
