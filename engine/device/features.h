#ifndef ENGINE_DEVICE_FEATURES_H
#define ENGINE_DEVICE_FEATURES_H

#include <stddef.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>
#include <lobe/vulkan.h>

#include "engine/device/vulkan_functions.h"

#define ENGINE_FEATURE_COUNT 12

/// Fills the list of what lobe knows about from what the device has. The device may be older than
/// Vulkan 1.3: what its version lacks is absent.
void engine_features_query(const engine_instance_api *api, VkPhysicalDevice physical,
                           lobe_device_feature features[ENGINE_FEATURE_COUNT]);

/// The same list from what a host turned on: a chain as for lobe_vulkan_device.
void engine_features_read(const VkPhysicalDeviceFeatures2 *enabled,
                          lobe_device_feature features[ENGINE_FEATURE_COUNT]);

/// The structures that enable all features of the list that are present, chained for
/// VkDeviceCreateInfo.pNext; `enable` must stay where it is while they are used.
void engine_features_enable(const lobe_device_feature features[ENGINE_FEATURE_COUNT],
                            lobe_vulkan_features *enable);

/// As lobe_vulkan_extensions_fill; LOBE_ERROR_OUT_OF_MEMORY.
lobe_result engine_extensions_fill(const engine_instance_api *api, VkPhysicalDevice physical,
                                   const lobe_host *host,
                                   const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS],
                                   uint32_t *filled);

/// The first that is required but absent; NULL where nothing is missing.
const lobe_device_feature *
engine_features_missing(const lobe_device_feature features[ENGINE_FEATURE_COUNT]);

#endif
