#include <lobe/vulkan.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "engine/device/features.h"
#include "engine/device/selection.h"

// ---------------------------------------------------------------------------------------------
// Extensions

static const lobe_vulkan_extension known[] = {
    {VK_EXT_MEMORY_BUDGET_EXTENSION_NAME, "detecting how much memory is available", false},
};
#define KNOWN_COUNT (sizeof known / sizeof *known)

_Static_assert(KNOWN_COUNT <= LOBE_VULKAN_MAXIMUM_EXTENSIONS, "names of all must fit");

const lobe_vulkan_extension *lobe_vulkan_extension_list(size_t *count) {
    if (!count)
        return known;
    *count = KNOWN_COUNT;
    return known;
}

static bool has_extension(const VkExtensionProperties *extensions, uint32_t count,
                          const char *name) {
    for (uint32_t i = 0; i < count; i++)
        if (!strcmp(extensions[i].extensionName, name))
            return true;
    return false;
}

lobe_result engine_extensions_fill(const engine_instance_api *api, VkPhysicalDevice physical,
                                   const lobe_host *host,
                                   const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS],
                                   uint32_t *filled) {
    uint32_t count = 0;
    *filled = 0;
    if (api->vkEnumerateDeviceExtensionProperties(physical, NULL, &count, NULL) != VK_SUCCESS)
        return LOBE_OK;
    VkExtensionProperties *extensions =
        lobe_allocate(lobe_host_allocator(host), count, sizeof *extensions);
    if (!extensions)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                              "out of memory listing a device's extensions");
    if (api->vkEnumerateDeviceExtensionProperties(physical, NULL, &count, extensions) >= VK_SUCCESS)
        for (size_t i = 0; i < KNOWN_COUNT; i++)
            if (has_extension(extensions, count, known[i].name))
                names[(*filled)++] = known[i].name;
    lobe_release(extensions);
    return LOBE_OK;
}

/// Loads the instance functions for the helpers below; false if there is no loader.
static bool load_functions(const lobe_vulkan_device *host, engine_instance_api *api) {
    return engine_loader_open(NULL, host->get_instance_proc_addr, api) == LOBE_OK &&
           engine_instance_api_load(NULL, host->instance, false, api) == LOBE_OK;
}

uint32_t lobe_vulkan_extensions_fill(const lobe_vulkan_device *host,
                                     const lobe_allocator *allocator,
                                     const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS]) {
    if (!host || !names)
        return 0;
    const lobe_host silent = {.allocator = allocator};
    engine_instance_api api;
    uint32_t filled = 0;
    if (load_functions(host, &api))
        (void)engine_extensions_fill(&api, host->physical_device, &silent, names, &filled);
    return filled;
}

// ---------------------------------------------------------------------------------------------
// Features and queues

void lobe_vulkan_features_fill(const lobe_vulkan_device *host, lobe_vulkan_features *features) {
    if (!host || !features)
        return;
    lobe_device_feature present[ENGINE_FEATURE_COUNT];
    engine_instance_api api;
    if (load_functions(host, &api))
        engine_features_query(&api, host->physical_device, present);
    else
        engine_features_read(&(VkPhysicalDeviceFeatures2){0}, present);
    engine_features_enable(present, features);
}

uint32_t lobe_vulkan_queue_family(const lobe_vulkan_device *host) {
    if (!host)
        return UINT32_MAX;
    engine_instance_api api;
    uint32_t timestamp_bits;
    return load_functions(host, &api)
               ? engine_queue_family_find(&api, host->physical_device, &timestamp_bits)
               : UINT32_MAX;
}

// ---------------------------------------------------------------------------------------------
// What is missing

/// Lines appended to a text buffer that may be too small for them.
typedef struct line_list {
    char *text;
    size_t size, used;
    size_t count;
} line_list;

static void __attribute__((format(printf, 2, 3)))
add_line(line_list *list, const char *format, ...) {
    va_list arguments;
    const size_t left = list->size - list->used;
    int length = 0;
    if (list->count++ && left > 1)
        length = snprintf(list->text + list->used, left, "\n");
    va_start(arguments, format);
    if (left > 1)
        length +=
            vsnprintf(list->text + list->used + length, left - (size_t)length, format, arguments);
    va_end(arguments);
    list->used += (size_t)length < left ? (size_t)length : left ? left - 1 : 0;
}

static void add_features(line_list *list, const engine_instance_api *api,
                         VkPhysicalDevice physical_device,
                         const VkPhysicalDeviceFeatures2 *enabled) {
    lobe_device_feature features[ENGINE_FEATURE_COUNT];
    if (enabled)
        engine_features_read(enabled, features);
    else
        engine_features_query(api, physical_device, features);
    for (size_t i = 0; i < ENGINE_FEATURE_COUNT; i++)
        if (features[i].required && !features[i].present)
            add_line(list, "feature %s (%s)", features[i].name, features[i].use);
}

size_t lobe_vulkan_missing(const lobe_vulkan_device *host, const VkPhysicalDeviceFeatures2 *enabled,
                           char *text, size_t size) {
    if (!host || (!text && size > 0))
        return 1;
    const VkPhysicalDevice physical = host->physical_device;
    line_list list = {.text = text, .size = size};
    engine_instance_api api;
    VkPhysicalDeviceProperties properties;
    uint32_t timestamp_bits;
    if (size > 0)
        text[0] = '\0';
    if (!load_functions(host, &api)) {
        add_line(&list, "a Vulkan loader (libvulkan.so.1, or the host's get_instance_proc_addr)");
        return list.count;
    }
    api.vkGetPhysicalDeviceProperties(physical, &properties);
    if (properties.apiVersion < LOBE_VULKAN_API_VERSION)
        add_line(&list, "Vulkan 1.3 (it offers %u.%u)", VK_API_VERSION_MAJOR(properties.apiVersion),
                 VK_API_VERSION_MINOR(properties.apiVersion));
    if (engine_queue_family_find(&api, physical, &timestamp_bits) == UINT32_MAX)
        add_line(&list, "a queue with both graphics and compute");
    add_features(&list, &api, physical, enabled);
    return list.count;
}
