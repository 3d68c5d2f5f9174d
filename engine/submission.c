#include "engine/device.h"

#include "engine/vulkan_check.h"

lobe_result engine_device_submit(lobe_device *device, VkCommandBuffer commands, uint64_t *value) {
    const VkCommandBufferSubmitInfo buffer = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = commands,
    };
    const VkSemaphoreSubmitInfo signal = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = device->timeline,
        .value = device->submitted + 1,
        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    };
    const VkSubmitInfo2 submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &buffer,
        .signalSemaphoreInfoCount = 1,
        .pSignalSemaphoreInfos = &signal,
    };
    const lobe_result result = VULKAN_CHECK(
        &device->log, vkQueueSubmit2(device->queue, 1, &submit, VK_NULL_HANDLE), "submission");
    if (result != LOBE_OK)
        return result;
    device->submitted++;
    if (value)
        *value = device->submitted;
    return LOBE_OK;
}

lobe_result engine_device_wait(lobe_device *device, uint64_t value) {
    const VkSemaphoreWaitInfo wait = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
        .semaphoreCount = 1,
        .pSemaphores = &device->timeline,
        .pValues = &value,
    };
    return VULKAN_CHECK(&device->log, vkWaitSemaphores(device->vulkan, &wait, UINT64_MAX),
                        "waiting for the device");
}

lobe_result engine_device_wait_all(lobe_device *device) {
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
    lobe_result result = VULKAN_CHECK(
        &device->log, vkAllocateCommandBuffers(device->vulkan, &allocate, commands), "%s", purpose);
    if (result != LOBE_OK)
        return result;
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    result = VULKAN_CHECK(&device->log, vkBeginCommandBuffer(*commands, &begin), "%s", purpose);
    if (result != LOBE_OK) {
        vkFreeCommandBuffers(device->vulkan, device->commands, 1, commands);
        *commands = VK_NULL_HANDLE;
    }
    return result;
}

lobe_result engine_device_finish_commands(lobe_device *device, const char *purpose,
                                          VkCommandBuffer commands) {
    uint64_t value = 0;
    lobe_result result = VULKAN_CHECK(&device->log, vkEndCommandBuffer(commands), "%s", purpose);
    if (result == LOBE_OK)
        result = engine_device_submit(device, commands, &value);
    if (result == LOBE_OK)
        result = engine_device_wait(device, value);
    vkFreeCommandBuffers(device->vulkan, device->commands, 1, &commands);
    return result;
}
