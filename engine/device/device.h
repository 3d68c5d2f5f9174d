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
#include "engine/resource/memory.h"

struct lobe_device {
    lobe_host host; ///< always valid; `write` may be NULL
    engine_validation validation;
    engine_instance instance;
    VkPhysicalDevice physical;
    VkDevice vulkan;
    engine_device_api api; ///< all zero until the device is there
    VkQueue queue;         ///< graphics, compute and transfer; used between lock and unlock alone
    pthread_mutex_t queue_mutex;
    bool imported;             ///< instance, device and queue are the host's
    lobe_vulkan_device import; ///< where imported: the callbacks; what it points to may be gone
    /// The host's, for Vulkan's own memory; NULL: none. Points to the copy behind it.
    const VkAllocationCallbacks *callbacks;
    VkAllocationCallbacks kept_callbacks;
    uint32_t queue_family;
    uint32_t timestamp_bits; ///< valid bits of a timestamp; 0: the queue has none
    VkPhysicalDeviceLimits limits;
    lobe_vulkan_features features;  ///< what was enabled
    VkSemaphore timeline;           ///< reaches n when the n-th submission is done
    _Atomic uint64_t submitted;     ///< submissions so far; grows under the lock of the queue
    _Atomic bool is_lost;           ///< what was submitted or waited for last found it so
    pthread_mutex_t commands_mutex; ///< from the begin to the finish of single-use commands
    VkCommandPool commands;         ///< of single-use command buffers
    engine_memory *memory;
    /// Around the shaders, pipelines and samplers made so far; recursive, for pipelines look for
    /// shaders. What is found lives as long as the device.
    pthread_mutex_t found_mutex;
    struct engine_shaders *shaders;     ///< see engine/shader/shader.h
    struct engine_pipelines *pipelines; ///< see engine/pipeline/pipeline.h
    _Atomic uint64_t last_stamp;        ///< see engine_device_stamp
    lobe_device_information information;
    _Atomic uint64_t validation_count;
    bool memory_budget; ///< VK_EXT_memory_budget is enabled
};

/// The first step of creation: an empty device with the log. Logs with the parameters' log.
lobe_result engine_device_allocate(const lobe_device_parameters *parameters, lobe_device **device);
/// The last: what lobe itself needs of a Vulkan device that is there.
lobe_result engine_device_equip(lobe_device *device, const lobe_device_parameters *parameters);

/// Around every use of the queue; not nested.
void engine_device_lock_queue(lobe_device *device);
void engine_device_unlock_queue(lobe_device *device);

/// A number that was never given before on this device, above 0: what a content is known by.
uint64_t engine_device_stamp(lobe_device *device);

/// Submits a finished command buffer. `*value` is what the timeline reaches when it is done;
/// `value` may be NULL. Submissions execute in order only where barriers say so. `host`: its
/// semaphores; NULL: none.
lobe_result engine_device_submit(lobe_device *device, VkCommandBuffer commands,
                                 const lobe_vulkan_submission *host, uint64_t *value);
/// Waits until the timeline has reached `value`.
lobe_result engine_device_wait(lobe_device *device, uint64_t value);
/// Waits for all submissions.
lobe_result engine_device_wait_all(lobe_device *device);
/// Waits for all that was submitted to the queue, by the host too.
lobe_result engine_device_wait_queue(lobe_device *device);

/// A command buffer in recording state, for single use. `purpose` is for the error line. Until it
/// is finished other threads wait for theirs.
lobe_result engine_device_begin_commands(lobe_device *device, const char *purpose,
                                         VkCommandBuffer *commands);
/// Ends, submits, waits and frees what engine_device_begin_commands gave, failure or not.
lobe_result engine_device_finish_commands(lobe_device *device, const char *purpose,
                                          VkCommandBuffer commands);

/// Debug names and labels; nothing happens where the debug utilities are absent.
void engine_device_name(const lobe_device *device, VkObjectType type, uint64_t handle,
                        const char *name);
void engine_device_begin_label(const lobe_device *device, VkCommandBuffer commands,
                               const char *name);
void engine_device_end_label(const lobe_device *device, VkCommandBuffer commands);

#endif
