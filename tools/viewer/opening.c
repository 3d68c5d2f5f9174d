#include "tools/viewer/opening.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "tools/cli/output_file.h"
#include "tools/viewer/lights.h"
#include "tools/viewer/viewer.h"

/// Panels need one frame to measure their text, and show it in the next.
#define FRAMES_TO_OPENING 2

// ---------------------------------------------------------------------------------------------
// Requests

static void wish(char **place, const char *text) {
    char *copy = strdup(text);
    if (!copy)
        return;
    free(*place);
    *place = copy;
}

const char *viewer_name_of(const char *path) {
    const char *name = path;
    for (const char *c = path; *c; c++)
        if (*c == '/' && c[1] != '\0')
            name = c + 1;
    return name;
}

/// Shows a message about a slow step in the frames before it starts.
static void announce(viewer *v, const char *name) {
    char text[VIEWER_MESSAGE_SIZE];
    snprintf(text, sizeof text, "opening %.400s ...", viewer_name_of(name));
    viewer_show_message(v, text);
    v->opens = true;
    v->frames_to_opening = FRAMES_TO_OPENING;
}

void viewer_request_light(viewer *v, const char *environment) {
    wish(&v->wanted_environment, environment);
    announce(v, environment);
}

void viewer_request_opening(viewer *v, const char *path) {
    if (output_file_has_ending(path, ".hdr") || output_file_has_ending(path, ".exr"))
        viewer_request_light(v, path);
    else {
        wish(&v->wanted_scene, path);
        announce(v, path);
    }
}

// ---------------------------------------------------------------------------------------------
// Scenes

static void set_title(const viewer *v) {
    char title[256];
    snprintf(title, sizeof title, "lobe - %s", v->scene->name);
    glfwSetWindowTitle(v->window, title);
}

/// Poses the first scene to the beginning of the animation that the command line names.
static lobe_result choose_animation(viewer *v) {
    const lobe_rig *rig = v->scene->rig;
    lobe_result result = LOBE_OK;
    if (!rig || rig->animation_count == 0)
        return LOBE_OK;
    if (v->request->animation)
        result = animation_find(v->scene, v->request->animation, &v->host, &v->view.animation);
    return result == LOBE_OK ? lobe_scene_set_pose(
                                   v->scene, &(lobe_pose){.animation = v->view.animation}, &v->host)
                             : result;
}

lobe_result viewer_open_first_scene(viewer *v) {
    const viewer_request *request = v->request;
    scene_options opening = v->opening;
    opening.has_lights = request->view.lights.count > 0;
    lobe_result result =
        scene_options_open(&opening, request->scene, request->size, &v->host, &v->scene);
    if (result == LOBE_OK && !view_options_apply(&request->view, request->lights, v->scene))
        result = lobe_host_fail(&v->host, LOBE_ERROR_INVALID_ARGUMENT,
                                "camera: eye and target are the same point");
    if (result != LOBE_OK) {
        lobe_release(request->lights); // the scene owns them now
        return result;
    }
    v->view.scene = v->scene;
    result = choose_animation(v);
    if (result != LOBE_OK)
        return result;
    v->view.camera = v->scene->camera;
    v->turned = v->opening.rotation;
    return viewer_lights_open(v);
}

static lobe_result give_scene(viewer *v, lobe_scene *scene) {
    v->view.scene = scene;
    lobe_result result = LOBE_OK;
    for (int i = 0; i < 2 && result == LOBE_OK; i++)
        result = viewer_side_set_scene(&v->view, &v->sides[i]);
    return result;
}

static lobe_result replace_scene(viewer *v, const char *name) {
    const uint32_t size[2] = {v->view.width, v->view.height};
    lobe_scene *scene = NULL;
    if (scene_options_open(&v->opening, name, size, &v->host, &scene) != LOBE_OK)
        return LOBE_OK;
    const size_t animation = v->view.animation;
    v->view.animation = 0;
    if (give_scene(v, scene) != LOBE_OK) {
        lobe_scene_destroy(&scene);
        v->view.animation = animation;
        return give_scene(v, v->scene);
    }
    lobe_scene_destroy(&v->scene);
    v->scene = scene;
    (void)viewer_lights_open(v); // shows a message if it fails
    v->path_frame = 0;
    v->view.seconds = 0;
    v->turned = v->opening.rotation;
    v->plays = v->records_path = false;
    set_title(v);
    viewer_reset_camera(v);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Environments

static lobe_result replace_environment(viewer *v, const char *name) {
    lobe_environment *environment = NULL;
    if (strcmp(name, "none") != 0 && lobe_environment_open(name, &v->host, &environment) != LOBE_OK)
        return LOBE_OK;
    lobe_scene_set_environment(v->scene, environment);
    v->scene->environment_visible = environment != NULL;
    wish(&v->environment, name);
    v->opening = (scene_options){.assets = v->request->opening.assets,
                                 .environment = v->environment,
                                 .intensity = 1,
                                 .background = environment != NULL};
    v->turned = 0;
    lobe_result result = LOBE_OK;
    for (int i = 0; i < 2 && result == LOBE_OK; i++)
        result = lobe_renderer_update_scene(v->sides[i].renderer,
                                            &(lobe_scene_changes){.environment = true});
    viewer_redraw_scene(v);
    return result;
}

/// Called once the opened scene or environment is visible.
static void end_announcement(viewer *v) {
    if (!v->opens || v->sides[0].stale)
        return;
    v->opens = false;
    viewer_show_message(v, "");
}

lobe_result viewer_open_wanted(viewer *v) {
    lobe_result result = LOBE_OK;
    if (!v->wanted_environment && !v->wanted_scene) {
        end_announcement(v);
        return LOBE_OK;
    }
    if (v->frames_to_opening > 0) {
        --v->frames_to_opening;
        return LOBE_OK;
    }
    if (v->wanted_environment)
        result = replace_environment(v, v->wanted_environment);
    if (result == LOBE_OK && v->wanted_scene)
        result = replace_scene(v, v->wanted_scene);
    free(v->wanted_environment);
    free(v->wanted_scene);
    v->wanted_environment = v->wanted_scene = NULL;
    return result;
}
