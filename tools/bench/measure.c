#include "tools/bench/bench.h"

#include <lobe/renderer.h>

#include "tools/bench/changed_frame.h"
#include "tools/bench/timing.h"

/// A supersampled frame costs as much as dozens of others, and its time varies less.
#define SUPERSAMPLED_FRAMES 2

/// The state for one scene. Each filter has its own renderer: they alternate, and maps must be
/// retained from turn to turn.
typedef struct bench_run {
    const bench_job *job;
    lobe_scene *scene;
    const char *name;
    lobe_renderer *renderers[BENCH_MAXIMUM_FILTERS];
    lobe_image truth, truth_lobe_base;
} bench_run;

uint32_t bench_frames(const bench_job *job, const bench_filter *filter) {
    bool few = lobe_filter_supersamples(filter->filter) && job->frames > SUPERSAMPLED_FRAMES;
    return few ? SUPERSAMPLED_FRAMES : job->frames;
}

void bench_result_free(bench_result *result) {
    for (int kind = 0; kind < BENCH_PROFILES; kind++)
        lobe_profile_destroy(&result->profiles[kind]);
}

static lobe_render_parameters parameters_of(const bench_job *job, const bench_filter *filter) {
    return (lobe_render_parameters){
        .filter = filter->filter,
        .settings = &filter->settings,
        .width = job->size[0],
        .height = job->size[1],
        .reference.samples = BENCH_TIMED_SAMPLES,
        .host = {.progress = progress_part, .user = job->progress},
    };
}

static lobe_result open_renderer(const bench_run *run, lobe_renderer **renderer) {
    lobe_result result = lobe_renderer_create(run->job->device, run->job->host, renderer);
    animation_attach(run->job->animation, *renderer);
    return result == LOBE_OK ? lobe_renderer_set_scene(*renderer, run->scene) : result;
}

// ---------------------------------------------------------------------------------------------
// Truth

static lobe_result render_truth(const bench_run *run, lobe_renderer *renderer,
                                const lobe_settings *settings, const char *kind,
                                lobe_image *image) {
    bench_filter reference = {.settings = *settings};
    lobe_result result = lobe_filter_find("reference", run->job->host, &reference.filter);
    if (result != LOBE_OK)
        return result;
    progress_step(run->job->progress, "%s: %s, samples per pixel: %u", run->name, kind,
                  run->job->samples);
    lobe_render_parameters parameters = parameters_of(run->job, &reference);
    parameters.reference.samples = run->job->samples;
    lobe_frame frame;
    result = lobe_renderer_render(renderer, &parameters, &frame);
    *image = frame.radiance;
    frame.radiance = (lobe_image){0};
    lobe_frame_free(&frame);
    return result;
}

static lobe_result render_truths(bench_run *run) {
    lobe_renderer *renderer;
    lobe_result result = open_renderer(run, &renderer);
    if (result == LOBE_OK)
        result = render_truth(run, renderer, &run->job->truth, "reference", &run->truth);
    if (result == LOBE_OK)
        result = render_truth(run, renderer, &run->job->truth_lobe_base,
                              "reference with base lobes converted", &run->truth_lobe_base);
    lobe_renderer_destroy(&renderer);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Memory and error

/// With no other renderer on the device: they share what they have in common.
static lobe_result measure_memory(const bench_run *run, bench_result *result) {
    lobe_device_memory before, after;
    lobe_renderer *renderer = NULL;
    lobe_device_memory_reset_peak(run->job->device);
    lobe_device_memory_query(run->job->device, &before);
    lobe_result status = open_renderer(run, &renderer);
    lobe_render_parameters parameters = parameters_of(run->job, result->filter);
    parameters.discard = true;
    parameters.reference.samples = 1; // memory does not depend on samples
    lobe_frame frame = {0};
    if (status == LOBE_OK)
        status = lobe_renderer_render(renderer, &parameters, &frame);
    lobe_device_memory_query(run->job->device, &after);
    result->memory_bytes = after.peak_used_bytes - before.used_bytes;
    if (frame.base_texels > 0)
        result->bytes_per_texel = (double)frame.filtered_bytes / (double)frame.base_texels;
    lobe_frame_free(&frame);
    lobe_renderer_destroy(&renderer);
    return status;
}

static lobe_result compare(const bench_run *run, const lobe_image *image, const lobe_image *truth,
                           const bench_result *result, error_metrics *error) {
    return error_metrics_measure(
        image, truth,
        &(error_metrics_parameters){.test_name = lobe_filter_name(result->filter->filter),
                                    .reference_name = run->name,
                                    .high_dynamic_range = true},
        run->job->host, error, NULL);
}

static lobe_result measure_error(const bench_run *run, size_t index, bench_result *result) {
    progress_step(run->job->progress, "%s: %s, error", run->name,
                  lobe_filter_name(result->filter->filter));
    lobe_render_parameters parameters = parameters_of(run->job, result->filter);
    lobe_frame frame;
    lobe_result status = lobe_renderer_render(run->renderers[index], &parameters, &frame);
    if (status == LOBE_OK)
        status = compare(run, &frame.radiance, &run->truth, result, &result->error);
    if (status == LOBE_OK)
        status =
            compare(run, &frame.radiance, &run->truth_lobe_base, result, &result->error_lobe_base);
    lobe_frame_free(&frame);
    return status;
}

// ---------------------------------------------------------------------------------------------
// Time

static lobe_result time_frame(const bench_run *run, size_t index, const bench_filter *filter,
                              bool rebuild, lobe_profile *profile) {
    lobe_render_parameters parameters = parameters_of(run->job, filter);
    parameters.rebuild = rebuild;
    parameters.discard = true;
    parameters.host.progress = NULL;
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(run->renderers[index], &parameters, &frame);
    if (result == LOBE_OK && profile)
        result = timing_add(profile, &frame, run->job->host);
    lobe_frame_free(&frame);
    return result;
}

/// `result`: NULL to warm up.
static lobe_result time_changed_frame(const bench_run *run, size_t index, bench_result *result) {
    lobe_render_parameters parameters = parameters_of(run->job, &run->job->filters[index]);
    parameters.discard = true;
    parameters.host.progress = NULL;
    lobe_frame frame;
    changed_cost cost;
    lobe_result status =
        changed_frame_render(run->renderers[index], run->scene, run->job->animation, &parameters,
                             run->job->host, &frame, &cost);
    if (status == LOBE_OK && result)
        status = timing_add(result->profiles[BENCH_CHANGED], &frame, run->job->host);
    if (status == LOBE_OK && result)
        status = changed_cost_add(result->profiles[BENCH_CHANGED_COST], &cost);
    lobe_frame_free(&frame);
    return status;
}

/// One frame with maps rebuilt, and one with maps retained. `result`: NULL to warm up.
static lobe_result time_still_frames(const bench_run *run, size_t index, bench_result *result) {
    const bench_filter *filter = &run->job->filters[index];
    lobe_result status =
        time_frame(run, index, filter, true, result ? result->profiles[BENCH_REBUILT] : NULL);
    return status ? status
                  : time_frame(run, index, filter, false,
                               result ? result->profiles[BENCH_RETAINED] : NULL);
}

typedef lobe_result (*frame_timer)(const bench_run *run, size_t index, bench_result *result);

/// Frames of each filter. The first round (`keep` false) only warms up; supersampling filters need
/// none.
static lobe_result time_round(const bench_run *run, frame_timer timer, uint32_t round, bool keep,
                              bench_result *results) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; status == LOBE_OK && i < run->job->filter_count; i++) {
        const bench_filter *filter = &run->job->filters[i];
        const bool left_out = keep ? round >= bench_frames(run->job, filter)
                                   : lobe_filter_supersamples(filter->filter);
        if (!left_out)
            status = timer(run, i, keep ? &results[i] : NULL);
    }
    return status;
}

/// Adds half of the whole to the progress, of which the part `first` is done before.
static lobe_result time_rounds(const bench_run *run, frame_timer timer, double first,
                               bench_result *results) {
    lobe_result result = time_round(run, timer, 0, false, results);
    for (uint32_t round = 0; result == LOBE_OK && round < run->job->frames; round++) {
        result = time_round(run, timer, round, true, results);
        progress_part(run->job->progress, first + 0.5 * (round + 1.0) / run->job->frames);
    }
    return result;
}

static lobe_result open_profiles(const bench_run *run, bench_result *result) {
    lobe_result status = LOBE_OK;
    for (int kind = 0; status == LOBE_OK && kind < BENCH_PROFILES; kind++)
        status = lobe_profile_create(run->job->host, &result->profiles[kind]);
    return status;
}

static lobe_result summarise(bench_result *result) {
    lobe_profile_summary *const summaries[BENCH_PROFILES] = {
        [BENCH_REBUILT] = &result->rebuilt,
        [BENCH_RETAINED] = &result->retained,
        [BENCH_CHANGED] = &result->changed,
        [BENCH_CHANGED_COST] = &result->changed_cost,
    };
    lobe_result status = LOBE_OK;
    for (int kind = 0; status == LOBE_OK && kind < BENCH_PROFILES; kind++)
        status = lobe_profile_statistics(result->profiles[kind], summaries[kind]);
    return status;
}

static lobe_result measure_times(const bench_run *run, bench_result *results) {
    progress_step(run->job->progress, "%s: times of %u frames", run->name, run->job->frames);
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < run->job->filter_count; i++)
        result = open_profiles(run, &results[i]);
    if (result == LOBE_OK)
        result = time_rounds(run, time_still_frames, 0, results);
    // Afterwards, as `moments` goes on to fit its bins to texels that have changed once.
    if (result == LOBE_OK)
        result = time_rounds(run, time_changed_frame, 0.5, results);
    for (size_t i = 0; result == LOBE_OK && i < run->job->filter_count; i++)
        result = summarise(&results[i]);
    return result;
}

lobe_result bench_measure(const bench_job *job, lobe_scene *scene, const char *name,
                          bench_result *results) {
    bench_job own = *job;
    bench_run run = {.job = &own, .scene = scene, .name = name};
    lobe_result result = animation_create(job->device, scene, job->host, &own.animation);
    if (result == LOBE_OK)
        result = render_truths(&run);
    for (size_t i = 0; result == LOBE_OK && i < job->filter_count; i++) {
        results[i].scene = name;
        results[i].filter = &job->filters[i];
        result = measure_memory(&run, &results[i]);
    }
    for (size_t i = 0; result == LOBE_OK && i < job->filter_count; i++) {
        result = open_renderer(&run, &run.renderers[i]);
        if (result == LOBE_OK)
            result = measure_error(&run, i, &results[i]);
    }
    if (result == LOBE_OK)
        result = measure_times(&run, results);
    for (size_t i = 0; i < job->filter_count; i++)
        lobe_renderer_destroy(&run.renderers[i]);
    animation_destroy(&own.animation);
    lobe_image_free(&run.truth);
    lobe_image_free(&run.truth_lobe_base);
    return result;
}
