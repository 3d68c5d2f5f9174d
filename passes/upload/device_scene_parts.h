#ifndef PASSES_UPLOAD_DEVICE_SCENE_PARTS_H
#define PASSES_UPLOAD_DEVICE_SCENE_PARTS_H

#include "passes/upload/device_scene.h"

/// The steps that creation and update of a device scene share, one per part. Each also uploads what
/// the part needs and the device does not have yet.

/// Describes a material from the scene and its maps, and stores those of its constants that differ,
/// in the buffers it has or in new ones. The material must have been checked.
lobe_result passes_device_scene_upload_material(device_scene *scene, uint32_t index,
                                                const lobe_host *host);

/// Clears what neither the directions nor the widths of lobes depend on.
void passes_device_material_forget_colours(struct material_constants *constants);

/// Fills the buffers of a mesh, which are created where it has none of that size. The mesh must
/// have been checked.
lobe_result passes_device_scene_upload_mesh(device_scene *scene, uint32_t index);

/// Creates the texture of an image, unless there is one or the host gives the texels.
lobe_result passes_device_scene_upload_image(device_scene *scene, int32_t index,
                                             const lobe_host *host);

/// Creates the textures of all height maps, for a filter that reads them.
lobe_result passes_device_scene_upload_heights(device_scene *scene, const lobe_host *host);

/// Creates the texture of the scene's environment, if it has one.
lobe_result passes_device_scene_upload_environment(device_scene *scene);

/// Makes room for a number of instances, without a change of those that there are. false: out of
/// memory.
bool passes_device_scene_reserve_instances(device_scene *scene, size_t count);
/// LOBE_ERROR_MALFORMED if the mesh or the material does not exist.
lobe_result passes_device_scene_check_instance(const lobe_scene *scene, size_t index,
                                               const lobe_host *host);
/// Checks and uploads what the instance needs and the device does not have, then derives
/// what follows from its transform, mesh and maps.
lobe_result passes_device_scene_upload_instance(device_scene *scene, size_t index,
                                                const lobe_host *host);
/// Takes over the scene's number of instances, lets each material and mesh find those that have it,
/// and finds what materials conclude from their meshes, after instances were uploaded.
void passes_device_scene_link_instances(device_scene *scene);

#endif
