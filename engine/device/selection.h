#ifndef ENGINE_DEVICE_SELECTION_H
#define ENGINE_DEVICE_SELECTION_H

#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

#include "engine/device/instance.h"

/// A Vulkan device of this machine.
typedef struct engine_candidate {
    VkPhysicalDevice physical;
    /// `features` is allocated; free with engine_candidates_free.
    lobe_device_information information;
    uint32_t queue_family; ///< with graphics and compute; UINT32_MAX: none
    uint32_t timestamp_bits;
} engine_candidate;

/// Whether a queue family has both graphics and compute; if so, gives the valid bits of its
/// timestamps.
bool engine_queue_family_serves(const engine_instance_api *api, VkPhysicalDevice physical,
                                uint32_t family, uint32_t *timestamp_bits);
/// Returns the first such family; UINT32_MAX (and 0 bits) if there is none.
uint32_t engine_queue_family_find(const engine_instance_api *api, VkPhysicalDevice physical,
                                  uint32_t *timestamp_bits);

/// Describes one device. Release `candidate->information.features` with lobe_release.
lobe_result engine_candidate_describe(const engine_instance_api *api, VkPhysicalDevice physical,
                                      const lobe_host *host, engine_candidate *candidate);

/// Lists all devices. Errors: LOBE_ERROR_NO_DEVICE (none found), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result engine_candidates_list(const engine_instance *instance, const lobe_host *host,
                                   engine_candidate **candidates, size_t *count);
void engine_candidates_free(engine_candidate **candidates, size_t count);

/// Gives the index of the device that `select` (see lobe_device_parameters) asks for.
/// LOBE_ERROR_NO_DEVICE: nothing matches, or what matches lacks something required.
lobe_result engine_candidates_select(const engine_candidate *candidates, size_t count,
                                     const char *select, const lobe_host *host, size_t *selected);

#endif
