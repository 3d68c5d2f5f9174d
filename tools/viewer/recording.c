#include "tools/viewer/recording.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "tools/bench/timing.h"
#include "tools/render/capture.h"
#include "tools/viewer/viewer.h"

/// The scene's name without folder and extension.
static void stem_of(const char *name, char stem[NAME_MAX]) {
    size_t length = strlen(name);
    while (length > 1 && name[length - 1] == '/')
        --length;
    size_t start = length;
    while (start > 0 && name[start - 1] != '/')
        --start;
    snprintf(stem, NAME_MAX - 16, "%.*s", (int)(length - start), name + start);
    char *dot = strrchr(stem, '.');
    if (dot && dot != stem)
        *dot = '\0';
}

/// False if all numbers are taken.
static bool choose_path(const viewer *v, char path[PATH_MAX]) {
    char stem[NAME_MAX];
    stem_of(v->scene->name, stem);
    for (unsigned number = 0; number < 1000000; number++) {
        const int length =
            snprintf(path, PATH_MAX, "%s/%s-%04u.exr", v->request->folder, stem, number);
        if (length < PATH_MAX && access(path, F_OK) != 0)
            return true;
    }
    return false;
}

/// A reference is recorded with the samples it has so far.
static lobe_result draw(viewer *v, viewer_side *side, lobe_frame *frame) {
    const lobe_result result = animation_set_time(side->animation, v->view.seconds);
    if (result != LOBE_OK)
        return result;
    return lobe_renderer_render(side->renderer,
                                &(lobe_render_parameters){
                                    .filter = side->filter,
                                    .settings = &side->settings,
                                    .camera = &v->view.camera,
                                    .width = v->view.width,
                                    .height = v->view.height,
                                    .reference.samples = side->samples > 0 ? side->samples : 1,
                                    .environment.cache = v->view.cache,
                                    .fits.cache = v->view.fit_cache,
                                    .aov = true,
                                },
                                frame);
}

static lobe_result write_file(const viewer *v, const viewer_side *side, const lobe_frame *frame,
                              const lobe_profile_summary *times, const char *path) {
    const lobe_environment *environment = v->scene->environment;
    return capture_write_exr(
        path,
        &(capture){
            .frame = frame,
            .scene = v->scene->name,
            .environment = environment ? environment->name : NULL,
            .filter = side->filter,
            .settings = &side->settings,
            .samples = lobe_filter_supersamples(side->filter) && side->samples ? side->samples : 1,
            .device = lobe_device_describe(v->device.lobe),
            .times = times,
            .animated = side->animation != NULL,
            .seconds = v->view.seconds,
            .first_frame = true,
            .depth = LOBE_EXR_HALF,
        },
        &v->host);
}

static lobe_result record(viewer *v, viewer_side *side, const char *path) {
    lobe_frame frame = {0};
    lobe_profile *profile = NULL;
    lobe_profile_summary times;
    lobe_result result = lobe_profile_create(&v->host, &profile);
    if (result == LOBE_OK)
        result = draw(v, side, &frame);
    if (result == LOBE_OK)
        result = timing_add(profile, &frame, &v->host);
    if (result == LOBE_OK)
        result = lobe_profile_statistics(profile, &times);
    if (result == LOBE_OK)
        result = write_file(v, side, &frame, &times, path);
    lobe_frame_free(&frame);
    lobe_profile_destroy(&profile);
    return result;
}

void viewer_record(viewer *v) {
    char path[PATH_MAX], text[PATH_MAX + 32];
    v->records_frame = false;
    if (!choose_path(v, path))
        lobe_host_log(&v->host, LOBE_LOG_ERROR, "%s: no free file name for a recorded frame",
                      v->request->folder);
    else if (record(v, &v->sides[0], path) == LOBE_OK) {
        snprintf(text, sizeof text, "recorded %s", path);
        viewer_show_message(v, text);
        return;
    }
    viewer_record_path(v, false);
}
