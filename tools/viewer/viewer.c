#include "tools/viewer/viewer.h"

#include <stdio.h>
#include <string.h>

void viewer_redraw_panels(viewer *v) {
    v->redraws = VIEWER_REDRAWS;
}

void viewer_redraw_scene(viewer *v) {
    for (int i = 0; i < 2; i++) {
        v->sides[i].stale = true;
        v->sides[i].failed = false;
    }
    viewer_redraw_panels(v);
}

void viewer_show_message(viewer *v, const char *text) {
    snprintf(v->message, sizeof v->message, "%s", text);
    v->opens = false;
    viewer_redraw_panels(v);
}

/// Poses the scene, so that the camera can follow it before anything is drawn.
static void pose(viewer *v) {
    const bool follows = memcmp(&v->view.camera, &v->scene->camera, sizeof v->view.camera) == 0;
    // A failure shows a message. Both sides pose the same scene: the last call decides.
    (void)animation_set_index(v->sides[1].animation, v->view.animation);
    (void)animation_set_index(v->sides[0].animation, v->view.animation);
    (void)animation_set_time(v->sides[0].animation, v->view.seconds);
    if (follows)
        v->view.camera = v->scene->camera;
    viewer_redraw_scene(v);
}

void viewer_set_time(viewer *v, double seconds) {
    v->view.seconds = seconds;
    pose(v);
}

void viewer_set_animation(viewer *v, size_t index) {
    v->view.animation = index;
    pose(v);
}

void viewer_reset_camera(viewer *v) {
    v->view.camera = v->scene->camera;
    viewer_redraw_scene(v);
}

void viewer_set_filter(viewer_side *side, const lobe_filter *filter) {
    const lobe_filter *old_filter = side->filter;
    const lobe_settings old = side->settings;
    side->filter = filter;
    side->stale = true;
    side->failed = false;
    lobe_settings_default(filter, &side->settings);
    for (size_t i = 0; i < lobe_filter_knob_count(old_filter); i++) {
        char value[64], assignment[128];
        const lobe_knob *knob = lobe_filter_knob(old_filter, i);
        if (old.values[i] == knob->initial)
            continue;
        lobe_settings_print(old_filter, &old, i, value, sizeof value);
        snprintf(assignment, sizeof assignment, "%s=%s", knob->name, value);
        (void)lobe_settings_set(filter, &side->settings, assignment, NULL);
    }
}

void viewer_set_comparison(viewer *v, viewer_comparison comparison) {
    v->look.comparison = comparison;
    viewer_redraw_panels(v);
}

void viewer_go_to(viewer *v, uint32_t path_frame) {
    v->path_frame = path_frame;
    lobe_scene_path(v->scene, (double)path_frame / (v->request->path_frames - 1), &v->view.camera);
    viewer_redraw_scene(v);
}

void viewer_record_path(viewer *v, bool on) {
    if (on)
        v->path_frame = 0;
    v->records_path = on;
    v->plays = false;
}
