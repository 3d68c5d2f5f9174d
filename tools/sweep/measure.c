#include "tools/sweep/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/changed_frame.h"
#include "tools/bench/timing.h"

/// Timed frames of each kind in one turn of a row; each turn also needs two untimed ones.
#define TURN_FRAMES 2

typedef struct row_times {
    lobe_profile *rebuilt, *retained, *parts, *changed, *changed_cost;
} row_times;

/// State of the measurements of one scene.
typedef struct scene_run {
    const sweep_job *job;
    lobe_scene *scene;
    const char *name; ///< in the results
    lobe_host errors; ///< only errors pass: a filter's warnings should not repeat
    sweep_row *rows;
    row_times *times; ///< one per row
    sweep_truth truth;
    sweep_path path;
} scene_run;

static void write_error(void *user, lobe_log_level level, const char *message) {
    const lobe_host *host = user;
    if (level == LOBE_LOG_ERROR)
        lobe_host_log(host, level, "%s", message);
}

static lobe_result out_of_memory(const scene_run *run) {
    return lobe_host_fail(run->job->bench.host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          run->scene->name);
}

static lobe_result open_renderer(const scene_run *run, const lobe_host *host,
                                 lobe_renderer **renderer) {
    lobe_result result = lobe_renderer_create(run->job->bench.device, host, renderer);
    animation_attach(run->job->bench.animation, *renderer);
    return result == LOBE_OK ? lobe_renderer_set_scene(*renderer, run->scene) : result;
}

static uint32_t sample_count(const sweep_variant *variant) {
    return lobe_filter_supersamples(variant->filter.filter) ? BENCH_TIMED_SAMPLES : 1;
}

// Work, in the unit of progress_expect: frames of one sample.

static double still_work(const sweep_job *job, const sweep_variant *variant) {
    bool pairs = !lobe_filter_supersamples(variant->filter.filter);
    return 1 + sample_count(variant) + (pairs ? 2 * job->stations : 0);
}

static double time_work(const sweep_job *job) {
    double work = 0;
    for (size_t i = 0; i < job->plan.count; i++) {
        const sweep_variant *variant = &job->plan.variants[i];
        const double kinds = job->brief ? 2 : 3;
        work += bench_frames(&job->bench, &variant->filter) * (kinds * sample_count(variant) + 1);
    }
    return work;
}

double sweep_scene_work(const sweep_job *job) {
    double work = sweep_truth_work(job) + 4.0 * job->stations * job->path_samples;
    for (size_t i = 0; i < job->plan.count; i++)
        work += still_work(job, &job->plan.variants[i]);
    return work + time_work(job);
}

static lobe_result render_truths(scene_run *run, sweep_scene *entry) {
    lobe_renderer *renderer = NULL;
    lobe_result result = open_renderer(run, &run->errors, &renderer);
    if (result == LOBE_OK)
        result = sweep_truth_render(run->job, run->scene, renderer, entry, &run->truth);
    if (result == LOBE_OK)
        result = sweep_path_render(run->job, run->scene, renderer, &run->path);
    lobe_renderer_destroy(&renderer);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Passes, memory, error and flicker of a row

static const lobe_pass_time *find_pass(const lobe_frame *frame, const char *name) {
    for (size_t i = 0; i < frame->pass_count; i++) {
        if (strcmp(frame->passes[i].name, name) == 0)
            return &frame->passes[i];
    }
    return NULL;
}

/// A pass builds if it runs in a frame that builds maps and not in the next, which retains them.
static lobe_result list_passes(const scene_run *run, const lobe_frame *built,
                               const lobe_frame *retained, sweep_row *row) {
    row->passes = calloc(built->pass_count + 1, sizeof *row->passes);
    if (!row->passes)
        return out_of_memory(run);
    row->pass_count = built->pass_count;
    for (size_t i = 0; i < built->pass_count; i++) {
        const lobe_pass_time *time = &built->passes[i];
        sweep_pass *pass = &row->passes[i];
        snprintf(pass->name, sizeof pass->name, "%s", time->name);
        pass->count = time->count;
        pass->milliseconds = time->milliseconds; // replaced by the median later
        pass->building = strcmp(time->name, "shading") != 0 && !find_pass(retained, time->name);
        // The texels that other passes fetch depend on the picture.
        pass->bytes = pass->building ? (double)(time->read_bytes + time->written_bytes) : 0;
    }
    return LOBE_OK;
}

static lobe_result measure_memory(const scene_run *run, const sweep_variant *variant,
                                  lobe_renderer **renderer, sweep_row *row, lobe_frame *built) {
    const bench_job *bench = &run->job->bench;
    const bool quiet = run->job->brief || variant->varied[0] != '\0';
    lobe_device_memory before, after;
    lobe_device_memory_reset_peak(bench->device);
    lobe_device_memory_query(bench->device, &before);
    lobe_result result = LOBE_OK;
    if (!*renderer)
        result = open_renderer(run, quiet ? &run->errors : bench->host, renderer);
    lobe_render_parameters parameters = sweep_parameters(run->job, variant);
    parameters.rebuild = parameters.environment.keep = true;
    parameters.reference.samples = 1; // memory does not depend on samples
    if (result == LOBE_OK)
        result = lobe_renderer_render(*renderer, &parameters, built);
    lobe_device_memory_query(bench->device, &after);
    row->memory_bytes = after.peak_used_bytes - before.used_bytes;
    if (built->base_texels > 0)
        row->bytes_per_texel = (double)built->filtered_bytes / (double)built->base_texels;
    return result;
}

static lobe_result compare(const scene_run *run, const lobe_image *image, const lobe_image *truth,
                           const sweep_row *row, error_metrics *error) {
    return error_metrics_measure(image, truth,
                                 &(error_metrics_parameters){.test_name = row->filter,
                                                             .reference_name = row->scene,
                                                             .high_dynamic_range = true},
                                 run->job->bench.host, error, NULL);
}

static lobe_result measure_error(const scene_run *run, const sweep_variant *variant,
                                 const lobe_frame *still, sweep_row *row) {
    lobe_result result = compare(run, &still->radiance, &run->truth.image, row, &row->error);
    if (result != LOBE_OK || run->job->brief)
        return result;
    result = compare(run, &still->radiance, &run->truth.lobe_base, row, &row->error_lobe_base);
    if (result == LOBE_OK && row->varied[0] == '\0')
        result = sweep_pictures_write(run->job, row->scene, variant, sample_count(variant),
                                      row->filter, still, &row->picture);
    return result;
}

static lobe_result measure_still(const scene_run *run, const sweep_variant *variant,
                                 lobe_renderer **renderer, sweep_row *row) {
    lobe_frame built = {0}, still = {0};
    lobe_render_parameters parameters = sweep_parameters(run->job, variant);
    parameters.discard = false;
    lobe_result result = measure_memory(run, variant, renderer, row, &built);
    if (result == LOBE_OK)
        result = lobe_renderer_render(*renderer, &parameters, &still);
    if (result == LOBE_OK && !sweep_stopped(run->job))
        result = measure_error(run, variant, &still, row);
    if (result == LOBE_OK)
        result = list_passes(run, &built, &still, row);
    if (result == LOBE_OK)
        result =
            sweep_path_flicker(run->job, run->scene, *renderer, variant, &run->path, &row->flicker);
    lobe_frame_free(&still);
    lobe_frame_free(&built);
    return result;
}

/// To measure its memory, each row has its own renderer. Brief sweeps use one for all, which
/// prepares an environment once.
static lobe_result measure_stills(const scene_run *run) {
    const sweep_job *job = run->job;
    lobe_renderer *renderer = NULL;
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < job->plan.count && !sweep_stopped(job); i++) {
        const sweep_variant *variant = &job->plan.variants[i];
        progress_step(job->bench.progress, "%s: error%s of %s, row %zu of %zu", run->name,
                      job->brief ? "" : " and flicker", run->rows[i].filter, i + 1,
                      job->plan.count);
        progress_weigh(job->bench.progress, still_work(job, variant));
        result = measure_still(run, variant, &renderer, &run->rows[i]);
        if (!job->brief)
            lobe_renderer_destroy(&renderer);
    }
    lobe_renderer_destroy(&renderer);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Time

/// Adds the two parts of a frame that built maps, as a frame of two passes.
static lobe_result add_parts(const scene_run *run, size_t index, const lobe_frame *frame) {
    lobe_pass_report parts[2] = {{.name = "building", .state = LOBE_PASS_RUN},
                                 {.name = "shading", .state = LOBE_PASS_RUN}};
    const sweep_row *row = &run->rows[index];
    for (size_t i = 0; i < row->pass_count; i++) {
        const lobe_pass_time *time = find_pass(frame, row->passes[i].name);
        parts[row->passes[i].building ? 0 : 1].milliseconds += time ? time->milliseconds : 0;
    }
    const lobe_graph_report report = {
        .passes = parts, .pass_count = 2, .milliseconds = frame->milliseconds};
    return lobe_profile_add(run->times[index].parts, &report);
}

/// How often passes run in a complete frame: those of the reference were listed from one sample.
static void count_passes(sweep_row *row, const lobe_frame *frame) {
    for (size_t i = 0; i < row->pass_count; i++) {
        const lobe_pass_time *time = find_pass(frame, row->passes[i].name);
        row->passes[i].count = time ? time->count : row->passes[i].count;
    }
}

static lobe_result time_frame(const scene_run *run, lobe_renderer *renderer, size_t index,
                              bool rebuild, bool keep) {
    const row_times *times = &run->times[index];
    lobe_render_parameters parameters = sweep_parameters(run->job, &run->job->plan.variants[index]);
    parameters.rebuild = rebuild;
    parameters.environment.keep = true;
    parameters.reference.samples = keep ? parameters.reference.samples : 1;
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(renderer, &parameters, &frame);
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
    lobe_result result = time_frame(run, renderer, index, rebuild, false);
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++)
        result = time_frame(run, renderer, index, rebuild, true);
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

/// The same with changed texels; none in brief sweeps.
static lobe_result time_changed_frames(const scene_run *run, lobe_renderer *renderer, size_t index,
                                       uint32_t count) {
    if (run->job->brief)
        return LOBE_OK;
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
    progress_weigh(job->bench.progress, time_work(job));
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

static lobe_result measure_times(const scene_run *run) {
    const sweep_job *job = run->job;
    lobe_renderer *renderer = NULL;
    sweep_copies *copies = NULL;
    lobe_result result =
        sweep_copies_create(job, run->rows, job->brief ? 0 : job->plan.count, &copies);
    if (result == LOBE_OK)
        result = open_renderer(run, &run->errors, &renderer);
    if (result == LOBE_OK)
        result = take_turns(run, renderer, copies);
    if (result == LOBE_OK)
        result = sweep_copies_summarise(copies, run->rows, job->plan.count);
    lobe_renderer_destroy(&renderer);
    sweep_copies_destroy(&copies);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Rows

static lobe_result summarise_passes(const row_times *times, sweep_row *row) {
    lobe_profile_summary summary;
    lobe_result result = lobe_profile_statistics(times->rebuilt, &summary);
    row->rebuilt_ms = summary.frame.median_milliseconds;
    row->rebuilt_p95_ms = summary.frame.p95_milliseconds;
    for (size_t i = 0; result == LOBE_OK && i < summary.pass_count; i++) {
        for (size_t k = 0; k < row->pass_count; k++) {
            if (strcmp(row->passes[k].name, summary.passes[i].name) == 0)
                row->passes[k].milliseconds = summary.passes[i].median_milliseconds;
        }
    }
    return result;
}

static lobe_result summarise_changed(const row_times *times, sweep_row *row) {
    lobe_profile_summary summary;
    row->changed_ms = row->changed_wall_ms = NAN;
    row->changed_caller_cpu_ms = row->changed_process_cpu_ms = NAN;
    lobe_result result = lobe_profile_statistics(times->changed, &summary);
    if (result != LOBE_OK || summary.frame.runs == 0)
        return result;
    row->changed_ms = summary.frame.median_milliseconds;
    result = lobe_profile_statistics(times->changed_cost, &summary);
    if (result != LOBE_OK)
        return result;
    row->changed_wall_ms = summary.passes[CHANGED_WALL].median_milliseconds;
    row->changed_caller_cpu_ms = summary.passes[CHANGED_CALLER_CPU].median_milliseconds;
    row->changed_process_cpu_ms = summary.passes[CHANGED_PROCESS_CPU].median_milliseconds;
    return LOBE_OK;
}

static lobe_result summarise(const row_times *times, sweep_row *row) {
    lobe_profile_summary summary;
    lobe_result result = summarise_passes(times, row);
    if (result == LOBE_OK)
        result = lobe_profile_statistics(times->retained, &summary);
    if (result != LOBE_OK)
        return result;
    row->retained_ms = summary.frame.median_milliseconds;
    row->retained_p95_ms = summary.frame.p95_milliseconds;
    result = lobe_profile_statistics(times->parts, &summary);
    if (result == LOBE_OK && summary.pass_count == 2) {
        row->building_ms = summary.passes[0].median_milliseconds;
        row->shading_ms = summary.passes[1].median_milliseconds;
    }
    return result == LOBE_OK ? summarise_changed(times, row) : result;
}

/// Passes of a frame that built everything, which frames that only build maps of materials lack.
static lobe_result mark_once(const row_times *times, sweep_row *row) {
    lobe_profile_summary summary;
    lobe_result result = lobe_profile_statistics(times->rebuilt, &summary);
    for (size_t i = 0; result == LOBE_OK && i < row->pass_count; i++) {
        bool timed = false;
        for (size_t k = 0; k < summary.pass_count; k++)
            timed = timed || strcmp(summary.passes[k].name, row->passes[i].name) == 0;
        row->passes[i].once = row->passes[i].building && !timed;
    }
    return result;
}

/// Lists where rows store the time of a pass that prepares the environment; returns the number.
static size_t list_once(const scene_run *run, const char *name, double **places) {
    size_t count = 0;
    for (size_t i = 0; i < run->job->plan.count; i++) {
        const sweep_row *row = &run->rows[i];
        for (size_t k = 0; k < row->pass_count; k++) {
            if (row->passes[k].once && strcmp(row->passes[k].name, name) == 0)
                places[count++] = &row->passes[k].milliseconds;
        }
    }
    return count;
}

/// All rows prepare the environment in the same way, so all get the median of their times.
static void share_median(const scene_run *run, const char *name, double **places, double *times) {
    const size_t count = list_once(run, name, places);
    for (size_t i = 0; i < count; i++)
        times[i] = *places[i];
    const double shared = timing_median(times, count);
    for (size_t i = 0; i < count; i++)
        *places[i] = shared;
}

static lobe_result summarise_environment(const scene_run *run) {
    double *times = calloc(run->job->plan.count, sizeof *times);
    double **places = calloc(run->job->plan.count, sizeof *places);
    for (size_t i = 0; times && places && i < run->job->plan.count; i++) {
        sweep_row *row = &run->rows[i];
        for (size_t k = 0; k < row->pass_count; k++) {
            if (!row->passes[k].once)
                continue;
            share_median(run, row->passes[k].name, places, times);
            row->environment_ms += row->passes[k].milliseconds;
        }
    }
    const bool fits = times && places;
    free(times);
    free(places);
    return fits ? LOBE_OK : out_of_memory(run);
}

static lobe_result summarise_rows(const scene_run *run) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < run->job->plan.count; i++) {
        result = summarise(&run->times[i], &run->rows[i]);
        if (result == LOBE_OK)
            result = mark_once(&run->times[i], &run->rows[i]);
    }
    return result == LOBE_OK ? summarise_environment(run) : result;
}

static lobe_result name_row(const scene_run *run, const sweep_variant *variant, const char *scene,
                            sweep_row *row) {
    row->scene = strdup(scene);
    row->filter = strdup(lobe_filter_name(variant->filter.filter));
    row->settings = calloc(LOBE_MAXIMUM_KNOBS, sizeof *row->settings);
    if (!row->scene || !row->filter || !row->settings)
        return out_of_memory(run);
    row->setting_count = sweep_variant_settings(variant, row->settings);
    snprintf(row->varied, sizeof row->varied, "%s", variant->varied);
    return LOBE_OK;
}

static lobe_result open_rows(scene_run *run, const char *scene) {
    const lobe_host *host = run->job->bench.host;
    run->times = calloc(run->job->plan.count, sizeof *run->times);
    lobe_result result = run->times ? LOBE_OK : out_of_memory(run);
    for (size_t i = 0; result == LOBE_OK && i < run->job->plan.count; i++) {
        row_times *times = &run->times[i];
        lobe_profile **const profiles[] = {&times->rebuilt, &times->retained, &times->parts,
                                           &times->changed, &times->changed_cost};
        result = name_row(run, &run->job->plan.variants[i], scene, &run->rows[i]);
        for (int k = 0; result == LOBE_OK && k < 5; k++)
            result = lobe_profile_create(host, profiles[k]);
    }
    return result;
}

static void close_run(scene_run *run) {
    for (size_t i = 0; run->times && i < run->job->plan.count; i++) {
        lobe_profile_destroy(&run->times[i].rebuilt);
        lobe_profile_destroy(&run->times[i].retained);
        lobe_profile_destroy(&run->times[i].parts);
        lobe_profile_destroy(&run->times[i].changed);
        lobe_profile_destroy(&run->times[i].changed_cost);
    }
    free(run->times);
    sweep_path_free(run->job, &run->path);
    sweep_truth_free(&run->truth);
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
    lobe_result result = open_rows(&run, entry->name);
    if (result == LOBE_OK)
        result = animation_create(job->bench.device, scene, job->bench.host, &own.bench.animation);
    if (result == LOBE_OK)
        result = render_truths(&run, entry);
    if (result == LOBE_OK && !sweep_stopped(job))
        result = measure_stills(&run);
    if (result == LOBE_OK && !sweep_stopped(job))
        result = measure_times(&run);
    if (result == LOBE_OK && !sweep_stopped(job))
        result = summarise_rows(&run);
    close_run(&run);
    animation_destroy(&own.bench.animation);
    return result;
}
