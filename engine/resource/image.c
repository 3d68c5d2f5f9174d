#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/format.h"
#include "engine/resource/resource.h"

static uint32_t at_least_one(uint32_t value) {
    return value ? value : 1;
}

static VkImageCreateInfo create_information(const engine_image_parameters *parameters) {
    return (VkImageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = parameters->flags,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = engine_format_vulkan(parameters->format),
        .extent = {parameters->width, parameters->height, 1},
        .mipLevels = at_least_one(parameters->levels),
        .arrayLayers = at_least_one(parameters->layers),
        .samples = (VkSampleCountFlagBits)at_least_one(parameters->samples),
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = parameters->usage,
    };
}

static VkResult query_limits(const lobe_device *device, const VkImageCreateInfo *create,
                             VkImageFormatProperties *limits) {
    const VkPhysicalDeviceImageFormatInfo2 query = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2,
        .format = create->format,
        .type = create->imageType,
        .tiling = create->tiling,
        .usage = create->usage,
        .flags = create->flags,
    };
    VkImageFormatProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2,
    };
    const VkResult result = device->instance.api.vkGetPhysicalDeviceImageFormatProperties2(
        device->physical, &query, &properties);
    *limits = properties.imageFormatProperties;
    return result;
}

static lobe_result check_limits(lobe_device *device, const engine_image_parameters *parameters,
                                const VkImageCreateInfo *create) {
    VkImageFormatProperties limits;
    const VkResult found = query_limits(device, create, &limits);
    const char *format = lobe_format_name(parameters->format);
    if (found == VK_ERROR_FORMAT_NOT_SUPPORTED)
        return lobe_host_fail(&device->host, LOBE_ERROR_UNSUPPORTED,
                              "image '%s': the device cannot use %s this way", parameters->name,
                              format);
    const lobe_result result = VULKAN_CHECK(&device->host, found, "image '%s'", parameters->name);
    if (result != LOBE_OK)
        return result;
    if (create->extent.width > limits.maxExtent.width ||
        create->extent.height > limits.maxExtent.height)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                              "image '%s': %ux%u is larger than the %ux%u the device allows",
                              parameters->name, create->extent.width, create->extent.height,
                              limits.maxExtent.width, limits.maxExtent.height);
    if (create->mipLevels > limits.maxMipLevels || create->arrayLayers > limits.maxArrayLayers)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                              "image '%s': %u levels and %u layers, the device allows %u and %u",
                              parameters->name, create->mipLevels, create->arrayLayers,
                              limits.maxMipLevels, limits.maxArrayLayers);
    if (!(limits.sampleCounts & create->samples))
        return lobe_host_fail(&device->host, LOBE_ERROR_UNSUPPORTED,
                              "image '%s': the device does not offer %u samples of %s",
                              parameters->name, create->samples, format);
    return LOBE_OK;
}

lobe_result engine_image_create(lobe_device *device, const engine_image_parameters *parameters,
                                VkImage *image, VkMemoryRequirements *requirements) {
    *image = VK_NULL_HANDLE;
    const VkImageCreateInfo create = create_information(parameters);
    if (parameters->width == 0 || parameters->height == 0)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT, "image '%s': an extent of %ux%u",
                              parameters->name, parameters->width, parameters->height);
    lobe_result result = check_limits(device, parameters, &create);
    if (result != LOBE_OK)
        return result;
    result = VULKAN_CHECK(
        &device->host, device->api.vkCreateImage(device->vulkan, &create, device->callbacks, image),
        "image '%s'", parameters->name);
    if (result != LOBE_OK)
        return result;
    device->api.vkGetImageMemoryRequirements(device->vulkan, *image, requirements);
    engine_device_name(device, VK_OBJECT_TYPE_IMAGE, (uint64_t)*image, parameters->name);
    return LOBE_OK;
}

lobe_result engine_view_create(lobe_device *device, const engine_view_parameters *parameters,
                               VkImageView *view) {
    *view = VK_NULL_HANDLE;
    const VkImageViewCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = parameters->image,
        .viewType = parameters->type,
        .format = engine_format_vulkan(parameters->format),
        .subresourceRange =
            {
                .aspectMask = engine_format_aspect(parameters->format),
                .baseMipLevel = parameters->first_level,
                .levelCount = parameters->level_count,
                .baseArrayLayer = parameters->first_layer,
                .layerCount = parameters->layer_count,
            },
    };
    const lobe_result result = VULKAN_CHECK(
        &device->host,
        device->api.vkCreateImageView(device->vulkan, &create, device->callbacks, view),
        "image '%s'", parameters->name);
    if (result == LOBE_OK)
        engine_device_name(device, VK_OBJECT_TYPE_IMAGE_VIEW, (uint64_t)*view, parameters->name);
    return result;
}
