#ifndef LOBE_VULKAN_H
#define LOBE_VULKAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/allocator.h>
#include <lobe/device.h>
#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// lobe inside a program that has Vulkan of its own: its device, its images, its semaphores. The
/// one header of lobe that speaks of Vulkan; lobe/lobe.h does not bring it.
///
/// lobe refers to no function of Vulkan by name: it asks the host's vkGetInstanceProcAddr for them,
/// or, where the host gives none, that of libvulkan.so.1, which it loads. Instance, device and
/// queue must come from that same loader. A host that links a loader statically therefore gives its
/// vkGetInstanceProcAddr; one that links libvulkan, or loads it as volk does, need not. Layers see
/// what lobe does as they see what the host does.

// ---------------------------------------------------------------------------------------------
// What lobe needs of a device

/// The version of Vulkan that instance and device must offer, and VkApplicationInfo ask for.
#define LOBE_VULKAN_API_VERSION VK_API_VERSION_1_3

/// See "Devices".
typedef struct lobe_vulkan_device lobe_vulkan_device;

/// Features in the form in which devices are asked for them.
typedef struct lobe_vulkan_features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan11Features vulkan_1_1;
    VkPhysicalDeviceVulkan12Features vulkan_1_2;
    VkPhysicalDeviceVulkan13Features vulkan_1_3;
} lobe_vulkan_features;

/// The features that lobe requires or makes use of, as a list: `required` says which, `present` is
/// false. Static storage.
const lobe_device_feature *lobe_vulkan_feature_list(size_t *count);

/// Where the functions below take a lobe_vulkan_device, they read its `get_instance_proc_addr`,
/// `instance` and `physical_device` only: the device need not have been made.

/// Turns on whatever of that list the device has, in structures chained for
/// VkDeviceCreateInfo.pNext (`features->core` is the first). A host turns on what it needs itself
/// beside these, and may append its own structures to `features->vulkan_1_3.pNext`. The structures
/// point to one another: they must stay where they are.
void lobe_vulkan_features_fill(const lobe_vulkan_device *host, lobe_vulkan_features *features);

/// A device extension that lobe makes use of.
typedef struct lobe_vulkan_extension {
    const char *name;
    const char *use; ///< what lobe does with it
    bool required;
} lobe_vulkan_extension;

/// Static storage. At present there are recommended ones alone.
const lobe_vulkan_extension *lobe_vulkan_extension_list(size_t *count);

/// Most names that lobe_vulkan_extensions_fill gives.
#define LOBE_VULKAN_MAXIMUM_EXTENSIONS 4
/// The names of those the device has, for VkDeviceCreateInfo.ppEnabledExtensionNames; returns how
/// many. Static storage. There are none without memory, which `allocator` gives for the call; NULL:
/// the C library's.
uint32_t lobe_vulkan_extensions_fill(const lobe_vulkan_device *host,
                                     const lobe_allocator *allocator,
                                     const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS]);

/// The first queue family that serves lobe: one with both graphics and compute. UINT32_MAX where
/// the device has none.
uint32_t lobe_vulkan_queue_family(const lobe_vulkan_device *host);

/// Says in words what lobe requires and a device lacks, one thing a line: "feature
/// synchronization2 (barriers of the render graph)". `enabled`: what the host turned on, or is
/// about to, as for lobe_vulkan_device; NULL: what the device itself offers is looked at.
/// Returns how many things are missing; 0: the device serves. `text` is cut to `size` bytes with
/// the zero at its end, and may be NULL where `size` is 0.
size_t lobe_vulkan_missing(const lobe_vulkan_device *host, const VkPhysicalDeviceFeatures2 *enabled,
                           char *text, size_t size);

// ---------------------------------------------------------------------------------------------
// Devices

/// A device with the queue that lobe submits to.
struct lobe_vulkan_device {
    /// The loader that all handles come from. NULL: libvulkan.so.1.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance; ///< made for LOBE_VULKAN_API_VERSION or later
    VkPhysicalDevice physical_device;
    VkDevice device;
    uint32_t queue_family; ///< with graphics and compute; images and buffers of lobe belong to it
    VkQueue queue;         ///< of that family
    /// What was turned on when the device was created: the structures of VkDeviceCreateInfo, with
    /// pEnabledFeatures, where that was used, in `features`. All that lobe requires must be on.
    /// Structures of other extensions are passed over. Needed during the call only.
    const VkPhysicalDeviceFeatures2 *features;
    const char *const *extensions; ///< device extensions that were turned on; during the call only
    uint32_t extension_count;
    bool debug_utils; ///< the instance has VK_EXT_debug_utils: lobe names its objects and passes
    /// Where the driver is to get the host's memory for all that lobe makes of Vulkan, from
    /// whatever thread lobe is called from; copied. NULL: wherever it likes. lobe's own structures
    /// come from the allocator of the log in the parameters.
    const VkAllocationCallbacks *allocation_callbacks;
    /// Called around each use of the queue, so that host and lobe can share it: nobody else may
    /// use the queue in between. Called from whatever thread lobe is called from, and never nested.
    /// Both or neither; NULL: the host uses the queue only where lobe is not being called.
    void (*lock_queue)(void *user);
    void (*unlock_queue)(void *user);
    void *user; ///< handed to both
};

/// Makes a lobe device of a host's. lobe_device_destroy waits for lobe's submissions and frees
/// what is lobe's; instance, device and queue stay as they are, and must live until then.
/// `parameters` may be NULL; `select`, `validation` and
/// `get_instance_proc_addr` are the host's business and must be empty.
/// Validation messages go to the host's messenger; lobe_device_validation_count stays 0.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (a handle or the features are missing, one callback without
/// the other), LOBE_ERROR_NO_DEVICE (the log line says what the device or its loader lacks).
lobe_result lobe_vulkan_import_device(const lobe_vulkan_device *import,
                                      const lobe_device_parameters *parameters,
                                      lobe_device **device);

/// The handles of any lobe device, for a host that makes images on it or submits to its queue.
/// `features` and `extensions` are empty; `lock_queue`, `unlock_queue` and `user` must be called
/// around the host's use of the queue. All belong to the device and live as long.
void lobe_vulkan_export_device(lobe_device *device, lobe_vulkan_device *handles);

// ---------------------------------------------------------------------------------------------
// Images

/// An image of the host's that a frame draws into or reads: see lobe_graph_import_image and
/// lobe_render_target. It must be alive until the device has finished the frame, and belong to the
/// queue family of the lobe device (or be shared by all).
struct lobe_vulkan_image {
    const char *name;        ///< for errors, dumps and labels; copied; NULL: "host image"
    VkImage image;           ///< two-dimensional, one sample a texel
    VkFormat format;         ///< one of which lobe_vulkan_format knows the name
    uint32_t width, height;  ///< texels of level 0
    uint32_t layers, levels; ///< 0 means 1
    VkImageUsageFlags usage; ///< it was created with; must allow what passes do with it
    /// What it is in when the frame starts. UNDEFINED: its content is not needed. The host's work
    /// on the image must be done by then: ordered before by the submission's semaphores, or by
    /// coming earlier in the queue or in the command buffer, where lobe waits for all of it.
    VkImageLayout layout;
    /// What to leave it in, ready for the host's use of it in these stages, with these kinds of
    /// access. UNDEFINED: GENERAL. Stages and access of 0: all, where a semaphore does not say.
    VkImageLayout final_layout;
    VkPipelineStageFlags2 final_stages;
    VkAccessFlags2 final_access;
    /// Two-dimensional, of level 0 of layer 0, in the image's format and with all its usages; alive
    /// as long as the image must be. VK_NULL_HANDLE: lobe makes one in every frame.
    VkImageView view;
};

/// lobe's name of a format; LOBE_FORMAT_NONE where it has none.
lobe_format lobe_vulkan_format(VkFormat format);

// ---------------------------------------------------------------------------------------------
// Submission

/// A moment that the queue waits for, or makes known.
typedef struct lobe_vulkan_semaphore {
    VkSemaphore semaphore;
    uint64_t value;               ///< of a timeline semaphore; a binary one has none
    VkPipelineStageFlags2 stages; ///< that wait, or have to be done; 0: all
} lobe_vulkan_semaphore;

/// Most semaphores that one submission waits for, and that it signals.
#define LOBE_VULKAN_MAXIMUM_SEMAPHORES 8

/// How a frame gets to the device: see lobe_graph_submit. All zero: lobe submits it to the
/// device's queue.
struct lobe_vulkan_submission {
    const lobe_vulkan_semaphore *waits;
    const lobe_vulkan_semaphore *signals;
    uint32_t wait_count, signal_count;
    /// Where given, the frame is recorded here and the host submits it: a primary command buffer
    /// in recording state, outside of any rendering, of the queue family of the lobe device; there
    /// are no semaphores then. Bound pipelines, descriptors and dynamic state are lost. The host
    /// submits it to lobe's queue before the next frame of the same graph is begun and before it
    /// changes textures or buffers that the frame reads; once only.
    VkCommandBuffer commands;
};

#ifdef __cplusplus
}
#endif

#endif
