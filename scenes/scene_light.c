#include <math.h>
#include <stdlib.h>

#include "scenes/scene.h"
#include "scenes/vector.h"

static lobe_light light_from(vector3 direction, float intensity) {
    lobe_light light = {.type = LOBE_LIGHT_DIRECTIONAL,
                        .intensity = {intensity, intensity, intensity}};
    vector3_normalise(&direction, 0);
    vector3_store(direction, light.direction);
    return light;
}

// The key comes over the left shoulder of whoever looks along the camera, the fill from the
// right. Pi lux make a white diffuse surface that faces the light as bright as 1.
static lobe_result add_lights(lobe_scene *scene, const lobe_log *log) {
    const lobe_camera *camera = &scene->camera;
    vector3 forward = vector3_subtract(vector3_load(camera->target), vector3_load(camera->eye));
    vector3 right = vector3_cross(forward, vector3_load(camera->up));
    if (!vector3_normalise(&forward, 0) || !vector3_normalise(&right, 0)) {
        forward = (vector3){0, 0, -1};
        right = (vector3){1, 0, 0};
    }
    vector3 up = vector3_cross(right, forward);
    vector3 key =
        vector3_add(forward, vector3_add(vector3_scale(right, 0.6), vector3_scale(up, -0.9)));
    vector3 fill =
        vector3_add(forward, vector3_add(vector3_scale(right, -0.8), vector3_scale(up, -0.2)));
    lobe_light lights[] = {light_from(key, (float)M_PI), light_from(fill, (float)(0.2 * M_PI))};
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        lobe_result result = scene_add_light(scene, &lights[i], log);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

lobe_result scene_add_missing_light(lobe_scene *scene, const lobe_log *log) {
    scene->has_added_light = scene->light_count == 0 && !scene->environment;
    if (!scene->has_added_light)
        return LOBE_OK;
    lobe_log_print(log, LOBE_LOG_NOTICE, "%s: has no light; added a key light and a weaker fill",
                   scene->name);
    return add_lights(scene, log);
}

static void remove_lights(lobe_scene *scene) {
    free(scene->lights);
    scene->lights = NULL;
    scene->light_count = 0;
}

void lobe_scene_set_environment(lobe_scene *scene, lobe_environment *environment) {
    lobe_environment_destroy(&scene->environment);
    scene->environment = environment;
    if (environment && scene->has_added_light)
        remove_lights(scene);
}
