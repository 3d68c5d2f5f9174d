#include <lobe/vulkan.h>

#include <string.h>

#include "engine/device/device.h"
#include "engine/device/features.h"
#include "engine/device/selection.h"

/// Enough for every required feature.
#define MISSING_SIZE 1024

// ---------------------------------------------------------------------------------------------
// Import

static lobe_result check_host(const lobe_vulkan_device *host,
                              const lobe_device_parameters *parameters, const lobe_log *log) {
    const char *why = NULL;
    if (!host->instance || !host->physical_device || !host->device || !host->queue)
        why = "instance, physical device, device and queue must be given";
    else if (!host->features)
        why = "the features that were turned on must be given";
    else if (!host->lock_queue != !host->unlock_queue)
        why = "a callback that locks the queue goes with one that unlocks it";
    else if (parameters->select || parameters->validation)
        why = "what device to use and how to validate it is the host's business";
    return why ? lobe_log_fail(log, LOBE_ERROR_INVALID_ARGUMENT, "imported device: %s", why)
               : LOBE_OK;
}

static lobe_result check_features(const lobe_vulkan_device *host, const char *name,
                                  const lobe_log *log) {
    char text[MISSING_SIZE];
    if (lobe_vulkan_missing(host->physical_device, host->features, text, sizeof text) == 0)
        return LOBE_OK;
    for (char *end = text; (end = strchr(end, '\n'));)
        *end = ',';
    return lobe_log_fail(log, LOBE_ERROR_NO_DEVICE, "imported device '%s' lacks: %s", name, text);
}

static lobe_result check_queue(const lobe_vulkan_device *host, engine_candidate *candidate,
                               const lobe_log *log) {
    if (!engine_queue_family_serves(host->physical_device, host->queue_family,
                                    &candidate->timestamp_bits))
        return lobe_log_fail(log, LOBE_ERROR_NO_DEVICE,
                             "imported device '%s': queue family %u lacks graphics or compute",
                             candidate->information.name, host->queue_family);
    candidate->queue_family = host->queue_family;
    return LOBE_OK;
}

/// What was turned on counts, not what the device could do.
static void take_features(const lobe_vulkan_device *host, lobe_device *device) {
    lobe_device_feature *features = (lobe_device_feature *)device->information.features;
    engine_features_read(host->features, features);
    engine_features_enable(features, &device->features);
    for (uint32_t i = 0; i < host->extension_count; i++)
        if (!strcmp(host->extensions[i], VK_EXT_MEMORY_BUDGET_EXTENSION_NAME))
            device->memory_budget = true;
}

static lobe_result take_host(const lobe_vulkan_device *host, lobe_device *device) {
    engine_candidate candidate = {0};
    lobe_result result = engine_candidate_describe(host->physical_device, &device->log, &candidate);
    if (result != LOBE_OK)
        return result;
    device->information = candidate.information; // with its list of features
    result = check_queue(host, &candidate, &device->log);
    if (result == LOBE_OK)
        result = check_features(host, candidate.information.name, &device->log);
    if (result != LOBE_OK)
        return result;
    device->host = *host;
    if (host->allocation_callbacks) {
        device->kept_callbacks = *host->allocation_callbacks;
        device->callbacks = &device->kept_callbacks;
    }
    device->imported = true;
    device->instance.vulkan = host->instance;
    device->instance.debug_utils = host->debug_utils;
    device->physical = host->physical_device;
    device->vulkan = host->device;
    device->queue = host->queue;
    device->queue_family = host->queue_family;
    device->timestamp_bits = candidate.timestamp_bits;
    if (!candidate.timestamp_bits)
        device->information.timestamp_period = 0;
    take_features(host, device);
    return LOBE_OK;
}

lobe_result lobe_vulkan_import_device(const lobe_vulkan_device *host,
                                      const lobe_device_parameters *parameters,
                                      lobe_device **device) {
    static const lobe_device_parameters defaults = {0};
    if (!parameters)
        parameters = &defaults;
    *device = NULL;
    lobe_result result = check_host(host, parameters, parameters->log);
    if (result == LOBE_OK)
        result = engine_device_allocate(parameters, device);
    if (result != LOBE_OK)
        return result;
    result = take_host(host, *device);
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
    *handles = (lobe_vulkan_device){
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
