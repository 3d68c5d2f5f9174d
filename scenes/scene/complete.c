#include <math.h>
#include <string.h>

#include "scenes/mesh/vector.h"
#include "scenes/scene/scene.h"

// Squares and products of lengths up to this stay within single precision on the GPU.
#define SCENE_MAXIMUM_LENGTH 1e18

static void include_point(vector3 p, vector3 *minimum, vector3 *maximum) {
    *minimum = (vector3){fmin(minimum->x, p.x), fmin(minimum->y, p.y), fmin(minimum->z, p.z)};
    *maximum = (vector3){fmax(maximum->x, p.x), fmax(maximum->y, p.y), fmax(maximum->z, p.z)};
}

static void include_instance(const lobe_scene *scene, const lobe_instance *instance,
                             vector3 *minimum, vector3 *maximum) {
    const lobe_mesh *mesh = &scene->meshes[instance->mesh];
    for (int corner = 0; corner < 8; corner++) {
        vector3 p = {corner & 1 ? mesh->maximum[0] : mesh->minimum[0],
                     corner & 2 ? mesh->maximum[1] : mesh->minimum[1],
                     corner & 4 ? mesh->maximum[2] : mesh->minimum[2]};
        include_point(vector3_transform(instance->transform, p), minimum, maximum);
    }
}

lobe_result scenes_set_bounds(lobe_scene *scene, const lobe_host *host) {
    vector3 minimum = {0, 0, 0}, maximum = {0, 0, 0};
    if (scene->instance_count > 0) {
        minimum = (vector3){INFINITY, INFINITY, INFINITY};
        maximum = vector3_scale(minimum, -1);
    }
    for (size_t i = 0; i < scene->instance_count; i++)
        include_instance(scene, &scene->instances[i], &minimum, &maximum);
    double largest = fmax(vector3_length(minimum), vector3_length(maximum));
    if (!(largest <= SCENE_MAXIMUM_LENGTH))
        return lobe_host_fail(host, LOBE_ERROR_LIMIT,
                              "%s: extends farther than %g m from the origin", scene->name,
                              SCENE_MAXIMUM_LENGTH);
    vector3_store(minimum, scene->minimum);
    vector3_store(maximum, scene->maximum);
    return LOBE_OK;
}

lobe_result scenes_add_missing_light(lobe_scene *scene, const lobe_host *host) {
    scene->has_added_light = scene->light_count == 0 && !scene->environment;
    if (!scene->has_added_light)
        return LOBE_OK;
    lobe_host_log(host, LOBE_LOG_NOTICE, "%s: has no light; added the environment 'sky'",
                  scene->name);
    return lobe_environment_open("sky", host, &scene->environment);
}

lobe_result scenes_complete(lobe_scene *scene, bool own_light_only, const lobe_host *host) {
    lobe_result result = scenes_set_bounds(scene, host);
    if (result != LOBE_OK)
        return result;
    if (!scene->has_camera)
        lobe_scene_frame(scene, 16.0 / 9, &scene->camera);
    // No notices about an empty scene: the renderer will report that it is empty.
    if (scene->instance_count == 0)
        return LOBE_OK;
    if (!scene->has_camera)
        lobe_host_log(host, LOBE_LOG_NOTICE, "%s: has no camera; added one that frames it",
                      scene->name);
    return own_light_only ? LOBE_OK : scenes_add_missing_light(scene, host);
}
