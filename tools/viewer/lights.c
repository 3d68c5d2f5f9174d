#include "tools/viewer/lights.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "third_party/imgui.h"
#include "tools/viewer/viewer.h"

// ---------------------------------------------------------------------------------------------
// Directions

/// From the middle of the scene.
static void place_of(const lobe_scene *scene, const lobe_light *light, double place[3]) {
    for (int i = 0; i < 3; i++)
        place[i] = light->position[i] - 0.5 * ((double)scene->minimum[i] + scene->maximum[i]);
}

/// Where the light comes from; not of unit length for a point light.
static void origin_of(const lobe_scene *scene, const lobe_light *light, double origin[3]) {
    if (light->type == LOBE_LIGHT_POINT) {
        place_of(scene, light, origin);
        return;
    }
    for (int i = 0; i < 3; i++)
        origin[i] = -(double)light->direction[i];
}

static double length(const double vector[3]) {
    return sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/// A point light keeps its distance.
static void point(const lobe_scene *scene, const viewer_light *shown, lobe_light *light) {
    double place[3];
    place_of(scene, light, place);
    const double heading = shown->heading * M_PI / 180, height = shown->height * M_PI / 180;
    const double origin[3] = {cos(height) * sin(heading), sin(height), cos(height) * cos(heading)};
    const double distance = length(place);
    for (int i = 0; i < 3; i++) {
        if (light->type == LOBE_LIGHT_POINT)
            light->position[i] += (float)(distance * origin[i] - place[i]);
        else
            light->direction[i] = (float)-origin[i];
    }
}

// ---------------------------------------------------------------------------------------------
// Colours

static void shine(const viewer_light *shown, lobe_light *light) {
    const double intensity = shown->on ? shown->intensity : 0;
    for (int i = 0; i < 3; i++)
        light->intensity[i] = (float)(intensity * lobe_srgb_decode(shown->colour[i]));
}

static viewer_light light_of(const lobe_scene *scene, const lobe_light *light) {
    viewer_light shown = {.on = true};
    double origin[3];
    origin_of(scene, light, origin);
    shown.heading = atan2(origin[0], origin[2]) * 180 / M_PI;
    shown.height = length(origin) > 0 ? asin(origin[1] / length(origin)) * 180 / M_PI : 0;
    for (int i = 0; i < 3; i++)
        shown.initial = fmax(shown.initial, light->intensity[i]);
    shown.intensity = shown.initial;
    for (int i = 0; i < 3; i++)
        shown.colour[i] =
            shown.initial > 0 ? lobe_srgb_encode((float)(light->intensity[i] / shown.initial)) : 1;
    return shown;
}

lobe_result viewer_lights_open(viewer *v) {
    const size_t count = v->scene->light_count;
    viewer_lights_close(v);
    v->lights = calloc(count > 0 ? count : 1, sizeof *v->lights);
    if (!v->lights)
        return lobe_host_fail(&v->host, LOBE_ERROR_OUT_OF_MEMORY, "lights: out of memory");
    v->light_count = count;
    for (size_t i = 0; i < count; i++)
        v->lights[i] = light_of(v->scene, &v->scene->lights[i]);
    return LOBE_OK;
}

void viewer_lights_close(viewer *v) {
    free(v->lights);
    v->lights = NULL;
    v->light_count = 0;
    v->light = 0;
}

// ---------------------------------------------------------------------------------------------
// Panel

static void choose_light(viewer *v) {
    static const char *const kinds[] = {"directional", "point", "spot"};
    int number = (int)v->light + 1;
    if (v->light_count > 1 && imgui_integer("number", 1, (int)v->light_count, &number))
        v->light = (size_t)number - 1;
    imgui_line("kind", kinds[v->scene->lights[v->light].type]);
}

static bool set_intensity(viewer_light *shown) {
    const double most = shown->initial > 0 ? 4 * shown->initial : 4;
    bool changed = imgui_checkbox("on", &shown->on);
    changed |= imgui_number("intensity", 0, most, &shown->intensity);
    imgui_tooltip("W/m2 of a directional light, W/sr of another");
    changed |= imgui_colour("colour", shown->colour);
    return changed;
}

static bool set_direction(viewer_light *shown) {
    bool changed = imgui_number("heading", -180, 180, &shown->heading);
    imgui_tooltip("degrees around the vertical axis to where the light comes from, from +Z to +X");
    changed |= imgui_number("height", -90, 90, &shown->height);
    imgui_tooltip("degrees above the horizon; a point light moves around the scene's middle");
    return changed;
}

void viewer_lights_panel(viewer *v) {
    char title[32];
    snprintf(title, sizeof title, v->light_count > 0 ? "Lights: %zu" : "Lights (none)",
             v->light_count);
    if (!imgui_section(title, false) || v->light_count == 0)
        return;
    imgui_begin_group("lights");
    choose_light(v);
    viewer_light *shown = &v->lights[v->light];
    lobe_light *light = &v->scene->lights[v->light];
    const bool brightness = set_intensity(shown), direction = set_direction(shown);
    if (brightness)
        shine(shown, light);
    if (direction)
        point(v->scene, shown, light);
    if (brightness || direction)
        viewer_redraw_scene(v);
    imgui_end_group();
}
