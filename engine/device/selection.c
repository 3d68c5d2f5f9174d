#include "engine/device/selection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/device/features.h"
#include "engine/device/vulkan_check.h"

// ---------------------------------------------------------------------------------------------
// Describing

static lobe_device_type type_of(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return LOBE_DEVICE_INTEGRATED_GPU;
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return LOBE_DEVICE_DISCRETE_GPU;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return LOBE_DEVICE_VIRTUAL_GPU;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return LOBE_DEVICE_CPU;
    default:
        return LOBE_DEVICE_OTHER;
    }
}

#define MAXIMUM_FAMILIES 32

bool engine_queue_family_serves(const engine_instance_api *api, VkPhysicalDevice physical,
                                uint32_t family, uint32_t *timestamp_bits) {
    const VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    VkQueueFamilyProperties families[MAXIMUM_FAMILIES];
    uint32_t count = MAXIMUM_FAMILIES;
    api->vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    if (family >= count || (families[family].queueFlags & wanted) != wanted)
        return false;
    *timestamp_bits = families[family].timestampValidBits;
    return true;
}

uint32_t engine_queue_family_find(const engine_instance_api *api, VkPhysicalDevice physical,
                                  uint32_t *timestamp_bits) {
    *timestamp_bits = 0;
    for (uint32_t family = 0; family < MAXIMUM_FAMILIES; family++)
        if (engine_queue_family_serves(api, physical, family, timestamp_bits))
            return family;
    return UINT32_MAX;
}

static uint64_t device_local_bytes(const engine_instance_api *api, VkPhysicalDevice physical) {
    VkPhysicalDeviceMemoryProperties memory;
    api->vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; i++)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT &&
            memory.memoryHeaps[i].size > bytes)
            bytes = memory.memoryHeaps[i].size;
    return bytes;
}

static bool filters_float32(const engine_instance_api *api, VkPhysicalDevice physical) {
    VkFormatProperties properties;
    api->vkGetPhysicalDeviceFormatProperties(physical, VK_FORMAT_R32G32B32A32_SFLOAT, &properties);
    return properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
}

static void describe_driver(const VkPhysicalDeviceProperties *properties,
                            const VkPhysicalDeviceDriverProperties *driver,
                            lobe_device_information *information) {
    if (driver->driverName[0])
        snprintf(information->driver, sizeof information->driver, "%s %s", driver->driverName,
                 driver->driverInfo);
    else // drivers older than Vulkan 1.2 do not fill in the structure
        snprintf(information->driver, sizeof information->driver, "version %u",
                 properties->driverVersion);
}

static void describe(const engine_instance_api *api, engine_candidate *candidate) {
    VkPhysicalDeviceDriverProperties driver = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
    };
    VkPhysicalDeviceProperties2 properties2 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
        .pNext = &driver,
    };
    api->vkGetPhysicalDeviceProperties2(candidate->physical, &properties2);
    const VkPhysicalDeviceProperties *properties = &properties2.properties;
    lobe_device_information *information = &candidate->information;
    snprintf(information->name, sizeof information->name, "%s", properties->deviceName);
    describe_driver(properties, &driver, information);
    information->type = type_of(properties->deviceType);
    information->vulkan_major = VK_API_VERSION_MAJOR(properties->apiVersion);
    information->vulkan_minor = VK_API_VERSION_MINOR(properties->apiVersion);
    information->vulkan_patch = VK_API_VERSION_PATCH(properties->apiVersion);
    information->maximum_image_extent = properties->limits.maxImageDimension2D;
    information->maximum_colour_outputs = properties->limits.maxColorAttachments;
    information->memory_bytes = device_local_bytes(api, candidate->physical);
    information->linear_filter_float32 = filters_float32(api, candidate->physical);
    candidate->queue_family =
        engine_queue_family_find(api, candidate->physical, &candidate->timestamp_bits);
    if (candidate->timestamp_bits)
        information->timestamp_period = properties->limits.timestampPeriod;
}

static bool describe_features(const engine_instance_api *api, engine_candidate *candidate,
                              const lobe_allocator *allocator) {
    lobe_device_feature *features =
        lobe_allocate(allocator, ENGINE_FEATURE_COUNT, sizeof *features);
    if (!features)
        return false;
    engine_features_query(api, candidate->physical, features);
    candidate->information.features = features;
    candidate->information.feature_count = ENGINE_FEATURE_COUNT;
    return true;
}

lobe_result engine_candidate_describe(const engine_instance_api *api, VkPhysicalDevice physical,
                                      const lobe_host *host, engine_candidate *candidate) {
    *candidate = (engine_candidate){.physical = physical};
    describe(api, candidate);
    return describe_features(api, candidate, lobe_host_allocator(host))
               ? LOBE_OK
               : lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "device '%s': out of memory",
                                candidate->information.name);
}

// ---------------------------------------------------------------------------------------------
// Listing

void engine_candidates_free(engine_candidate **candidates, size_t count) {
    for (size_t i = 0; *candidates && i < count; i++)
        lobe_release((void *)(*candidates)[i].information.features);
    lobe_release(*candidates);
    *candidates = NULL;
}

static lobe_result describe_all(const engine_instance_api *api, const VkPhysicalDevice *physical,
                                size_t count, const lobe_host *host,
                                engine_candidate **candidates) {
    const lobe_allocator *allocator = lobe_host_allocator(host);
    *candidates = lobe_allocate(allocator, count, sizeof **candidates);
    bool complete = *candidates != NULL;
    for (size_t i = 0; complete && i < count; i++) {
        (*candidates)[i].physical = physical[i];
        describe(api, &(*candidates)[i]);
        complete = describe_features(api, &(*candidates)[i], allocator);
    }
    if (complete)
        return LOBE_OK;
    engine_candidates_free(candidates, count);
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "out of memory listing Vulkan devices");
}

lobe_result engine_candidates_list(const engine_instance *instance, const lobe_host *host,
                                   engine_candidate **candidates, size_t *count) {
    *candidates = NULL;
    *count = 0;
    const engine_instance_api *api = &instance->api;
    VkPhysicalDevice physical[64];
    uint32_t found = sizeof physical / sizeof *physical;
    const lobe_result result =
        VULKAN_CHECK(host, api->vkEnumeratePhysicalDevices(instance->vulkan, &found, physical),
                     "Vulkan devices");
    if (result != LOBE_OK)
        return result;
    if (found == 0)
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE,
                              "no Vulkan device: no driver reports one on this machine");
    *count = found;
    return describe_all(api, physical, found, host, candidates);
}

// ---------------------------------------------------------------------------------------------
// Selecting

static bool is_recent(const lobe_device_information *information) {
    return information->vulkan_major > 1 || information->vulkan_minor >= 3;
}

static bool is_suited(const engine_candidate *candidate) {
    return is_recent(&candidate->information) && candidate->queue_family != UINT32_MAX &&
           !engine_features_missing(candidate->information.features);
}

static lobe_result fail_unsuited(const engine_candidate *candidate, const lobe_host *host) {
    const lobe_device_information *information = &candidate->information;
    if (!is_recent(information))
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE,
                              "device '%s' offers Vulkan %u.%u, 1.3 is required", information->name,
                              information->vulkan_major, information->vulkan_minor);
    if (candidate->queue_family == UINT32_MAX)
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE,
                              "device '%s' has no queue with both graphics and compute",
                              information->name);
    const lobe_device_feature *missing = engine_features_missing(information->features);
    return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE, "device '%s' lacks the feature %s (%s)",
                          information->name, missing->name, missing->use);
}

static int rank(lobe_device_type type) {
    static const int ranks[] = {
        [LOBE_DEVICE_OTHER] = 0,        [LOBE_DEVICE_CPU] = 1,
        [LOBE_DEVICE_VIRTUAL_GPU] = 2,  [LOBE_DEVICE_INTEGRATED_GPU] = 3,
        [LOBE_DEVICE_DISCRETE_GPU] = 4,
    };
    return ranks[type];
}

static bool is_preferred(const engine_candidate *candidate, const engine_candidate *to) {
    if (is_suited(candidate) != is_suited(to))
        return is_suited(candidate);
    return rank(candidate->information.type) > rank(to->information.type);
}

/// Reads `select` as the index of one of `count` devices; returns `count` if it is not one.
static size_t index_in(const char *select, size_t count) {
    char *end;
    const unsigned long number = strtoul(select, &end, 10);
    const bool is_number = select[0] >= '0' && select[0] <= '9' && *end == '\0';
    return is_number && number < count ? number : count;
}

/// Matches an index by position and any other text ("llvmpipe", "4090") by part of the name.
static bool matches(const engine_candidate *candidates, size_t count, size_t i,
                    const char *select) {
    if (!select)
        return true;
    const size_t index = index_in(select, count);
    return index < count ? index == i : strcasestr(candidates[i].information.name, select) != NULL;
}

lobe_result engine_candidates_select(const engine_candidate *candidates, size_t count,
                                     const char *select, const lobe_host *host, size_t *selected) {
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < count; i++)
        if (matches(candidates, count, i, select) &&
            (best == SIZE_MAX || is_preferred(&candidates[i], &candidates[best])))
            best = i;
    if (best == SIZE_MAX)
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE,
                              "no Vulkan device matches '%s' (%zu found, the first is '%s')",
                              select, count, candidates[0].information.name);
    if (!is_suited(&candidates[best]))
        return fail_unsuited(&candidates[best], host);
    *selected = best;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Public

const char *lobe_device_type_name(lobe_device_type type) {
    switch (type) {
    case LOBE_DEVICE_INTEGRATED_GPU:
        return "integrated GPU";
    case LOBE_DEVICE_DISCRETE_GPU:
        return "discrete GPU";
    case LOBE_DEVICE_VIRTUAL_GPU:
        return "virtual GPU";
    case LOBE_DEVICE_CPU:
        return "CPU";
    default:
        return "other device";
    }
}
