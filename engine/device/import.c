#include <lobe/vulkan.h>

#include <string.h>

#include "engine/device/device.h"
#include "engine/device/features.h"
#include "engine/device/selection.h"

/// Enough for every required feature.
#define MISSING_SIZE 1024

// ---------------------------------------------------------------------------------------------
// Import

static lobe_result check_host(const lobe_vulkan_device *import,
                              const lobe_device_parameters *parameters, const lobe_host *host) {
    const char *why = NULL;
    if (!import->instance || !import->physical_device || !import->device || !import->queue)
        why = "instance, physical device, device and queue must be given";
    else if (!import->features)
        why = "the enabled features must be given";
    else if (!import->lock_queue != !import->unlock_queue)
        why = "lock_queue and unlock_queue: give either both callbacks or neither";
    else if (parameters->select || parameters->validation || parameters->get_instance_proc_addr)
        why = "device, validation and loader are chosen by the host, not by the parameters";
    return why ? lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "imported device: %s", why)
               : LOBE_OK;
}

static lobe_result check_features(const lobe_vulkan_device *import, const char *name,
                                  const lobe_host *host) {
    char text[MISSING_SIZE];
    if (lobe_vulkan_missing(import, import->features, text, sizeof text) == 0)
        return LOBE_OK;
    for (char *end = text; (end = strchr(end, '\n'));)
        *end = ',';
    return lobe_host_fail(host, LOBE_ERROR_NO_DEVICE, "imported device '%s' lacks: %s", name, text);
}

static lobe_result check_queue(const lobe_vulkan_device *import, const lobe_device *device,
                               engine_candidate *candidate) {
    if (!engine_queue_family_serves(&device->instance.api, import->physical_device,
                                    import->queue_family, &candidate->timestamp_bits))
        return lobe_host_fail(&device->host, LOBE_ERROR_NO_DEVICE,
                              "imported device '%s': queue family %u lacks graphics or compute",
                              candidate->information.name, import->queue_family);
    candidate->queue_family = import->queue_family;
    return LOBE_OK;
}

/// Uses the features that the host enabled, not those that the device offers.
static void take_features(const lobe_vulkan_device *import, lobe_device *device) {
    lobe_device_feature *features = (lobe_device_feature *)device->information.features;
    engine_features_read(import->features, features);
    engine_features_enable(features, &device->features);
    for (uint32_t i = 0; i < import->extension_count; i++)
        if (!strcmp(import->extensions[i], VK_EXT_MEMORY_BUDGET_EXTENSION_NAME))
            device->memory_budget = true;
}

static lobe_result take_host(const lobe_vulkan_device *import, lobe_device *device) {
    engine_candidate candidate = {0};
    engine_instance *instance = &device->instance;
    lobe_result result =
        engine_loader_open(&device->host, import->get_instance_proc_addr, &instance->api);
    if (result == LOBE_OK)
        result = engine_instance_api_load(&device->host, import->instance, import->debug_utils,
                                          &instance->api);
    if (result == LOBE_OK)
        result = engine_candidate_describe(&instance->api, import->physical_device, &device->host,
                                           &candidate);
    if (result != LOBE_OK)
        return result;
    device->information = candidate.information; // with its list of features
    result = check_queue(import, device, &candidate);
    if (result == LOBE_OK)
        result = check_features(import, candidate.information.name, &device->host);
    if (result == LOBE_OK)
        result =
            engine_device_api_load(&device->host, &instance->api, import->device, &device->api);
    if (result != LOBE_OK)
        return result;
    device->import = *import;
    if (import->allocation_callbacks) {
        device->kept_callbacks = *import->allocation_callbacks;
        device->callbacks = &device->kept_callbacks;
    }
    device->imported = true;
    device->instance.vulkan = import->instance;
    device->instance.debug_utils = import->debug_utils;
    device->physical = import->physical_device;
    device->vulkan = import->device;
    device->queue = import->queue;
    device->queue_family = import->queue_family;
    device->timestamp_bits = candidate.timestamp_bits;
    if (!candidate.timestamp_bits)
        device->information.timestamp_period = 0;
    take_features(import, device);
    return LOBE_OK;
}

lobe_result lobe_vulkan_import_device(const lobe_vulkan_device *import,
                                      const lobe_device_parameters *parameters,
                                      lobe_device **device) {
    if (device)
        *device = NULL;
    if (!import || !device)
        return lobe_host_fail(parameters ? parameters->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_vulkan_import_device: import and device must not be NULL");
    static const lobe_device_parameters defaults = {0};
    if (!parameters)
        parameters = &defaults;
    lobe_result result = check_host(import, parameters, parameters->host);
    if (result == LOBE_OK)
        result = engine_device_allocate(parameters, device);
    if (result != LOBE_OK)
        return result;
    result = take_host(import, *device);
    if (result == LOBE_OK)
        result = engine_device_equip(*device, parameters);
    if (result != LOBE_OK)
        lobe_device_destroy(device);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Export

static void lock_queue(void *device) {
    engine_device_lock_queue(device);
}

static void unlock_queue(void *device) {
    engine_device_unlock_queue(device);
}

void lobe_vulkan_export_device(lobe_device *device, lobe_vulkan_device *handles) {
    if (!device || !handles)
        return;
    *handles = (lobe_vulkan_device){
        .get_instance_proc_addr = device->instance.api.vkGetInstanceProcAddr,
        .instance = device->instance.vulkan,
        .physical_device = device->physical,
        .device = device->vulkan,
        .queue_family = device->queue_family,
        .queue = device->queue,
        .debug_utils = device->instance.debug_utils,
        .allocation_callbacks = device->callbacks,
        .lock_queue = lock_queue,
        .unlock_queue = unlock_queue,
        .user = device,
    };
}
