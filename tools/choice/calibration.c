#include "tools/choice/calibration.h"

#include <stdlib.h>

#include "tools/sweep/sweep.h"

/// One disturbed frame does not change the median of three.
#define CALIBRATION_FRAMES  3
#define CALIBRATION_SAMPLES 64

static void add_filters(bench_job *bench) {
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const lobe_filter *filter = lobe_filter_get(i);
        if (lobe_filter_supersamples(filter) || bench->filter_count == BENCH_MAXIMUM_FILTERS)
            continue;
        bench_filter *added = &bench->filters[bench->filter_count++];
        added->filter = filter;
        lobe_settings_default(filter, &added->settings);
    }
}

static lobe_result make_plan(sweep_job *job) {
    const lobe_filter *reference;
    bench_job *bench = &job->bench;
    lobe_result result = lobe_filter_find("reference", bench->host, &reference);
    if (result != LOBE_OK)
        return result;
    lobe_settings_default(reference, &bench->truth);
    add_filters(bench);
    // Knobs of environments keep their values: preparing their maps takes too long for a
    // calibration.
    const sweep_plan_request request = {bench->filters, bench->filter_count, false, NULL};
    return sweep_plan_make(&request, bench->host, &job->plan);
}

static lobe_result measure(const sweep_job *job, lobe_scene *scene, sweep_results *results) {
    const bench_job *bench = &job->bench;
    sweep_scene entry = {.name = scene->name};
    results->rows = calloc(job->plan.count, sizeof *results->rows);
    if (!results->rows)
        return lobe_host_fail(bench->host, LOBE_ERROR_OUT_OF_MEMORY, "calibration: out of memory");
    results->row_count = job->plan.count;
    lobe_host_log(bench->host, LOBE_LOG_NOTICE,
                  "calibrating: %zu choices of filter and knobs at %ux%u, %u frames each, errors "
                  "against %u samples per pixel",
                  job->plan.count, bench->size[0], bench->size[1], bench->frames, bench->samples);
    progress_expect(bench->progress, sweep_scene_work(job));
    lobe_result result = sweep_measure(job, scene, &entry, results->rows);
    progress_end(bench->progress);
    for (size_t i = 0; result == LOBE_OK && i < results->row_count; i++)
        results->rows[i].error.relative_l2 = sweep_error_without_noise(&entry, &results->rows[i]);
    return result;
}

lobe_result calibrate(const calibration *calibration, sweep_results *results) {
    const volatile sig_atomic_t interrupted = 0; // Ctrl-C ends the program
    progress progress = progress_begin(false);
    sweep_job job = {
        .bench = {.device = calibration->device,
                  .host = calibration->host,
                  .progress = &progress,
                  .size = {calibration->size[0], calibration->size[1]},
                  .frames = CALIBRATION_FRAMES,
                  .samples = CALIBRATION_SAMPLES},
        .brief = true,
        .interrupted = &interrupted,
    };
    *results = (sweep_results){
        .size = {calibration->size[0], calibration->size[1]},
        .reference_samples = CALIBRATION_SAMPLES,
        .frames = CALIBRATION_FRAMES,
    };
    lobe_result result = make_plan(&job);
    if (result == LOBE_OK)
        result = measure(&job, calibration->scene, results);
    sweep_plan_free(&job.plan);
    return result;
}
