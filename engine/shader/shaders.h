#ifndef ENGINE_SHADERS_H
#define ENGINE_SHADERS_H

#include "engine/shader/shader.h"

/// The shaders of a device.
typedef struct engine_shaders engine_shaders;

/// Starts with the embedded shaders. `folder`: of their sources, for hot reload.
lobe_result engine_shaders_create(lobe_device *device, const char *folder,
                                  engine_shaders **shaders);
void engine_shaders_destroy(engine_shaders **shaders);

/// Adds a table of shaders that take precedence over those known before: for shaders outside of the
/// library, such as the tests'. The table is ordered by name (as strcmp does) and must outlive the
/// device. One that was added before is not added again.
lobe_result engine_shaders_add(lobe_device *device, const engine_shader_code *codes, size_t count,
                               const char *folder);

/// The number of shaders in use whose source changed since they were compiled; 0 without hot
/// reload.
size_t engine_shaders_stale(lobe_device *device);

/// Finds a shader by name and loads it if needed. It lives as long as the device. With hot reload,
/// a new shader with a new version is returned once its source has changed. LOBE_ERROR_SHADER: no
/// shader has that name, or it does not compile.
lobe_result engine_shader_find(lobe_device *device, const char *name, const engine_shader **shader);

#endif
