// A program that uses Vulkan itself: it creates a device and an image, draws a background into the
// image, and lets lobe draw a scene on top, all in one of its own command buffers.
//
//     host_device SCENE FILE.exr WIDTH HEIGHT

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/lobe.h>
#include <lobe/vulkan.h>

#define CHECK(call)                                                                                \
    do {                                                                                           \
        if ((call) != VK_SUCCESS) {                                                                \
            fprintf(stderr, "host_device: %s failed\n", #call);                                    \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static void print(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level <= LOBE_LOG_WARNING)
        fprintf(stderr, "host_device: %s\n", message);
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
    fprintf(stderr, "host_device: no device serves, for lack of:\n%s\n", missing);
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
// An image, and a buffer to read it back

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

static VkImage create_image(const host *h, const lobe_vulkan_image *image, VkDeviceMemory *memory) {
    const VkImageCreateInfo create = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                      .imageType = VK_IMAGE_TYPE_2D,
                                      .format = image->format,
                                      .extent = {image->width, image->height, 1},
                                      .mipLevels = 1,
                                      .arrayLayers = 1,
                                      .samples = VK_SAMPLE_COUNT_1_BIT,
                                      .usage = image->usage};
    VkImage created;
    VkMemoryRequirements needed;
    CHECK(vkCreateImage(h->vulkan.device, &create, NULL, &created));
    vkGetImageMemoryRequirements(h->vulkan.device, created, &needed);
    *memory = allocate(h, needed, 0);
    CHECK(vkBindImageMemory(h->vulkan.device, created, *memory, 0));
    return created;
}

static VkBuffer create_buffer(const host *h, VkDeviceSize size, VkDeviceMemory *memory) {
    const VkBufferCreateInfo create = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                       .size = size,
                                       .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer created;
    VkMemoryRequirements needed;
    CHECK(vkCreateBuffer(h->vulkan.device, &create, NULL, &created));
    vkGetBufferMemoryRequirements(h->vulkan.device, created, &needed);
    *memory = allocate(h, needed,
                       VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK(vkBindBufferMemory(h->vulkan.device, created, *memory, 0));
    return created;
}

// ---------------------------------------------------------------------------------------------
// The frame

static void barrier(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                           .dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT,
                                           .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                           .oldLayout = from,
                                           .newLayout = to,
                                           .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                           .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                           .image = image,
                                           .subresourceRange = {1, 0, 1, 0, 1}};
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .imageMemoryBarrierCount = 1,
                                         .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

static void draw_background(VkCommandBuffer commands, VkImage image, const float rgb[3]) {
    const VkClearColorValue colour = {{rgb[0], rgb[1], rgb[2], 0}};
    const VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    barrier(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &colour, 1, &range);
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

static void submit_and_wait(const host *h, VkCommandBuffer commands) {
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &commands};
    CHECK(vkEndCommandBuffer(commands));
    CHECK(vkQueueSubmit(h->vulkan.queue, 1, &submit, VK_NULL_HANDLE));
    CHECK(vkQueueWaitIdle(h->vulkan.queue));
}

/// Background, scene, and a copy that the program can read, into `pixels`.
static lobe_result draw(const host *h, lobe_renderer *renderer, const lobe_scene *scene,
                        lobe_image *pixels) {
    lobe_vulkan_image image = {
        .name = "canvas",
        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
        .width = pixels->width,
        .height = pixels->height,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
        .layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
        .final_stages = VK_PIPELINE_STAGE_2_COPY_BIT,
        .final_access = VK_ACCESS_2_TRANSFER_READ_BIT,
    };
    const size_t size = (size_t)pixels->width * pixels->height * lobe_format_size(pixels->format);
    VkDeviceMemory image_memory, buffer_memory;
    image.image = create_image(h, &image, &image_memory);
    VkBuffer buffer = create_buffer(h, size, &buffer_memory);

    VkCommandBuffer commands = begin(h);
    draw_background(commands, image.image, scene->background);
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(
        renderer,
        &(lobe_render_parameters){
            .host = {.target = &(lobe_render_target){.radiance = &image, .keep = true},
                     .submission = &(lobe_vulkan_submission){.commands = commands}},
        },
        &frame);
    if (result == LOBE_OK) {
        const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                        .imageExtent = {image.width, image.height, 1}};
        vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer,
                               1, &copy);
        submit_and_wait(h, commands);
        void *mapped;
        CHECK(vkMapMemory(h->vulkan.device, buffer_memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        memcpy(pixels->texels, mapped, size);
    }
    lobe_frame_free(&frame);
    vkDestroyBuffer(h->vulkan.device, buffer, NULL);
    vkDestroyImage(h->vulkan.device, image.image, NULL);
    vkFreeMemory(h->vulkan.device, buffer_memory, NULL);
    vkFreeMemory(h->vulkan.device, image_memory, NULL);
    return result;
}

int main(int argc, char **argv) {
    if (argc != 5) {
        fprintf(stderr, "Usage: host_device SCENE FILE.exr WIDTH HEIGHT\n");
        return 2;
    }
    host h = {0};
    open_host(&h);
    lobe_device *device = NULL;
    lobe_scene *scene = NULL;
    lobe_renderer *renderer = NULL;
    lobe_image pixels = {0};
    lobe_result result =
        lobe_vulkan_import_device(&h.vulkan, &(lobe_device_parameters){.host = &messages}, &device);
    result = result ? result : lobe_scene_open(argv[1], &messages, &scene);
    result = result ? result : lobe_renderer_create(device, &messages, &renderer);
    result = result ? result : lobe_renderer_set_scene(renderer, scene);
    result = result ? result
                    : lobe_image_allocate(&pixels, LOBE_FORMAT_RGBA32_FLOAT,
                                          (uint32_t)strtoul(argv[3], NULL, 10),
                                          (uint32_t)strtoul(argv[4], NULL, 10), &messages);
    result = result ? result : draw(&h, renderer, scene, &pixels);
    const lobe_exr_layer layer = {.image = &pixels, .depth = LOBE_EXR_FLOAT};
    result =
        result ? result
               : lobe_exr_write(argv[2], &(lobe_exr_parameters){.layers = &layer, .layer_count = 1},
                                &messages);
    lobe_image_free(&pixels);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
    lobe_device_destroy(&device); // does not destroy the program's device
    close_host(&h);
    return result != LOBE_OK;
}
