#include "scenes/scene/scene.h"

lobe_result scenes_add_missing_light(lobe_scene *scene, const lobe_host *host) {
    scene->has_added_light = scene->light_count == 0 && !scene->environment;
    if (!scene->has_added_light)
        return LOBE_OK;
    lobe_host_log(host, LOBE_LOG_NOTICE, "%s: has no light; added the environment 'sky'",
                  scene->name);
    return lobe_environment_open("sky", host, &scene->environment);
}

void lobe_scene_set_environment(lobe_scene *scene, lobe_environment *environment) {
    lobe_environment_destroy(&scene->environment);
    scene->environment = environment;
    scene->has_added_light = false;
}
