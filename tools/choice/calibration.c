#include "tools/choice/calibration.h"

#include <stdlib.h>

#include "tools/sweep/sweep.h"

/// One disturbed frame does not change the median of three.
#define CALIBRATION_FRAMES  3
#define CALIBRATION_SAMPLES 64

/// A filter's knobs are not varied if its defaults miss the limit by more than this factor, or cost
/// more than this many times what those of another filter within the limit do.
#define FARTHEST 4

/// Nor are they if another filter errs less by this factor and takes no more time.
#define CLEARLY_BETTER 2

typedef struct candidates {
    const trade_request *request;
    size_t count; ///< of rows
} candidates;

/// The row of the same filter with its defaults, which comes before.
static const sweep_row *find_defaults(const sweep_row *rows, size_t index) {
    size_t defaults = index;
    while (defaults > 0 && rows[defaults].varied[0] != '\0')
        defaults--;
    return &rows[defaults];
}

/// Whether other knobs are unlikely to make the filter of `row` a better choice than `other`.
static bool is_beaten(const trade_request *request, const sweep_row *row, const sweep_row *other) {
    const double error = row->error.relative_l2, others_error = other->error.relative_l2;
    const double time = trade_milliseconds(request, row);
    const double others_time = trade_milliseconds(request, other);
    if (others_error * CLEARLY_BETTER < error && others_time <= time)
        return true;
    return request->kind == TRADE_LIMIT_MILLISECONDS
               ? others_time <= request->limit && error > FARTHEST * others_error
               : others_error <= request->limit && time > FARTHEST * others_time;
}

/// Whether knobs of a row's filter may make it the choice: see sweep_brief.wants.
static bool may_be_picked(void *user, const sweep_row *rows, size_t index) {
    const candidates *among = user;
    const trade_request *request = among->request;
    const sweep_row *defaults = find_defaults(rows, index);
    const double limited = request->kind == TRADE_LIMIT_MILLISECONDS
                               ? trade_milliseconds(request, defaults)
                               : defaults->error.relative_l2;
    bool may = limited <= FARTHEST * request->limit;
    for (size_t i = 0; may && i < among->count; i++)
        may = rows[i].varied[0] != '\0' || !is_beaten(request, defaults, &rows[i]);
    return may;
}

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
                  "calibrating: up to %zu choices of filter and knobs at %ux%u, up to %u frames "
                  "each, errors against %u samples per pixel",
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
    candidates among = {.request = calibration->request};
    const sweep_brief brief = {
        .retained = calibration->request->retained, .wants = may_be_picked, .user = &among};
    sweep_job job = {
        .bench = {.device = calibration->device,
                  .host = calibration->host,
                  .progress = &progress,
                  .size = {calibration->size[0], calibration->size[1]},
                  .frames = CALIBRATION_FRAMES,
                  .samples = CALIBRATION_SAMPLES},
        .brief = &brief,
        .interrupted = &interrupted,
    };
    *results = (sweep_results){
        .size = {calibration->size[0], calibration->size[1]},
        .reference_samples = CALIBRATION_SAMPLES,
        .frames = CALIBRATION_FRAMES,
    };
    lobe_result result = make_plan(&job);
    among.count = job.plan.count;
    if (result == LOBE_OK)
        result = measure(&job, calibration->scene, results);
    sweep_plan_free(&job.plan);
    return result;
}
