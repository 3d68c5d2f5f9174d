#include "engine/pipeline/raster.h"

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/format.h"

#define COLOURS ENGINE_MAXIMUM_COLOUR_ATTACHMENTS

static VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage,
                                                VkShaderModule module) {
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .module = module,
        .pName = "main",
    };
}

static VkCullModeFlags cull_mode_of(lobe_cull cull) {
    switch (cull) {
    case LOBE_CULL_BACK:
        return VK_CULL_MODE_BACK_BIT;
    case LOBE_CULL_FRONT:
        return VK_CULL_MODE_FRONT_BIT;
    default:
        return VK_CULL_MODE_NONE;
    }
}

static VkPipelineRasterizationStateCreateInfo
rasterisation_of(const engine_raster_parameters *parameters) {
    return (VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = cull_mode_of(parameters->cull),
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1,
    };
}

static VkCompareOp comparison_of(const engine_raster_parameters *parameters) {
    if (!parameters->depth_test)
        return VK_COMPARE_OP_ALWAYS;
    return parameters->depth_equal ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER;
}

/// Vulkan writes depth only if the depth test is on.
static VkPipelineDepthStencilStateCreateInfo depth_of(const engine_raster_parameters *parameters) {
    return (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = parameters->depth_test || parameters->depth_write,
        .depthWriteEnable = parameters->depth_write,
        .depthCompareOp = comparison_of(parameters),
    };
}

static VkPipelineColorBlendAttachmentState blend_of(lobe_blend blend, bool written) {
    const VkColorComponentFlags all = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                      VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    const VkBlendFactor target =
        blend == LOBE_BLEND_ALPHA ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = blend != LOBE_BLEND_OFF,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = target,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = target,
        .colorWriteMask = written ? all : 0,
    };
}

static uint32_t colour_count(const engine_raster_parameters *parameters) {
    uint32_t count = COLOURS;
    while (count > 0 && parameters->colour[count - 1] == LOBE_FORMAT_NONE)
        count--;
    return count;
}

/// Attachments that the fragment shader does not write keep their content, except that a device
/// without independent blending must treat all attachments alike.
static void fill_blending(const lobe_device *device, const engine_raster_parameters *parameters,
                          uint32_t outputs, VkPipelineColorBlendAttachmentState blends[COLOURS]) {
    const bool alike = !device->features.core.features.independentBlend;
    for (uint32_t i = 0; i < COLOURS; i++)
        blends[i] = blend_of(parameters->blend, alike || (outputs >> i & 1));
}

static lobe_result check_blending(lobe_device *device, const engine_raster_parameters *parameters,
                                  const char *name) {
    for (uint32_t i = 0; i < COLOURS && parameters->blend != LOBE_BLEND_OFF; i++) {
        if (parameters->colour[i] == LOBE_FORMAT_NONE)
            continue;
        VkFormatProperties properties;
        device->instance.api.vkGetPhysicalDeviceFormatProperties(
            device->physical, engine_format_vulkan(parameters->colour[i]), &properties);
        if (!(properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT))
            return lobe_host_fail(&device->host, LOBE_ERROR_UNSUPPORTED,
                                  "pipeline '%s': the device cannot blend into %s", name,
                                  lobe_format_name(parameters->colour[i]));
    }
    return LOBE_OK;
}

lobe_result engine_raster_pipeline_create(lobe_device *device, VkPipelineCache cache,
                                          const engine_raster_parameters *parameters,
                                          VkShaderModule vertex, VkShaderModule fragment,
                                          engine_pipeline *pipeline) {
    const lobe_result supported = check_blending(device, parameters, pipeline->name);
    if (supported != LOBE_OK)
        return supported;
    VkPipelineShaderStageCreateInfo stages[2] = {stage_of(VK_SHADER_STAGE_VERTEX_BIT, vertex)};
    if (fragment)
        stages[1] = stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, fragment);
    const VkPipelineVertexInputStateCreateInfo no_attributes = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
    };
    const VkPipelineInputAssemblyStateCreateInfo triangles = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    const VkPipelineRasterizationStateCreateInfo rasterisation = rasterisation_of(parameters);
    const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples =
            (VkSampleCountFlagBits)(parameters->samples ? parameters->samples : 1),
    };
    const VkPipelineDepthStencilStateCreateInfo depth = depth_of(parameters);
    VkPipelineColorBlendAttachmentState blends[COLOURS];
    fill_blending(device, parameters, pipeline->output_locations, blends);
    const VkPipelineColorBlendStateCreateInfo blending = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = colour_count(parameters),
        .pAttachments = blends,
    };
    static const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT,
                                                    VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = sizeof dynamic_states / sizeof *dynamic_states,
        .pDynamicStates = dynamic_states,
    };
    VkFormat formats[COLOURS];
    for (uint32_t i = 0; i < COLOURS; i++)
        formats[i] = engine_format_vulkan(parameters->colour[i]);
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = blending.attachmentCount,
        .pColorAttachmentFormats = formats,
        .depthAttachmentFormat = engine_format_vulkan(parameters->depth),
    };
    const VkGraphicsPipelineCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = fragment ? 2 : 1,
        .pStages = stages,
        .pVertexInputState = &no_attributes,
        .pInputAssemblyState = &triangles,
        .pViewportState = &viewport,
        .pRasterizationState = &rasterisation,
        .pMultisampleState = &samples,
        .pDepthStencilState = &depth,
        .pColorBlendState = &blending,
        .pDynamicState = &dynamic,
        .layout = pipeline->layout,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreateGraphicsPipelines(device->vulkan, cache, 1, &create,
                                                              device->callbacks,
                                                              &pipeline->pipeline),
                        "pipeline '%s'", pipeline->name);
}
