#include "passes/context/camera.h"
#include "passes/filters/settings.h"
#include "passes/maps/colours/colour_correlation.h"
#include "passes/renderer/delivery.h"
#include "passes/renderer/motion/motion.h"
#include "passes/renderer/shading.h"
#include "passes/upload/device_scene_parts.h"
#include "passes/upload/frame_check.h"

// ---------------------------------------------------------------------------------------------
// Checks

/// Whether the host requests something that is impossible in several submissions.
static bool needs_one_submission(const lobe_render_host *host) {
    return host->add_passes || (host->target && (host->target->depth || host->target->motion)) ||
           (host->submission && !host->target);
}

static lobe_result check(const rendering *r) {
    const lobe_host *host = &r->renderer->host;
    const lobe_render_parameters *parameters = r->parameters;
    uint32_t limit = lobe_device_describe(r->renderer->device)->maximum_image_extent;
    if (!r->renderer->scene)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "render: no scene is set");
    if (!parameters->width != !parameters->height && !parameters->host.target)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: a picture of %ux%u pixels", parameters->width,
                              parameters->height);
    if (parameters->filter && lobe_filter_supersamples(parameters->filter) &&
        needs_one_submission(&parameters->host))
        return lobe_host_fail(
            host, LOBE_ERROR_UNSUPPORTED,
            "render: the reference takes many submissions, and only the last draws "
            "into the target's radiance: it supports neither a target's depth or motion nor "
            "the host's passes, nor a submission without a target");
    if (parameters->reference.samples > LOBE_MAXIMUM_SAMPLES)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: more than %d samples per pixel", LOBE_MAXIMUM_SAMPLES);
    if (r->width > limit || r->height > limit)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT,
                              "render: %ux%u pixels exceed the device's limit of %ux%u", r->width,
                              r->height, limit, limit);
    const lobe_scene *scene = r->renderer->scene->scene;
    if (scene->instance_count != r->renderer->scene->instance_count)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: %s has %zu instances, but the renderer was told of %zu: "
                              "call lobe_renderer_update_scene",
                              scene->name, scene->instance_count,
                              r->renderer->scene->instance_count);
    lobe_result result = passes_check_frame(scene, host);
    if (result == LOBE_OK)
        result =
            passes_camera_check(parameters->camera ? parameters->camera : &scene->camera, host);
    return result ? result : passes_motion_check(&parameters->motion, scene, host);
}

// ---------------------------------------------------------------------------------------------
// Preparation

/// What a frame reads back can be saved when the next one begins, unless several frames are in
/// flight: only the host knows when commands of its own have finished.
static bool may_save(const lobe_render_parameters *parameters) {
    return !parameters->host.submission || parameters->host.frames_in_flight <= 1;
}

/// But for a sixteenth, which is left for pictures and light.
static uint64_t free_bytes(const lobe_device *device) {
    lobe_device_memory memory;
    lobe_device_memory_query(device, &memory);
    const uint64_t bytes =
        memory.budget_bytes > memory.used_bytes ? memory.budget_bytes - memory.used_bytes : 0;
    return bytes - bytes / 16;
}

static fit_work fits_of(const rendering *r) {
    const lobe_render_fits *fits = &r->parameters->fits;
    return (fit_work){
        .parts = fits->parts ? fits->parts : UINT32_MAX,
        .cache = fits->cache,
        .saves = fits->cache && may_save(r->parameters),
        .rebuilds = r->parameters->rebuild,
        .most_texels = lobe_device_describe(r->renderer->device)->maximum_image_extent,
        .free_bytes = fits->cache ? free_bytes(r->renderer->device) : 0,
    };
}

static void fill_context(rendering *r, const lobe_filter *filter) {
    lobe_renderer *renderer = r->renderer;
    const lobe_render_parameters *parameters = r->parameters;
    r->images = passes_filtered_images_of(renderer->filtered_images, renderer->scene->scene);
    r->context = (filter_context){
        .graph = renderer->graph,
        .device = lobe_device_describe(renderer->device),
        .scene = renderer->scene,
        .view = {parameters->camera ? parameters->camera : &renderer->scene->scene->camera,
                 r->width, r->height},
        .filter = filter,
        .settings = &r->settings,
        .images = &r->images,
        .work = &r->fits,
        .host = &renderer->host,
    };
    r->environment = (environment_work){
        .state = &renderer->environment,
        .parts = parameters->environment.parts,
        .cache = parameters->environment.cache,
        .saves = parameters->environment.cache && may_save(parameters),
    };
    r->fits = fits_of(r);
}

static lobe_result prepare(rendering *r) {
    const lobe_filter *filter;
    lobe_result result = passes_renderer_follow_pose(r->renderer);
    if (result == LOBE_OK)
        result = check(r);
    if (result == LOBE_OK)
        result = passes_settings_choose(r->parameters->filter, r->parameters->settings,
                                        lobe_device_describe(r->renderer->device),
                                        &r->renderer->host, &filter, &r->settings);
    if (result != LOBE_OK)
        return result;
    fill_context(r, filter);
    result = passes_environment_light_check(&r->context);
    if (result == LOBE_OK && filter->reads_heights)
        result = passes_device_scene_upload_heights(r->renderer->scene, &r->renderer->host);
    return result ? result
                  : passes_displacement_prepare(&r->renderer->displacement, &r->context,
                                                r->renderer->scene);
}

/// Saves the cubes and fitted maps that the last submitted frame read back, if that has not been
/// done, and loads the cubes that this frame needs.
static lobe_result update_caches(rendering *r) {
    environment_state *state = r->environment.state;
    lobe_result result = LOBE_OK;
    if (state->reads_back || r->renderer->fits_are_read_back)
        result = lobe_graph_wait(r->context.graph);
    if (result == LOBE_OK)
        passes_fits_save(r);
    if (result == LOBE_OK && r->environment.saves)
        passes_environment_light_save(&r->environment, r->context.graph, r->context.host);
    state->reads_back = false;
    return result == LOBE_OK
               ? passes_environment_light_load(&r->context, &r->environment, r->renderer->device)
               : result;
}

lobe_result passes_rendering_begin(rendering *r) {
    lobe_result result = prepare(r);
    if (result == LOBE_OK)
        result = update_caches(r);
    return result == LOBE_OK && !r->parameters->host.submission
               ? passes_colour_correlations_ask(&r->context)
               : result;
}

/// One submission for each part of the environment's maps, reported to the host: `*stopped` if it
/// wants no more. The maps of instances are declared, but not made, so that they are kept.
static lobe_result prepare_environment(rendering *r, lobe_frame *frame, bool *stopped) {
    static const frame_delivery none = {0};
    const lobe_render_host *host = &r->parameters->host;
    const uint32_t count = passes_environment_light_parts_left(&r->context, &r->environment);
    lobe_result result = LOBE_OK;
    const uint32_t fits = r->fits.parts;
    r->environment.parts = 1;
    r->fits.parts = 0;
    for (uint32_t done = 1; result == LOBE_OK && !*stopped && done <= count; done++) {
        lobe_graph_begin(r->renderer->graph);
        passes_instances_list(r);
        passes_instance_maps_build(r, NULL, frame);
        (void)passes_shading_light_prepare(&r->context, &r->environment);
        result = passes_delivery_run(r, &none, frame);
        *stopped =
            result == LOBE_OK && !host->environment_progress(host->user, done / (double)count);
    }
    r->environment.parts = 0;
    r->fits.parts = fits;
    return result;
}

static bool prepares_environment(const lobe_render_parameters *parameters) {
    return parameters->host.environment_progress && !parameters->host.submission &&
           parameters->environment.parts == 0;
}

static bool prepares_fits(const rendering *r) {
    const lobe_render_parameters *parameters = r->parameters;
    return r->context.filter->save && parameters->host.fits_progress &&
           !parameters->host.submission && parameters->fits.parts == 0;
}

static void invalidate_maps(const rendering *r) {
    if (r->parameters->rebuild && r->parameters->environment.keep)
        lobe_graph_invalidate_except(r->renderer->graph, ENVIRONMENT_MAP_PREFIX);
    else if (r->parameters->rebuild)
        lobe_graph_invalidate(r->renderer->graph);
}

// ---------------------------------------------------------------------------------------------
// The call

static lobe_result draw(rendering *r, lobe_frame *frame) {
    const frame_delivery delivery = passes_delivery_of(r->parameters);
    const lobe_render_host *host = &r->parameters->host;
    bool stopped = false;
    lobe_result result =
        prepares_environment(r->parameters) ? prepare_environment(r, frame, &stopped) : LOBE_OK;
    if (result == LOBE_OK && !stopped && prepares_fits(r))
        result = passes_fits_make(r, frame, host->fits_progress, host->user, &stopped);
    if (stopped)
        lobe_frame_free(frame);
    if (result != LOBE_OK || stopped)
        return result;
    return r->context.filter->supersamples ? passes_reference_render(r, &delivery, frame)
                                           : passes_frame_render(r, &delivery, frame);
}

lobe_result lobe_renderer_render(lobe_renderer *renderer, const lobe_render_parameters *parameters,
                                 lobe_frame *frame) {
    if (frame)
        *frame = (lobe_frame){0};
    if (!renderer || !parameters || !frame)
        return lobe_host_fail(
            renderer ? &renderer->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_renderer_render: renderer, parameters and frame must not be NULL");
    rendering r = {
        .renderer = renderer,
        .parameters = parameters,
        .width = parameters->width ? parameters->width : 1280,
        .height = parameters->height ? parameters->height : 720,
    };
    lobe_result result = passes_rendering_begin(&r);
    if (result != LOBE_OK)
        return result;
    passes_instance_maps_warn(&r);
    invalidate_maps(&r);
    result = draw(&r, frame);
    const environment_maps *maps = &renderer->environment.last;
    frame->environment_parts_left = maps->part_count - maps->parts_done;
    frame->fit_parts_left = r.fits.parts_left;
    if (result != LOBE_OK) {
        renderer->fits_are_read_back = false;
        renderer->environment.reads_back = false;
        lobe_frame_free(frame);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// Pipelines alone

/// The host's callback, which is not asked again once it has said stop, or another thread.
typedef struct preparation {
    const lobe_render_host *host;
    const atomic_bool *stopped_from_outside;
    bool stopped;
} preparation;

static bool is_stopped_from_outside(const preparation *p) {
    return p->stopped_from_outside && atomic_load(p->stopped_from_outside);
}

static bool report_preparation(void *user, double part) {
    preparation *p = user;
    p->stopped = p->stopped || is_stopped_from_outside(p) ||
                 (p->host->progress && !p->host->progress(p->host->user, part));
    return !p->stopped;
}

/// Callbacks that add passes get the host's own pointer.
static void add_prepared_passes(void *user, lobe_graph *graph, lobe_render_stage stage,
                                lobe_render_resources *resources) {
    const lobe_render_host *host = ((preparation *)user)->host;
    host->add_passes(host->user, graph, stage, resources);
}

/// As if the environment had no maps yet.
static lobe_result prepare_frame(rendering *r, environment_state *environment, lobe_frame *frame) {
    const frame_delivery delivery = {.target = r->parameters->host.target,
                                     .aov = r->parameters->aov,
                                     .motion = passes_delivery_of(r->parameters).motion,
                                     .prepares = true};
    lobe_result result = prepare(r);
    if (result != LOBE_OK)
        return result;
    r->environment.state = environment;
    r->environment.saves = false;
    r->fits.is_dry = true;
    result = passes_colour_correlations_ask(&r->context);
    if (result != LOBE_OK || is_stopped_from_outside(r->parameters->host.user))
        return result;
    result = passes_environment_light_load(&r->context, &r->environment, r->renderer->device);
    if (result != LOBE_OK)
        return result;
    result = r->context.filter->supersamples ? passes_reference_render(r, &delivery, frame)
                                             : passes_frame_render(r, &delivery, frame);
    // Nothing of the frame is left that could refer to the environment's maps.
    lobe_graph_begin(r->renderer->graph);
    return result;
}

lobe_result passes_renderer_prepare(lobe_renderer *renderer,
                                    const lobe_render_parameters *parameters,
                                    const atomic_bool *stopped) {
    preparation state = {.host = &parameters->host, .stopped_from_outside = stopped};
    lobe_render_parameters prepared = *parameters;
    prepared.host.progress = report_preparation;
    prepared.host.add_passes = parameters->host.add_passes ? add_prepared_passes : NULL;
    prepared.host.user = &state;
    prepared.environment.parts = 0;
    rendering r = {
        .renderer = renderer,
        .parameters = &prepared,
        .width = parameters->width ? parameters->width : 1280,
        .height = parameters->height ? parameters->height : 720,
    };
    environment_state environment = {0};
    lobe_frame frame = {0};
    const lobe_result result = prepare_frame(&r, &environment, &frame);
    lobe_frame_free(&frame);
    passes_environment_light_forget(&environment);
    return result;
}

lobe_result lobe_renderer_prepare(lobe_renderer *renderer,
                                  const lobe_render_parameters *parameters) {
    if (!renderer || !parameters)
        return lobe_host_fail(renderer ? &renderer->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_renderer_prepare: renderer and parameters must not be NULL");
    return passes_renderer_prepare(renderer, parameters, NULL);
}
