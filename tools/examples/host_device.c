// A program that uses Vulkan itself: it creates a device and an image, draws a background into the
// image, and lets lobe draw a scene on top, all in one of its own command buffers.
//
//     host_device SCENE FILE.exr WIDTH HEIGHT

#define PROGRAM "host_device"
#include "vulkan_host.h"

// ---------------------------------------------------------------------------------------------
// The frame

static void draw_background(VkCommandBuffer commands, VkImage image, const float rgb[3]) {
    const VkClearColorValue colour = {{rgb[0], rgb[1], rgb[2], 0}};
    const VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    barrier(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &colour, 1, &range);
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
    image.image = create_image(h, image.format, (VkExtent2D){image.width, image.height},
                               image.usage, &image_memory);
    VkBuffer buffer = create_buffer(h, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &buffer_memory);

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
