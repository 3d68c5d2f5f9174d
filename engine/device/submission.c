#include "engine/device/device.h"

#include "engine/device/vulkan_check.h"

void engine_device_lock_queue(lobe_device *device) {
    // Serialises lobe's own threads, so that calls of the host's callback never overlap.
    pthread_mutex_lock(&device->queue_mutex);
    if (device->import.lock_queue)
        device->import.lock_queue(device->import.user);
}

void engine_device_unlock_queue(lobe_device *device) {
    if (device->import.unlock_queue)
        device->import.unlock_queue(device->import.user);
    pthread_mutex_unlock(&device->queue_mutex);
}

static void list_semaphores(const lobe_vulkan_semaphore *semaphores, uint32_t count,
                            VkSemaphoreSubmitInfo *list) {
    for (uint32_t i = 0; i < count; i++)
        list[i] = (VkSemaphoreSubmitInfo){
            .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
            .semaphore = semaphores[i].semaphore,
            .value = semaphores[i].value,
            .stageMask =
                semaphores[i].stages ? semaphores[i].stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        };
}

/// Logs the loss of the device only once: every later wait, during destruction, fails the same way.
static lobe_result check(lobe_device *device, VkResult code, const char *function,
                         const char *purpose) {
    const bool was_lost = atomic_exchange(&device->is_lost, code == VK_ERROR_DEVICE_LOST);
    if (was_lost && code == VK_ERROR_DEVICE_LOST)
        return LOBE_ERROR_DEVICE_LOST;
    return engine_vulkan_check(&device->host, code, function, "%s", purpose);
}

lobe_result engine_device_submit(lobe_device *device, VkCommandBuffer commands,
                                 const lobe_vulkan_submission *host, uint64_t *value) {
    const VkCommandBufferSubmitInfo buffer = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = commands,
    };
    VkSemaphoreSubmitInfo waits[LOBE_VULKAN_MAXIMUM_SEMAPHORES];
    VkSemaphoreSubmitInfo signals[LOBE_VULKAN_MAXIMUM_SEMAPHORES + 1];
    const uint32_t wait_count = host ? host->wait_count : 0;
    const uint32_t signal_count = host ? host->signal_count : 0;
    if (host) {
        list_semaphores(host->waits, wait_count, waits);
        list_semaphores(host->signals, signal_count, signals + 1);
    }
    const VkSubmitInfo2 submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .waitSemaphoreInfoCount = wait_count,
        .pWaitSemaphoreInfos = waits,
        .commandBufferInfoCount = commands ? 1 : 0,
        .pCommandBufferInfos = &buffer,
        .signalSemaphoreInfoCount = signal_count + 1,
        .pSignalSemaphoreInfos = signals,
    };
    engine_device_lock_queue(device);
    const uint64_t reached = device->submitted + 1;
    signals[0] = (VkSemaphoreSubmitInfo){
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = device->timeline,
        .value = reached,
        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    };
    const VkResult submitted =
        device->api.vkQueueSubmit2(device->queue, 1, &submit, VK_NULL_HANDLE);
    if (submitted == VK_SUCCESS)
        device->submitted = reached;
    engine_device_unlock_queue(device);
    if (submitted == VK_SUCCESS && value)
        *value = reached;
    return check(device, submitted, "vkQueueSubmit2", "submission");
}

uint64_t engine_device_finished(lobe_device *device) {
    uint64_t value = 0;
    const VkResult result =
        device->api.vkGetSemaphoreCounterValue(device->vulkan, device->timeline, &value);
    return result == VK_SUCCESS ? value : 0;
}

lobe_result engine_device_wait(lobe_device *device, uint64_t value) {
    const VkSemaphoreWaitInfo wait = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
        .semaphoreCount = 1,
        .pSemaphores = &device->timeline,
        .pValues = &value,
    };
    return check(device, device->api.vkWaitSemaphores(device->vulkan, &wait, UINT64_MAX),
                 "vkWaitSemaphores", "waiting for the device");
}

lobe_result engine_device_wait_queue(lobe_device *device) {
    uint64_t value = 0;
    // A signal comes after all earlier work of its queue.
    const lobe_result result = engine_device_submit(device, VK_NULL_HANDLE, NULL, &value);
    if (result == LOBE_OK)
        return engine_device_wait(device, value);
    if (result != LOBE_ERROR_DEVICE_LOST) {
        // The caller is going to destroy what the queue uses. Meanwhile nobody can submit.
        engine_device_lock_queue(device);
        (void)device->api.vkQueueWaitIdle(device->queue);
        engine_device_unlock_queue(device);
    }
    return result;
}

lobe_result engine_device_wait_all(lobe_device *device) {
    // The host may have submitted lobe's work in its own command buffers.
    if (device->imported)
        return engine_device_wait_queue(device);
    return engine_device_wait(device, device->submitted);
}

lobe_result engine_device_begin_commands(lobe_device *device, const char *purpose,
                                         VkCommandBuffer *commands) {
    *commands = VK_NULL_HANDLE;
    const VkCommandBufferAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = device->commands,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1,
    };
    pthread_mutex_lock(&device->commands_mutex);
    lobe_result result = VULKAN_CHECK(
        &device->host, device->api.vkAllocateCommandBuffers(device->vulkan, &allocate, commands),
        "%s", purpose);
    if (result != LOBE_OK) {
        pthread_mutex_unlock(&device->commands_mutex);
        return result;
    }
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    result = VULKAN_CHECK(&device->host, device->api.vkBeginCommandBuffer(*commands, &begin), "%s",
                          purpose);
    if (result != LOBE_OK) {
        device->api.vkFreeCommandBuffers(device->vulkan, device->commands, 1, commands);
        *commands = VK_NULL_HANDLE;
        pthread_mutex_unlock(&device->commands_mutex);
    }
    return result;
}

static void free_commands(lobe_device *device, VkCommandBuffer commands) {
    pthread_mutex_lock(&device->commands_mutex);
    device->api.vkFreeCommandBuffers(device->vulkan, device->commands, 1, &commands);
    pthread_mutex_unlock(&device->commands_mutex);
}

lobe_result engine_device_submit_commands(lobe_device *device, const char *purpose,
                                          VkCommandBuffer commands, uint64_t *value) {
    lobe_result result =
        VULKAN_CHECK(&device->host, device->api.vkEndCommandBuffer(commands), "%s", purpose);
    if (result == LOBE_OK)
        result = engine_device_submit(device, commands, NULL, value);
    pthread_mutex_unlock(&device->commands_mutex); // others may record now
    if (result != LOBE_OK)
        free_commands(device, commands);
    return result;
}

lobe_result engine_device_finish_commands(lobe_device *device, VkCommandBuffer commands,
                                          uint64_t value) {
    const lobe_result result = engine_device_wait(device, value);
    free_commands(device, commands);
    return result;
}
