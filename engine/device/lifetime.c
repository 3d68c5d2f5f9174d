#include "engine/device/device.h"

#include <string.h>

#include "engine/device/features.h"
#include "engine/device/instance.h"
#include "engine/device/selection.h"
#include "engine/device/vulkan_check.h"
#include "engine/pipeline/pipelines.h"
#include "engine/resource/memory.h"
#include "engine/resource/shared.h"
#include "engine/shader/shaders.h"

// ---------------------------------------------------------------------------------------------
// The steps of creation, in order

static lobe_result open_instance(lobe_device *device, const lobe_device_parameters *parameters) {
    device->validation = (engine_validation){&device->host, &device->validation_count};
    const engine_instance_parameters wanted = {
        .get_instance_proc_addr = parameters->get_instance_proc_addr,
        .validation = parameters->validation ? &device->validation : NULL,
    };
    return engine_instance_create(&device->host, &wanted, &device->instance);
}

static lobe_result select_physical(lobe_device *device, const char *select) {
    engine_candidate *candidates = NULL;
    size_t count = 0, selected = 0;
    lobe_result result =
        engine_candidates_list(&device->instance, &device->host, &candidates, &count);
    if (result == LOBE_OK)
        result = engine_candidates_select(candidates, count, select, &device->host, &selected);
    if (result == LOBE_OK) {
        engine_candidate *candidate = &candidates[selected];
        device->physical = candidate->physical;
        device->queue_family = candidate->queue_family;
        device->timestamp_bits = candidate->timestamp_bits;
        device->information = candidate->information;
        candidate->information.features = NULL; // now the device's
    }
    engine_candidates_free(&candidates, count);
    return result;
}

static lobe_result load_functions(lobe_device *device) {
    const lobe_result result =
        engine_device_api_load(&device->host, &device->instance.api, device->vulkan, &device->api);
    if (result == LOBE_OK)
        return LOBE_OK;
    if (device->api.vkDestroyDevice)
        device->api.vkDestroyDevice(device->vulkan, NULL);
    device->vulkan = VK_NULL_HANDLE;
    return result;
}

static lobe_result open_device(lobe_device *device) {
    const char *extensions[LOBE_VULKAN_MAXIMUM_EXTENSIONS];
    uint32_t extension_count;
    lobe_result result = engine_extensions_fill(&device->instance.api, device->physical,
                                                &device->host, extensions, &extension_count);
    if (result != LOBE_OK)
        return result;
    for (uint32_t i = 0; i < extension_count; i++)
        device->memory_budget |= !strcmp(extensions[i], VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    engine_features_enable(device->information.features, &device->features);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = device->queue_family,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    const VkDeviceCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &device->features.core,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .enabledExtensionCount = extension_count,
        .ppEnabledExtensionNames = extensions,
    };
    result = VULKAN_CHECK(
        &device->host,
        device->instance.api.vkCreateDevice(device->physical, &create, NULL, &device->vulkan),
        "device '%s'", device->information.name);
    if (result == LOBE_OK)
        result = load_functions(device);
    if (result == LOBE_OK)
        device->api.vkGetDeviceQueue(device->vulkan, device->queue_family, 0, &device->queue);
    return result;
}

static void read_limits(lobe_device *device) {
    VkPhysicalDeviceProperties properties;
    device->instance.api.vkGetPhysicalDeviceProperties(device->physical, &properties);
    device->limits = properties.limits;
}

static lobe_result create_timeline(lobe_device *device) {
    const VkSemaphoreTypeCreateInfo type = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
        .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE,
    };
    const VkSemaphoreCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
        .pNext = &type,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreateSemaphore(device->vulkan, &create, device->callbacks,
                                                      &device->timeline),
                        "device '%s'", device->information.name);
}

static lobe_result create_command_pool(lobe_device *device) {
    const VkCommandPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
        .queueFamilyIndex = device->queue_family,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreateCommandPool(device->vulkan, &create, device->callbacks,
                                                        &device->commands),
                        "device '%s'", device->information.name);
}

static lobe_result open_vulkan(lobe_device *device, const lobe_device_parameters *parameters) {
    lobe_result result = open_instance(device, parameters);
    if (result == LOBE_OK)
        result = select_physical(device, parameters->select);
    return result == LOBE_OK ? open_device(device) : result;
}

static void create_mutexes(lobe_device *device) {
    pthread_mutexattr_t recursive;
    pthread_mutexattr_init(&recursive);
    pthread_mutexattr_settype(&recursive, PTHREAD_MUTEX_RECURSIVE);
    pthread_mutex_init(&device->found_mutex, &recursive);
    pthread_mutexattr_destroy(&recursive);
    pthread_mutex_init(&device->queue_mutex, NULL);
    pthread_mutex_init(&device->commands_mutex, NULL);
}

static void destroy_mutexes(lobe_device *device) {
    pthread_mutex_destroy(&device->found_mutex);
    pthread_mutex_destroy(&device->queue_mutex);
    pthread_mutex_destroy(&device->commands_mutex);
}

lobe_result engine_device_allocate(const lobe_device_parameters *parameters, lobe_device **device) {
    *device = lobe_allocate(lobe_host_allocator(parameters->host), 1, sizeof **device);
    if (!*device)
        return lobe_host_fail(parameters->host, LOBE_ERROR_OUT_OF_MEMORY, "device: out of memory");
    create_mutexes(*device);
    if (parameters->host)
        (*device)->host = *parameters->host;
    return LOBE_OK;
}

lobe_result engine_device_equip(lobe_device *device, const lobe_device_parameters *parameters) {
    read_limits(device);
    lobe_result result = create_timeline(device);
    if (result == LOBE_OK)
        result = create_command_pool(device);
    if (result == LOBE_OK)
        result = engine_memory_create(device, parameters->memory_limit, &device->memory);
    if (result == LOBE_OK)
        result = engine_shared_table_create(device, &device->shared);
    if (result == LOBE_OK)
        result = engine_shaders_create(device, parameters->shader_source, &device->shaders);
    if (result == LOBE_OK)
        result = engine_pipelines_create(device, parameters->pipeline_cache, &device->pipelines);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Public

lobe_result lobe_device_create(const lobe_device_parameters *parameters, lobe_device **device) {
    if (!device)
        return lobe_host_fail(parameters ? parameters->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_device_create: device must not be NULL");
    static const lobe_device_parameters defaults = {0};
    if (!parameters)
        parameters = &defaults;
    lobe_result result = engine_device_allocate(parameters, device);
    if (result != LOBE_OK)
        return result;
    result = open_vulkan(*device, parameters);
    if (result == LOBE_OK)
        result = engine_device_equip(*device, parameters);
    if (result != LOBE_OK)
        lobe_device_destroy(device);
    return result;
}

/// Waits on the host's device for what lobe may have submitted. The semaphore tells when the device
/// has finished; threads of the driver or of a layer may use it a moment longer. (Mesa 22.3 with
/// validation corrupted its memory in one of 40 runs of a test that creates and destroys many.)
static void wait_on_hosts_device(lobe_device *device) {
    (void)engine_device_wait_all(device);
    engine_device_lock_queue(device);
    (void)device->api.vkQueueWaitIdle(device->queue);
    engine_device_unlock_queue(device);
}

static void destroy_vulkan(lobe_device *device) {
    // A lost device has finished.
    if (!device->imported)
        device->api.vkDeviceWaitIdle(device->vulkan);
    else if (device->timeline)
        wait_on_hosts_device(device);
    engine_pipelines_destroy(device, &device->pipelines);
    engine_shaders_destroy(&device->shaders);
    engine_shared_table_destroy(&device->shared);
    engine_memory_destroy(&device->memory);
    device->api.vkDestroyCommandPool(device->vulkan, device->commands, device->callbacks);
    device->api.vkDestroySemaphore(device->vulkan, device->timeline, device->callbacks);
    if (!device->imported)
        device->api.vkDestroyDevice(device->vulkan, NULL);
}

void lobe_device_destroy(lobe_device **device) {
    if (!device || !*device)
        return;
    if ((*device)->vulkan)
        destroy_vulkan(*device);
    if (!(*device)->imported)
        engine_instance_destroy(&(*device)->instance);
    destroy_mutexes(*device);
    lobe_release((void *)(*device)->information.features);
    lobe_release(*device);
    *device = NULL;
}

const lobe_allocator *lobe_device_allocator(const lobe_device *device) {
    if (!device)
        return NULL;
    return device->host.allocator;
}

const lobe_device_information *lobe_device_describe(const lobe_device *device) {
    if (!device)
        return NULL;
    return &device->information;
}

lobe_result lobe_device_list(const lobe_device_parameters *parameters,
                             lobe_device_information **devices, size_t *count) {
    if (devices)
        *devices = NULL;
    if (!devices || !count)
        return lobe_host_fail(parameters ? parameters->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_device_list: devices and count must not be NULL");
    const lobe_host *host = parameters ? parameters->host : NULL;
    const engine_instance_parameters wanted = {
        .get_instance_proc_addr = parameters ? parameters->get_instance_proc_addr : NULL,
    };
    *devices = NULL;
    *count = 0;
    engine_instance instance = {0};
    engine_candidate *candidates = NULL;
    lobe_result result = engine_instance_create(host, &wanted, &instance);
    if (result != LOBE_OK)
        return result;
    result = engine_candidates_list(&instance, host, &candidates, count);
    if (result != LOBE_OK)
        goto cleanup;
    *devices = lobe_allocate(lobe_host_allocator(host), *count, sizeof **devices);
    if (!*devices) {
        result = lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "Vulkan devices: out of memory");
        goto cleanup;
    }
    for (size_t i = 0; i < *count; i++) {
        (*devices)[i] = candidates[i].information;
        candidates[i].information.features = NULL; // now the caller's
    }
cleanup:
    engine_candidates_free(&candidates, *count);
    engine_instance_destroy(&instance);
    if (result != LOBE_OK)
        *count = 0;
    return result;
}

void lobe_device_list_free(lobe_device_information **devices, size_t count) {
    if (!devices)
        return;
    for (size_t i = 0; *devices && i < count; i++)
        lobe_release((void *)(*devices)[i].features);
    lobe_release(*devices);
    *devices = NULL;
}

void lobe_device_memory_query(const lobe_device *device, lobe_device_memory *memory) {
    if (!device || !memory)
        return;
    engine_memory_query(device->memory, memory);
}

void lobe_device_memory_reset_peak(lobe_device *device) {
    if (!device)
        return;
    engine_memory_reset_peak(device->memory);
}

uint64_t lobe_device_validation_count(const lobe_device *device) {
    if (!device)
        return 0;
    return atomic_load(&device->validation_count);
}
