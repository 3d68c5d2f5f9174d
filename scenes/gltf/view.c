#include <math.h>
#include <string.h>

#include "scenes/gltf/gltf.h"
#include "scenes/mesh/vector.h"
#include "scenes/scene/scene.h"

static vector3 axis(const double world[16], int column) {
    return (vector3){world[4 * column], world[4 * column + 1], world[4 * column + 2]};
}

static bool in_range(double value, double minimum, double maximum) {
    return value >= minimum && value <= maximum;
}

// ---------------------------------------------------------------------------------------------
// KHR_lights_punctual

static bool convert_type(const char *type, lobe_light_type *converted) {
    static const struct {
        const char *name;
        lobe_light_type type;
    } types[] = {{"directional", LOBE_LIGHT_DIRECTIONAL},
                 {"point", LOBE_LIGHT_POINT},
                 {"spot", LOBE_LIGHT_SPOT}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (strcmp(type, types[i].name) == 0) {
            *converted = types[i].type;
            return true;
        }
    }
    return false;
}

static bool convert_values(const gltf_light *from, lobe_light *to) {
    bool valid = convert_type(from->type, &to->type) && in_range(from->range, 0, 1e18);
    for (int i = 0; i < 3; i++) {
        valid = valid && in_range(from->colour[i] * from->intensity, 0, 1e18);
        to->intensity[i] = (float)(from->colour[i] * from->intensity);
    }
    to->range = to->type == LOBE_LIGHT_DIRECTIONAL ? 0 : (float)from->range;
    if (to->type != LOBE_LIGHT_SPOT)
        return valid;
    to->inner_cone = (float)from->inner_cone;
    to->outer_cone = (float)from->outer_cone;
    return valid && from->inner_cone >= 0 && from->inner_cone < from->outer_cone &&
           from->outer_cone <= M_PI / 2 + 1e-6;
}

lobe_result scenes_gltf_convert_light(gltf_import *import, int light, const double world[16]) {
    if ((size_t)light >= import->document->light_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no light %d",
                              import->path, light);
    const gltf_light *from = &import->document->lights[light];
    lobe_light to = {0};
    vector3 direction = vector3_scale(axis(world, 2), -1);
    if (!convert_values(from, &to))
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: light %d of type '%.32s' has a value out of its range",
                              import->path, light, from->type);
    if (!vector3_normalise(&direction, 0) && to.type != LOBE_LIGHT_POINT)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: light %d has no direction",
                              import->path, light);
    if (to.type != LOBE_LIGHT_DIRECTIONAL)
        vector3_store(axis(world, 3), to.position);
    if (to.type != LOBE_LIGHT_POINT)
        vector3_store(direction, to.direction);
    return scenes_add_light(import->scene, &to, import->host);
}

// ---------------------------------------------------------------------------------------------
// Cameras

static bool convert_projection(const gltf_camera *from, lobe_camera *to) {
    to->near_plane = (float)from->near_plane;
    if (from->perspective) {
        to->vertical_field_of_view = (float)from->field_of_view;
        return from->field_of_view > 0 && from->field_of_view < M_PI &&
               in_range(from->near_plane, 1e-18, 1e18);
    }
    to->orthographic_height = (float)(2 * fabs(from->height));
    // glTF allows an orthographic near plane at the eye; lobe does not.
    to->near_plane = fmaxf(to->near_plane, 1e-4f * to->orthographic_height);
    return in_range(fabs(from->height), 1e-18, 1e18) && in_range(from->near_plane, 0, 1e18);
}

/// At least `distance`; more where that is close to the precision of a float.
static double precise_distance(vector3 eye, double distance) {
    return fmax(distance, 1e-3 * vector3_length(eye));
}

lobe_result scenes_gltf_convert_camera(gltf_import *import, int camera, const double world[16]) {
    if ((size_t)camera >= import->document->camera_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no camera %d",
                              import->path, camera);
    if (import->scene->has_camera)
        return LOBE_OK;
    lobe_camera to = {0};
    vector3 eye = axis(world, 3), up = axis(world, 1), back = axis(world, 2);
    bool valid = convert_projection(&import->document->cameras[camera], &to);
    valid = vector3_normalise(&up, 0) && vector3_normalise(&back, 0) && valid;
    if (!valid)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: camera %d has a value out of its range", import->path, camera);
    vector3_store(eye, to.eye);
    vector3_store(up, to.up);
    // How far is decided when the scene's extent is known.
    vector3_store(vector3_subtract(eye, vector3_scale(back, precise_distance(eye, 1))), to.target);
    import->scene->camera = to;
    import->scene->has_camera = true;
    return LOBE_OK;
}

void scenes_gltf_aim_camera(lobe_scene *scene) {
    const vector3 eye = vector3_load(scene->camera.eye);
    const vector3 low = vector3_load(scene->minimum), high = vector3_load(scene->maximum);
    vector3 forward = vector3_subtract(vector3_load(scene->camera.target), eye);
    if (!vector3_normalise(&forward, 0))
        return;
    const vector3 middle = vector3_scale(vector3_add(low, high), 0.5);
    double distance = vector3_dot(vector3_subtract(middle, eye), forward);
    // A camera that looks away from the scene has a target as far away as the scene is large.
    if (!(distance > scene->camera.near_plane)) {
        const double radius = 0.5 * vector3_length(vector3_subtract(high, low));
        distance = precise_distance(eye, radius > 0 ? radius : 1);
    }
    vector3_store(vector3_add(eye, vector3_scale(forward, distance)), scene->camera.target);
}
