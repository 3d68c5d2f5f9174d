// A program with its own device, vertex buffers, lights and pipelines, which takes only the
// filtering from lobe: the maps of materials, and the GLSL that reads them. It draws a scene into
// an OpenEXR file.
//
//     own_shading FILTER SCENE FILE.exr WIDTH HEIGHT [ENVIRONMENT]

#define PROGRAM "own_shading"
#include "vulkan_host.h"

#include <math.h>

#include "own_shading_lean.h"
#include "own_shading_lean_environment.h"
#include "own_shading_lobes.h"
#include "own_shading_lobes_environment.h"
#include "own_shading_moments.h"
#include "own_shading_moments_environment.h"
#include "own_shading_toksvig.h"
#include "own_shading_toksvig_environment.h"
#include "own_shading_vertex.h"

// As in own_shading.frag.
#define LOBE_SET           1
#define LOBE_BINDING_BASE  8
#define LOBE_CONSTANT_BASE 100

static void check(bool fine, const char *what) {
    if (fine)
        return;
    fprintf(stderr, PROGRAM ": %s failed\n", what);
    exit(1);
}

/// The program's fragment shader, compiled for each filter, without and with an environment.
typedef struct shader_words {
    const char *name;
    const uint32_t *words;
    size_t size;
} shader_words;

#define SHADER(name)                                                                               \
    { #name, own_shading_##name, sizeof own_shading_##name }
static const shader_words shaders[] = {
    SHADER(toksvig), SHADER(toksvig_environment), SHADER(lean),    SHADER(lean_environment),
    SHADER(lobes),   SHADER(lobes_environment),   SHADER(moments), SHADER(moments_environment)};

static const shader_words *shader_of(const char *filter, bool environment) {
    char name[64];
    snprintf(name, sizeof name, "%s%s", filter, environment ? "_environment" : "");
    for (size_t i = 0; i < sizeof shaders / sizeof *shaders; i++)
        if (!strcmp(shaders[i].name, name))
            return &shaders[i];
    check(false, "finding a shader for the filter");
    return NULL;
}

// ---------------------------------------------------------------------------------------------
// Resources

/// One buffer for all that the program gives to the device or takes from it.
typedef struct store {
    VkBuffer buffer;
    VkDeviceMemory memory;
    void *mapped;
    VkDeviceSize used;
} store;

static store create_store(const host *h, VkDeviceSize size) {
    store s = {0};
    s.buffer =
        create_buffer(h, size,
                      VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                      &s.memory);
    CHECK(vkMapMemory(h->vulkan.device, s.memory, 0, VK_WHOLE_SIZE, 0, &s.mapped));
    return s;
}

#define STORE_ALIGNMENT 256

/// Returns the offset. `data`: NULL: the device will write.
static VkDeviceSize add(store *s, const void *data, size_t size) {
    const VkDeviceSize offset = s->used;
    if (data)
        memcpy((char *)s->mapped + offset, data, size);
    s->used += (size + STORE_ALIGNMENT - 1) / STORE_ALIGNMENT * STORE_ALIGNMENT;
    return offset;
}

typedef struct image {
    VkImage image;
    VkImageView view;
    VkDeviceMemory memory;
} image;

static image create_view(const host *h, VkFormat format, VkImageAspectFlags aspect, VkFlags usage,
                         VkExtent2D extent) {
    image created;
    created.image = create_image(h, format, extent, usage, &created.memory);
    const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = created.image,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = format,
                                        .subresourceRange = {aspect, 0, 1, 0, 1}};
    CHECK(vkCreateImageView(h->vulkan.device, &view, NULL, &created.view));
    return created;
}

static void destroy_image(const host *h, image *gone) {
    vkDestroyImageView(h->vulkan.device, gone->view, NULL);
    vkDestroyImage(h->vulkan.device, gone->image, NULL);
    vkFreeMemory(h->vulkan.device, gone->memory, NULL);
}

// ---------------------------------------------------------------------------------------------
// The program's descriptors and pipelines

typedef struct own_material {
    VkDescriptorSetLayout set_layout;
    VkDescriptorSet set;
    VkPipelineLayout layout;
    VkPipeline pipeline;
} own_material;

typedef struct own_mesh {
    VkDeviceSize vertices, indices; ///< where they are in the store
} own_mesh;

typedef struct drawing {
    const host *host;
    const lobe_scene *scene;
    const shader_words *shader;
    VkExtent2D extent;
    VkDescriptorPool pool;
    VkDescriptorSetLayout own_layout;
    VkDescriptorSet own_set;
    store store;
    VkDeviceSize pixels; ///< where they are in the store
    image colour, depth;
    own_mesh *meshes;
    own_material *materials;
} drawing;

static void create_pool(drawing *d) {
    const uint32_t sets = (uint32_t)d->scene->material_count + 1, most = 32 * sets;
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, most},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, most},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, most}};
    const VkDescriptorPoolCreateInfo create = {.sType =
                                                   VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                               .maxSets = sets,
                                               .poolSizeCount = 3,
                                               .pPoolSizes = sizes};
    CHECK(vkCreateDescriptorPool(d->host->vulkan.device, &create, NULL, &d->pool));
}

/// A layout and a set of it with these descriptors, which come `base` bindings later.
static VkDescriptorSet create_set(const drawing *d, const lobe_vulkan_descriptor *descriptors,
                                  size_t count, uint32_t base, VkDescriptorSetLayout *layout) {
    const VkDevice device = d->host->vulkan.device;
    VkDescriptorSetLayoutBinding bindings[64];
    VkWriteDescriptorSet writes[64];
    check(count <= 64, "binding so many resources");
    for (size_t i = 0; i < count; i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = base + descriptors[i].binding,
                                                     .descriptorType = descriptors[i].type,
                                                     .descriptorCount = 1,
                                                     .stageFlags = VK_SHADER_STAGE_VERTEX_BIT |
                                                                   VK_SHADER_STAGE_FRAGMENT_BIT};
    const VkDescriptorSetLayoutCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = (uint32_t)count,
        .pBindings = bindings};
    CHECK(vkCreateDescriptorSetLayout(device, &create, NULL, layout));
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = d->pool,
        .descriptorSetCount = 1,
        .pSetLayouts = layout};
    VkDescriptorSet set;
    CHECK(vkAllocateDescriptorSets(device, &allocate, &set));
    for (size_t i = 0; i < count; i++)
        writes[i] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                           .dstSet = set,
                                           .dstBinding = bindings[i].binding,
                                           .descriptorCount = 1,
                                           .descriptorType = descriptors[i].type,
                                           .pImageInfo = &descriptors[i].image,
                                           .pBufferInfo = &descriptors[i].buffer};
    vkUpdateDescriptorSets(device, (uint32_t)count, writes, 0, NULL);
    return set;
}

static VkShaderModule create_module(const host *h, const uint32_t *words, size_t size) {
    const VkShaderModuleCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    VkShaderModule module;
    CHECK(vkCreateShaderModule(h->vulkan.device, &create, NULL, &module));
    return module;
}

/// `stages`: two.
static VkPipeline create_pipeline(const drawing *d, const VkPipelineShaderStageCreateInfo *stages,
                                  VkPipelineLayout layout, bool double_sided) {
    static const VkFormat three = VK_FORMAT_R32G32B32_SFLOAT, four = VK_FORMAT_R32G32B32A32_SFLOAT;
    static const VkVertexInputBindingDescription binding = {0, sizeof(lobe_scene_vertex),
                                                            VK_VERTEX_INPUT_RATE_VERTEX};
    static const VkVertexInputAttributeDescription attributes[] = {
        {0, 0, three, offsetof(lobe_scene_vertex, position)},
        {1, 0, three, offsetof(lobe_scene_vertex, normal)},
        {2, 0, four, offsetof(lobe_scene_vertex, tangent)},
        {3, 0, four, offsetof(lobe_scene_vertex, texture_coordinates)},
        {4, 0, four, offsetof(lobe_scene_vertex, colour)}};
    const VkPipelineVertexInputStateCreateInfo input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 1,
        .pVertexBindingDescriptions = &binding,
        .vertexAttributeDescriptionCount = 5,
        .pVertexAttributeDescriptions = attributes};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkViewport viewport = {
        .width = (float)d->extent.width, .height = (float)d->extent.height, .maxDepth = 1};
    const VkRect2D scissor = {.extent = d->extent};
    const VkPipelineViewportStateCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .pViewports = &viewport,
        .scissorCount = 1,
        .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE,
        .depthCompareOp = VK_COMPARE_OP_GREATER};
    const VkPipelineColorBlendAttachmentState plain = {.colorWriteMask = 0xf};
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &plain};
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = 1,
        .pColorAttachmentFormats = &four,
        .depthAttachmentFormat = VK_FORMAT_D32_SFLOAT};
    const VkGraphicsPipelineCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = 2,
        .pStages = stages,
        .pVertexInputState = &input,
        .pInputAssemblyState = &assembly,
        .pViewportState = &view,
        .pRasterizationState = &raster,
        .pMultisampleState = &samples,
        .pDepthStencilState = &depth,
        .pColorBlendState = &blend,
        .layout = layout};
    VkPipeline pipeline;
    CHECK(vkCreateGraphicsPipelines(d->host->vulkan.device, NULL, 1, &create, NULL, &pipeline));
    return pipeline;
}

static VkSpecializationInfo specialise(const lobe_material_maps *maps,
                                       VkSpecializationMapEntry entries[128]) {
    check(maps->constant_count <= 128, "setting so many constants");
    for (uint32_t i = 0; i < maps->constant_count; i++)
        entries[i] = (VkSpecializationMapEntry){
            .constantID = LOBE_CONSTANT_BASE + maps->constants[i].id,
            .offset = (uint32_t)(i * sizeof *maps->constants + offsetof(lobe_specialisation, bits)),
            .size = sizeof maps->constants[i].bits};
    return (VkSpecializationInfo){(uint32_t)maps->constant_count, entries,
                                  maps->constant_count * sizeof *maps->constants, maps->constants};
}

/// What lobe says of a material becomes a descriptor set and a specialised pipeline.
static own_material create_material(const drawing *d, const lobe_material *source,
                                    const lobe_material_maps *maps) {
    own_material material;
    material.set = create_set(d, maps->descriptors, maps->descriptor_count, LOBE_BINDING_BASE,
                              &material.set_layout);
    const VkDescriptorSetLayout sets[] = {d->own_layout, material.set_layout};
    const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, 16 * sizeof(float)};
    const VkPipelineLayoutCreateInfo create = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 2,
                                               .pSetLayouts = sets,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &push};
    CHECK(vkCreatePipelineLayout(d->host->vulkan.device, &create, NULL, &material.layout));
    VkSpecializationMapEntry entries[128];
    const VkSpecializationInfo specialisation = specialise(maps, entries);
    VkPipelineShaderStageCreateInfo stages[] = {
        {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
         .stage = VK_SHADER_STAGE_VERTEX_BIT,
         .module = create_module(d->host, own_shading_vertex, sizeof own_shading_vertex),
         .pName = "main"},
        {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
         .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
         .module = create_module(d->host, d->shader->words, d->shader->size),
         .pName = "main",
         .pSpecializationInfo = &specialisation}};
    material.pipeline = create_pipeline(d, stages, material.layout, source->double_sided);
    for (int i = 0; i < 2; i++)
        vkDestroyShaderModule(d->host->vulkan.device, stages[i].module, NULL);
    return material;
}

/// What the program's shaders read: the camera, the picture's scales, the lights.
static void describe_own(drawing *d) {
    const lobe_scene *scene = d->scene;
    const float high = 1 / tanf(0.5f * scene->camera.vertical_field_of_view);
    const float scales[] = {high / ((float)d->extent.width / (float)d->extent.height), high};
    const size_t lights = scene->light_count * sizeof *scene->lights,
                 size = sizeof scene->camera + sizeof scales + lights;
    const VkDeviceSize offset = add(&d->store, NULL, size);
    char *block = (char *)d->store.mapped + offset;
    memcpy(block, &scene->camera, sizeof scene->camera);
    memcpy(block + sizeof scene->camera, scales, sizeof scales);
    memcpy(block + size - lights, scene->lights, lights);
    const lobe_vulkan_descriptor own = {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                        .buffer = {d->store.buffer, offset, size}};
    d->own_set = create_set(d, &own, 1, 0, &d->own_layout);
}

static void add_meshes(drawing *d) {
    for (size_t i = 0; i < d->scene->mesh_count; i++) {
        const lobe_mesh *mesh = &d->scene->meshes[i];
        d->meshes[i].vertices =
            add(&d->store, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
        d->meshes[i].indices =
            add(&d->store, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    }
}

static void create_drawing(drawing *d) {
    const size_t pixels = (size_t)16 * d->extent.width * d->extent.height;
    size_t size = pixels + (d->scene->mesh_count * 2 + 4) * STORE_ALIGNMENT +
                  (d->scene->light_count + 2) * sizeof *d->scene->lights;
    for (size_t i = 0; i < d->scene->mesh_count; i++)
        size += d->scene->meshes[i].vertex_count * sizeof *d->scene->meshes[i].vertices +
                d->scene->meshes[i].index_count * sizeof *d->scene->meshes[i].indices;
    d->meshes = calloc(d->scene->mesh_count, sizeof *d->meshes);
    d->materials = calloc(d->scene->material_count, sizeof *d->materials);
    check(d->meshes && d->materials, "allocating memory");
    d->store = create_store(d->host, size);
    d->pixels = add(&d->store, NULL, pixels);
    add_meshes(d);
    d->colour = create_view(d->host, VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_ASPECT_COLOR_BIT,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            d->extent);
    d->depth = create_view(d->host, VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT,
                           VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, d->extent);
    create_pool(d);
    describe_own(d);
}

static void destroy_drawing(drawing *d) {
    const VkDevice device = d->host->vulkan.device;
    for (size_t i = 0; i < d->scene->material_count; i++) {
        vkDestroyPipeline(device, d->materials[i].pipeline, NULL);
        vkDestroyPipelineLayout(device, d->materials[i].layout, NULL);
        vkDestroyDescriptorSetLayout(device, d->materials[i].set_layout, NULL);
    }
    vkDestroyDescriptorSetLayout(device, d->own_layout, NULL);
    vkDestroyDescriptorPool(device, d->pool, NULL);
    vkDestroyBuffer(device, d->store.buffer, NULL);
    vkFreeMemory(device, d->store.memory, NULL);
    destroy_image(d->host, &d->colour);
    destroy_image(d->host, &d->depth);
    free(d->meshes);
    free(d->materials);
}

// ---------------------------------------------------------------------------------------------
// The picture

static void draw_instance(const drawing *d, VkCommandBuffer commands,
                          const lobe_instance *instance) {
    const own_material *material = &d->materials[instance->material];
    const VkDescriptorSet sets[] = {d->own_set, material->set};
    const own_mesh *mesh = &d->meshes[instance->mesh];
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, material->pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, material->layout, 0, 2, sets,
                            0, NULL);
    vkCmdPushConstants(commands, material->layout, VK_SHADER_STAGE_VERTEX_BIT, 0,
                       sizeof instance->transform, instance->transform);
    vkCmdBindVertexBuffers(commands, 0, 1, &d->store.buffer, &mesh->vertices);
    vkCmdBindIndexBuffer(commands, d->store.buffer, mesh->indices, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, (uint32_t)d->scene->meshes[instance->mesh].index_count, 1, 0, 0, 0);
}

static void draw(const drawing *d, VkCommandBuffer commands) {
    VkRenderingAttachmentInfo colour = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = d->colour.view,
                                        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    memcpy(colour.clearValue.color.float32, d->scene->background, sizeof d->scene->background);
    const VkRenderingAttachmentInfo depth = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = d->depth.view,
                                             .imageLayout =
                                                 VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR};
    const VkRenderingInfo rendering = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                       .renderArea = {.extent = d->extent},
                                       .layerCount = 1,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &colour,
                                       .pDepthAttachment = &depth};
    barrier(commands, d->colour.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            colour.imageLayout);
    barrier(commands, d->depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            depth.imageLayout);
    vkCmdBeginRendering(commands, &rendering);
    for (size_t i = 0; i < d->scene->instance_count; i++)
        draw_instance(d, commands, &d->scene->instances[i]);
    vkCmdEndRendering(commands);
    barrier(commands, d->colour.image, VK_IMAGE_ASPECT_COLOR_BIT, colour.imageLayout,
            VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy = {.bufferOffset = d->pixels,
                                    .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {d->extent.width, d->extent.height, 1}};
    vkCmdCopyImageToBuffer(commands, d->colour.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           d->store.buffer, 1, &copy);
}

/// Filtering and drawing, in one command buffer.
static lobe_result draw_with(drawing *d, lobe_maps *maps) {
    VkCommandBuffer commands = begin(d->host);
    lobe_result result = lobe_maps_record(maps, &(lobe_vulkan_submission){.commands = commands});
    for (uint32_t i = 0; result == LOBE_OK && i < d->scene->material_count; i++) {
        lobe_material_maps material;
        result = lobe_maps_get(maps, i, &material);
        if (result == LOBE_OK)
            d->materials[i] = create_material(d, &d->scene->materials[i], &material);
    }
    if (result != LOBE_OK)
        return result;
    draw(d, commands);
    submit_and_wait(d->host, commands);
    return LOBE_OK;
}

static lobe_result write_picture(const drawing *d, const char *path) {
    const lobe_image picture = {LOBE_FORMAT_RGBA32_FLOAT, d->extent.width, d->extent.height,
                                (char *)d->store.mapped + d->pixels};
    const lobe_exr_layer layer = {.image = &picture, .depth = LOBE_EXR_FLOAT};
    return lobe_exr_write(path, &(lobe_exr_parameters){.layers = &layer, .layer_count = 1},
                          &messages);
}

int main(int argc, char **argv) {
    if (argc != 6 && argc != 7) {
        fprintf(stderr, "Usage: own_shading FILTER SCENE FILE.exr WIDTH HEIGHT [ENVIRONMENT]\n");
        return 2;
    }
    host h = {0};
    open_host(&h);
    lobe_device *device = NULL;
    lobe_scene *scene = NULL;
    lobe_environment *environment = NULL;
    lobe_maps *maps = NULL;
    lobe_maps_parameters parameters = {.vertex_colours = true}; // white where a mesh has none
    lobe_result result =
        lobe_vulkan_import_device(&h.vulkan, &(lobe_device_parameters){.host = &messages}, &device);
    result = result ? result : lobe_filter_find(argv[1], &messages, &parameters.filter);
    result = result ? result : lobe_scene_open(argv[2], &messages, &scene);
    if (!result && argc == 7)
        result = lobe_environment_open(argv[6], &messages, &environment);
    if (environment)
        lobe_scene_set_environment(scene, environment);
    parameters.scene = scene;
    result = result ? result : lobe_maps_create(device, &parameters, &messages, &maps);
    if (result == LOBE_OK) {
        drawing d = {
            .host = &h,
            .scene = scene,
            .shader = shader_of(argv[1], scene->environment != NULL),
            .extent = {(uint32_t)strtoul(argv[4], NULL, 10), (uint32_t)strtoul(argv[5], NULL, 10)}};
        create_drawing(&d);
        result = draw_with(&d, maps);
        result = result ? result : write_picture(&d, argv[3]);
        destroy_drawing(&d);
    }
    lobe_maps_destroy(&maps);
    lobe_scene_destroy(&scene);
    lobe_device_destroy(&device);
    close_host(&h);
    return result != LOBE_OK;
}
