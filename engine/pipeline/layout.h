#ifndef ENGINE_PIPELINE_LAYOUT_H
#define ENGINE_PIPELINE_LAYOUT_H

#include <stddef.h>

#include "engine/pipeline/pipeline.h"

#define ENGINE_MAXIMUM_STAGES 2

/// Merges the bindings of a pipeline's stages and creates its Vulkan layouts: fills in bindings,
/// set_layout, layout and push_constant_*. `pipeline->name` must be set. Destroy them with
/// engine_pipeline_layout_destroy, even after a failure.
/// LOBE_ERROR_SHADER: two stages disagree. LOBE_ERROR_LIMIT: push constants are too large.
lobe_result engine_pipeline_layout_create(lobe_device *device, const engine_shader *const *shaders,
                                          size_t count, engine_pipeline *pipeline);
void engine_pipeline_layout_destroy(lobe_device *device, engine_pipeline *pipeline);

#endif
