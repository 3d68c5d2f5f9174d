#include "tools/sweep/scene_run.h"

#include <string.h>

// ---------------------------------------------------------------------------------------------
// What is shared

lobe_result scene_run_out_of_memory(const scene_run *run) {
    return lobe_host_fail(run->job->bench.host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          run->scene->name);
}

lobe_result scene_run_renderer(const scene_run *run, const lobe_host *host,
                               lobe_renderer **renderer) {
    lobe_result result = lobe_renderer_create(run->job->bench.device, host, renderer);
    animation_attach(run->job->bench.animation, *renderer);
    return result == LOBE_OK ? lobe_renderer_set_scene(*renderer, run->scene) : result;
}

uint32_t scene_run_samples(const sweep_variant *variant) {
    return lobe_filter_supersamples(variant->filter.filter) ? BENCH_TIMED_SAMPLES : 1;
}

const lobe_pass_time *scene_run_find_pass(const lobe_frame *frame, const char *name) {
    for (size_t i = 0; i < frame->pass_count; i++) {
        if (strcmp(frame->passes[i].name, name) == 0)
            return &frame->passes[i];
    }
    return NULL;
}

static void write_error(void *user, lobe_log_level level, const char *message) {
    const lobe_host *host = user;
    if (level == LOBE_LOG_ERROR)
        lobe_host_log(host, level, "%s", message);
}

// ---------------------------------------------------------------------------------------------
// Whole sweeps

static void show_step(const scene_run *run, size_t index) {
    const sweep_job *job = run->job;
    progress_step(job->bench.progress, "%s: %s of %s, row %zu of %zu", run->name,
                  job->brief ? "error and time" : "error and flicker", run->rows[index].filter,
                  index + 1, job->plan.count);
}

/// To measure its memory, each row has its own renderer.
static lobe_result measure_stills(const scene_run *run) {
    const sweep_job *job = run->job;
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < job->plan.count && !sweep_stopped(job); i++) {
        const sweep_variant *variant = &job->plan.variants[i];
        lobe_renderer *renderer = NULL;
        show_step(run, i);
        progress_weigh(job->bench.progress, still_work(job, variant));
        result = still_measure(run, variant, &renderer, &run->rows[i]);
        lobe_renderer_destroy(&renderer);
    }
    return result;
}

static lobe_result measure_wholly(const scene_run *run) {
    lobe_result result = measure_stills(run);
    if (result == LOBE_OK && !sweep_stopped(run->job))
        result = times_measure(run);
    return result == LOBE_OK && !sweep_stopped(run->job) ? rows_summarise(run) : result;
}

// ---------------------------------------------------------------------------------------------
// Brief sweeps

static bool is_wanted(const scene_run *run, size_t index) {
    const sweep_brief *brief = run->job->brief;
    return run->rows[index].varied[0] == '\0' || brief->wants(brief->user, run->rows, index);
}

static lobe_result measure_row(const scene_run *run, size_t index, lobe_renderer **renderer) {
    const sweep_job *job = run->job;
    const sweep_variant *variant = &job->plan.variants[index];
    const double work = still_work(job, variant) + times_work(job, variant);
    if (!is_wanted(run, index)) {
        progress_spare(job->bench.progress, work);
        return LOBE_OK;
    }
    show_step(run, index);
    progress_weigh(job->bench.progress, work);
    lobe_result result = still_measure(run, variant, renderer, &run->rows[index]);
    if (result == LOBE_OK && !sweep_stopped(job))
        result = times_measure_briefly(run, *renderer, index);
    return result == LOBE_OK && !sweep_stopped(job) ? rows_summarise_row(run, index) : result;
}

/// One renderer for all rows prepares an environment once. A row's frames follow each other, so
/// that its maps are built as seldom as can be.
static lobe_result measure_briefly(const scene_run *run) {
    const sweep_job *job = run->job;
    lobe_renderer *renderer = NULL;
    lobe_result result = LOBE_OK;
    for (int varied = 0; varied < 2; varied++) {
        for (size_t i = 0; i < job->plan.count && result == LOBE_OK && !sweep_stopped(job); i++) {
            if ((run->rows[i].varied[0] != '\0') == varied)
                result = measure_row(run, i, &renderer);
        }
    }
    lobe_renderer_destroy(&renderer);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Interface

double sweep_scene_work(const sweep_job *job) {
    double work = sweep_truth_work(job) + 4.0 * job->stations * job->path_samples;
    for (size_t i = 0; i < job->plan.count; i++)
        work += still_work(job, &job->plan.variants[i]) + times_work(job, &job->plan.variants[i]);
    return work;
}

static lobe_result render_truths(scene_run *run, sweep_scene *entry) {
    lobe_renderer *renderer = NULL;
    lobe_result result = scene_run_renderer(run, &run->errors, &renderer);
    if (result == LOBE_OK)
        result = sweep_truth_render(run->job, run->scene, renderer, entry, &run->truth);
    if (result == LOBE_OK)
        result = sweep_path_render(run->job, run->scene, renderer, &run->path);
    lobe_renderer_destroy(&renderer);
    return result;
}

lobe_result sweep_measure(const sweep_job *job, lobe_scene *scene, sweep_scene *entry,
                          sweep_row *rows) {
    lobe_host host = *job->bench.host;
    sweep_job own = *job;
    scene_run run = {.job = &own,
                     .scene = scene,
                     .name = entry->name,
                     .errors = {.write = write_error, .user = &host},
                     .rows = rows};
    lobe_result result = rows_open(&run, entry->name);
    if (result == LOBE_OK)
        result = animation_create(job->bench.device, scene, job->bench.host, &own.bench.animation);
    if (result == LOBE_OK)
        result = render_truths(&run, entry);
    if (result == LOBE_OK && !sweep_stopped(job))
        result = job->brief ? measure_briefly(&run) : measure_wholly(&run);
    rows_close(&run);
    sweep_path_free(run.job, &run.path);
    sweep_truth_free(&run.truth);
    animation_destroy(&own.bench.animation);
    return result;
}
