#include "tools/scenes/asset_scene.h"

#include "scenes/mesh/mesh.h"
#include "scenes/scene/scene.h"

lobe_result asset_scene_assemble(const asset_mesh *wanted, const char *assets,
                                 const builtin_step *steps, const lobe_host *host,
                                 lobe_scene **scene) {
    lobe_mesh mesh;
    *scene = NULL;
    lobe_result status = asset_mesh_load(wanted, assets, host, &mesh);
    if (!status)
        status = scenes_allocate(wanted->scene, host, scene);
    for (; !status && *steps; steps++)
        status = (*steps)(*scene, host);
    if (!status)
        status = scenes_place_mesh(*scene, &mesh, 0, host);
    if (!status)
        status = scenes_complete(*scene, false, host);
    scenes_mesh_free(&mesh);
    if (status)
        lobe_scene_destroy(scene);
    return status;
}
