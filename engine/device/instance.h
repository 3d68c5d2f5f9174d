#ifndef ENGINE_DEVICE_INSTANCE_H
#define ENGINE_DEVICE_INSTANCE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "engine/device/vulkan_functions.h"

/// All zero: none.
typedef struct engine_instance {
    VkInstance vulkan;
    engine_instance_api api;
    VkDebugUtilsMessengerEXT messenger; ///< only with validation
    bool debug_utils;                   ///< VK_EXT_debug_utils is enabled
} engine_instance;

/// Where validation messages go.
typedef struct engine_validation {
    const lobe_host *host;
    _Atomic uint64_t *count; ///< of warnings and errors
} engine_validation;

typedef struct engine_instance_parameters {
    PFN_vkGetInstanceProcAddr get_instance_proc_addr; ///< NULL: that of libvulkan.so.1
    /// Turns the validation layer on; must outlive the instance. NULL: off.
    const engine_validation *validation;
    const char *const *extensions; ///< required ones, such as those of a window's surface
    uint32_t extension_count;
} engine_instance_parameters;

/// Errors: LOBE_ERROR_NO_DEVICE (no loader, no driver, or Vulkan older than 1.3),
/// LOBE_ERROR_UNSUPPORTED (no validation layer).
lobe_result engine_instance_create(const lobe_host *host,
                                   const engine_instance_parameters *parameters,
                                   engine_instance *instance);
void engine_instance_destroy(engine_instance *instance);

#endif
