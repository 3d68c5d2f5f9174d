#ifndef ENGINE_RESOURCE_UPLOAD_H
#define ENGINE_RESOURCE_UPLOAD_H

#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

/// Maximum number of bytes of mapped memory that an upload uses at a time. Larger uploads take
/// several steps, so that a large texture does not need twice its size.
#define ENGINE_UPLOAD_STEP ((VkDeviceSize)16 << 20)

/// Fills a buffer (with zeros if `data` is NULL) and makes the content visible to every later
/// submission. Waits for the device.
lobe_result engine_upload_buffer(lobe_device *device, const char *name, VkBuffer buffer,
                                 VkDeviceSize size, const void *data);

/// Fills level 0 of a single-layer colour image, rows tightly packed, and leaves it in
/// SHADER_READ_ONLY_OPTIMAL layout, visible to every later submission. Waits for the device.
lobe_result engine_upload_image(lobe_device *device, const char *name, VkImage image,
                                const lobe_image *content);

#endif
