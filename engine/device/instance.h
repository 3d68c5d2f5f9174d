#ifndef ENGINE_DEVICE_INSTANCE_H
#define ENGINE_DEVICE_INSTANCE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// Vulkan's loader, opened. All zero: none.
typedef struct engine_instance {
    VkInstance vulkan;
    VkDebugUtilsMessengerEXT messenger; ///< only with validation
    bool debug_utils;
} engine_instance;

/// Where validation messages go.
typedef struct engine_validation {
    const lobe_host *host;
    _Atomic uint64_t *count; ///< of warnings and errors
} engine_validation;

/// `validation` turns the validation layer on; it must outlive the instance. NULL: off.
/// Errors: LOBE_ERROR_NO_DEVICE (no driver, or Vulkan older than 1.3),
/// LOBE_ERROR_UNSUPPORTED (no validation layer).
lobe_result engine_instance_create(const lobe_host *host, const engine_validation *validation,
                                   engine_instance *instance);
/// The same with extensions that the loader must have: those of a window's surface.
lobe_result engine_instance_create_with(const lobe_host *host, const engine_validation *validation,
                                        const char *const *extensions, uint32_t extension_count,
                                        engine_instance *instance);
void engine_instance_destroy(engine_instance *instance);

#endif
