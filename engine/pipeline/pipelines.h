#ifndef ENGINE_PIPELINES_H
#define ENGINE_PIPELINES_H

#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/use.h"

/// Maximum number of pipelines that a device keeps. Beyond it, the least recently used pipelines
/// that no frame in progress uses are destroyed. Far more than one scene needs; it bounds what
/// accumulates over hours of changing settings.
#define ENGINE_MAXIMUM_PIPELINES 256

/// The pipelines and samplers of a device.
typedef struct engine_pipelines engine_pipelines;

/// `cache_file` may be NULL: nothing is read or written.
lobe_result engine_pipelines_create(lobe_device *device, const char *cache_file,
                                    engine_pipelines **pipelines);
/// Writes the cache file, then frees everything.
void engine_pipelines_destroy(lobe_device *device, engine_pipelines **pipelines);

/// Begins and ends a frame in progress: pipelines found in between live until it ends.
void engine_pipelines_begin_use(lobe_device *device, engine_pipeline_use *use);
void engine_pipelines_end_use(lobe_device *device, engine_pipeline_use *use);
/// Ends it as soon as the device's timeline has reached `submission`.
void engine_pipelines_end_use_after(lobe_device *device, engine_pipeline_use *use,
                                    uint64_t submission);

/// Finds or creates the pipeline for these parameters. With hot reload, a new one is returned once
/// a shader's source has changed. Outside of a frame in progress, the next call may evict it.
/// LOBE_ERROR_SHADER: a shader is missing or for another stage, or two stages disagree about a
/// binding.
lobe_result engine_pipeline_compute(lobe_device *device,
                                    const engine_compute_parameters *parameters,
                                    const engine_pipeline **pipeline);
/// Triangle lists without vertex attributes; viewport and scissor are dynamic.
lobe_result engine_pipeline_raster(lobe_device *device, const engine_raster_parameters *parameters,
                                   const engine_pipeline **pipeline);

/// Finds or creates the sampler for these settings. It lives as long as the device.
lobe_result engine_sampler(lobe_device *device, const lobe_sampler *settings, VkSampler *sampler);

#endif
