#ifndef ENGINE_PIPELINE_H
#define ENGINE_PIPELINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>
#include <lobe/graph.h>

#include "engine/pipeline/use.h"
#include "engine/shader/shader.h"

#define ENGINE_MAXIMUM_COLOUR_ATTACHMENTS 4

/// Pipelines that a device keeps. Above it those go that no frame in progress uses, the one unused
/// for longest first. Far more than one scene takes: it bounds hours of changed settings.
#define ENGINE_MAXIMUM_PIPELINES 256

/// A pipeline with all that is needed to bind resources to it. One descriptor set, set 0, shared
/// by all stages.
typedef struct engine_pipeline {
    const char *name; ///< of its shaders, for errors and labels
    VkPipelineBindPoint bind_point;
    VkPipeline pipeline;
    VkPipelineLayout layout;
    VkDescriptorSetLayout set_layout; ///< also where there are no bindings
    uint64_t stamp;                   ///< of this one, see engine_device_stamp: handles come again
    engine_shader_binding *bindings;  ///< of all stages, merged; ordered by binding
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
    bool depth_test, depth_write;
    lobe_blend blend;
    lobe_format colour[ENGINE_MAXIMUM_COLOUR_ATTACHMENTS]; ///< NONE: no attachment there
    lobe_format depth;                                     ///< NONE: no depth attachment
    uint32_t samples;                                      ///< 0 means 1
} engine_raster_parameters;

typedef struct engine_pipelines engine_pipelines;

/// `cache_file` may be NULL: nothing is read or written.
lobe_result engine_pipelines_create(lobe_device *device, const char *cache_file,
                                    engine_pipelines **pipelines);
/// Writes the cache file, then frees all.
void engine_pipelines_destroy(lobe_device *device, engine_pipelines **pipelines);

/// A frame in progress: pipelines that are found until it ends live until then at least.
void engine_pipelines_begin_use(lobe_device *device, engine_pipeline_use *use);
void engine_pipelines_end_use(lobe_device *device, engine_pipeline_use *use);

/// Gives the pipeline for these parameters, made at the first call, or again when it was evicted
/// since (see ENGINE_MAXIMUM_PIPELINES). With hot reload another one is given once a shader's
/// source has changed. Outside of a frame in progress it may be gone at the next call.
/// LOBE_ERROR_SHADER: a shader is missing, is of another stage, two stages disagree about a
/// binding.
lobe_result engine_pipeline_compute(lobe_device *device,
                                    const engine_compute_parameters *parameters,
                                    const engine_pipeline **pipeline);
/// Triangle lists without vertex attributes; viewport and scissor are dynamic.
lobe_result engine_pipeline_raster(lobe_device *device, const engine_raster_parameters *parameters,
                                   const engine_pipeline **pipeline);

/// Finds a binding by name; NULL where the pipeline has none.
const engine_shader_binding *engine_pipeline_binding(const engine_pipeline *pipeline,
                                                     const char *name);

/// Gives the sampler for these settings, made at the first call; lives as long as the device.
lobe_result engine_sampler(lobe_device *device, const lobe_sampler *settings, VkSampler *sampler);

#endif
