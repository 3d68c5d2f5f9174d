#ifndef TESTS_ENGINE_SUPPORT_HOST_DEVICE_H
#define TESTS_ENGINE_SUPPORT_HOST_DEVICE_H

#include <lobe/vulkan.h>

#include "tests/engine/support/log_recorder.h"

/// The loader of every device that the tests open; NULL: libvulkan's. vulkan_faults.c sets its own.
extern PFN_vkGetInstanceProcAddr test_vulkan_loader;

/// A program that uses Vulkan itself, under the validation layer, and lets lobe use its device.
typedef struct host_device {
    log_recorder recorder;     ///< of lobe
    lobe_vulkan_device vulkan; ///< with everything that lobe can use, but no callbacks
    lobe_vulkan_features features;
    const char *extensions[LOBE_VULKAN_MAXIMUM_EXTENSIONS];
    VkDebugUtilsMessengerEXT messenger;
    VkCommandPool pool;
    uint64_t mistakes; ///< messages of the validation layer
    char last_mistake[16384];
} host_device;

/// Asserts that everything succeeds. The structure must not be moved.
void host_device_open(host_device *host);
/// The same without the validation layer, whose memory grows with each call.
void host_device_open_unvalidated(host_device *host);
/// Asserts that the validation layer reported nothing.
void host_device_close(host_device *host);

/// Imports it, and asserts that this succeeds.
lobe_device *host_device_import(host_device *host);

/// An image with its own memory.
typedef struct host_image {
    VkImage image;
    VkDeviceMemory memory;
    VkFormat format;
    uint32_t width, height;
    uint32_t layer, level; ///< the part that the functions below use
} host_image;

host_image host_image_create(const host_device *host, VkFormat format, uint32_t width,
                             uint32_t height, VkImageUsageFlags usage);
/// The same with several layers and levels; its part is the first of both.
host_image host_image_create_array(const host_device *host, VkFormat format, uint32_t width,
                                   uint32_t height, uint32_t layers, uint32_t levels,
                                   VkImageUsageFlags usage);
void host_image_destroy(const host_device *host, host_image *image);

/// A buffer with its own memory.
typedef struct host_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
} host_buffer;

host_buffer host_buffer_create(const host_device *host, VkDeviceSize size,
                               VkBufferUsageFlags usage);
void host_buffer_destroy(const host_device *host, host_buffer *buffer);

/// A command buffer in recording state.
VkCommandBuffer host_begin(const host_device *host);
/// Ends, submits, waits and frees it.
void host_finish(const host_device *host, VkCommandBuffer commands);
/// Makes everything before visible to everything after, and changes the layout of an image
/// (colour or depth, by its format).
void host_barrier(VkCommandBuffer commands, const host_image *image, VkImageLayout from,
                  VkImageLayout to);
/// Fills an image in TRANSFER_DST_OPTIMAL with a colour.
void host_clear(VkCommandBuffer commands, const host_image *image, const float colour[4]);
/// Writes bytes, multiples of four, into a buffer that has TRANSFER_DST.
void host_write(VkCommandBuffer commands, const host_buffer *buffer, VkDeviceSize offset,
                const void *data, VkDeviceSize size);
/// Copies `size` bytes of texels from an image in TRANSFER_SRC_OPTIMAL; waits for it.
void host_read(const host_device *host, const host_image *image, void *texels, size_t size);

/// A semaphore; `timeline`: one that counts from 0.
VkSemaphore host_semaphore(const host_device *host, bool timeline);

#endif
