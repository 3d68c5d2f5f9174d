#include "tools/viewer/viewer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "third_party/imgui.h"
#include "tools/scenes/scene_list.h"
#include "tools/viewer/keys.h"
#include "tools/viewer/lights.h"
#include "tools/viewer/opening.h"
#include "tools/viewer/panel.h"
#include "tools/viewer/window.h"

#define MAXIMUM_CHOICES 64

// Pixels, before scaling.
#define MARGIN      8
#define PANEL_WIDTH 300
#define TIMES_WIDTH 270
/// Window widths from which there is room for help beside the panel, and for times on the right.
#define WIDTH_FOR_HELP  780
#define WIDTH_FOR_TIMES 960

// ---------------------------------------------------------------------------------------------
// Scene

static void choose_scene(viewer *v) {
    const char *names[MAXIMUM_CHOICES] = {viewer_name_of(v->scene->name)};
    size_t count = 1, chosen = 0;
    for (size_t i = 0; i < scene_list_count() && count < MAXIMUM_CHOICES; i++)
        if (strcmp(scene_list_get(i).name, v->scene->name) != 0)
            names[count++] = scene_list_get(i).name;
    if (imgui_choice("scene", names, count, &chosen))
        viewer_request_opening(v, names[chosen]);
    imgui_tooltip("or drop a glTF file, or a folder of maps, onto the window");
}

/// How the environment lights the scene.
static void set_environment(viewer *v) {
    lobe_environment *environment = v->scene->environment;
    bool visible = v->scene->environment_visible, changed = false;
    double intensity = environment->intensity, turned = v->turned;
    changed |= imgui_number("intensity", 0, 4, &intensity);
    imgui_tooltip("the factor by which the environment's radiance is multiplied");
    changed |= imgui_number("turned", -180, 180, &turned);
    imgui_tooltip("degrees by which the environment is turned around the vertical axis");
    changed |= imgui_checkbox("background", &visible);
    imgui_tooltip("shows the environment behind the scene");
    if (!changed)
        return;
    environment->intensity = (float)intensity;
    lobe_environment_turn(environment, turned - v->turned);
    v->turned = turned;
    v->scene->environment_visible = visible;
    viewer_redraw_scene(v);
}

static void choose_environment(viewer *v) {
    const lobe_environment *environment = v->scene->environment;
    const char *names[] = {environment ? viewer_name_of(environment->name) : "none", "sky", "none"};
    size_t chosen = 0;
    // The first is the current one; of the others, only those that differ from it.
    if (!environment)
        names[2] = names[1];
    else if (strcmp(environment->name, "sky") == 0)
        names[1] = names[2];
    const size_t count = environment && strcmp(environment->name, "sky") != 0 ? 3 : 2;
    if (imgui_choice("environment", names, count, &chosen))
        viewer_request_light(v, names[chosen]);
    imgui_tooltip("light from all around: drop an .hdr or .exr file onto the window");
    if (environment)
        set_environment(v);
}

// ---------------------------------------------------------------------------------------------
// Filter and knobs

static bool choose_filter(viewer_side *side) {
    const char *names[MAXIMUM_CHOICES];
    size_t count = 0, chosen = 0;
    for (; count < lobe_filter_count() && count < MAXIMUM_CHOICES; count++) {
        names[count] = lobe_filter_name(lobe_filter_get(count));
        if (lobe_filter_get(count) == side->filter)
            chosen = count;
    }
    bool changed = imgui_choice("filter", names, count, &chosen);
    imgui_tooltip(lobe_filter_summary(side->filter));
    if (changed)
        viewer_set_filter(side, lobe_filter_get(chosen));
    return changed;
}

static bool set_choice(const lobe_knob *knob, double *value) {
    size_t count = 0, chosen = (size_t)*value;
    while (knob->choices[count])
        ++count;
    const bool changed = imgui_choice(knob->name, knob->choices, count, &chosen);
    *value = (double)chosen;
    return changed;
}

static bool set_integer(const lobe_knob *knob, double *value) {
    int number = (int)*value;
    const bool changed = imgui_integer(knob->name, (int)knob->minimum, (int)knob->maximum, &number);
    *value = number;
    return changed;
}

static bool set_knob(const lobe_knob *knob, double *value) {
    switch (knob->kind) {
    case LOBE_KNOB_CHOICE:
        return set_choice(knob, value);
    case LOBE_KNOB_INTEGER:
        return set_integer(knob, value);
    default:
        return imgui_number(knob->name, knob->minimum, knob->maximum, value);
    }
}

/// Either the knobs that only matter with an environment, or the others.
static bool set_knobs(viewer_side *side, bool of_environments) {
    bool changed = false;
    for (size_t i = 0; i < lobe_filter_knob_count(side->filter); i++) {
        const lobe_knob *knob = lobe_filter_knob(side->filter, i);
        if (knob->environment != of_environments)
            continue;
        changed |= set_knob(knob, &side->settings.values[i]);
        imgui_tooltip(knob->summary);
    }
    return changed;
}

static void set_side(const char *group, viewer_side *side, bool has_environment) {
    imgui_begin_group(group);
    bool changed = choose_filter(side);
    changed |= set_knobs(side, false);
    if (imgui_section(has_environment ? "Environment" : "Environment (none)", has_environment))
        changed |= set_knobs(side, true);
    side->stale |= changed;
    side->failed &= !changed;
    imgui_end_group();
}

// ---------------------------------------------------------------------------------------------
// Picture

static void choose_output(viewer *v) {
    static const char *const outputs[] = {"picture", "normal", "depth"};
    size_t chosen = (size_t)v->sides[0].output;
    if (imgui_choice("show", outputs, 3, &chosen)) {
        for (int i = 0; i < 2; i++)
            v->sides[i].output = (viewer_output)chosen;
        viewer_redraw_scene(v);
    }
    imgui_tooltip("picture: what the filter's knob 'view' asks for");
    imgui_number("exposure", -VIEWER_MAXIMUM_EXPOSURE, VIEWER_MAXIMUM_EXPOSURE, &v->look.exposure);
    imgui_tooltip("stops by which the picture is brightened");
}

static void show_samples(const viewer *v) {
    char text[64];
    for (int i = 0; i < 2; i++) {
        if (!viewer_side_supersamples(&v->sides[i]) ||
            (i == 1 && v->look.comparison == VIEWER_SINGLE))
            continue;
        snprintf(text, sizeof text, "%u of %u", v->sides[i].samples, v->view.maximum_samples);
        imgui_line("samples of the reference", text);
    }
}

static void show_left(const char *what, uint32_t left) {
    char text[32];
    snprintf(text, sizeof text, "%u to do", left);
    if (left > 0)
        imgui_line(what, text);
}

/// Shown until all of the environment's maps light the scene, and all materials are filtered.
static void show_parts(const viewer *v) {
    const bool both = v->look.comparison != VIEWER_SINGLE;
    const viewer_side *first = &v->sides[0], *second = &v->sides[1];
    show_left("parts of the light", first->parts_left + (both ? second->parts_left : 0));
    show_left("parts of the materials",
              first->fit_parts_left + (both ? second->fit_parts_left : 0));
}

static void choose_comparison(viewer *v) {
    static const char *const comparisons[] = {"one picture", "split view", "difference"};
    size_t chosen = (size_t)v->look.comparison;
    if (imgui_choice("compare", comparisons, 3, &chosen))
        viewer_set_comparison(v, (viewer_comparison)chosen);
    imgui_tooltip("with a second filter: by a divider that can be dragged, or as a heat map of "
                  "the relative error against it");
    if (v->look.comparison == VIEWER_ERROR) {
        imgui_number("error", 0.01, 2, &v->look.error_maximum);
        imgui_tooltip("the relative error that is shown brightest");
    }
    show_samples(v);
    show_parts(v);
}

// ---------------------------------------------------------------------------------------------
// Passes

static void show_skipped(const viewer_side *side) {
    char text[1024] = "skipped:";
    size_t length = strlen(text);
    for (size_t i = 0; i < side->pass_count && length < sizeof text; i++)
        if (side->passes[i].skipped > 0)
            length += (size_t)snprintf(text + length, sizeof text - length, "%s %s",
                                       text[length - 1] == ':' ? "" : ",", side->passes[i].name);
    if (text[length - 1] != ':')
        imgui_faint_text(text);
}

static void show_passes(const viewer_side *side) {
    char text[64];
    bool first = false;
    for (size_t i = 0; i < side->pass_count; i++)
        first |= side->passes[i].first;
    snprintf(text, sizeof text, first ? "(%.2f) ms" : "%.2f ms", side->milliseconds);
    imgui_line(lobe_filter_name(side->filter), text);
    for (size_t i = 0; i < side->pass_count; i++) {
        const viewer_pass *pass = &side->passes[i];
        if (pass->run == 0)
            continue;
        snprintf(text, sizeof text, pass->first ? "(%.2f)" : "%.2f", pass->milliseconds);
        imgui_indented_line(pass->name, text);
    }
    if (first)
        imgui_faint_text("(in brackets): with compiling shaders");
    show_skipped(side);
}

static void show_all_passes(const viewer *v) {
    show_passes(&v->sides[0]);
    if (v->look.comparison == VIEWER_SINGLE)
        return;
    imgui_space();
    show_passes(&v->sides[1]);
}

// ---------------------------------------------------------------------------------------------
// Time

static void choose_animation(viewer *v) {
    const lobe_rig *rig = v->scene->rig;
    const char *names[MAXIMUM_CHOICES] = {"all at once"};
    size_t count = 1;
    for (; rig && count <= rig->animation_count && count < MAXIMUM_CHOICES; count++)
        names[count] = rig->animations[count - 1].name[0] ? rig->animations[count - 1].name
                                                          : "(without a name)";
    size_t chosen = v->view.animation == LOBE_ANIMATION_ALL ? 0 : v->view.animation + 1;
    if (count > 2 && imgui_choice("animation", names, count, &chosen))
        viewer_set_animation(v, chosen == 0 ? LOBE_ANIMATION_ALL : chosen - 1);
}

/// A line of time for animations that repeat; others go on until time is stopped.
static void show_time(viewer *v) {
    const double duration = animation_duration(v->sides[0].animation);
    double seconds = duration > 0 ? fmod(v->view.seconds, duration) : v->view.seconds;
    char text[32];
    choose_animation(v);
    if (duration > 0) {
        if (imgui_number("seconds", 0, duration, &seconds)) {
            v->time_runs = false;
            viewer_set_time(v, fmin(fmax(seconds, 0), ANIMATION_MAXIMUM_SECONDS));
        }
    } else {
        snprintf(text, sizeof text, "%.1f", seconds);
        imgui_line("seconds", text);
    }
    if (imgui_button(v->time_runs ? "stop time" : "let time go on"))
        v->time_runs = !v->time_runs;
}

// ---------------------------------------------------------------------------------------------
// Path

static void show_path(viewer *v) {
    int frame = (int)v->path_frame;
    if (imgui_integer("frame", 0, (int)v->request->path_frames - 1, &frame))
        viewer_go_to(v, (uint32_t)frame);
    imgui_tooltip("of the path along which the camera moves");
    if (imgui_button(v->plays ? "pause" : "play"))
        v->plays = !v->plays;
    imgui_same_line();
    if (imgui_button("step"))
        v->steps = true;
    imgui_same_line();
    if (imgui_button("record"))
        v->records_frame = true;
    imgui_same_line();
    if (imgui_button(v->records_path ? "stop" : "record path"))
        viewer_record_path(v, !v->records_path);
}

// ---------------------------------------------------------------------------------------------
// All

static bool is_wide(const viewer *v, float width) {
    return (float)v->swapchain.width >= width * v->scale;
}

static void show_panel(viewer *v) {
    const float margin = MARGIN * v->scale;
    const float size[2] = {PANEL_WIDTH * v->scale, (float)v->swapchain.height - 2 * margin};
    const bool has_environment = v->scene->environment != NULL;
    const bool compares = v->look.comparison != VIEWER_SINGLE;
    imgui_begin_panel("panel", (float[2]){margin, margin}, size);
    choose_scene(v);
    choose_environment(v);
    choose_output(v);
    choose_comparison(v);
    imgui_space();
    viewer_lights_panel(v);
    if (imgui_section(compares ? "First filter" : "Filter", true))
        set_side("first", &v->sides[0], has_environment);
    if (compares && imgui_section("Second filter", true))
        set_side("second", &v->sides[1], has_environment);
    if (!is_wide(v, WIDTH_FOR_TIMES) && imgui_section("Times", true))
        show_all_passes(v);
    if (v->sides[0].animation && imgui_section("Time", true))
        show_time(v);
    if (imgui_section("Path of the camera", true))
        show_path(v);
    imgui_space();
    imgui_faint_text("F1: keys   Tab: hides the panels");
    imgui_end_panel();
}

/// On the right, where it does not cover the middle of the picture.
static void show_times(const viewer *v) {
    const float margin = MARGIN * v->scale;
    imgui_begin_list("times", (float[2]){(float)v->swapchain.width - margin, margin},
                     TIMES_WIDTH * v->scale, (float)v->swapchain.height - 2 * margin);
    show_all_passes(v);
    imgui_end_panel();
}

/// Beside the panel, or over it if the window is too narrow for both.
static float left_of_room(const viewer *v) {
    const float margin = MARGIN * v->scale;
    const bool beside = v->shows_panel && is_wide(v, WIDTH_FOR_HELP);
    return beside ? 2 * margin + PANEL_WIDTH * v->scale : margin;
}

static void show_help(const viewer *v) {
    const float margin = MARGIN * v->scale;
    const float size[2] = {0, (float)v->swapchain.height - 2 * margin};
    imgui_begin_panel("keys", (float[2]){left_of_room(v), margin}, size);
    for (size_t i = 0; i < viewer_key_count; i++)
        imgui_term(viewer_keys[i].name, viewer_keys[i].summary);
    imgui_end_panel();
}

/// At the lower edge.
static void show_message(const viewer *v) {
    const float margin = MARGIN * v->scale, left = left_of_room(v);
    imgui_begin_note("message", (float[2]){left, (float)v->swapchain.height - margin},
                     (float)v->swapchain.width - left - margin);
    imgui_text(v->message);
    imgui_end_panel();
}

void viewer_panel(viewer *v) {
    if (v->shows_panel)
        show_panel(v);
    if (v->shows_panel && is_wide(v, WIDTH_FOR_TIMES))
        show_times(v);
    if (v->shows_help)
        show_help(v);
    if (v->message[0])
        show_message(v);
    if (viewer_window_is_on_divider(v))
        imgui_show_drag_pointer();
}
