// A host program, linked to the installed library and to Vulkan: to libvulkan, or with -DUSE_VOLK
// to its own volk, whose global variables are named like libvulkan's functions. Draws a scene on
// lobe's own device and on an imported one, with lobe's loader and with the host's, and fails if a
// picture differs.

#ifdef USE_VOLK
#define VOLK_IMPLEMENTATION
#include <volk.h>
#else
#include <vulkan/vulkan.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/lobe.h>
#include <lobe/vulkan.h>

enum { EXTENT = 16 };

static float expected[4 * EXTENT * EXTENT];

static void require(bool condition, const char *what) {
    if (condition)
        return;
    fprintf(stderr, "vulkan_host: %s\n", what);
    exit(1);
}

static void write_line(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level == LOBE_LOG_ERROR)
        fprintf(stderr, "lobe: %s\n", message);
}

static const lobe_host host = {.write = write_line};

// ---------------------------------------------------------------------------------------------
// The host's Vulkan

static void open_instance(lobe_vulkan_device *vulkan) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = LOBE_VULKAN_API_VERSION};
    const VkInstanceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                         .pApplicationInfo = &application};
#ifdef USE_VOLK
    require(volkInitialize() == VK_SUCCESS, "volk finds no loader");
#endif
    require(vkCreateInstance(&create, NULL, &vulkan->instance) == VK_SUCCESS, "no instance");
#ifdef USE_VOLK
    volkLoadInstance(vulkan->instance);
#endif
}

static void open_device(lobe_vulkan_device *vulkan, lobe_vulkan_features *features) {
    uint32_t count = 1;
    require(vkEnumeratePhysicalDevices(vulkan->instance, &count, &vulkan->physical_device) >= 0 &&
                count == 1,
            "no device");
    require(lobe_vulkan_missing(vulkan, NULL, NULL, 0) == 0, "the device does not serve");
    lobe_vulkan_features_fill(vulkan, features);
    vulkan->features = &features->core;
    vulkan->queue_family = lobe_vulkan_queue_family(vulkan);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = vulkan->queue_family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = &features->core,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue};
    require(vkCreateDevice(vulkan->physical_device, &create, NULL, &vulkan->device) == VK_SUCCESS,
            "vkCreateDevice fails");
    vkGetDeviceQueue(vulkan->device, vulkan->queue_family, 0, &vulkan->queue);
}

static void close_vulkan(lobe_vulkan_device *vulkan) {
    require(vkDeviceWaitIdle(vulkan->device) == VK_SUCCESS, "vkDeviceWaitIdle fails");
    vkDestroyDevice(vulkan->device, NULL);
    vkDestroyInstance(vulkan->instance, NULL);
}

// ---------------------------------------------------------------------------------------------
// Pictures

static void draw(lobe_device *device, float *texels) {
    lobe_scene *scene = NULL;
    lobe_renderer *renderer = NULL;
    lobe_frame frame;
    require(lobe_scene_open("bumps", &host, &scene) == LOBE_OK, "no scene");
    require(lobe_renderer_create(device, &host, &renderer) == LOBE_OK, "no renderer");
    require(lobe_renderer_set_scene(renderer, scene) == LOBE_OK, "the scene is refused");
    const lobe_render_parameters parameters = {.width = EXTENT, .height = EXTENT};
    require(lobe_renderer_render(renderer, &parameters, &frame) == LOBE_OK, "no picture");
    memcpy(texels, frame.radiance.texels, sizeof expected);
    lobe_frame_free(&frame);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
}

static void check_picture(lobe_device *device) {
    float texels[4 * EXTENT * EXTENT];
    draw(device, texels);
    require(memcmp(texels, expected, sizeof expected) == 0, "another picture");
    lobe_device_destroy(&device);
}

static void check_devices(PFN_vkGetInstanceProcAddr loader) {
    lobe_vulkan_device vulkan = {.get_instance_proc_addr = loader};
    lobe_vulkan_features features;
    lobe_device *own = NULL, *imported = NULL;
    open_instance(&vulkan);
    open_device(&vulkan, &features);
    const lobe_device_parameters parameters = {.get_instance_proc_addr = loader, .host = &host};
    require(lobe_device_create(&parameters, &own) == LOBE_OK, "no device of lobe's");
    require(lobe_vulkan_import_device(&vulkan, &(lobe_device_parameters){.host = &host},
                                      &imported) == LOBE_OK,
            "the device is refused");
    check_picture(own);
    check_picture(imported);
    close_vulkan(&vulkan);
}

int main(void) {
    lobe_device *first = NULL;
    require(lobe_device_create(&(lobe_device_parameters){.host = &host}, &first) == LOBE_OK,
            "no first device");
    draw(first, expected);
    lobe_device_destroy(&first);
    check_devices(NULL);
    check_devices(vkGetInstanceProcAddr);
    puts("the pictures agree");
}
