#include <lobe/profile.h>

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "engine/base/growing_array.h"

/// Milliseconds in each frame in which it ran.
typedef struct time_series {
    char *name;
    double *milliseconds;
    uint32_t capacity;
    uint32_t runs;
    bool running; ///< in the frame being added
} time_series;

struct lobe_profile {
    lobe_host host;
    time_series frame, recording;
    time_series *passes;
    uint32_t pass_count, pass_capacity;
    lobe_profile_times *times; ///< of the passes, in the last summary
    uint32_t time_capacity;
    double *scratch; ///< for sorting
    uint32_t scratch_capacity;
};

static lobe_result fail_memory(const lobe_profile *profile) {
    return lobe_host_fail(&profile->host, LOBE_ERROR_OUT_OF_MEMORY, "profile: out of memory");
}

lobe_result lobe_profile_create(const lobe_host *host, lobe_profile **profile) {
    if (!profile)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_profile_create: profile must not be NULL");
    *profile = lobe_allocate(lobe_host_allocator(host), 1, sizeof **profile);
    if (!*profile)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "profile: out of memory");
    if (host)
        (*profile)->host = *host;
    (*profile)->frame.name = "frame";
    (*profile)->recording.name = "host";
    return LOBE_OK;
}

void lobe_profile_destroy(lobe_profile **profile) {
    lobe_profile *gone = profile ? *profile : NULL;
    if (!gone)
        return;
    for (uint32_t i = 0; i < gone->pass_count; i++) {
        lobe_release(gone->passes[i].name);
        lobe_release(gone->passes[i].milliseconds);
    }
    lobe_release(gone->passes);
    lobe_release(gone->frame.milliseconds);
    lobe_release(gone->recording.milliseconds);
    lobe_release(gone->times);
    lobe_release(gone->scratch);
    lobe_release(gone);
    *profile = NULL;
}

// ---------------------------------------------------------------------------------------------
// Gathering

static time_series *find_pass(lobe_profile *profile, const char *name) {
    for (uint32_t i = 0; i < profile->pass_count; i++)
        if (strcmp(profile->passes[i].name, name) == 0)
            return &profile->passes[i];
    return NULL;
}

static bool add_pass(lobe_profile *profile, const char *name) {
    if (!engine_array_reserve(profile->host.allocator, (void **)&profile->passes,
                              &profile->pass_capacity, (uint64_t)profile->pass_count + 1,
                              sizeof *profile->passes))
        return false;
    time_series *added = &profile->passes[profile->pass_count];
    *added = (time_series){.name = lobe_copy_text(profile->host.allocator, name)};
    if (!added->name)
        return false;
    profile->pass_count++;
    return true;
}

static bool make_room_for_run(const lobe_profile *profile, time_series *series) {
    return engine_array_reserve(profile->host.allocator, (void **)&series->milliseconds,
                                &series->capacity, (uint64_t)series->runs + 1,
                                sizeof *series->milliseconds);
}

/// Does everything that can fail, so that a frame is counted completely or not at all.
static bool make_room(lobe_profile *profile, const lobe_graph_report *report) {
    for (size_t i = 0; i < report->pass_count; i++)
        if (report->passes[i].state == LOBE_PASS_RUN &&
            !find_pass(profile, report->passes[i].name) &&
            !add_pass(profile, report->passes[i].name))
            return false;
    for (uint32_t i = 0; i < profile->pass_count; i++)
        if (!make_room_for_run(profile, &profile->passes[i]))
            return false;
    return make_room_for_run(profile, &profile->frame) &&
           make_room_for_run(profile, &profile->recording);
}

static void add_time(time_series *series, double milliseconds) {
    if (!series->running)
        series->milliseconds[series->runs++] = 0.0;
    series->running = true;
    series->milliseconds[series->runs - 1] += milliseconds;
}

lobe_result lobe_profile_add(lobe_profile *profile, const lobe_graph_report *report) {
    if (!profile || !report)
        return lobe_host_fail(profile ? &profile->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_profile_add: profile and report must not be NULL");
    if (!make_room(profile, report))
        return fail_memory(profile);
    for (size_t i = 0; i < report->pass_count; i++)
        if (report->passes[i].state == LOBE_PASS_RUN)
            add_time(find_pass(profile, report->passes[i].name), report->passes[i].milliseconds);
    add_time(&profile->frame, report->milliseconds);
    add_time(&profile->recording, report->host_milliseconds);
    profile->frame.running = profile->recording.running = false;
    for (uint32_t i = 0; i < profile->pass_count; i++)
        profile->passes[i].running = false;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Statistics

static int compare_times(const void *a, const void *b) {
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

static double sum_of(const time_series *series) {
    double sum = 0.0;
    for (uint32_t i = 0; i < series->runs; i++)
        sum += series->milliseconds[i];
    return sum;
}

static lobe_profile_times times_of(const lobe_profile *profile, const time_series *series,
                                   double whole) {
    uint32_t count = series->runs;
    double *sorted = profile->scratch;
    memcpy(sorted, series->milliseconds, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, compare_times);
    uint32_t p95 = (uint32_t)(((uint64_t)count * 95 + 99) / 100) - 1; // nearest rank
    return (lobe_profile_times){.name = series->name,
                                .median_milliseconds =
                                    0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]),
                                .p95_milliseconds = sorted[p95],
                                .share = whole > 0.0 ? sum_of(series) / whole : 0.0,
                                .runs = count};
}

static lobe_result reserve_results(lobe_profile *profile) {
    if (engine_array_reserve(profile->host.allocator, (void **)&profile->times,
                             &profile->time_capacity, (uint64_t)profile->pass_count + 1,
                             sizeof *profile->times) &&
        engine_array_reserve(profile->host.allocator, (void **)&profile->scratch,
                             &profile->scratch_capacity, profile->frame.runs,
                             sizeof *profile->scratch))
        return LOBE_OK;
    return fail_memory(profile);
}

lobe_result lobe_profile_statistics(lobe_profile *profile, lobe_profile_summary *summary) {
    if (!profile || !summary)
        return lobe_host_fail(profile ? &profile->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_profile_statistics: profile and summary must not be NULL");
    *summary = (lobe_profile_summary){.frame = {.name = profile->frame.name},
                                      .host = {.name = profile->recording.name}};
    if (profile->frame.runs == 0)
        return LOBE_OK;
    lobe_result result = reserve_results(profile);
    if (result != LOBE_OK)
        return result;
    double whole = sum_of(&profile->frame);
    summary->passes = profile->times;
    for (uint32_t i = 0; i < profile->pass_count; i++)
        if (profile->passes[i].runs > 0)
            profile->times[summary->pass_count++] = times_of(profile, &profile->passes[i], whole);
    summary->frame = times_of(profile, &profile->frame, whole);
    summary->host = times_of(profile, &profile->recording, 0.0);
    return LOBE_OK;
}
