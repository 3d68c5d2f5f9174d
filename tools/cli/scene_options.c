#include "tools/cli/scene_options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/animation/rig.h"
#include "tools/cli/closest_name.h"
#include "tools/scenes/scene_list.h"

option scene_option_assets(scene_options *options) {
    return (option){
        .name = "assets",
        .kind = OPTION_TEXT,
        .argument = "DIR",
        .summary = "the folder that contains models/, which some scenes need (default: "
                   "environment variable LOBE_ASSETS)",
        .target = &options->assets,
    };
}

option scene_option_environment(scene_options *options) {
    return (option){
        .name = "environment",
        .kind = OPTION_TEXT,
        .argument = "FILE",
        .summary = "environment light instead of the scene's own: an .exr or .hdr file, 'sky' "
                   "or 'none'",
        .target = &options->environment,
    };
}

option scene_option_rotation(scene_options *options) {
    return (option){
        .name = "environment-rotation",
        .kind = OPTION_NUMBER,
        .argument = "DEGREES",
        .summary = "turn the environment about +Y, counter-clockwise as seen from above",
        .target = &options->rotation,
        .fallback = "0",
        .minimum = -36000,
        .maximum = 36000,
        .given = &options->has_rotation,
    };
}

option scene_option_intensity(scene_options *options) {
    return (option){
        .name = "environment-intensity",
        .kind = OPTION_NUMBER,
        .argument = "FACTOR",
        .summary = "multiply the environment's radiance",
        .target = &options->intensity,
        .fallback = "1",
        .minimum = 0,
        .maximum = 1e6,
        .given = &options->has_intensity,
    };
}

option scene_option_background(scene_options *options) {
    return (option){
        .name = "background",
        .kind = OPTION_FLAG,
        .summary = "show the environment behind the scene",
        .target = &options->background,
    };
}

option scene_option_no_lights(scene_options *options) {
    return (option){
        .name = "no-lights",
        .kind = OPTION_FLAG,
        .summary = "remove the scene's lights and keep its environment",
        .target = &options->no_lights,
    };
}

static void remove_lights(lobe_scene *scene) {
    lobe_release(scene->lights);
    scene->lights = NULL;
    scene->light_count = 0;
    scenes_rig_forget_lights(scene);
}

static lobe_result replace_environment(const scene_options *options, const lobe_host *host,
                                       lobe_scene *scene) {
    lobe_environment *environment = NULL;
    lobe_result result = LOBE_OK;
    if (strcmp(options->environment, "none") != 0)
        result = lobe_environment_open(options->environment, host, &environment);
    if (result == LOBE_OK)
        lobe_scene_set_environment(scene, environment);
    return result;
}

static const char *first_ignored(const scene_options *options) {
    return options->has_rotation    ? "--environment-rotation"
           : options->has_intensity ? "--environment-intensity"
           : options->background    ? "--background"
                                    : NULL;
}

void scene_options_describe(const scene_options *options, char text[SCENE_OPTIONS_DESCRIPTION]) {
    char turned[48] = "", intensity[48] = "";
    if (options->rotation != 0)
        snprintf(turned, sizeof turned, ", turned by %g", options->rotation);
    if (options->intensity != 1)
        snprintf(intensity, sizeof intensity, ", intensity %g", options->intensity);
    char all[SCENE_OPTIONS_DESCRIPTION + 2];
    snprintf(all, sizeof all, "%s%s%s%s", options->no_lights ? ", no lights" : "", turned,
             intensity, options->background ? ", background" : "");
    snprintf(text, SCENE_OPTIONS_DESCRIPTION, "%s", all[0] ? all + 2 : "");
}

bool scene_options_give_light(const scene_options *options) {
    return options->environment || options->has_lights;
}

lobe_result scene_options_light(const scene_options *options, const lobe_host *host,
                                lobe_scene *scene) {
    lobe_result result = LOBE_OK;
    if (options->environment)
        result = replace_environment(options, host, scene);
    lobe_environment *environment = scene->environment;
    if (result != LOBE_OK)
        return result;
    if (options->no_lights)
        remove_lights(scene);
    if (environment) {
        lobe_environment_turn(environment, options->rotation);
        environment->intensity *= (float)options->intensity;
        scene->environment_visible |= options->background;
    } else if (first_ignored(options)) {
        lobe_host_log(host, LOBE_LOG_WARNING, "%s: has no environment; %s is ignored", scene->name,
                      first_ignored(options));
    }
    return LOBE_OK;
}

/// After the line that says that there is no such scene.
static void suggest_scene(const char *name, const lobe_host *host) {
    closest_name closest = {.name = name, .length = strlen(name)};
    for (size_t i = 0; i < scene_list_count(); i++)
        closest_name_offer(&closest, scene_list_get(i).name);
    if (closest.closest && closest.edits > 0)
        lobe_host_log(host, LOBE_LOG_NOTICE, "%s: did you mean '%s'?", name, closest.closest);
}

/// The bounds of the scene in some moments of its first animation. It is left at rest.
static lobe_result find_motion(lobe_scene *scene, float minimum[3], float maximum[3],
                               const lobe_host *host) {
    enum { MOMENTS = 16 };
    lobe_result result = LOBE_OK;
    for (int i = 0; result == LOBE_OK && i <= MOMENTS; i++) {
        const lobe_pose pose = {.seconds = scene->rig->animations[0].duration * i / MOMENTS,
                                .once = true};
        result = lobe_scene_set_pose(scene, &pose, host);
        for (int axis = 0; axis < 3; axis++) {
            minimum[axis] =
                i > 0 ? fminf(minimum[axis], scene->minimum[axis]) : scene->minimum[axis];
            maximum[axis] =
                i > 0 ? fmaxf(maximum[axis], scene->maximum[axis]) : scene->maximum[axis];
        }
    }
    return result == LOBE_OK
               ? lobe_scene_set_pose(scene, &(lobe_pose){.animation = LOBE_ANIMATION_NONE}, host)
               : result;
}

/// Sees all of a box.
static void frame_box(const float minimum[3], const float maximum[3], double aspect,
                      lobe_camera *camera) {
    lobe_scene_vertex corners[8] = {0};
    for (int i = 0; i < 8; i++)
        for (int axis = 0; axis < 3; axis++)
            corners[i].position[axis] = (i >> axis & 1 ? maximum : minimum)[axis];
    lobe_mesh box = {.vertices = corners, .vertex_count = 8};
    lobe_instance instance = {.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    lobe_scene scene = {
        .meshes = &box, .mesh_count = 1, .instances = &instance, .instance_count = 1};
    memcpy(scene.minimum, minimum, sizeof scene.minimum);
    memcpy(scene.maximum, maximum, sizeof scene.maximum);
    lobe_scene_frame(&scene, aspect, camera);
}

/// Of what moves, all that its first animation reaches.
static lobe_result frame(lobe_scene *scene, double aspect, const lobe_host *host) {
    float minimum[3], maximum[3];
    if (!scene->rig || scene->rig->animation_count == 0) {
        lobe_scene_frame(scene, aspect, &scene->camera);
        return LOBE_OK;
    }
    const lobe_result result = find_motion(scene, minimum, maximum, host);
    if (result == LOBE_OK)
        frame_box(minimum, maximum, aspect, &scene->camera);
    return result;
}

lobe_result scene_options_open(const scene_options *options, const char *scene,
                               const uint32_t size[2], const lobe_host *host, lobe_scene **result) {
    const char *assets = options->assets ? options->assets : getenv("LOBE_ASSETS");
    if (assets && assets[0] == '\0')
        assets = NULL;
    lobe_result status =
        scene_list_open(scene, assets, scene_options_give_light(options), host, result);
    if (status == LOBE_ERROR_NOT_FOUND)
        suggest_scene(scene, host);
    if (status == LOBE_OK && !(*result)->has_camera)
        status = frame(*result, (double)size[0] / size[1], host);
    if (status == LOBE_OK)
        status = scene_options_light(options, host, *result);
    if (status != LOBE_OK)
        lobe_scene_destroy(result);
    return status;
}

int scene_options_check_source(const option_table *table, const char *scene, const char *material) {
    if (!scene && !material)
        return options_usage_error(table, "no SCENE, and no --material either");
    if (scene && material)
        return options_usage_error(table, "SCENE '%s' and --material exclude each other", scene);
    return 0;
}

lobe_result scene_options_open_material(const scene_options *options, const char *folder,
                                        lobe_carrier carrier, const lobe_host *host,
                                        lobe_scene **result) {
    const lobe_scene_open_parameters parameters = {
        .scene = folder,
        .own_light_only = scene_options_give_light(options),
        .carrier = &carrier,
    };
    lobe_result status = lobe_scene_open_with(&parameters, host, result);
    if (status == LOBE_OK)
        status = scene_options_light(options, host, *result);
    return status;
}

bool scene_options_lack_assets(const char *scene, lobe_result result) {
    return result == LOBE_ERROR_NOT_FOUND && scene_list_needs_assets(scene);
}
