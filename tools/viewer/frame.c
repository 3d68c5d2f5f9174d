#include "tools/viewer/frame.h"

#include "engine/device/vulkan_check.h"

lobe_result viewer_frame_open(const viewer_device *device, viewer_frame *frame) {
    VkDevice vulkan = device->vulkan.device;
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                          .queueFamilyIndex = device->vulkan.queue_family};
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    lobe_result result = VULKAN_CHECK(
        &device->host, vkCreateCommandPool(vulkan, &pool, NULL, &frame->pool), "frame");
    if (result == LOBE_OK)
        result =
            VULKAN_CHECK(&device->host, vkCreateFence(vulkan, &fence, NULL, &frame->done), "frame");
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = frame->pool,
        .commandBufferCount = VIEWER_COMMANDS};
    if (result == LOBE_OK)
        result = VULKAN_CHECK(
            &device->host, vkAllocateCommandBuffers(vulkan, &commands, frame->commands), "frame");
    if (result != LOBE_OK)
        viewer_frame_close(device, frame);
    return result;
}

void viewer_frame_close(const viewer_device *device, viewer_frame *frame) {
    VkDevice vulkan = device->vulkan.device;
    if (frame->under_way)
        vkDeviceWaitIdle(vulkan);
    if (frame->done)
        vkDestroyFence(vulkan, frame->done, NULL);
    if (frame->pool)
        vkDestroyCommandPool(vulkan, frame->pool, NULL);
    *frame = (viewer_frame){0};
}

lobe_result viewer_frame_finish(const viewer_device *device, viewer_frame *frame,
                                viewer_side sides[2]) {
    VkDevice vulkan = device->vulkan.device;
    if (!frame->under_way)
        return LOBE_OK;
    lobe_result result = VULKAN_CHECK(
        &device->host, vkWaitForFences(vulkan, 1, &frame->done, VK_TRUE, UINT64_MAX), "frame");
    if (result != LOBE_OK)
        return result;
    frame->under_way = false;
    result = VULKAN_CHECK(&device->host, vkResetFences(vulkan, 1, &frame->done), "frame");
    for (int i = 0; i < 2 && result == LOBE_OK; i++)
        result = viewer_side_finish(&sides[i]);
    return result;
}

static lobe_result begin(const viewer_device *device, VkCommandBuffer commands) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    return VULKAN_CHECK(&device->host, vkBeginCommandBuffer(commands, &begin), "frame");
}

static lobe_result end(const viewer_device *device, VkCommandBuffer commands) {
    return VULKAN_CHECK(&device->host, vkEndCommandBuffer(commands), "frame");
}

/// Each side has its own command buffer: that of a side that fails is not submitted.
static lobe_result record_side(const viewer_view *view, viewer_side *side, VkCommandBuffer commands,
                               bool *recorded) {
    *recorded = false;
    if (!side->stale || viewer_side_supersamples(side))
        return LOBE_OK;
    lobe_result result = begin(view->device, commands);
    if (result != LOBE_OK)
        return result;
    result = viewer_side_record(view, side, commands);
    if (result != LOBE_OK)
        return result == LOBE_ERROR_DEVICE_LOST ? result : LOBE_OK;
    *recorded = true;
    return end(view->device, commands);
}

static lobe_result submit(const viewer_device *device, viewer_frame *frame,
                          const VkCommandBuffer *commands, uint32_t count,
                          const viewer_swapchain *swapchain) {
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
        .waitSemaphoreCount = 1,
        .pWaitSemaphores = &swapchain->acquired,
        .pWaitDstStageMask = &stage,
        .commandBufferCount = count,
        .pCommandBuffers = commands,
        .signalSemaphoreCount = 1,
        .pSignalSemaphores = &swapchain->drawn[swapchain->current],
    };
    lobe_result result = VULKAN_CHECK(
        &device->host, vkQueueSubmit(device->vulkan.queue, 1, &submit, frame->done), "frame");
    frame->under_way = result == LOBE_OK;
    return result;
}

lobe_result viewer_frame_draw(const viewer_view *view, viewer_frame *frame, viewer_display *display,
                              const viewer_look *look, viewer_side sides[2],
                              const viewer_swapchain *swapchain) {
    const viewer_device *device = view->device;
    const int side_count = look->comparison == VIEWER_SINGLE ? 1 : 2;
    VkCommandBuffer recorded[VIEWER_COMMANDS];
    uint32_t count = 0;
    lobe_result result = VULKAN_CHECK(
        &device->host, vkResetCommandPool(device->vulkan.device, frame->pool, 0), "frame");
    for (int i = 0; i < side_count && result == LOBE_OK; i++) {
        bool is_recorded;
        result = record_side(view, &sides[i], frame->commands[i], &is_recorded);
        if (is_recorded)
            recorded[count++] = frame->commands[i];
    }
    VkCommandBuffer last = frame->commands[VIEWER_COMMANDS - 1];
    if (result == LOBE_OK)
        result = begin(device, last);
    if (result == LOBE_OK)
        result = viewer_display_record(display, look, sides, swapchain, last);
    if (result == LOBE_OK)
        result = end(device, last);
    recorded[count++] = last;
    return result == LOBE_OK ? submit(device, frame, recorded, count, swapchain) : result;
}
