#include "engine/device/device.h"

#include "engine/device/vulkan_check.h"

void engine_debug_labels_load(lobe_device *device) {
    if (!device->instance.debug_utils)
        return;
    device->set_name = (PFN_vkSetDebugUtilsObjectNameEXT)vkGetInstanceProcAddr(
        device->instance.vulkan, "vkSetDebugUtilsObjectNameEXT");
    device->begin_label = (PFN_vkCmdBeginDebugUtilsLabelEXT)vkGetInstanceProcAddr(
        device->instance.vulkan, "vkCmdBeginDebugUtilsLabelEXT");
    device->end_label = (PFN_vkCmdEndDebugUtilsLabelEXT)vkGetInstanceProcAddr(
        device->instance.vulkan, "vkCmdEndDebugUtilsLabelEXT");
}

void engine_device_name(const lobe_device *device, VkObjectType type, uint64_t handle,
                        const char *name) {
    if (!device->set_name)
        return;
    const VkDebugUtilsObjectNameInfoEXT information = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    // A name is a help for people; without memory for it all goes on.
    device->set_name(device->vulkan, &information);
}

void engine_device_begin_label(const lobe_device *device, VkCommandBuffer commands,
                               const char *name) {
    if (!device->begin_label)
        return;
    const VkDebugUtilsLabelEXT label = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
        .pLabelName = name,
    };
    device->begin_label(commands, &label);
}

void engine_device_end_label(const lobe_device *device, VkCommandBuffer commands) {
    if (device->end_label)
        device->end_label(commands);
}
