#ifndef TOOLS_VIEWER_GRAPHICS_DEVICE_H
#define TOOLS_VIEWER_GRAPHICS_DEVICE_H

#include <stdatomic.h>

#include <lobe/vulkan.h>

#include "engine/device/instance.h"
#include "tools/cli/device_options.h"

struct GLFWwindow;

/// The viewer's own Vulkan objects, which lobe imports: an instance with window surfaces, a
/// surface, and a device that presents to it. All zero: none.
typedef struct viewer_device {
    engine_validation validation;
    _Atomic uint64_t fault_count; ///< messages of the validation layer
    lobe_host host;
    engine_instance instance;
    VkSurfaceKHR surface;
    lobe_vulkan_device vulkan;
    lobe_device *lobe;
} viewer_device;

/// The structure must not be moved until it is closed. On failure it is closed. Errors:
/// LOBE_ERROR_NO_DEVICE, LOBE_ERROR_UNSUPPORTED (the device cannot present here),
/// LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result viewer_device_open(const device_options *options, struct GLFWwindow *window,
                               const lobe_host *host, viewer_device *device);
/// Waits for work in flight. All zero is allowed.
void viewer_device_close(viewer_device *device);

/// Replaces a lost surface of the window.
lobe_result viewer_device_renew_surface(viewer_device *device, struct GLFWwindow *window);

#endif
