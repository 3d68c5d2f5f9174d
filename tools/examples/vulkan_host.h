#ifndef EXAMPLES_VULKAN_HOST_H
#define EXAMPLES_VULKAN_HOST_H

// What programs that use Vulkan themselves do, whatever they then do with lobe: open a device,
// allocate memory, submit a command buffer. PROGRAM is the program's name, for messages.

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/lobe.h>
#include <lobe/vulkan.h>

#define CHECK(call)                                                                                \
    do {                                                                                           \
        if ((call) != VK_SUCCESS) {                                                                \
            fprintf(stderr, PROGRAM ": %s failed\n", #call);                                       \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static void print(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level <= LOBE_LOG_WARNING)
        fprintf(stderr, PROGRAM ": %s\n", message);
}

static const lobe_host messages = {.write = print};

// ---------------------------------------------------------------------------------------------
// A device with everything that lobe requires, and whatever else the program needs

typedef struct host {
    lobe_vulkan_device vulkan;
    lobe_vulkan_features features;
    const char *extensions[LOBE_VULKAN_MAXIMUM_EXTENSIONS];
    VkCommandPool pool;
} host;

static void choose_physical_device(host *h) {
    VkPhysicalDevice devices[16];
    uint32_t count = 16;
    char missing[1024] = "a Vulkan device";
    if (vkEnumeratePhysicalDevices(h->vulkan.instance, &count, devices) >= VK_SUCCESS)
        for (uint32_t i = 0; i < count; i++) {
            h->vulkan.physical_device = devices[i];
            if (lobe_vulkan_missing(&h->vulkan, NULL, missing, sizeof missing) == 0)
                return;
        }
    fprintf(stderr, PROGRAM ": no device serves, for lack of:\n%s\n", missing);
    exit(1);
}

static void open_host(host *h) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = LOBE_VULKAN_API_VERSION};
    const VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                           .pApplicationInfo = &application};
    CHECK(vkCreateInstance(&instance, NULL, &h->vulkan.instance));
    choose_physical_device(h);

    lobe_vulkan_features_fill(&h->vulkan, &h->features);
    h->vulkan.features = &h->features.core;
    h->vulkan.extensions = h->extensions;
    h->vulkan.extension_count = lobe_vulkan_extensions_fill(&h->vulkan, NULL, h->extensions);
    h->vulkan.queue_family = lobe_vulkan_queue_family(&h->vulkan);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = h->vulkan.queue_family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = &h->features.core,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .enabledExtensionCount = h->vulkan.extension_count,
                                       .ppEnabledExtensionNames = h->extensions};
    CHECK(vkCreateDevice(h->vulkan.physical_device, &device, NULL, &h->vulkan.device));
    vkGetDeviceQueue(h->vulkan.device, h->vulkan.queue_family, 0, &h->vulkan.queue);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = h->vulkan.queue_family};
    CHECK(vkCreateCommandPool(h->vulkan.device, &pool, NULL, &h->pool));
}

static void close_host(host *h) {
    vkDestroyCommandPool(h->vulkan.device, h->pool, NULL);
    vkDestroyDevice(h->vulkan.device, NULL);
    vkDestroyInstance(h->vulkan.instance, NULL);
}

// ---------------------------------------------------------------------------------------------
// Memory and commands

static VkDeviceMemory allocate(const host *h, VkMemoryRequirements needed, VkFlags flags) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(h->vulkan.physical_device, &memory);
    uint32_t type = 0;
    while (type + 1 < memory.memoryTypeCount &&
           (!(needed.memoryTypeBits & 1u << type) ||
            (memory.memoryTypes[type].propertyFlags & flags) != flags))
        type++;
    const VkMemoryAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                           .allocationSize = needed.size,
                                           .memoryTypeIndex = type};
    VkDeviceMemory allocated;
    CHECK(vkAllocateMemory(h->vulkan.device, &allocate, NULL, &allocated));
    return allocated;
}

static VkImage create_image(const host *h, VkFormat format, VkExtent2D extent, VkFlags usage,
                            VkDeviceMemory *memory) {
    const VkImageCreateInfo create = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                      .imageType = VK_IMAGE_TYPE_2D,
                                      .format = format,
                                      .extent = {extent.width, extent.height, 1},
                                      .mipLevels = 1,
                                      .arrayLayers = 1,
                                      .samples = VK_SAMPLE_COUNT_1_BIT,
                                      .usage = usage};
    VkImage created;
    VkMemoryRequirements needed;
    CHECK(vkCreateImage(h->vulkan.device, &create, NULL, &created));
    vkGetImageMemoryRequirements(h->vulkan.device, created, &needed);
    *memory = allocate(h, needed, 0);
    CHECK(vkBindImageMemory(h->vulkan.device, created, *memory, 0));
    return created;
}

/// In memory that can be mapped.
static VkBuffer create_buffer(const host *h, VkDeviceSize size, VkFlags usage,
                              VkDeviceMemory *memory) {
    const VkBufferCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    VkBuffer created;
    VkMemoryRequirements needed;
    CHECK(vkCreateBuffer(h->vulkan.device, &create, NULL, &created));
    vkGetBufferMemoryRequirements(h->vulkan.device, created, &needed);
    *memory = allocate(h, needed,
                       VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK(vkBindBufferMemory(h->vulkan.device, created, *memory, 0));
    return created;
}

static VkCommandBuffer begin(const host *h) {
    const VkCommandBufferAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = h->pool,
        .commandBufferCount = 1};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkCommandBuffer commands;
    CHECK(vkAllocateCommandBuffers(h->vulkan.device, &allocate, &commands));
    CHECK(vkBeginCommandBuffer(commands, &begin));
    return commands;
}

/// Waits for all that comes before.
static void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                    VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                           .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                           .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                           .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                           .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT |
                                                            VK_ACCESS_2_MEMORY_WRITE_BIT,
                                           .oldLayout = from,
                                           .newLayout = to,
                                           .image = image,
                                           .subresourceRange = {aspect, 0, 1, 0, 1}};
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .imageMemoryBarrierCount = 1,
                                         .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

static void submit_and_wait(const host *h, VkCommandBuffer commands) {
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &commands};
    CHECK(vkEndCommandBuffer(commands));
    CHECK(vkQueueSubmit(h->vulkan.queue, 1, &submit, VK_NULL_HANDLE));
    CHECK(vkQueueWaitIdle(h->vulkan.queue));
}

#endif
