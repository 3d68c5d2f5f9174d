#include <lobe/profile.h>

#include <stdlib.h>
#include <string.h>

#include "engine/growing_array.h"

/// Milliseconds of each frame; frames before its first are 0.
typedef struct time_series {
    char *name;
    double *milliseconds;
    uint32_t capacity;
    uint32_t runs;
} time_series;

struct lobe_profile {
    lobe_log log;
    time_series frame;
    time_series *passes;
    uint32_t pass_count, pass_capacity;
    uint32_t frames;
    lobe_profile_times *times; ///< of the passes, for the last summary
    uint32_t time_capacity;
    double *scratch; ///< for sorting
    uint32_t scratch_capacity;
};

static lobe_result fail_memory(const lobe_profile *profile) {
    return lobe_log_fail(&profile->log, LOBE_ERROR_OUT_OF_MEMORY, "profile: no host memory");
}

lobe_result lobe_profile_create(const lobe_log *log, lobe_profile **profile) {
    *profile = calloc(1, sizeof **profile);
    if (!*profile)
        return lobe_log_fail(log, LOBE_ERROR_OUT_OF_MEMORY, "profile: no host memory");
    if (log)
        (*profile)->log = *log;
    (*profile)->frame.name = "frame";
    return LOBE_OK;
}

void lobe_profile_destroy(lobe_profile **profile) {
    lobe_profile *gone = *profile;
    if (!gone)
        return;
    for (uint32_t n = 0; n < gone->pass_count; n++) {
        free(gone->passes[n].name);
        free(gone->passes[n].milliseconds);
    }
    free(gone->passes);
    free(gone->frame.milliseconds);
    free(gone->times);
    free(gone->scratch);
    free(gone);
    *profile = NULL;
}

// ---------------------------------------------------------------------------------------------
// Gathering

static time_series *find_pass(lobe_profile *profile, const char *name) {
    for (uint32_t n = 0; n < profile->pass_count; n++)
        if (strcmp(profile->passes[n].name, name) == 0)
            return &profile->passes[n];
    return NULL;
}

static bool add_pass(lobe_profile *profile, const char *name) {
    if (!engine_array_reserve((void **)&profile->passes, &profile->pass_capacity,
                              (uint64_t)profile->pass_count + 1, sizeof *profile->passes))
        return false;
    time_series *added = &profile->passes[profile->pass_count];
    *added = (time_series){.name = strdup(name)};
    if (!added->name)
        return false;
    profile->pass_count++;
    return true;
}

/// Room for the frame to come, which starts at 0, and for those from before the first one.
static bool extend(time_series *series, uint32_t frames) {
    uint32_t before = series->capacity;
    if (!engine_array_reserve((void **)&series->milliseconds, &series->capacity,
                              (uint64_t)frames + 1, sizeof *series->milliseconds))
        return false;
    for (uint32_t n = before; n < series->capacity; n++)
        series->milliseconds[n] = 0.0;
    series->milliseconds[frames] = 0.0;
    return true;
}

/// All that can fail comes first, so that a frame counts as a whole or not at all.
static bool make_room(lobe_profile *profile, const lobe_graph_report *report) {
    for (size_t n = 0; n < report->pass_count; n++)
        if (report->passes[n].state == LOBE_PASS_RUN &&
            !find_pass(profile, report->passes[n].name) &&
            !add_pass(profile, report->passes[n].name))
            return false;
    for (uint32_t n = 0; n < profile->pass_count; n++)
        if (!extend(&profile->passes[n], profile->frames))
            return false;
    return extend(&profile->frame, profile->frames);
}

static bool ran_before(const lobe_graph_report *report, size_t pass) {
    for (size_t n = 0; n < pass; n++)
        if (report->passes[n].state == LOBE_PASS_RUN &&
            strcmp(report->passes[n].name, report->passes[pass].name) == 0)
            return true;
    return false;
}

lobe_result lobe_profile_add(lobe_profile *profile, const lobe_graph_report *report) {
    if (!make_room(profile, report))
        return fail_memory(profile);
    for (size_t n = 0; n < report->pass_count; n++) {
        if (report->passes[n].state != LOBE_PASS_RUN)
            continue;
        time_series *series = find_pass(profile, report->passes[n].name);
        series->milliseconds[profile->frames] += report->passes[n].milliseconds;
        series->runs += !ran_before(report, n);
    }
    profile->frame.milliseconds[profile->frames] = report->milliseconds;
    profile->frame.runs++;
    profile->frames++;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Statistics

static int compare_times(const void *a, const void *b) {
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

static double sum_of(const time_series *series, uint32_t frames) {
    double sum = 0.0;
    for (uint32_t n = 0; n < frames; n++)
        sum += series->milliseconds[n];
    return sum;
}

static lobe_profile_times times_of(const lobe_profile *profile, const time_series *series,
                                   double whole) {
    uint32_t count = profile->frames;
    double *sorted = profile->scratch;
    memcpy(sorted, series->milliseconds, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, compare_times);
    uint32_t p95 = (uint32_t)(((uint64_t)count * 95 + 99) / 100) - 1; // nearest rank
    return (lobe_profile_times){.name = series->name,
                                .median_milliseconds =
                                    0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]),
                                .p95_milliseconds = sorted[p95],
                                .share = whole > 0.0 ? sum_of(series, count) / whole : 0.0,
                                .runs = series->runs};
}

static lobe_result reserve_results(lobe_profile *profile) {
    if (engine_array_reserve((void **)&profile->times, &profile->time_capacity,
                             (uint64_t)profile->pass_count + 1, sizeof *profile->times) &&
        engine_array_reserve((void **)&profile->scratch, &profile->scratch_capacity,
                             profile->frames, sizeof *profile->scratch))
        return LOBE_OK;
    return fail_memory(profile);
}

lobe_result lobe_profile_statistics(lobe_profile *profile, lobe_profile_summary *summary) {
    *summary = (lobe_profile_summary){0};
    if (profile->frames == 0)
        return LOBE_OK;
    lobe_result result = reserve_results(profile);
    if (result != LOBE_OK)
        return result;
    double whole = sum_of(&profile->frame, profile->frames);
    for (uint32_t n = 0; n < profile->pass_count; n++)
        profile->times[n] = times_of(profile, &profile->passes[n], whole);
    *summary = (lobe_profile_summary){.passes = profile->times,
                                      .pass_count = profile->pass_count,
                                      .frame = times_of(profile, &profile->frame, whole),
                                      .frames = profile->frames};
    return LOBE_OK;
}
