#ifndef PASSES_UPLOAD_DEVICE_SCENE_PARTS_H
#define PASSES_UPLOAD_DEVICE_SCENE_PARTS_H

#include "passes/upload/device_scene.h"

/// The steps of a device scene's creation that its update takes again, one for each part. What a
/// part needs and the device lacks is uploaded, too.

/// How a material uses a map (MAP_...); NULL: it has none, or the scene does not need it.
const lobe_texture_use *passes_device_scene_map(const lobe_scene *scene,
                                                const lobe_material *material, uint32_t map);

/// Describes a material from the scene and its maps, and stores its constants: in new buffers, or
/// those it has. The material must have been checked.
lobe_result passes_device_scene_upload_material(lobe_device *device, device_scene *scene,
                                                uint32_t index, const lobe_host *host);

/// Buffers of a mesh, which has none. It must have been checked.
lobe_result passes_device_scene_upload_mesh(lobe_device *device, device_scene *scene,
                                            uint32_t index);

/// The texture of the scene's environment, if it has one and there is none yet.
lobe_result passes_device_scene_upload_environment(lobe_device *device, device_scene *scene);

/// LOBE_ERROR_MALFORMED: its mesh or its material does not exist.
lobe_result passes_device_scene_check_instance(const lobe_scene *scene, size_t index,
                                               const lobe_host *host);
/// Checks and uploads what the instance needs and the device lacks, then measures it.
lobe_result passes_device_scene_upload_instance(lobe_device *device, device_scene *scene,
                                                size_t index, const lobe_host *host);
/// What follows from its transform, its mesh and its maps.
void passes_device_scene_measure_instance(device_scene *scene, size_t index);

#endif
