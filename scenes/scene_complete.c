#include <math.h>
#include <string.h>

#include "scenes/scene.h"
#include "scenes/vector.h"

// Squares and products of lengths up to here stay within single precision on the GPU.
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

static lobe_result set_bounds(lobe_scene *scene, const lobe_log *log) {
    vector3 minimum = {0, 0, 0}, maximum = {0, 0, 0};
    if (scene->instance_count > 0) {
        minimum = (vector3){INFINITY, INFINITY, INFINITY};
        maximum = vector3_scale(minimum, -1);
    }
    for (size_t i = 0; i < scene->instance_count; i++)
        include_instance(scene, &scene->instances[i], &minimum, &maximum);
    double largest = fmax(vector3_length(minimum), vector3_length(maximum));
    if (!(largest <= SCENE_MAXIMUM_LENGTH))
        return lobe_log_fail(log, LOBE_ERROR_LIMIT, "%s: reaches farther than %g m", scene->name,
                             SCENE_MAXIMUM_LENGTH);
    vector3_store(minimum, scene->minimum);
    vector3_store(maximum, scene->maximum);
    return LOBE_OK;
}

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

lobe_result scene_complete(lobe_scene *scene, const lobe_log *log) {
    lobe_result result = set_bounds(scene, log);
    if (result != LOBE_OK)
        return result;
    if (!scene->has_camera)
        lobe_scene_frame(scene, 16.0 / 9, &scene->camera);
    // Of an empty scene, that it is empty is all there is to say; who draws it will.
    if (scene->instance_count == 0)
        return LOBE_OK;
    if (!scene->has_camera)
        lobe_log_print(log, LOBE_LOG_NOTICE, "%s: has no camera; added one that frames it",
                       scene->name);
    if (scene->light_count > 0)
        return LOBE_OK;
    lobe_log_print(log, LOBE_LOG_NOTICE, "%s: has no light; added a key light and a weaker fill",
                   scene->name);
    return add_lights(scene, log);
}
