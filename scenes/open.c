#include <lobe/scene.h>

#include "scenes/builtin.h"
#include "scenes/gltf.h"

lobe_result lobe_scene_open(const char *scene, const lobe_log *log, lobe_scene **result) {
    *result = NULL;
    const builtin_scene *builtin = builtin_scene_find(scene);
    return builtin ? builtin->build(log, result) : gltf_open(scene, log, result);
}
