#include "tools/sweep/scene_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/changed_frame.h"
#include "tools/bench/timing.h"

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

lobe_result rows_summarise_row(const scene_run *run, size_t index) {
    const row_times *times = &run->times[index];
    sweep_row *row = &run->rows[index];
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
    return fits ? LOBE_OK : scene_run_out_of_memory(run);
}

lobe_result rows_summarise(const scene_run *run) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < run->job->plan.count; i++) {
        result = rows_summarise_row(run, i);
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
        return scene_run_out_of_memory(run);
    row->inside_relative_l2 = row->silhouettes_relative_l2 = NAN; // until measured
    row->setting_count = sweep_variant_settings(variant, row->settings);
    snprintf(row->varied, sizeof row->varied, "%s", variant->varied);
    return LOBE_OK;
}

lobe_result rows_open(scene_run *run, const char *scene) {
    const lobe_host *host = run->job->bench.host;
    run->times = calloc(run->job->plan.count, sizeof *run->times);
    lobe_result result = run->times ? LOBE_OK : scene_run_out_of_memory(run);
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

void rows_close(scene_run *run) {
    for (size_t i = 0; run->times && i < run->job->plan.count; i++) {
        lobe_profile_destroy(&run->times[i].rebuilt);
        lobe_profile_destroy(&run->times[i].retained);
        lobe_profile_destroy(&run->times[i].parts);
        lobe_profile_destroy(&run->times[i].changed);
        lobe_profile_destroy(&run->times[i].changed_cost);
    }
    free(run->times);
}
