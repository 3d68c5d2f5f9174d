#include "tools/sweep/scene_run.h"

#include <string.h>

#include "tools/bench/changed_frame.h"
#include "tools/bench/timing.h"

/// Timed frames of each kind in one turn of a row; each turn also needs two untimed ones.
#define TURN_FRAMES 2

/// Frames of brief sweeps that take longer are timed once: disturbances are short beside them.
#define LONG_FRAME_MILLISECONDS 500

double times_work(const sweep_job *job, const sweep_variant *variant) {
    const double kinds = job->brief ? 1 : 3;
    return bench_frames(&job->bench, &variant->filter) * (kinds * scene_run_samples(variant) + 1);
}

/// Adds the two parts of a frame that built maps, as a frame of two passes.
static lobe_result add_parts(const scene_run *run, size_t index, const lobe_frame *frame) {
    lobe_pass_report parts[2] = {{.name = "building", .state = LOBE_PASS_RUN},
                                 {.name = "shading", .state = LOBE_PASS_RUN}};
    const sweep_row *row = &run->rows[index];
    for (size_t i = 0; i < row->pass_count; i++) {
        const lobe_pass_time *time = scene_run_find_pass(frame, row->passes[i].name);
        parts[row->passes[i].building ? 0 : 1].milliseconds += time ? time->milliseconds : 0;
    }
    const lobe_graph_report report = {
        .passes = parts, .pass_count = 2, .milliseconds = frame->milliseconds};
    return lobe_profile_add(run->times[index].parts, &report);
}

/// How often passes run in a complete frame: those of the reference were listed from one sample.
static void count_passes(sweep_row *row, const lobe_frame *frame) {
    for (size_t i = 0; i < row->pass_count; i++) {
        const lobe_pass_time *time = scene_run_find_pass(frame, row->passes[i].name);
        row->passes[i].count = time ? time->count : row->passes[i].count;
    }
}

/// `*milliseconds`: of the frame; NULL: not needed.
static lobe_result time_frame(const scene_run *run, lobe_renderer *renderer, size_t index,
                              bool rebuild, bool keep, double *milliseconds) {
    const row_times *times = &run->times[index];
    lobe_render_parameters parameters = sweep_parameters(run->job, &run->job->plan.variants[index]);
    parameters.rebuild = rebuild;
    parameters.environment.keep = true;
    parameters.reference.samples = keep ? parameters.reference.samples : 1;
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(renderer, &parameters, &frame);
    if (milliseconds)
        *milliseconds = result == LOBE_OK ? frame.milliseconds : 0;
    if (result == LOBE_OK && keep && !sweep_stopped(run->job)) {
        result =
            timing_add(rebuild ? times->rebuilt : times->retained, &frame, run->job->bench.host);
        if (result == LOBE_OK && rebuild) {
            count_passes(&run->rows[index], &frame);
            result = add_parts(run, index, &frame);
        }
    }
    lobe_frame_free(&frame);
    return result;
}

/// Timed frames of one kind, after one warm-up frame with one sample.
static lobe_result time_frames(const scene_run *run, lobe_renderer *renderer, size_t index,
                               bool rebuild, uint32_t count) {
    lobe_result result = time_frame(run, renderer, index, rebuild, false, NULL);
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++)
        result = time_frame(run, renderer, index, rebuild, true, NULL);
    return result;
}

static lobe_result time_changed_frame(const scene_run *run, lobe_renderer *renderer, size_t index,
                                      bool keep) {
    const row_times *times = &run->times[index];
    lobe_render_parameters parameters = sweep_parameters(run->job, &run->job->plan.variants[index]);
    parameters.reference.samples = keep ? parameters.reference.samples : 1;
    lobe_frame frame;
    changed_cost cost;
    lobe_result result = changed_frame_render(renderer, run->scene, run->job->bench.animation,
                                              &parameters, run->job->bench.host, &frame, &cost);
    if (result == LOBE_OK && keep && !sweep_stopped(run->job)) {
        result = timing_add(times->changed, &frame, run->job->bench.host);
        if (result == LOBE_OK)
            result = changed_cost_add(times->changed_cost, &cost);
    }
    lobe_frame_free(&frame);
    return result;
}

/// The same with changed texels.
static lobe_result time_changed_frames(const scene_run *run, lobe_renderer *renderer, size_t index,
                                       uint32_t count) {
    lobe_result result = time_changed_frame(run, renderer, index, false);
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++)
        result = time_changed_frame(run, renderer, index, true);
    return result;
}

static lobe_result take_turn(const scene_run *run, lobe_renderer *renderer, size_t index,
                             uint32_t first) {
    const uint32_t frames = bench_frames(&run->job->bench, &run->job->plan.variants[index].filter);
    if (first >= frames)
        return LOBE_OK;
    const uint32_t count = frames - first < TURN_FRAMES ? frames - first : TURN_FRAMES;
    lobe_result result = time_frames(run, renderer, index, true, count);
    if (result == LOBE_OK)
        result = time_frames(run, renderer, index, false, count);
    return result == LOBE_OK ? time_changed_frames(run, renderer, index, count) : result;
}

static lobe_result take_turns(const scene_run *run, lobe_renderer *renderer, sweep_copies *copies) {
    const sweep_job *job = run->job;
    const uint32_t rounds = (job->bench.frames + TURN_FRAMES - 1) / TURN_FRAMES;
    progress_step(job->bench.progress, "%s: times of %u frames of %zu rows", run->name,
                  job->bench.frames, job->plan.count);
    double work = 0;
    for (size_t i = 0; i < job->plan.count; i++)
        work += times_work(job, &job->plan.variants[i]);
    progress_weigh(job->bench.progress, work);
    lobe_result result = LOBE_OK;
    for (uint32_t round = 0; round < rounds; round++) {
        for (size_t i = 0; i < job->plan.count; i++) {
            if (result == LOBE_OK && !sweep_stopped(job))
                result = take_turn(run, renderer, i, round * TURN_FRAMES);
        }
        if (result == LOBE_OK && !sweep_stopped(job))
            result = sweep_copies_time(copies);
        progress_part(job->bench.progress, (round + 1.0) / rounds);
    }
    return result;
}

lobe_result times_measure(const scene_run *run) {
    const sweep_job *job = run->job;
    lobe_renderer *renderer = NULL;
    sweep_copies *copies = NULL;
    lobe_result result = sweep_copies_create(job, run->rows, job->plan.count, &copies);
    if (result == LOBE_OK)
        result = scene_run_renderer(run, &run->errors, &renderer);
    if (result == LOBE_OK)
        result = take_turns(run, renderer, copies);
    if (result == LOBE_OK)
        result = sweep_copies_summarise(copies, run->rows, job->plan.count);
    lobe_renderer_destroy(&renderer);
    sweep_copies_destroy(&copies);
    return result;
}

lobe_result times_measure_briefly(const scene_run *run, lobe_renderer *renderer, size_t index) {
    const bool rebuild = !run->job->brief->retained;
    const uint32_t frames = bench_frames(&run->job->bench, &run->job->plan.variants[index].filter);
    double milliseconds = 0;
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; i < frames && milliseconds < LONG_FRAME_MILLISECONDS; i++) {
        if (result == LOBE_OK)
            result = time_frame(run, renderer, index, rebuild, true, &milliseconds);
    }
    return result;
}
