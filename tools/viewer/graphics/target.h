#ifndef TOOLS_VIEWER_GRAPHICS_TARGET_H
#define TOOLS_VIEWER_GRAPHICS_TARGET_H

#include "tools/viewer/graphics/device.h"

/// An image of linear radiance that lobe draws into and the viewer's own shader reads. All zero:
/// none.
typedef struct viewer_target {
    lobe_vulkan_image image; ///< in its state when a frame starts
    VkDeviceMemory memory;
} viewer_target;

/// Replaces the old image, which must be unused.
lobe_result viewer_target_renew(const viewer_device *device, uint32_t width, uint32_t height,
                                viewer_target *target);
void viewer_target_destroy(const viewer_device *device, viewer_target *target);

/// Marks that it holds a picture from now on, also for later commands of this frame.
void viewer_target_is_drawn(viewer_target *target);

#endif
