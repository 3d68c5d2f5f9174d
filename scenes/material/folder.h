#ifndef SCENES_MATERIAL_FOLDER_H
#define SCENES_MATERIAL_FOLDER_H

#include <lobe/scene.h>

/// Opens a folder of maps: see lobe_scene_open_material.
lobe_result scenes_material_open(const lobe_scene_open_parameters *parameters, lobe_carrier carrier,
                                 const lobe_host *host, lobe_scene **result);

#endif
