#ifndef ENGINE_PIPELINE_H
#define ENGINE_PIPELINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>
#include <lobe/graph.h>

#include "engine/shader/shader.h"

#define ENGINE_MAXIMUM_COLOUR_ATTACHMENTS 8

/// A pipeline with everything needed to bind resources to it: one descriptor set, set 0, shared by
/// all stages.
typedef struct engine_pipeline {
    const char *name; ///< of its shaders, for errors and labels
    VkPipelineBindPoint bind_point;
    VkPipeline pipeline;
    VkPipelineLayout layout;
    VkDescriptorSetLayout set_layout; ///< valid even without bindings
    uint64_t stamp;                  ///< identifies it (engine_device_stamp); handles may be reused
    engine_shader_binding *bindings; ///< of all stages, merged; ordered by binding
    size_t binding_count;
    VkShaderStageFlags push_constant_stages;
    uint32_t push_constant_size; ///< bytes; 0: none
    uint32_t local_size[3];      ///< compute, specialisation applied
    uint32_t output_locations;   ///< raster: colour outputs the fragment shader writes, as bits
} engine_pipeline;

typedef struct engine_compute_parameters {
    const char *shader;
    const lobe_specialisation *specialisation;
    size_t specialisation_count;
} engine_compute_parameters;

typedef struct engine_raster_parameters {
    const char *vertex_shader;
    const char *fragment_shader; ///< NULL: depth only
    const lobe_specialisation *specialisation;
    size_t specialisation_count;
    lobe_cull cull; ///< counter-clockwise as seen in the picture is the front
    bool depth_test, depth_write, depth_equal; ///< see lobe_draw
    lobe_blend blend;
    lobe_format colour[ENGINE_MAXIMUM_COLOUR_ATTACHMENTS]; ///< NONE: no attachment there
    lobe_format depth;                                     ///< NONE: no depth attachment
    uint32_t samples;                                      ///< 0 means 1
} engine_raster_parameters;

#endif
