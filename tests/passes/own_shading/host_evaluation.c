#include "tests/passes/own_shading/host_evaluation.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define CHECK(call) assert_int_equal(call, VK_SUCCESS)

static void create_pool(host_evaluation *e) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 32},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 32},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 32}};
    const VkDescriptorPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 2,
        .poolSizeCount = 3,
        .pPoolSizes = sizes,
    };
    CHECK(vkCreateDescriptorPool(e->host->vulkan.device, &create, NULL, &e->pool));
}

static void create_set(host_evaluation *e, uint32_t number,
                       const lobe_vulkan_descriptor *descriptors, size_t count) {
    const VkDevice device = e->host->vulkan.device;
    VkDescriptorSetLayoutBinding bindings[64];
    assert_in_range(count, 1, 64);
    for (size_t i = 0; i < count; i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){descriptors[i].binding, descriptors[i].type, 1,
                                                     VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    const VkDescriptorSetLayoutCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = (uint32_t)count,
        .pBindings = bindings,
    };
    CHECK(vkCreateDescriptorSetLayout(device, &create, NULL, &e->set_layouts[number]));
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = e->pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &e->set_layouts[number],
    };
    CHECK(vkAllocateDescriptorSets(device, &allocate, &e->sets[number]));
    for (size_t i = 0; i < count; i++) {
        const VkWriteDescriptorSet write = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = e->sets[number],
            .dstBinding = descriptors[i].binding,
            .descriptorCount = 1,
            .descriptorType = descriptors[i].type,
            .pImageInfo = &descriptors[i].image,
            .pBufferInfo = &descriptors[i].buffer,
        };
        vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
    }
}

static void create_pipeline(host_evaluation *e, const host_shader *shader,
                            const lobe_material_maps *maps) {
    const VkDevice device = e->host->vulkan.device;
    const VkShaderModuleCreateInfo code = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                           .codeSize = shader->size,
                                           .pCode = shader->words};
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 2,
        .pSetLayouts = e->set_layouts,
    };
    VkSpecializationMapEntry entries[128];
    VkShaderModule module;
    CHECK(vkCreateShaderModule(device, &code, NULL, &module));
    CHECK(vkCreatePipelineLayout(device, &layout, NULL, &e->layout));
    assert_in_range(maps->constant_count, 1, 128);
    for (uint32_t i = 0; i < maps->constant_count; i++)
        entries[i] = (VkSpecializationMapEntry){
            shader->constant_base + maps->constants[i].id,
            (uint32_t)(i * sizeof *maps->constants + offsetof(lobe_specialisation, bits)), 4};
    const VkSpecializationInfo specialisation = {(uint32_t)maps->constant_count, entries,
                                                 maps->constant_count * sizeof *maps->constants,
                                                 maps->constants};
    const VkComputePipelineCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main",
                  .pSpecializationInfo = &specialisation},
        .layout = e->layout,
    };
    CHECK(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &create, NULL, &e->pipeline));
    vkDestroyShaderModule(device, module, NULL);
}

static void begin(host_evaluation *e, host_device *host, lobe_maps *maps, const host_shader *shader,
                  size_t size) {
    lobe_material_maps material;
    assert_int_equal(lobe_maps_get(maps, 0, &material), LOBE_OK);
    e->host = host;
    e->data = host_buffer_create(host, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    create_pool(e);
    const lobe_vulkan_descriptor own = {.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                        .buffer = {e->data.buffer, 0, size}};
    create_set(e, 0, &own, 1);
    create_set(e, 1, material.descriptors, material.descriptor_count);
    create_pipeline(e, shader, &material);
}

static void copy(const host_evaluation *e, void *data, size_t size, bool out) {
    void *mapped;
    CHECK(vkMapMemory(e->host->vulkan.device, e->data.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    memcpy(out ? data : mapped, out ? mapped : data, size);
    vkUnmapMemory(e->host->vulkan.device, e->data.memory);
}

void host_evaluation_run(host_evaluation *e, host_device *host, lobe_maps *maps,
                         const host_shader *shader, void *data, size_t size) {
    VkCommandBuffer commands = host_begin(host);
    if (lobe_maps_record(maps, &(lobe_vulkan_submission){.commands = commands}) != LOBE_OK)
        fail_msg("%s", host->recorder.last_error);
    if (!e->host)
        begin(e, host, maps, shader, size);
    copy(e, data, size, false);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, e->pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, e->layout, 0, 2, e->sets, 0,
                            NULL);
    vkCmdDispatch(commands, shader->groups, 1, 1);
    host_finish(host, commands);
    copy(e, data, size, true);
}

void host_evaluation_end(host_evaluation *e) {
    const VkDevice device = e->host->vulkan.device;
    vkDestroyPipeline(device, e->pipeline, NULL);
    vkDestroyPipelineLayout(device, e->layout, NULL);
    vkDestroyDescriptorPool(device, e->pool, NULL);
    for (int i = 0; i < 2; i++)
        vkDestroyDescriptorSetLayout(device, e->set_layouts[i], NULL);
    host_buffer_destroy(e->host, &e->data);
}
