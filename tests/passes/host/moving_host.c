#include "tests/passes/host/moving_host.h"

#include <stdlib.h>

#include "ripples_words.h"
#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

#define CHECK(call) assert_int_equal(call, VK_SUCCESS)

struct ripple_constants {
    float phase, waves, depth;
};

// ---------------------------------------------------------------------------------------------
// The scene

/// Metal, plastic and vMF lobes; the first materials have maps that the host gives, and two of
/// them, which are no metal, colours.
static lobe_material material_of(lobe_scene *scene, uint32_t number) {
    static const lobe_distribution distributions[] = {LOBE_DISTRIBUTION_GGX,
                                                      LOBE_DISTRIBUTION_BECKMANN};
    lobe_material material =
        number % 3 == 2
            ? half_vector_material(LOBE_DISTRIBUTION_VMF, 10 + (float)number)
            : microfacet_material(distributions[number % 2], 0.3 + 0.02 * number, number % 4 == 0);
    material.base_colour[0] = 0.2f + 0.03f * (float)number;
    if (number >= 1 && number <= MOVING_COLOURS)
        material.base_colour_map.image = (int32_t)number - 1;
    material.normal_map =
        scene_add_map(scene, random_normal_map(MOVING_MAP, MOVING_MAP, 0.4, 60 + number));
    return material;
}

static void place(float transform[16], uint32_t instance) {
    const uint32_t column = instance % 40, row = instance / 40;
    for (int i = 0; i < 15; i++)
        transform[i] = i % 5 == 0 ? 0.02f : 0;
    transform[12] = 0.05f * ((float)column - 19.5f);
    transform[14] = 0.05f * ((float)row - 12);
    transform[15] = 1;
}

static lobe_scene *moving_scene(void) {
    lobe_scene *scene = scene_begin();
    float transform[16];
    for (uint32_t i = 0; i < MOVING_COLOURS; i++)
        (void)scene_add_map(scene, random_map(MOVING_MAP, MOVING_MAP, 0, 1, i));
    for (uint32_t i = 0; i < MOVING_MATERIALS; i++) {
        const lobe_material material = material_of(scene, i);
        place(transform, i);
        scene_add_square(scene, &material, 1, transform);
    }
    for (uint32_t i = 0; i < MOVING_MAPS; i++)
        scene->images[i].on_device = true;
    for (uint32_t i = MOVING_MATERIALS; i < MOVING_INSTANCES; i++) {
        place(transform, i);
        assert_int_equal(scenes_add_instance(scene, i % 3, i % MOVING_MATERIALS, transform, NULL),
                         LOBE_OK);
    }
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 1.6);
    scene_end(scene);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// What the host creates

static void create_layouts(moving_host *m) {
    const VkDevice device = m->host.vulkan.device;
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1,
                                                  VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 1,
        .pBindings = &binding,
    };
    const VkPushConstantRange constants = {VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                           sizeof(struct ripple_constants)};
    CHECK(vkCreateDescriptorSetLayout(device, &set, NULL, &m->set_layout));
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &m->set_layout,
        .pushConstantRangeCount = 1,
        .pPushConstantRanges = &constants,
    };
    CHECK(vkCreatePipelineLayout(device, &layout, NULL, &m->layout));
}

static void create_pipeline(moving_host *m) {
    const VkDevice device = m->host.vulkan.device;
    const VkShaderModuleCreateInfo code = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = sizeof ripples_words,
        .pCode = ripples_words,
    };
    VkShaderModule module;
    CHECK(vkCreateShaderModule(device, &code, NULL, &module));
    const VkComputePipelineCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main"},
        .layout = m->layout,
    };
    CHECK(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &create, NULL, &m->ripples));
    vkDestroyShaderModule(device, module, NULL);
}

static void create_map(moving_host *m, uint32_t number) {
    const VkDevice device = m->host.vulkan.device;
    m->maps[number] = host_image_create(&m->host, VK_FORMAT_R8G8B8A8_UNORM, MOVING_MAP, MOVING_MAP,
                                        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    const VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = m->maps[number].image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = m->maps[number].format,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = m->descriptors,
        .descriptorSetCount = 1,
        .pSetLayouts = &m->set_layout,
    };
    CHECK(vkCreateImageView(device, &view, NULL, &m->views[number]));
    CHECK(vkAllocateDescriptorSets(device, &allocate, &m->sets[number]));
    const VkDescriptorImageInfo image = {VK_NULL_HANDLE, m->views[number], VK_IMAGE_LAYOUT_GENERAL};
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = m->sets[number],
        .descriptorCount = 1,
        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        .pImageInfo = &image,
    };
    vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
}

static void create_commands(moving_host *m) {
    const VkDevice device = m->host.vulkan.device;
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = m->host.vulkan.queue_family,
    };
    CHECK(vkCreateCommandPool(device, &pool, NULL, &m->pool));
    const VkCommandBufferAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = m->pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = MOVING_FLIGHT,
    };
    CHECK(vkAllocateCommandBuffers(device, &allocate, m->commands));
    m->timeline = host_semaphore(&m->host, true);
}

static void create_maps(moving_host *m) {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, MOVING_MAPS};
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = MOVING_MAPS,
        .poolSizeCount = 1,
        .pPoolSizes = &size,
    };
    CHECK(vkCreateDescriptorPool(m->host.vulkan.device, &pool, NULL, &m->descriptors));
    for (uint32_t i = 0; i < MOVING_MAPS; i++)
        create_map(m, i);
}

/// The scene's first images are those that move: colours, then normals.
static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const moving_host *m = user;
    for (size_t i = 0; i < MOVING_MAPS; i++)
        content->images[i] = lobe_graph_import_image(
            graph, &(lobe_vulkan_image){.image = m->maps[i].image,
                                        .format = m->maps[i].format,
                                        .width = MOVING_MAP,
                                        .height = MOVING_MAP,
                                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                        .layout = VK_IMAGE_LAYOUT_GENERAL,
                                        .final_layout = VK_IMAGE_LAYOUT_GENERAL});
}

void moving_host_open(moving_host *m, const char *filter, bool validated) {
    *m = (moving_host){.filter = filter_named(filter)};
    if (validated)
        host_device_open(&m->host);
    else
        host_device_open_unvalidated(&m->host);
    create_layouts(m);
    create_pipeline(m);
    create_maps(m);
    create_commands(m);
    counting_allocator_start(&m->counting);
    m->host.recorder.host.allocator = &m->counting.allocator;
    m->device = host_device_import(&m->host);
    m->scene = moving_scene();
    assert_int_equal(lobe_renderer_create(m->device, &m->host.recorder.host, &m->renderer),
                     LOBE_OK);
    if (lobe_renderer_set_scene(m->renderer, m->scene) != LOBE_OK)
        fail_msg("%s", m->host.recorder.last_error);
    lobe_renderer_set_content_giver(m->renderer, give, m);
}

static void destroy_pictures(moving_host *m) {
    for (int i = 0; i < MOVING_FLIGHT; i++)
        if (m->pictures[i].image)
            host_image_destroy(&m->host, &m->pictures[i]);
}

void moving_host_close(moving_host *m) {
    const VkDevice device = m->host.vulkan.device;
    moving_host_finish(m);
    lobe_renderer_destroy(&m->renderer);
    lobe_device_destroy(&m->device);
    lobe_scene_destroy(&m->scene);
    assert_nothing_left(&m->counting);
    assert_int_equal(m->host.recorder.errors, 0);
    vkDestroySemaphore(device, m->timeline, NULL);
    vkDestroyCommandPool(device, m->pool, NULL);
    vkDestroyPipeline(device, m->ripples, NULL);
    vkDestroyPipelineLayout(device, m->layout, NULL);
    vkDestroyDescriptorPool(device, m->descriptors, NULL);
    vkDestroyDescriptorSetLayout(device, m->set_layout, NULL);
    for (int i = 0; i < MOVING_MAPS; i++) {
        vkDestroyImageView(device, m->views[i], NULL);
        host_image_destroy(&m->host, &m->maps[i]);
    }
    destroy_pictures(m);
    host_device_close(&m->host);
}

// ---------------------------------------------------------------------------------------------
// Frames

static void wait_for(moving_host *m, uint64_t value) {
    const VkSemaphoreWaitInfo wait = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
        .semaphoreCount = 1,
        .pSemaphores = &m->timeline,
        .pValues = &value,
    };
    CHECK(vkWaitSemaphores(m->host.vulkan.device, &wait, UINT64_MAX));
}

void moving_host_finish(moving_host *m) {
    wait_for(m, m->value);
}

void moving_host_resize(moving_host *m, uint32_t width, uint32_t height) {
    moving_host_finish(m);
    destroy_pictures(m);
    for (int i = 0; i < MOVING_FLIGHT; i++)
        m->pictures[i] = host_image_create(&m->host, VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                                           VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                               VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
}

static void record_ripples(moving_host *m, VkCommandBuffer commands, float phase) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    CHECK(vkBeginCommandBuffer(commands, &begin));
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m->ripples);
    for (uint32_t i = 0; i < MOVING_MAPS; i++) {
        const bool colours = i < MOVING_COLOURS;
        const struct ripple_constants constants = {
            phase, colours ? 2 + (float)i : 1 + (float)(i - MOVING_COLOURS),
            colours ? m->colours : 1};
        host_barrier(commands, &m->maps[i], VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m->layout, 0, 1,
                                &m->sets[i], 0, NULL);
        vkCmdPushConstants(commands, m->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                           &constants);
        vkCmdDispatch(commands, MOVING_MAP / 8, MOVING_MAP / 8, 1);
    }
    CHECK(vkEndCommandBuffer(commands));
}

/// After the frame before, which reads the maps.
static void submit_ripples(moving_host *m, VkCommandBuffer commands) {
    const VkSemaphoreSubmitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                        .semaphore = m->timeline,
                                        .value = m->value,
                                        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    VkSemaphoreSubmitInfo signal = wait;
    signal.value = ++m->value;
    const VkCommandBufferSubmitInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                              .commandBuffer = commands};
    const VkSubmitInfo2 submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .waitSemaphoreInfoCount = 1,
        .pWaitSemaphoreInfos = &wait,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &buffer,
        .signalSemaphoreInfoCount = 1,
        .pSignalSemaphoreInfos = &signal,
    };
    CHECK(vkQueueSubmit2(m->host.vulkan.queue, 1, &submit, VK_NULL_HANDLE));
}

static void render(moving_host *m, const host_image *picture) {
    const lobe_vulkan_semaphore wait = {.semaphore = m->timeline, .value = m->value},
                                signal = {.semaphore = m->timeline, .value = m->value + 1};
    const lobe_vulkan_submission submission = {
        .waits = &wait, .wait_count = 1, .signals = &signal, .signal_count = 1};
    const lobe_vulkan_image radiance = {.image = picture->image,
                                        .format = picture->format,
                                        .width = picture->width,
                                        .height = picture->height,
                                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                        .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const lobe_render_target target = {.radiance = &radiance};
    const lobe_render_parameters parameters = {
        .filter = m->filter,
        .settings = m->settings,
        .host = {.target = &target, .submission = &submission, .frames_in_flight = MOVING_FLIGHT}};
    lobe_frame frame;
    if (lobe_renderer_render(m->renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s", m->host.recorder.last_error);
    lobe_frame_free(&frame);
    m->value++;
}

void moving_host_draw(moving_host *m, float phase) {
    m->slot = m->frame++ % MOVING_FLIGHT;
    wait_for(m, m->done[m->slot]);
    record_ripples(m, m->commands[m->slot], phase);
    submit_ripples(m, m->commands[m->slot]);
    render(m, &m->pictures[m->slot]);
    m->done[m->slot] = m->value;
}

float *moving_host_picture(moving_host *m) {
    const host_image *picture = &m->pictures[m->slot];
    const size_t size = (size_t)picture->width * picture->height * 4 * sizeof(float);
    float *texels = malloc(size);
    assert_non_null(texels);
    moving_host_finish(m);
    host_read(&m->host, picture, texels, size);
    return texels;
}
