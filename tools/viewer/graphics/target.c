#include "tools/viewer/graphics/target.h"

#include "engine/device/vulkan_check.h"

static uint32_t memory_type(const viewer_device *device, uint32_t allowed) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device->vulkan.physical_device, &memory);
    uint32_t any = 0;
    for (uint32_t i = memory.memoryTypeCount; i-- > 0;) {
        if (!(allowed & 1u << i))
            continue;
        any = i;
        if (memory.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)
            return i;
    }
    return any;
}

static lobe_result give_memory(const viewer_device *device, viewer_target *target) {
    VkDevice vulkan = device->vulkan.device;
    VkMemoryRequirements needed;
    vkGetImageMemoryRequirements(vulkan, target->image.image, &needed);
    const VkMemoryAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = needed.size,
        .memoryTypeIndex = memory_type(device, needed.memoryTypeBits),
    };
    lobe_result result = VULKAN_CHECK(
        &device->host, vkAllocateMemory(vulkan, &allocate, NULL, &target->memory), "picture");
    if (result == LOBE_OK)
        result = VULKAN_CHECK(&device->host,
                              vkBindImageMemory(vulkan, target->image.image, target->memory, 0),
                              "picture");
    return result;
}

static lobe_result create_image(const viewer_device *device, viewer_target *target) {
    const lobe_vulkan_image *image = &target->image;
    const VkImageCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = image->format,
        .extent = {image->width, image->height, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = image->usage,
    };
    return VULKAN_CHECK(&device->host,
                        vkCreateImage(device->vulkan.device, &create, NULL, &target->image.image),
                        "picture");
}

lobe_result viewer_target_renew(const viewer_device *device, uint32_t width, uint32_t height,
                                viewer_target *target) {
    viewer_target_destroy(device, target);
    target->image = (lobe_vulkan_image){
        .name = "picture",
        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
        .width = width,
        .height = height,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
        .final_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
    };
    lobe_result result = create_image(device, target);
    if (result == LOBE_OK)
        result = give_memory(device, target);
    if (result != LOBE_OK)
        viewer_target_destroy(device, target);
    return result;
}

void viewer_target_destroy(const viewer_device *device, viewer_target *target) {
    if (target->image.image)
        vkDestroyImage(device->vulkan.device, target->image.image, NULL);
    if (target->memory)
        vkFreeMemory(device->vulkan.device, target->memory, NULL);
    *target = (viewer_target){0};
}

void viewer_target_is_drawn(viewer_target *target) {
    target->image.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}
