#ifndef ENGINE_PIPELINE_MODULE_H
#define ENGINE_PIPELINE_MODULE_H

#include <lobe/graph.h>

#include "engine/shader/shader.h"

/// Creates the module of a shader for one pipeline, with values for its specialisation constants;
/// those of constants that it lacks are ignored. Destroy it with vkDestroyShaderModule as soon as
/// the pipeline exists.
///
/// Constants are not left to the driver: they make most code of a shading shader unreachable, which
/// SPIRV-Tools finds out faster than lavapipe. The hall's shading pipelines take two thirds of the
/// time, and a third of it with light from an environment.
/// LOBE_ERROR_SHADER: the shader cannot be specialised.
lobe_result engine_module_create(lobe_device *device, const engine_shader *shader,
                                 const lobe_specialisation *values, size_t count,
                                 VkShaderModule *module);

#endif
