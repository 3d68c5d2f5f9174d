#include "tools/viewer/viewer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/shader/shaders.h"
#include "engine/shader/words.h"
#include "third_party/imgui.h"
#include "tools/viewer/camera.h"
#include "tools/viewer/graphics/graphics.h"
#include "tools/viewer/keys.h"
#include "tools/viewer/lights.h"
#include "tools/viewer/opening.h"
#include "tools/viewer/panel.h"
#include "tools/viewer/recording.h"
#include "tools/viewer/window.h"

/// Interval of checks for saved shaders while the window is idle.
#define RELOAD_SECONDS 0.25

// ---------------------------------------------------------------------------------------------
// Opening and closing

/// Shows the last message in the window if it is a warning or an error.
static void write_log(void *user, lobe_log_level level, const char *message) {
    viewer *v = user;
    v->console.write(v->console.user, level, message);
    if (level <= LOBE_LOG_WARNING)
        viewer_show_message(v, message);
}

static void prepare(const viewer_request *request, const lobe_host *console, viewer *v) {
    const lobe_filter *reference = NULL;
    for (size_t i = 0; i < lobe_filter_count() && !reference; i++)
        if (lobe_filter_supersamples(lobe_filter_get(i)))
            reference = lobe_filter_get(i);
    *v = (viewer){
        .request = request,
        .console = *console,
        .host = {.write = write_log, .user = v},
        .opening = request->opening,
        .look = {.exposure = request->exposure, .divider = 0.5, .error_maximum = 0.5},
        .sides = {{.filter = request->filter, .settings = request->settings},
                  {.filter = reference}},
        .shows_panel = true,
        .time_runs = true,
        .redraws = VIEWER_REDRAWS,
    };
    v->view.device = &v->device;
    v->view.host = &v->host;
    v->view.maximum_samples = request->samples;
    v->view.cache = cache_options_find(&request->cache, "environments", v->cache_folder);
    v->view.fit_cache = cache_options_find(&request->cache, "mixtures", v->fit_cache_folder);
    lobe_settings_default(reference, &v->sides[1].settings);
}

static void clean_up(viewer *v) {
    viewer_graphics_close(v);
    viewer_window_close(v);
    viewer_lights_close(v);
    lobe_scene_destroy(&v->scene);
    free(v->wanted_scene);
    free(v->wanted_environment);
    free(v->environment);
}

// ---------------------------------------------------------------------------------------------
// Time

/// One step along the path; the first follows the last.
static void advance(viewer *v) {
    const uint32_t last = v->request->path_frames - 1;
    v->path_frame = v->path_frame < last ? v->path_frame + 1 : 0;
    v->steps = false;
}

static bool changes_with_time(const viewer *v) {
    return v->sides[0].animation && v->time_runs;
}

static void move(viewer *v) {
    const double now = glfwGetTime(), seconds = fmin(now - v->last_time, 0.1);
    double steps[3];
    if (changes_with_time(v)) {
        viewer_set_time(v, fmod(v->view.seconds + now - v->last_time, ANIMATION_MAXIMUM_SECONDS));
    }
    v->last_time = now;
    if (v->plays || v->steps) {
        advance(v);
        viewer_go_to(v, v->path_frame);
    }
    if (v->records_path) {
        viewer_go_to(v, v->path_frame);
        v->view.seconds = v->path_frame / 30.0;
    }
    if (!imgui_takes_keys() && viewer_keys_fly(v, seconds, steps)) {
        viewer_camera_fly(&v->view.camera, steps);
        viewer_redraw_scene(v);
    }
}

/// Called after a frame: writes the recording.
static void record(viewer *v) {
    if (v->records_frame || v->records_path)
        viewer_record(v);
    if (!v->records_path)
        return;
    if (v->path_frame + 1 == v->request->path_frames)
        viewer_record_path(v, false);
    else
        advance(v);
}

// ---------------------------------------------------------------------------------------------
// Frames

static bool has_work(const viewer *v) {
    const int count = v->look.comparison == VIEWER_SINGLE ? 1 : 2;
    double steps[3];
    bool work = v->redraws > 0 || changes_with_time(v) || v->plays || v->steps || v->records_path ||
                v->records_frame || v->wanted_scene || v->wanted_environment ||
                v->swapchain_is_stale || v->frames_drawn < v->request->frames ||
                viewer_keys_fly(v, 0, steps);
    for (int i = 0; i < count; i++)
        work = work || viewer_side_has_work(&v->view, &v->sides[i]);
    return work;
}

static bool is_hidden(const viewer *v) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(v->window, &width, &height);
    return width == 0 || height == 0 || glfwGetWindowAttrib(v->window, GLFW_ICONIFIED);
}

/// In a build with hot reload: redraws if a shader in use was saved. Other saved shaders stay stale
/// until they are used.
static void check_shaders(viewer *v) {
    const size_t stale = engine_shaders_stale(v->device.lobe);
    const bool more = stale > v->stale_shaders;
    if (more || (v->reloads && stale > 0)) {
        v->message[0] = '\0';
        viewer_redraw_scene(v);
    }
    v->reloads = more; // one may have been saved while drawing: check again
    v->stale_shaders = stale;
}

/// Sleeps while there is nothing to do.
static void wait_for_events(viewer *v) {
    const bool reloads = engine_shader_words_folder() != NULL;
    if (!is_hidden(v) && has_work(v)) {
        glfwPollEvents();
        return;
    }
    if (reloads)
        glfwWaitEventsTimeout(RELOAD_SECONDS);
    else
        glfwWaitEvents();
    v->last_time = glfwGetTime();
    if (reloads)
        check_shaders(v);
}

static lobe_result refine(viewer *v) {
    const int count = v->look.comparison == VIEWER_SINGLE ? 1 : 2;
    for (int i = 0; i < count; i++) {
        const lobe_result result = viewer_side_refine(&v->view, &v->sides[i]);
        if (result == LOBE_ERROR_DEVICE_LOST)
            return result;
    }
    return LOBE_OK;
}

/// Shaders that the frame compiled are no longer stale.
static void update_stale_shaders(viewer *v) {
    const size_t stale = v->stale_shaders > 0 ? engine_shaders_stale(v->device.lobe) : 0;
    if (stale < v->stale_shaders)
        v->stale_shaders = stale;
}

static lobe_result show(viewer *v) {
    lobe_result result;
    viewer_shown shown = viewer_swapchain_acquire(&v->device, &v->swapchain, &result);
    if (shown != VIEWER_SHOWN)
        return viewer_graphics_handle_result(v, shown, result);
    imgui_begin_frame();
    viewer_panel(v);
    imgui_end_frame();
    result = viewer_frame_draw(&v->view, &v->frame, &v->display, &v->look, v->sides, &v->swapchain);
    if (result != LOBE_OK)
        return result;
    shown = viewer_swapchain_present(&v->device, &v->swapchain, &result);
    v->frames_drawn += v->frames_drawn < UINT32_MAX;
    update_stale_shaders(v);
    if (v->redraws == 0 && (v->sides[0].awaits_times || v->sides[1].awaits_times))
        v->redraws = 1; // the next frame shows this one's times
    if (shown == VIEWER_SHOWN)
        v->losses = 0;
    return viewer_graphics_handle_result(v, shown, result);
}

static lobe_result draw_frame(viewer *v) {
    lobe_result result = viewer_frame_finish(&v->device, &v->frame, v->sides);
    if (result == LOBE_OK)
        result = viewer_open_wanted(v);
    if (result == LOBE_OK && v->scale_is_stale)
        result = viewer_graphics_rescale(v);
    if (result == LOBE_OK && v->swapchain_is_stale)
        result = viewer_graphics_resize(v);
    if (result != LOBE_OK || v->swapchain.count == 0)
        return result;
    if (v->redraws > 0)
        v->redraws--;
    move(v);
    result = refine(v);
    if (result == LOBE_OK)
        result = show(v);
    if (result == LOBE_OK && (v->records_frame || v->records_path)) {
        result = viewer_frame_finish(&v->device, &v->frame, v->sides);
        if (result == LOBE_OK)
            record(v);
    }
    return result;
}

static bool is_done(const viewer *v) {
    return glfwWindowShouldClose(v->window) ||
           (v->request->exit && v->frames_drawn >= v->request->frames);
}

static lobe_result show_until_closed(viewer *v) {
    lobe_result result = LOBE_OK;
    while (result == LOBE_OK && !is_done(v)) {
        wait_for_events(v);
        if (is_hidden(v) || !has_work(v))
            continue;
        result = draw_frame(v);
        if (result == LOBE_ERROR_DEVICE_LOST)
            result = viewer_graphics_recover(v);
    }
    return result;
}

static lobe_result check_faults(const viewer *v) {
    const unsigned long long count = v->device.fault_count;
    return count == 0 ? LOBE_OK
                      : lobe_host_fail(&v->host, LOBE_ERROR_UNSUPPORTED,
                                       "the validation layer reported %llu errors", count);
}

lobe_result viewer_run(const viewer_request *request, const lobe_host *console) {
    viewer v;
    prepare(request, console, &v);
    lobe_result result = viewer_open_first_scene(&v);
    if (result == LOBE_OK)
        result = viewer_window_open(&v);
    if (result == LOBE_OK)
        result = viewer_graphics_open(&v);
    if (result == LOBE_OK)
        result = show_until_closed(&v);
    clean_up(&v);
    return result == LOBE_OK ? check_faults(&v) : result;
}
