#ifndef TOOLS_VIEWER_GRAPHICS_SWAPCHAIN_H
#define TOOLS_VIEWER_GRAPHICS_SWAPCHAIN_H

#include <stdbool.h>

#include "tools/viewer/graphics/device.h"

#define VIEWER_MAXIMUM_IMAGES 16

/// The images of a window. One frame is in flight at a time. All zero: none.
typedef struct viewer_swapchain {
    VkSwapchainKHR swapchain;
    VkFormat format;
    uint32_t width, height; ///< pixels
    uint32_t count;
    VkImage images[VIEWER_MAXIMUM_IMAGES];
    VkSemaphore drawn[VIEWER_MAXIMUM_IMAGES]; ///< of each: it may be shown
    VkSemaphore acquired;                     ///< the one acquired last may be drawn into
    uint32_t current;                         ///< that one
    bool fits;                                ///< an image was presented without being suboptimal
    bool fits_badly; ///< the surface reported the one acquired last as suboptimal
} viewer_swapchain;

/// Result of showing a frame, or of preparing for it.
typedef enum viewer_shown {
    VIEWER_SHOWN,
    VIEWER_BUSY,         ///< the window accepts no image now: it may be covered
    VIEWER_OUT_OF_DATE,  ///< the window has changed: recreate the swapchain
    VIEWER_SURFACE_LOST, ///< recreate the surface, too
    VIEWER_FAILED,       ///< the log says why
} viewer_shown;

/// Creates a swapchain of about this size in place of the old one, whose images must be unused. If
/// the window has no size now (it is minimised) there is none, and `count` is 0.
viewer_shown viewer_swapchain_renew(const viewer_device *device, uint32_t width, uint32_t height,
                                    viewer_swapchain *swapchain, lobe_result *result);
void viewer_swapchain_destroy(const viewer_device *device, viewer_swapchain *swapchain);

/// Acquires the next image, waiting for a short time.
viewer_shown viewer_swapchain_acquire(const viewer_device *device, viewer_swapchain *swapchain,
                                      lobe_result *result);
/// Shows it, once its semaphore `drawn` is signalled.
viewer_shown viewer_swapchain_present(const viewer_device *device, viewer_swapchain *swapchain,
                                      lobe_result *result);

#endif
