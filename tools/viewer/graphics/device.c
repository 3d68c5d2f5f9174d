#include "tools/viewer/graphics/device.h"

#include <stdlib.h>
#include <string.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/device/selection.h"
#include "engine/device/vulkan_check.h"
#include "tools/cli/cache_folder.h"

static lobe_result create_instance(viewer_device *device, bool validation) {
    uint32_t count = 0;
    const char **extensions = glfwGetRequiredInstanceExtensions(&count);
    if (!extensions)
        return lobe_host_fail(&device->host, LOBE_ERROR_NO_DEVICE,
                              "window: Vulkan offers no surfaces here");
    device->validation = (engine_validation){&device->host, &device->fault_count};
    const engine_instance_parameters wanted = {
        .get_instance_proc_addr = vkGetInstanceProcAddr,
        .validation = validation ? &device->validation : NULL,
        .extensions = extensions,
        .extension_count = count,
    };
    const lobe_result result = engine_instance_create(&device->host, &wanted, &device->instance);
    device->vulkan.get_instance_proc_addr = vkGetInstanceProcAddr;
    device->vulkan.instance = device->instance.vulkan;
    return result;
}

lobe_result viewer_device_renew_surface(viewer_device *device, struct GLFWwindow *window) {
    vkDestroySurfaceKHR(device->instance.vulkan, device->surface, NULL);
    device->surface = VK_NULL_HANDLE;
    return VULKAN_CHECK(
        &device->host,
        glfwCreateWindowSurface(device->instance.vulkan, window, NULL, &device->surface),
        "window's surface");
}

static lobe_result choose(viewer_device *device, const char *select) {
    engine_candidate *candidates = NULL;
    size_t count = 0, selected = 0;
    lobe_result result =
        engine_candidates_list(&device->instance, &device->host, &candidates, &count);
    if (result == LOBE_OK)
        result = engine_candidates_select(candidates, count, select, &device->host, &selected);
    VkBool32 presents = VK_FALSE;
    if (result == LOBE_OK) {
        const engine_candidate *chosen = &candidates[selected];
        device->vulkan.physical_device = chosen->physical;
        device->vulkan.queue_family = chosen->queue_family;
        result =
            VULKAN_CHECK(&device->host,
                         vkGetPhysicalDeviceSurfaceSupportKHR(
                             chosen->physical, chosen->queue_family, device->surface, &presents),
                         "window's surface");
    }
    if (result == LOBE_OK && !presents)
        result = lobe_host_fail(&device->host, LOBE_ERROR_UNSUPPORTED,
                                "device '%s' cannot show pictures in this window",
                                candidates[selected].information.name);
    engine_candidates_free(&candidates, count);
    return result;
}

/// With the features that lobe needs, and swapchains.
static lobe_result create_device(viewer_device *device) {
    lobe_vulkan_device *vulkan = &device->vulkan;
    lobe_vulkan_features features;
    const char *extensions[LOBE_VULKAN_MAXIMUM_EXTENSIONS + 1];
    lobe_vulkan_features_fill(vulkan, &features);
    uint32_t count = lobe_vulkan_extensions_fill(vulkan, NULL, extensions);
    extensions[count++] = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = vulkan->queue_family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = &features.core,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .enabledExtensionCount = count,
                                       .ppEnabledExtensionNames = extensions};
    lobe_result result = VULKAN_CHECK(
        &device->host, vkCreateDevice(vulkan->physical_device, &create, NULL, &vulkan->device),
        "viewer's device");
    if (result != LOBE_OK)
        return result;
    vkGetDeviceQueue(vulkan->device, vulkan->queue_family, 0, &vulkan->queue);
    vulkan->debug_utils = device->instance.debug_utils;
    vulkan->features = &features.core;
    vulkan->extensions = extensions;
    vulkan->extension_count = count;
    char cache[CACHE_FOLDER_SIZE];
    result = lobe_vulkan_import_device(
        vulkan,
        &(lobe_device_parameters){.pipeline_cache = device_options_pipeline_cache(cache),
                                  .host = &device->host},
        &device->lobe);
    vulkan->features = NULL; // only needed during the call
    vulkan->extensions = NULL;
    return result;
}

lobe_result viewer_device_open(const device_options *options, struct GLFWwindow *window,
                               const lobe_host *host, viewer_device *device) {
    *device = (viewer_device){.host = *host};
    lobe_result result = create_instance(device, options->validation);
    if (result == LOBE_OK)
        result = viewer_device_renew_surface(device, window);
    if (result == LOBE_OK)
        result = choose(device, device_options_selection(options));
    if (result == LOBE_OK)
        result = create_device(device);
    if (result != LOBE_OK)
        viewer_device_close(device);
    return result;
}

void viewer_device_close(viewer_device *device) {
    lobe_device_destroy(&device->lobe);
    if (device->vulkan.device)
        vkDestroyDevice(device->vulkan.device, NULL);
    if (device->surface)
        vkDestroySurfaceKHR(device->instance.vulkan, device->surface, NULL);
    if (device->instance.vulkan)
        engine_instance_destroy(&device->instance);
    device->vulkan = (lobe_vulkan_device){0};
    device->surface = VK_NULL_HANDLE;
}
