#ifndef ENGINE_PIPELINE_RASTER_H
#define ENGINE_PIPELINE_RASTER_H

#include "engine/pipeline/pipeline.h"

/// Creates the Vulkan pipeline for a draw. `pipeline` has its name, layout and output_locations;
/// `fragment` may be null; `cache` may be null.
/// LOBE_ERROR_UNSUPPORTED: the device cannot blend into an attachment's format.
lobe_result engine_raster_pipeline_create(lobe_device *device, VkPipelineCache cache,
                                          const engine_raster_parameters *parameters,
                                          VkShaderModule vertex, VkShaderModule fragment,
                                          engine_pipeline *pipeline);

#endif
