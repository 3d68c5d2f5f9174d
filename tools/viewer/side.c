#include "tools/viewer/side.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "tools/viewer/shaders/outputs.h"

bool viewer_side_supersamples(const viewer_side *side) {
    return side->output == VIEWER_RADIANCE && lobe_filter_supersamples(side->filter);
}

lobe_result viewer_side_open(const viewer_view *view, viewer_side *side) {
    side->stale = true;
    lobe_result result = lobe_renderer_create(view->device->lobe, view->host, &side->renderer);
    if (result == LOBE_OK)
        result = viewer_side_set_scene(view, side);
    return result;
}

static void free_mean(viewer_side *side) {
    lobe_texture_destroy(&side->mean);
    lobe_image_free(&side->mean_image);
    free(side->sum);
    side->sum = NULL;
    side->samples = side->pattern = 0;
}

void viewer_side_close(const viewer_view *view, viewer_side *side) {
    free_mean(side);
    lobe_renderer_destroy(&side->renderer);
    animation_destroy(&side->animation);
    viewer_target_destroy(view->device, &side->target);
    side->pass_count = 0;
    side->parts_left = side->fit_parts_left = 0;
    side->awaits_times = false;
}

lobe_result viewer_side_set_scene(const viewer_view *view, viewer_side *side) {
    side->stale = true;
    side->compiled = (viewer_compiled){0}; // other materials have other shaders
    lobe_renderer_set_scene(side->renderer, NULL);
    animation_destroy(&side->animation);
    lobe_result result =
        animation_create(view->device->lobe, view->scene, view->host, &side->animation);
    animation_attach(side->animation, side->renderer);
    if (result == LOBE_OK && view->animation != 0)
        result = animation_set_index(side->animation, view->animation);
    return result == LOBE_OK ? lobe_renderer_set_scene(side->renderer, view->scene) : result;
}

lobe_result viewer_side_resize(const viewer_view *view, viewer_side *side) {
    side->stale = true;
    free_mean(side);
    return viewer_target_renew(view->device, view->width, view->height, &side->target);
}

bool viewer_side_has_work(const viewer_view *view, const viewer_side *side) {
    bool refines = viewer_side_supersamples(side) && side->samples < view->maximum_samples;
    return side->stale || (refines && !side->failed);
}

// ---------------------------------------------------------------------------------------------
// Times

/// The entry of that name, added if missing.
static viewer_pass *line_of(viewer_side *side, const char *name) {
    for (size_t i = 0; i < side->pass_count; i++)
        if (strcmp(side->passes[i].name, name) == 0)
            return &side->passes[i];
    if (side->pass_count == VIEWER_MAXIMUM_PASSES)
        return NULL;
    viewer_pass *line = &side->passes[side->pass_count++];
    *line = (viewer_pass){0};
    snprintf(line->name, sizeof line->name, "%s", name);
    return line;
}

/// Of the filter and those of its knobs that are built into shaders.
static uint64_t hash_of_shaders(const viewer_side *side) {
    uint64_t hash = 14695981039346656037u ^ (uint64_t)side->output; // FNV-1a
    for (const char *name = lobe_filter_name(side->filter); *name; name++)
        hash = (hash ^ (unsigned char)*name) * 1099511628211u;
    for (size_t i = 0; i < lobe_filter_knob_count(side->filter); i++)
        if (lobe_filter_knob(side->filter, i)->kind != LOBE_KNOB_NUMBER)
            hash = (hash ^ (uint64_t)side->settings.values[i]) * 1099511628211u;
    return hash;
}

static bool is_compiled(const viewer_side *side, const char *pass) {
    for (size_t i = 0; i < side->compiled.pass_count; i++)
        if (strcmp(side->compiled.passes[i], pass) == 0)
            return true;
    return false;
}

static void remember_compiled(viewer_side *side) {
    viewer_compiled *compiled = &side->compiled;
    for (size_t i = 0; i < side->pass_count; i++)
        if (side->passes[i].first && compiled->pass_count < VIEWER_MAXIMUM_PASSES)
            snprintf(compiled->passes[compiled->pass_count++], sizeof *compiled->passes, "%s",
                     side->passes[i].name);
}

static void add_pass(viewer_side *side, const lobe_pass_report *pass) {
    viewer_pass *line = line_of(side, pass->name);
    if (!line)
        return;
    line->first |= pass->state == LOBE_PASS_RUN && !is_compiled(side, pass->name);
    line->milliseconds += pass->milliseconds;
    line->run += pass->state == LOBE_PASS_RUN;
    line->skipped += pass->state == LOBE_PASS_SKIPPED;
    line->culled += pass->state == LOBE_PASS_CULLED;
}

static void take_times(viewer_side *side) {
    const lobe_graph_report *report = lobe_graph_describe(lobe_renderer_graph(side->renderer));
    const uint64_t shaders = hash_of_shaders(side);
    if (side->compiled.shaders != shaders)
        side->compiled = (viewer_compiled){.shaders = shaders};
    side->pass_count = 0;
    for (size_t i = 0; i < report->pass_count; i++)
        add_pass(side, &report->passes[i]);
    remember_compiled(side);
    side->milliseconds = report->milliseconds;
}

lobe_result viewer_side_finish(viewer_side *side) {
    if (!side->awaits_times)
        return LOBE_OK;
    side->awaits_times = false;
    lobe_result result = lobe_graph_wait(lobe_renderer_graph(side->renderer));
    if (result == LOBE_OK)
        take_times(side);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Refining

static lobe_result start_mean(const viewer_view *view, viewer_side *side) {
    size_t count = (size_t)view->width * view->height * 4;
    side->samples = side->pattern = 0;
    side->step = side->step ? side->step : 1;
    if (side->sum) {
        memset(side->sum, 0, count * sizeof *side->sum);
        return LOBE_OK;
    }
    side->sum = calloc(count, sizeof *side->sum);
    if (!side->sum)
        return lobe_host_fail(view->host, LOBE_ERROR_OUT_OF_MEMORY, "reference: out of memory");
    lobe_result result = lobe_image_allocate(&side->mean_image, LOBE_FORMAT_RGBA32_FLOAT,
                                             view->width, view->height, view->host);
    if (result == LOBE_OK)
        result = lobe_texture_create(
            view->device->lobe,
            &(lobe_texture_parameters){.name = "reference", .image = &side->mean_image},
            &side->mean);
    if (result != LOBE_OK)
        free_mean(side);
    return result;
}

static void add_samples(viewer_side *side, const lobe_image *radiance, uint32_t count) {
    const float *texels = radiance->texels;
    float *mean = side->mean_image.texels;
    side->samples += count;
    for (size_t i = 0; i < (size_t)radiance->width * radiance->height * 4; i++) {
        side->sum[i] += (double)texels[i] * count;
        mean[i] = (float)(side->sum[i] / side->samples);
    }
}

/// As many samples at once as keep the window responsive.
static void adapt_step(viewer_side *side, double seconds) {
    if (seconds < 0.02 && side->step < 16)
        side->step *= 2;
    else if (seconds > 0.08 && side->step > 1)
        side->step /= 2;
}

static lobe_result render_samples(const viewer_view *view, viewer_side *side, uint32_t count) {
    lobe_frame frame;
    lobe_result result = animation_set_time(side->animation, view->seconds);
    if (result == LOBE_OK)
        result =
            lobe_renderer_render(side->renderer,
                                 &(lobe_render_parameters){
                                     .filter = side->filter,
                                     .settings = &side->settings,
                                     .camera = &view->camera,
                                     .width = view->width,
                                     .height = view->height,
                                     .reference = {.samples = count, .pattern = side->pattern++},
                                     .environment.cache = view->cache,
                                 },
                                 &frame);
    if (result != LOBE_OK)
        return result;
    take_times(side);
    side->milliseconds = frame.milliseconds;
    add_samples(side, &frame.radiance, count);
    lobe_frame_free(&frame);
    return lobe_texture_update(side->mean, &side->mean_image);
}

lobe_result viewer_side_refine(const viewer_view *view, viewer_side *side) {
    if (!viewer_side_supersamples(side) || !viewer_side_has_work(view, side))
        return LOBE_OK;
    lobe_result result = side->stale ? start_mean(view, side) : LOBE_OK;
    side->stale = false;
    uint32_t left = view->maximum_samples - side->samples;
    double before = glfwGetTime();
    if (result == LOBE_OK)
        result = render_samples(view, side, side->step < left ? side->step : left);
    adapt_step(side, glfwGetTime() - before);
    side->failed = result != LOBE_OK;
    return result;
}

// ---------------------------------------------------------------------------------------------
// Drawing

/// Normals or depth are drawn over the radiance.
static void show_output(void *user, lobe_graph *graph, lobe_render_stage stage,
                        lobe_render_resources *resources) {
    const struct outputs_constants *constants = user;
    if (stage != LOBE_RENDER_AFTER_SHADING)
        return;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_RASTER, "output variables");
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "normal_depth", .resource = resources->normal_depth});
    resources->radiance = lobe_pass_colour(
        pass, 0, &(lobe_attachment){.resource = resources->radiance, .load = LOBE_LOAD_DISCARD});
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "display.vert",
                                      .fragment_shader = "outputs.frag",
                                      .index_count = 3,
                                      .constants = constants,
                                      .constants_size = sizeof *constants});
}

/// Parts of the environment's maps: more per frame as long as the frames do not become slow.
static void adapt_parts(viewer_side *side) {
    const double now = side->milliseconds, before = side->former_milliseconds;
    if (side->parts_left == 0)
        side->parts = 1;
    else if ((now < 50 || now < 1.5 * before) && side->parts < 64)
        side->parts *= 2;
    side->former_milliseconds = now;
}

/// Parts of the materials' mixtures: as many in a frame as take a twentieth to a fifth of a second.
static void adapt_fit_parts(viewer_side *side) {
    if (side->fit_parts_left == 0)
        side->fit_parts = 1;
    else if (side->milliseconds < 50 && side->fit_parts < 64)
        side->fit_parts *= 2;
    else if (side->milliseconds > 200 && side->fit_parts > 1)
        side->fit_parts /= 2;
}

/// If this frame built maps, the next one uses more of them; the frame after the last one saves
/// them in the folder.
static void go_on_with_parts(viewer_side *side, const lobe_frame *frame) {
    side->stale = frame->environment_parts_left > 0 || side->parts_left > 0 ||
                  frame->fit_parts_left > 0 || side->fit_parts_left > 0;
    side->parts_left = frame->environment_parts_left;
    side->fit_parts_left = frame->fit_parts_left;
}

/// The side's own filter and settings, or, if that filter supersamples, the first that does not.
static const lobe_filter *filter_to_draw(const viewer_side *side, lobe_settings *settings) {
    size_t i = 0;
    *settings = side->settings;
    if (!lobe_filter_supersamples(side->filter))
        return side->filter;
    while (lobe_filter_supersamples(lobe_filter_get(i)))
        ++i;
    lobe_settings_default(lobe_filter_get(i), settings);
    return lobe_filter_get(i);
}

static float reach(const lobe_camera *camera) {
    float squared = 0;
    for (int i = 0; i < 3; i++)
        squared += (camera->target[i] - camera->eye[i]) * (camera->target[i] - camera->eye[i]);
    return sqrtf(squared);
}

lobe_result viewer_side_record(const viewer_view *view, viewer_side *side,
                               VkCommandBuffer commands) {
    if (!side->stale || viewer_side_supersamples(side))
        return LOBE_OK;
    struct outputs_constants constants = {
        .depth = side->output == VIEWER_DEPTH,
        .scale = reach(&view->camera),
    };
    const bool outputs = side->output != VIEWER_RADIANCE;
    lobe_frame frame;
    lobe_settings settings;
    const lobe_filter *filter = filter_to_draw(side, &settings);
    adapt_parts(side);
    adapt_fit_parts(side);
    side->failed = animation_set_time(side->animation, view->seconds) != LOBE_OK;
    if (side->failed) {
        side->stale = false;
        return LOBE_ERROR_MALFORMED; // said already
    }
    side->target.image.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    lobe_result result = lobe_renderer_render(
        side->renderer,
        &(lobe_render_parameters){
            .filter = filter,
            .settings = &settings,
            .camera = &view->camera,
            .environment = {.parts = side->parts, .cache = view->cache},
            .fits = {.parts = side->fit_parts, .cache = view->fit_cache},
            .aov = outputs,
            .host = {.add_passes = outputs ? show_output : NULL,
                     .user = &constants,
                     .target = &(lobe_render_target){.radiance = &side->target.image},
                     .submission = &(lobe_vulkan_submission){.commands = commands}},
        },
        &frame);
    go_on_with_parts(side, &frame);
    side->failed = result != LOBE_OK;
    if (result != LOBE_OK)
        return result;
    lobe_frame_free(&frame);
    viewer_target_is_drawn(&side->target);
    side->awaits_times = true;
    return LOBE_OK;
}
