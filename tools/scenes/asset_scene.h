#ifndef TOOLS_SCENES_ASSET_SCENE_H
#define TOOLS_SCENES_ASSET_SCENE_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

#include "scenes/builtin/assembly.h"
#include "tools/scenes/asset_mesh.h"

/// Scenes that show one mesh from a folder of assets (may be NULL). Each is one file,
/// tools/scenes/<name>.c, and one row of the table in tools/scenes/scene_list.c. On failure
/// `*scene` is NULL. Errors: as for asset_mesh_load.

/// Reads the mesh, runs the steps, an array that ends with NULL, on an empty scene, places the mesh
/// there with the first material that they added, and completes the scene.
lobe_result asset_scene_assemble(const asset_mesh *wanted, const char *assets,
                                 const builtin_step *steps, const lobe_host *host,
                                 lobe_scene **scene);

lobe_result asset_scene_bunny(const char *assets, const lobe_host *host, lobe_scene **scene);
lobe_result asset_scene_dragon(const char *assets, const lobe_host *host, lobe_scene **scene);

#endif
