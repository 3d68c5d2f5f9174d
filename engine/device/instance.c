#include "engine/device/instance.h"

#include <string.h>

#include "engine/device/vulkan_check.h"

#define VALIDATION_LAYER "VK_LAYER_KHRONOS_validation"

static lobe_result fail_memory(const lobe_host *host) {
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "Vulkan: no host memory to look around");
}

/// Whether `name` is an extension of the loader and drivers.
static lobe_result find_extension(const lobe_host *host, const char *name, bool *found) {
    uint32_t count = 0;
    *found = false;
    lobe_result result = VULKAN_CHECK(
        host, vkEnumerateInstanceExtensionProperties(NULL, &count, NULL), "extensions");
    if (result != LOBE_OK || count == 0)
        return result;
    VkExtensionProperties *extensions =
        lobe_allocate(lobe_host_allocator(host), count, sizeof *extensions);
    if (!extensions)
        return fail_memory(host);
    result = VULKAN_CHECK(host, vkEnumerateInstanceExtensionProperties(NULL, &count, extensions),
                          "extensions");
    for (uint32_t i = 0; result == LOBE_OK && i < count && !*found; i++)
        *found = !strcmp(extensions[i].extensionName, name);
    lobe_release(extensions);
    return result;
}

static lobe_result require_layer(const lobe_host *host, const char *name) {
    uint32_t count = 0;
    bool found = false;
    lobe_result result =
        VULKAN_CHECK(host, vkEnumerateInstanceLayerProperties(&count, NULL), "layers");
    if (result != LOBE_OK)
        return result;
    VkLayerProperties *layers = lobe_allocate(lobe_host_allocator(host), count, sizeof *layers);
    if (!layers)
        return fail_memory(host);
    result = VULKAN_CHECK(host, vkEnumerateInstanceLayerProperties(&count, layers), "layers");
    for (uint32_t i = 0; result == LOBE_OK && i < count && !found; i++)
        found = !strcmp(layers[i].layerName, name);
    lobe_release(layers);
    if (result != LOBE_OK || found)
        return result;
    return lobe_host_fail(host, LOBE_ERROR_UNSUPPORTED, "validation: the layer %s is not installed",
                          name);
}

static VKAPI_ATTR VkBool32 VKAPI_CALL receive_message(
    VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
    const VkDebugUtilsMessengerCallbackDataEXT *data, void *user) {
    (void)types;
    const engine_validation *validation = user;
    const bool error = severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    atomic_fetch_add(validation->count, 1);
    lobe_host_log(validation->host, LOBE_LOG_ERROR, "Vulkan validation %s: %s",
                  error ? "error" : "warning", data->pMessage);
    return VK_FALSE;
}

static VkDebugUtilsMessengerCreateInfoEXT messenger_settings(const engine_validation *validation) {
    return (VkDebugUtilsMessengerCreateInfoEXT){
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = receive_message,
        .pUserData = (void *)validation,
    };
}

/// What the instance is asked for beside what lobe knows by itself.
typedef struct instance_request {
    const void *next;
    const char *layer; ///< NULL: none
    const char *const *extensions;
    uint32_t extension_count;
    const lobe_allocator *allocator;
} instance_request;

static VkResult create_plain(engine_instance *instance, const instance_request *request) {
    const VkApplicationInfo application = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .pEngineName = "lobe",
        .apiVersion = VK_API_VERSION_1_3,
    };
    const char **extensions =
        lobe_allocate(request->allocator, request->extension_count + 1, sizeof *extensions);
    if (!extensions)
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    uint32_t count = 0;
    while (count < request->extension_count) {
        extensions[count] = request->extensions[count];
        count++;
    }
    if (instance->debug_utils)
        extensions[count++] = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkInstanceCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = request->next,
        .pApplicationInfo = &application,
        .enabledLayerCount = request->layer ? 1 : 0,
        .ppEnabledLayerNames = &request->layer,
        .enabledExtensionCount = count,
        .ppEnabledExtensionNames = extensions,
    };
    const VkResult result = vkCreateInstance(&create, NULL, &instance->vulkan);
    lobe_release(extensions);
    return result;
}

static VkResult create_validated(engine_instance *instance, const engine_validation *validation,
                                 const instance_request *plain) {
    static const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
    };
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_settings(validation);
    const VkValidationFeaturesEXT features = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext = &messenger,
        .enabledValidationFeatureCount = sizeof enabled / sizeof *enabled,
        .pEnabledValidationFeatures = enabled,
    };
    instance_request request = *plain;
    request.next = &features;
    request.layer = VALIDATION_LAYER;
    return create_plain(instance, &request);
}

static lobe_result create_messenger(const lobe_host *host, const engine_validation *validation,
                                    engine_instance *instance) {
    const VkDebugUtilsMessengerCreateInfoEXT settings = messenger_settings(validation);
    PFN_vkCreateDebugUtilsMessengerEXT create =
        (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(instance->vulkan,
                                                                  "vkCreateDebugUtilsMessengerEXT");
    return VULKAN_CHECK(host, create(instance->vulkan, &settings, NULL, &instance->messenger),
                        "validation messages");
}

lobe_result engine_instance_create(const lobe_host *host, const engine_validation *validation,
                                   engine_instance *instance) {
    return engine_instance_create_with(host, validation, NULL, 0, instance);
}

lobe_result engine_instance_create_with(const lobe_host *host, const engine_validation *validation,
                                        const char *const *extensions, uint32_t extension_count,
                                        engine_instance *instance) {
    const instance_request request = {.extensions = extensions,
                                      .extension_count = extension_count,
                                      .allocator = lobe_host_allocator(host)};
    *instance = (engine_instance){0};
    instance->debug_utils = true; // which the layer brings
    lobe_result result = validation ? require_layer(host, VALIDATION_LAYER)
                                    : find_extension(host, VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                     &instance->debug_utils);
    if (result != LOBE_OK)
        return result;
    const VkResult created = validation ? create_validated(instance, validation, &request)
                                        : create_plain(instance, &request);
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER)
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE, "no Vulkan driver is installed");
    result = VULKAN_CHECK(host, created, "Vulkan (vkCreateInstance)");
    if (result == LOBE_OK && validation)
        result = create_messenger(host, validation, instance);
    if (result != LOBE_OK)
        engine_instance_destroy(instance);
    return result;
}

void engine_instance_destroy(engine_instance *instance) {
    if (instance->messenger) {
        PFN_vkDestroyDebugUtilsMessengerEXT destroy =
            (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
                instance->vulkan, "vkDestroyDebugUtilsMessengerEXT");
        destroy(instance->vulkan, instance->messenger, NULL);
    }
    vkDestroyInstance(instance->vulkan, NULL);
    *instance = (engine_instance){0};
}
