#include "engine/pipeline/layout.h"

#include <stdlib.h>
#include <string.h>

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"

// ---------------------------------------------------------------------------------------------
// Merging

static bool clash(const engine_shader_binding *first, const engine_shader_binding *second) {
    const bool same_name = !strcmp(first->name, second->name);
    const bool same_binding = first->binding == second->binding;
    const bool same_kind = first->type == second->type && first->count == second->count &&
                           first->view == second->view && first->format == second->format;
    return same_name != same_binding || (same_binding && !same_kind);
}

static void merge_into(engine_shader_binding *target, const engine_shader_binding *source) {
    target->stages |= source->stages;
    target->reads |= source->reads;
    target->writes |= source->writes;
    target->used |= source->used;
    if (source->size > target->size)
        target->size = source->size;
}

static lobe_result merge_binding(const lobe_host *host, const engine_shader_binding *binding,
                                 engine_pipeline *pipeline) {
    for (size_t i = 0; i < pipeline->binding_count; i++) {
        engine_shader_binding *other = &pipeline->bindings[i];
        if (clash(other, binding))
            return lobe_host_fail(host, LOBE_ERROR_SHADER,
                                  "pipeline '%s': the stages disagree about '%s' (binding %u) and "
                                  "'%s' (binding %u)",
                                  pipeline->name, other->name, other->binding, binding->name,
                                  binding->binding);
        if (other->binding == binding->binding) {
            merge_into(other, binding);
            return LOBE_OK;
        }
    }
    pipeline->bindings[pipeline->binding_count++] = *binding;
    return LOBE_OK;
}

static int order_by_binding(const void *first, const void *second) {
    const uint32_t a = ((const engine_shader_binding *)first)->binding;
    const uint32_t b = ((const engine_shader_binding *)second)->binding;
    return (a > b) - (a < b);
}

/// What is declared but not used needs no descriptor. Lavapipe would read one that is not written:
/// it follows the pointers of samplers.
static void drop_unused(engine_pipeline *pipeline) {
    size_t count = 0;
    for (size_t i = 0; i < pipeline->binding_count; i++)
        if (pipeline->bindings[i].used)
            pipeline->bindings[count++] = pipeline->bindings[i];
    pipeline->binding_count = count;
}

static lobe_result merge_bindings(const lobe_host *host, const engine_shader *const *shaders,
                                  size_t count, engine_pipeline *pipeline) {
    size_t most = 1;
    for (size_t i = 0; i < count; i++)
        most += shaders[i]->binding_count;
    pipeline->bindings = lobe_allocate(host->allocator, most, sizeof *pipeline->bindings);
    if (!pipeline->bindings)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "pipeline '%s': out of memory",
                              pipeline->name);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < shaders[i]->binding_count; j++) {
            const lobe_result result = merge_binding(host, &shaders[i]->bindings[j], pipeline);
            if (result != LOBE_OK)
                return result;
        }
    drop_unused(pipeline);
    qsort(pipeline->bindings, pipeline->binding_count, sizeof *pipeline->bindings,
          order_by_binding);
    return LOBE_OK;
}

static void merge_push_constants(const engine_shader *const *shaders, size_t count,
                                 engine_pipeline *pipeline) {
    for (size_t i = 0; i < count; i++) {
        if (shaders[i]->push_constant_size == 0)
            continue;
        pipeline->push_constant_stages |= shaders[i]->stage;
        if (shaders[i]->push_constant_size > pipeline->push_constant_size)
            pipeline->push_constant_size = shaders[i]->push_constant_size;
    }
}

// ---------------------------------------------------------------------------------------------
// Vulkan's layouts

static uint32_t count_type(const engine_pipeline *pipeline, VkDescriptorType type,
                           VkShaderStageFlags stage) {
    uint32_t count = 0;
    for (size_t i = 0; i < pipeline->binding_count; i++)
        if (pipeline->bindings[i].type == type && pipeline->bindings[i].stages & stage)
            count += pipeline->bindings[i].count;
    return count;
}

/// Drivers need not report it themselves: lavapipe would read other textures.
static lobe_result check_samplers(lobe_device *device, const engine_pipeline *pipeline) {
    static const VkShaderStageFlags stages[] = {
        VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT, VK_SHADER_STAGE_COMPUTE_BIT};
    const uint32_t most = device->limits.maxPerStageDescriptorSamplers;
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        const uint32_t count =
            count_type(pipeline, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, stages[i]);
        if (count > most)
            return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                                  "pipeline '%s': a stage has %u samplers, the device allows %u",
                                  pipeline->name, count, most);
    }
    return LOBE_OK;
}

static lobe_result create_set_layout(lobe_device *device, engine_pipeline *pipeline) {
    VkDescriptorSetLayoutBinding *bindings =
        lobe_allocate(device->host.allocator, pipeline->binding_count + 1, sizeof *bindings);
    if (!bindings)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "pipeline '%s': out of memory", pipeline->name);
    for (size_t i = 0; i < pipeline->binding_count; i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){
            .binding = pipeline->bindings[i].binding,
            .descriptorType = pipeline->bindings[i].type,
            .descriptorCount = pipeline->bindings[i].count,
            .stageFlags = pipeline->bindings[i].stages,
        };
    const VkDescriptorSetLayoutCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = (uint32_t)pipeline->binding_count,
        .pBindings = bindings,
    };
    const lobe_result result =
        VULKAN_CHECK(&device->host,
                     device->api.vkCreateDescriptorSetLayout(
                         device->vulkan, &create, device->callbacks, &pipeline->set_layout),
                     "pipeline '%s'", pipeline->name);
    lobe_release(bindings);
    return result;
}

static lobe_result create_layout(lobe_device *device, engine_pipeline *pipeline) {
    if (pipeline->push_constant_size > device->limits.maxPushConstantsSize)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                              "pipeline '%s': %u bytes of push constants, the device allows %u",
                              pipeline->name, pipeline->push_constant_size,
                              device->limits.maxPushConstantsSize);
    const VkPushConstantRange range = {
        .stageFlags = pipeline->push_constant_stages,
        .size = pipeline->push_constant_size,
    };
    const VkPipelineLayoutCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &pipeline->set_layout,
        .pushConstantRangeCount = pipeline->push_constant_size ? 1 : 0,
        .pPushConstantRanges = &range,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreatePipelineLayout(device->vulkan, &create,
                                                           device->callbacks, &pipeline->layout),
                        "pipeline '%s'", pipeline->name);
}

lobe_result engine_pipeline_layout_create(lobe_device *device, const engine_shader *const *shaders,
                                          size_t count, engine_pipeline *pipeline) {
    merge_push_constants(shaders, count, pipeline);
    lobe_result result = merge_bindings(&device->host, shaders, count, pipeline);
    if (result == LOBE_OK)
        result = check_samplers(device, pipeline);
    if (result == LOBE_OK)
        result = create_set_layout(device, pipeline);
    if (result == LOBE_OK)
        result = create_layout(device, pipeline);
    return result;
}

void engine_pipeline_layout_destroy(lobe_device *device, engine_pipeline *pipeline) {
    device->api.vkDestroyPipelineLayout(device->vulkan, pipeline->layout, device->callbacks);
    device->api.vkDestroyDescriptorSetLayout(device->vulkan, pipeline->set_layout,
                                             device->callbacks);
    lobe_release(pipeline->bindings);
}
