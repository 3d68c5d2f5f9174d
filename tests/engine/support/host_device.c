#include "tests/engine/support/host_device.h"

#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <string.h>

PFN_vkGetInstanceProcAddr test_vulkan_loader;

#define CHECK(call) assert_int_equal(call, VK_SUCCESS)

static VKAPI_ATTR VkBool32 VKAPI_CALL receive_message(
    VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
    const VkDebugUtilsMessengerCallbackDataEXT *data, void *user) {
    (void)severity;
    (void)types;
    host_device *host = user;
    host->mistakes++;
    snprintf(host->last_mistake, sizeof host->last_mistake, "%s", data->pMessage);
    return VK_FALSE;
}

static void open_instance(host_device *host, bool validated) {
    static const char *const layer = "VK_LAYER_KHRONOS_validation";
    static const char *const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    static const VkValidationFeatureEnableEXT enabled =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkDebugUtilsMessengerCreateInfoEXT messenger = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = receive_message,
        .pUserData = host,
    };
    const VkValidationFeaturesEXT features = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext = &messenger,
        .enabledValidationFeatureCount = 1,
        .pEnabledValidationFeatures = &enabled,
    };
    const VkApplicationInfo application = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .apiVersion = LOBE_VULKAN_API_VERSION,
    };
    const VkInstanceCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = validated ? &features : NULL,
        .pApplicationInfo = &application,
        .enabledLayerCount = validated,
        .ppEnabledLayerNames = &layer,
        .enabledExtensionCount = 1,
        .ppEnabledExtensionNames = &extension,
    };
    CHECK(vkCreateInstance(&create, NULL, &host->vulkan.instance));
    PFN_vkCreateDebugUtilsMessengerEXT create_messenger =
        (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(host->vulkan.instance,
                                                                  "vkCreateDebugUtilsMessengerEXT");
    CHECK(create_messenger(host->vulkan.instance, &messenger, NULL, &host->messenger));
    host->vulkan.get_instance_proc_addr = test_vulkan_loader;
    host->vulkan.debug_utils = true;
}

static void open_device(host_device *host) {
    lobe_vulkan_device *vulkan = &host->vulkan;
    uint32_t count = 1;
    assert_true(vkEnumeratePhysicalDevices(vulkan->instance, &count, &vulkan->physical_device) >=
                VK_SUCCESS);
    assert_int_equal(count, 1);
    lobe_vulkan_features_fill(vulkan, &host->features);
    vulkan->features = &host->features.core;
    vulkan->extensions = host->extensions;
    vulkan->extension_count = lobe_vulkan_extensions_fill(vulkan, NULL, host->extensions);
    vulkan->queue_family = lobe_vulkan_queue_family(vulkan);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = vulkan->queue_family,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    const VkDeviceCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &host->features.core,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .enabledExtensionCount = vulkan->extension_count,
        .ppEnabledExtensionNames = host->extensions,
    };
    CHECK(vkCreateDevice(vulkan->physical_device, &create, NULL, &vulkan->device));
    vkGetDeviceQueue(vulkan->device, vulkan->queue_family, 0, &vulkan->queue);
}

static void open_host(host_device *host, bool validated) {
    *host = (host_device){0};
    log_recorder_start(&host->recorder);
    open_instance(host, validated);
    open_device(host);
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .queueFamilyIndex = host->vulkan.queue_family,
    };
    CHECK(vkCreateCommandPool(host->vulkan.device, &pool, NULL, &host->pool));
}

void host_device_open(host_device *host) {
    open_host(host, true);
}

void host_device_open_unvalidated(host_device *host) {
    open_host(host, false);
}

void host_device_close(host_device *host) {
    PFN_vkDestroyDebugUtilsMessengerEXT destroy =
        (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
            host->vulkan.instance, "vkDestroyDebugUtilsMessengerEXT");
    CHECK(vkDeviceWaitIdle(host->vulkan.device));
    vkDestroyCommandPool(host->vulkan.device, host->pool, NULL);
    vkDestroyDevice(host->vulkan.device, NULL);
    destroy(host->vulkan.instance, host->messenger, NULL);
    vkDestroyInstance(host->vulkan.instance, NULL);
    if (host->mistakes)
        fail_msg("%s", host->last_mistake);
}

lobe_device *host_device_import(host_device *host) {
    lobe_device *device = NULL;
    const lobe_device_parameters parameters = {.host = &host->recorder.host};
    if (lobe_vulkan_import_device(&host->vulkan, &parameters, &device) != LOBE_OK)
        fail_msg("%s", host->recorder.last_error);
    return device;
}

// ---------------------------------------------------------------------------------------------
// Images

static uint32_t memory_type(const host_device *host, uint32_t types, VkMemoryPropertyFlags flags) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(host->vulkan.physical_device, &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; i++)
        if ((types & 1u << i) && (memory.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    fail_msg("no memory of this type");
    return 0;
}

static VkDeviceMemory allocate(const host_device *host, const VkMemoryRequirements *requirements,
                               VkMemoryPropertyFlags flags) {
    const VkMemoryAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = requirements->size,
        .memoryTypeIndex = memory_type(host, requirements->memoryTypeBits, flags),
    };
    VkDeviceMemory memory;
    CHECK(vkAllocateMemory(host->vulkan.device, &allocate, NULL, &memory));
    return memory;
}

host_image host_image_create(const host_device *host, VkFormat format, uint32_t width,
                             uint32_t height, VkImageUsageFlags usage) {
    return host_image_create_array(host, format, width, height, 1, 1, usage);
}

host_image host_image_create_array(const host_device *host, VkFormat format, uint32_t width,
                                   uint32_t height, uint32_t layers, uint32_t levels,
                                   VkImageUsageFlags usage) {
    host_image image = {.format = format, .width = width, .height = height};
    const VkImageCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {width, height, 1},
        .mipLevels = levels,
        .arrayLayers = layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = usage,
    };
    VkMemoryRequirements requirements;
    CHECK(vkCreateImage(host->vulkan.device, &create, NULL, &image.image));
    vkGetImageMemoryRequirements(host->vulkan.device, image.image, &requirements);
    image.memory = allocate(host, &requirements, 0);
    CHECK(vkBindImageMemory(host->vulkan.device, image.image, image.memory, 0));
    return image;
}

void host_image_destroy(const host_device *host, host_image *image) {
    vkDestroyImage(host->vulkan.device, image->image, NULL);
    vkFreeMemory(host->vulkan.device, image->memory, NULL);
    *image = (host_image){0};
}

// ---------------------------------------------------------------------------------------------
// Buffers

static host_buffer create_buffer(const host_device *host, VkDeviceSize size,
                                 VkBufferUsageFlags usage, VkMemoryPropertyFlags flags) {
    const VkBufferCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    VkMemoryRequirements requirements;
    host_buffer buffer;
    CHECK(vkCreateBuffer(host->vulkan.device, &create, NULL, &buffer.buffer));
    vkGetBufferMemoryRequirements(host->vulkan.device, buffer.buffer, &requirements);
    buffer.memory = allocate(host, &requirements, flags);
    CHECK(vkBindBufferMemory(host->vulkan.device, buffer.buffer, buffer.memory, 0));
    return buffer;
}

host_buffer host_buffer_create(const host_device *host, VkDeviceSize size,
                               VkBufferUsageFlags usage) {
    return create_buffer(host, size, usage,
                         VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                             VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
}

void host_buffer_destroy(const host_device *host, host_buffer *buffer) {
    vkDestroyBuffer(host->vulkan.device, buffer->buffer, NULL);
    vkFreeMemory(host->vulkan.device, buffer->memory, NULL);
    *buffer = (host_buffer){0};
}

// ---------------------------------------------------------------------------------------------
// Commands

VkCommandBuffer host_begin(const host_device *host) {
    const VkCommandBufferAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = host->pool,
        .commandBufferCount = 1,
    };
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    VkCommandBuffer commands;
    CHECK(vkAllocateCommandBuffers(host->vulkan.device, &allocate, &commands));
    CHECK(vkBeginCommandBuffer(commands, &begin));
    return commands;
}

void host_finish(const host_device *host, VkCommandBuffer commands) {
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
        .commandBufferCount = 1,
        .pCommandBuffers = &commands,
    };
    CHECK(vkEndCommandBuffer(commands));
    CHECK(vkQueueSubmit(host->vulkan.queue, 1, &submit, VK_NULL_HANDLE));
    CHECK(vkQueueWaitIdle(host->vulkan.queue));
    vkFreeCommandBuffers(host->vulkan.device, host->pool, 1, &commands);
}

static VkImageAspectFlags aspect_of(const host_image *image) {
    return image->format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                 : VK_IMAGE_ASPECT_COLOR_BIT;
}

static VkImageSubresourceRange part_of(const host_image *image) {
    return (VkImageSubresourceRange){aspect_of(image), image->level, 1, image->layer, 1};
}

void host_barrier(VkCommandBuffer commands, const host_image *image, VkImageLayout from,
                  VkImageLayout to) {
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
        .image = image->image,
        .subresourceRange = part_of(image),
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = 1,
        .pImageMemoryBarriers = &barrier,
    };
    vkCmdPipelineBarrier2(commands, &dependency);
}

void host_clear(VkCommandBuffer commands, const host_image *image, const float colour[4]) {
    VkClearColorValue value;
    memcpy(value.float32, colour, sizeof value.float32);
    const VkImageSubresourceRange range = part_of(image);
    vkCmdClearColorImage(commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1,
                         &range);
}

void host_write(VkCommandBuffer commands, const host_buffer *buffer, VkDeviceSize offset,
                const void *data, VkDeviceSize size) {
    const VkDeviceSize most = 65536; // of one command
    for (VkDeviceSize done = 0; done < size; done += most)
        vkCmdUpdateBuffer(commands, buffer->buffer, offset + done,
                          size - done < most ? size - done : most, (const char *)data + done);
}

void host_read(const host_device *host, const host_image *image, void *texels, size_t size) {
    void *mapped;
    host_buffer buffer =
        create_buffer(host, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    const VkBufferImageCopy copy = {
        .imageSubresource = {aspect_of(image), image->level, image->layer, 1},
        .imageExtent = {image->width >> image->level, image->height >> image->level, 1}};
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT,
    };
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .memoryBarrierCount = 1,
                                         .pMemoryBarriers = &barrier};
    VkCommandBuffer commands = host_begin(host);
    vkCmdCopyImageToBuffer(commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           buffer.buffer, 1, &copy);
    vkCmdPipelineBarrier2(commands, &dependency);
    host_finish(host, commands);
    CHECK(vkMapMemory(host->vulkan.device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    memcpy(texels, mapped, size);
    host_buffer_destroy(host, &buffer);
}

VkSemaphore host_semaphore(const host_device *host, bool timeline) {
    const VkSemaphoreTypeCreateInfo type = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
        .semaphoreType = timeline ? VK_SEMAPHORE_TYPE_TIMELINE : VK_SEMAPHORE_TYPE_BINARY,
    };
    const VkSemaphoreCreateInfo create = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                          .pNext = &type};
    VkSemaphore semaphore;
    CHECK(vkCreateSemaphore(host->vulkan.device, &create, NULL, &semaphore));
    return semaphore;
}
