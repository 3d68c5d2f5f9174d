#ifndef PASSES_UPLOAD_SCENE_UPLOAD_H
#define PASSES_UPLOAD_SCENE_UPLOAD_H

#include "passes/upload/device_scene.h"

/// Uploads, for one graph. `scene` must live as long as the copy, and the graph for longer. Errors:
/// as lobe_renderer_set_scene.
lobe_result passes_device_scene_create(lobe_device *device, lobe_graph *graph,
                                       const lobe_scene *scene, const lobe_host *host,
                                       device_scene **result);
/// The same, for texels that change: with `keeps_conclusions`.
lobe_result passes_device_scene_create_for_changing_texels(lobe_device *device, lobe_graph *graph,
                                                           const lobe_scene *scene,
                                                           const lobe_host *host,
                                                           device_scene **result);
/// Uploads what changed in the scene. Errors: as lobe_renderer_update_scene. If it fails half-way,
/// the copy is `torn`; if it fails for texels alone, it can still be drawn.
lobe_result passes_device_scene_update(device_scene *scene, const lobe_scene_changes *changes,
                                       const lobe_host *host);
/// Takes the numbers of materials that a pose moves (lobe_posed_material) to be those that were
/// uploaded.
void passes_device_scene_take_pose(device_scene *scene);
/// Uploads those that poses have moved since: no host announces them. Errors: as above.
lobe_result passes_device_scene_follow_pose(device_scene *scene, const lobe_host *host,
                                            bool *moved);
/// Clears the pointer; NULL is allowed.
void passes_device_scene_destroy(device_scene **scene);

#endif
