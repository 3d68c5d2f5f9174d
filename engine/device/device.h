#ifndef ENGINE_DEVICE_H
#define ENGINE_DEVICE_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>
#include <lobe/vulkan.h>

#include "engine/device/instance.h"
#include "engine/device/vulkan_functions.h"

struct lobe_device {
    lobe_host host; ///< always valid; `write` may be NULL
    engine_validation validation;
    engine_instance instance;
    VkPhysicalDevice physical;
    VkDevice vulkan;
    engine_device_api api; ///< all zero until the device is open
    VkQueue queue;         ///< graphics, compute and transfer; used only between lock and unlock
    pthread_mutex_t queue_mutex;
    bool imported;             ///< instance, device and queue are the host's
    lobe_vulkan_device import; ///< if imported; only its callbacks are used, pointers may dangle
    /// The host's, for the driver's memory; NULL: none. Points to `kept_callbacks`.
    const VkAllocationCallbacks *callbacks;
    VkAllocationCallbacks kept_callbacks;
    uint32_t queue_family;
    uint32_t timestamp_bits; ///< valid bits of a timestamp; 0: the queue has none
    VkPhysicalDeviceLimits limits;
    lobe_vulkan_features features;  ///< what was enabled
    VkSemaphore timeline;           ///< reaches n when the n-th submission is done
    _Atomic uint64_t submitted;     ///< number of submissions; incremented with the queue locked
    _Atomic bool is_lost;           ///< found at the last submission or wait
    pthread_mutex_t commands_mutex; ///< held while single-use commands are recorded
    VkCommandPool commands;         ///< pool for single-use command buffers
    struct engine_memory *memory;   ///< see engine/resource/memory.h
    struct engine_shared_table *shared; ///< see engine/resource/shared.h
    /// Protects shaders, pipelines and samplers; recursive, because finding a pipeline looks up
    /// shaders. Not held while the driver makes a pipeline.
    pthread_mutex_t found_mutex;
    struct engine_shaders *shaders;     ///< see engine/shader/shaders.h
    struct engine_pipelines *pipelines; ///< see engine/pipeline/pipelines.h
    _Atomic uint64_t last_stamp;        ///< see engine_device_stamp
    lobe_device_information information;
    _Atomic uint64_t validation_count;
    bool memory_budget; ///< VK_EXT_memory_budget is enabled
};

/// First step of creation: allocates an empty device with a copy of the host.
lobe_result engine_device_allocate(const lobe_device_parameters *parameters, lobe_device **device);
/// Last step: creates what lobe needs on an open Vulkan device.
lobe_result engine_device_equip(lobe_device *device, const lobe_device_parameters *parameters);

/// Must surround every use of the queue; not nested.
void engine_device_lock_queue(lobe_device *device);
void engine_device_unlock_queue(lobe_device *device);

/// Returns a number above 0 that this device has not returned before. It identifies content.
static inline uint64_t engine_device_stamp(lobe_device *device) {
    return ++device->last_stamp;
}

/// Submits a finished command buffer, or none. The timeline reaches `*value` when it has executed;
/// `value` may be NULL. Only barriers order submissions. `host`: its semaphores; NULL: none.
lobe_result engine_device_submit(lobe_device *device, VkCommandBuffer commands,
                                 const lobe_vulkan_submission *host, uint64_t *value);
/// The value that the timeline has reached, without waiting; 0 if the device does not say.
uint64_t engine_device_finished(lobe_device *device);
/// Waits until the timeline has reached `value`.
lobe_result engine_device_wait(lobe_device *device, uint64_t value);
/// Waits for all submissions.
lobe_result engine_device_wait_all(lobe_device *device);
/// Waits for everything submitted to the queue, including the host's work. Others may use the queue
/// meanwhile.
lobe_result engine_device_wait_queue(lobe_device *device);

/// Begins a single-use command buffer. `purpose` is for the error line. Other threads' calls block
/// until it is submitted.
lobe_result engine_device_begin_commands(lobe_device *device, const char *purpose,
                                         VkCommandBuffer *commands);
/// Ends and submits the command buffer; the timeline reaches `*value` when it has executed. On
/// failure it is freed.
lobe_result engine_device_submit_commands(lobe_device *device, const char *purpose,
                                          VkCommandBuffer commands, uint64_t *value);
/// Waits for the command buffer, and frees it even on failure.
lobe_result engine_device_finish_commands(lobe_device *device, VkCommandBuffer commands,
                                          uint64_t value);

/// Debug names and labels; do nothing without VK_EXT_debug_utils.
void engine_device_name(const lobe_device *device, VkObjectType type, uint64_t handle,
                        const char *name);
void engine_device_begin_label(const lobe_device *device, VkCommandBuffer commands,
                               const char *name);
void engine_device_end_label(const lobe_device *device, VkCommandBuffer commands);

#endif
