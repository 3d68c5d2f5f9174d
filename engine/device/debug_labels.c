#include "engine/device/device.h"

void engine_device_name(const lobe_device *device, VkObjectType type, uint64_t handle,
                        const char *name) {
    if (!device->instance.debug_utils)
        return;
    const VkDebugUtilsObjectNameInfoEXT information = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name,
    };
    // Names only help people debug: failing to set one is harmless.
    (void)device->instance.api.vkSetDebugUtilsObjectNameEXT(device->vulkan, &information);
}

void engine_device_begin_label(const lobe_device *device, VkCommandBuffer commands,
                               const char *name) {
    if (!device->instance.debug_utils)
        return;
    const VkDebugUtilsLabelEXT label = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
        .pLabelName = name,
    };
    device->instance.api.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
}

void engine_device_end_label(const lobe_device *device, VkCommandBuffer commands) {
    if (device->instance.debug_utils)
        device->instance.api.vkCmdEndDebugUtilsLabelEXT(commands);
}
