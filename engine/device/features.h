#ifndef ENGINE_DEVICE_FEATURES_H
#define ENGINE_DEVICE_FEATURES_H

#include <stddef.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>
#include <lobe/vulkan.h>

#include "engine/device/vulkan_functions.h"

#define ENGINE_FEATURE_COUNT 12

/// Lists the features that lobe knows and whether the device has them. The device may be older than
/// Vulkan 1.3; features that its version lacks count as absent.
void engine_features_query(const engine_instance_api *api, VkPhysicalDevice physical,
                           lobe_device_feature features[ENGINE_FEATURE_COUNT]);

/// The same list, from what a host enabled: a chain as in lobe_vulkan_device.
void engine_features_read(const VkPhysicalDeviceFeatures2 *enabled,
                          lobe_device_feature features[ENGINE_FEATURE_COUNT]);

/// Fills in structures that enable all features present in the list, chained for
/// VkDeviceCreateInfo.pNext. They point to one another: `enable` must not move while in use.
void engine_features_enable(const lobe_device_feature features[ENGINE_FEATURE_COUNT],
                            lobe_vulkan_features *enable);

/// As lobe_vulkan_extensions_fill; LOBE_ERROR_OUT_OF_MEMORY.
lobe_result engine_extensions_fill(const engine_instance_api *api, VkPhysicalDevice physical,
                                   const lobe_host *host,
                                   const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS],
                                   uint32_t *filled);

/// Returns the first required feature that is absent; NULL if none is.
const lobe_device_feature *
engine_features_missing(const lobe_device_feature features[ENGINE_FEATURE_COUNT]);

#endif
