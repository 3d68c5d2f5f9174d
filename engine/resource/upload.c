#include "engine/resource/upload.h"

#include <string.h>

#include "engine/device/device.h"
#include "engine/resource/resource.h"

static VkDeviceSize minimum(VkDeviceSize first, VkDeviceSize second) {
    return first < second ? first : second;
}

// ---------------------------------------------------------------------------------------------
// Barriers around an upload: nothing before may still use the target, everything after sees it

static void record_memory_barrier(const lobe_device *device, VkCommandBuffer commands,
                                  VkPipelineStageFlags2 from, VkAccessFlags2 written,
                                  VkPipelineStageFlags2 to, VkAccessFlags2 used) {
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = from,
        .srcAccessMask = written,
        .dstStageMask = to,
        .dstAccessMask = used,
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = 1,
        .pMemoryBarriers = &barrier,
    };
    device->api.vkCmdPipelineBarrier2(commands, &dependency);
}

static void record_before(const lobe_device *device, VkCommandBuffer commands) {
    record_memory_barrier(device, commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                          VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                          VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

static void record_after(const lobe_device *device, VkCommandBuffer commands) {
    record_memory_barrier(device, commands, VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                          VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                          VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
}

static void record_layout(const lobe_device *device, VkCommandBuffer commands, VkImage image,
                          VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = 1,
        .pImageMemoryBarriers = &barrier,
    };
    device->api.vkCmdPipelineBarrier2(commands, &dependency);
}

// ---------------------------------------------------------------------------------------------
// Buffers

static lobe_result zero_buffer(lobe_device *device, const char *name, VkBuffer buffer) {
    VkCommandBuffer commands;
    const lobe_result result = engine_device_begin_commands(device, name, &commands);
    if (result != LOBE_OK)
        return result;
    record_before(device, commands);
    device->api.vkCmdFillBuffer(commands, buffer, 0, VK_WHOLE_SIZE, 0);
    record_after(device, commands);
    return engine_device_finish_commands(device, name, commands);
}

static lobe_result copy_to_buffer(lobe_device *device, const char *name, VkBuffer source,
                                  VkBuffer target, VkDeviceSize offset, VkDeviceSize size) {
    VkCommandBuffer commands;
    const lobe_result result = engine_device_begin_commands(device, name, &commands);
    if (result != LOBE_OK)
        return result;
    record_before(device, commands);
    device->api.vkCmdCopyBuffer(commands, source, target, 1,
                                &(VkBufferCopy){.dstOffset = offset, .size = size});
    record_after(device, commands);
    return engine_device_finish_commands(device, name, commands);
}

lobe_result engine_upload_buffer(lobe_device *device, const char *name, VkBuffer buffer,
                                 VkDeviceSize size, const void *data) {
    if (!data)
        return zero_buffer(device, name, buffer);
    engine_staging staging;
    lobe_result result = engine_staging_create(device, name, minimum(size, ENGINE_UPLOAD_STEP),
                                               ENGINE_MEMORY_UPLOAD, &staging);
    for (VkDeviceSize done = 0; result == LOBE_OK && done < size; done += staging.size) {
        const VkDeviceSize step = minimum(staging.size, size - done);
        memcpy(staging.mapped, (const char *)data + done, step);
        result = copy_to_buffer(device, name, staging.buffer, buffer, done, step);
    }
    engine_staging_destroy(device, &staging);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Images

static lobe_result copy_to_image(lobe_device *device, const char *name, VkBuffer source,
                                 VkImage image, const lobe_image *content, uint32_t first_row,
                                 uint32_t rows) {
    VkCommandBuffer commands;
    const lobe_result result = engine_device_begin_commands(device, name, &commands);
    if (result != LOBE_OK)
        return result;
    const bool first = first_row == 0, last = first_row + rows == content->height;
    record_layout(device, commands, image,
                  first ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy copy = {
        .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        .imageOffset = {0, (int32_t)first_row, 0},
        .imageExtent = {content->width, rows, 1},
    };
    device->api.vkCmdCopyBufferToImage(commands, source, image,
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    if (last)
        record_layout(device, commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    return engine_device_finish_commands(device, name, commands);
}

lobe_result engine_upload_image(lobe_device *device, const char *name, VkImage image,
                                const lobe_image *content) {
    const VkDeviceSize row = content->width * (VkDeviceSize)lobe_format_size(content->format);
    const VkDeviceSize fitting = row < ENGINE_UPLOAD_STEP ? ENGINE_UPLOAD_STEP / row : 1;
    const uint32_t rows = (uint32_t)minimum(fitting, content->height);
    engine_staging staging;
    lobe_result result =
        engine_staging_create(device, name, rows * row, ENGINE_MEMORY_UPLOAD, &staging);
    for (uint32_t first = 0; result == LOBE_OK && first < content->height; first += rows) {
        const uint32_t step = (uint32_t)minimum(rows, content->height - first);
        memcpy(staging.mapped, (const char *)content->texels + first * row, step * row);
        result = copy_to_image(device, name, staging.buffer, image, content, first, step);
    }
    engine_staging_destroy(device, &staging);
    return result;
}
