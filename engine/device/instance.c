#include "engine/device/instance.h"

#include <string.h>

#include "engine/device/vulkan_check.h"

#define VALIDATION_LAYER "VK_LAYER_KHRONOS_validation"

static lobe_result fail_memory(const lobe_host *host, const char *listed) {
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "out of memory listing Vulkan %s",
                          listed);
}

/// Whether the loader, a driver or an implicit layer has an instance extension.
static lobe_result find_extension(const lobe_host *host, const engine_instance_api *api,
                                  const char *name, bool *found) {
    uint32_t count = 0;
    *found = false;
    lobe_result result = VULKAN_CHECK(
        host, api->vkEnumerateInstanceExtensionProperties(NULL, &count, NULL), "extensions");
    if (result != LOBE_OK || count == 0)
        return result;
    VkExtensionProperties *extensions =
        lobe_allocate(lobe_host_allocator(host), count, sizeof *extensions);
    if (!extensions)
        return fail_memory(host, "extensions");
    result = VULKAN_CHECK(
        host, api->vkEnumerateInstanceExtensionProperties(NULL, &count, extensions), "extensions");
    for (uint32_t i = 0; result == LOBE_OK && i < count && !*found; i++)
        *found = !strcmp(extensions[i].extensionName, name);
    lobe_release(extensions);
    return result;
}

static lobe_result require_layer(const lobe_host *host, const engine_instance_api *api,
                                 const char *name) {
    uint32_t count = 0;
    bool found = false;
    lobe_result result =
        VULKAN_CHECK(host, api->vkEnumerateInstanceLayerProperties(&count, NULL), "layers");
    if (result != LOBE_OK)
        return result;
    VkLayerProperties *layers = lobe_allocate(lobe_host_allocator(host), count, sizeof *layers);
    if (!layers)
        return fail_memory(host, "layers");
    result = VULKAN_CHECK(host, api->vkEnumerateInstanceLayerProperties(&count, layers), "layers");
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
    const VkResult result = instance->api.vkCreateInstance(&create, NULL, &instance->vulkan);
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
    return VULKAN_CHECK(host,
                        instance->api.vkCreateDebugUtilsMessengerEXT(instance->vulkan, &settings,
                                                                     NULL, &instance->messenger),
                        "validation messages");
}

/// Finds the layers and extensions to create the instance with.
static lobe_result check_loader(const lobe_host *host, const engine_instance_parameters *parameters,
                                engine_instance *instance) {
    const engine_instance_api *api = &instance->api;
    if (!parameters->validation)
        return find_extension(host, api, VK_EXT_DEBUG_UTILS_EXTENSION_NAME, &instance->debug_utils);
    instance->debug_utils = true; // the validation layer implements it
    return require_layer(host, api, VALIDATION_LAYER);
}

static lobe_result create_instance(const lobe_host *host,
                                   const engine_instance_parameters *parameters,
                                   engine_instance *instance) {
    const instance_request request = {.extensions = parameters->extensions,
                                      .extension_count = parameters->extension_count,
                                      .allocator = lobe_host_allocator(host)};
    const VkResult created = parameters->validation
                                 ? create_validated(instance, parameters->validation, &request)
                                 : create_plain(instance, &request);
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER)
        return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE, "no Vulkan driver is installed");
    return VULKAN_CHECK(host, created, "Vulkan (vkCreateInstance)");
}

lobe_result engine_instance_create(const lobe_host *host,
                                   const engine_instance_parameters *parameters,
                                   engine_instance *instance) {
    *instance = (engine_instance){0};
    lobe_result result =
        engine_loader_open(host, parameters->get_instance_proc_addr, &instance->api);
    if (result == LOBE_OK)
        result = check_loader(host, parameters, instance);
    if (result == LOBE_OK)
        result = create_instance(host, parameters, instance);
    if (result == LOBE_OK)
        result =
            engine_instance_api_load(host, instance->vulkan, instance->debug_utils, &instance->api);
    if (result == LOBE_OK && parameters->validation)
        result = create_messenger(host, parameters->validation, instance);
    if (result != LOBE_OK)
        engine_instance_destroy(instance);
    return result;
}

void engine_instance_destroy(engine_instance *instance) {
    const engine_instance_api *api = &instance->api;
    if (instance->messenger)
        api->vkDestroyDebugUtilsMessengerEXT(instance->vulkan, instance->messenger, NULL);
    if (instance->vulkan && api->vkDestroyInstance)
        api->vkDestroyInstance(instance->vulkan, NULL);
    *instance = (engine_instance){0};
}
