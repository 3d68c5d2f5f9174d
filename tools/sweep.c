#include "tools/sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lobe/lobe.h>

#include "tools/device_options.h"

bool sweep_stopped(const sweep_job *job) {
    return *job->interrupted != 0;
}

static bool go_on(void *user, double part) {
    (void)part;
    return !sweep_stopped(user);
}

bool sweep_show_progress(void *user, double part) {
    const sweep_job *job = user;
    progress_part(job->bench.progress, part);
    return !sweep_stopped(job);
}

lobe_render_parameters sweep_parameters(const sweep_job *job, const sweep_variant *variant) {
    return (lobe_render_parameters){
        .filter = variant->filter.filter,
        .settings = &variant->filter.settings,
        .width = job->bench.size[0],
        .height = job->bench.size[1],
        .samples = BENCH_TIMED_SAMPLES,
        .discard = true,
        .progress = go_on,
        .user = (void *)job,
    };
}

static lobe_result out_of_memory(const sweep_job *job) {
    return lobe_log_fail(job->bench.log, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
}

// ---------------------------------------------------------------------------------------------
// Results of this sweep, and of one before that it goes on from

static lobe_result describe_sweep(const sweep_job *job, sweep_results *results) {
    const lobe_device_information *device = lobe_device_describe(job->bench.device);
    *results = (sweep_results){
        .version = strdup(lobe_version()),
        .device = strdup(device->name),
        .driver = strdup(device->driver),
        .device_type = strdup(lobe_device_type_name(device->type)),
        .size = {job->bench.size[0], job->bench.size[1]},
        .reference_samples = job->bench.samples,
        .path_samples = job->path_samples,
        .stations = job->stations,
        .frames = job->bench.frames,
    };
    bool fits = results->version && results->device && results->driver && results->device_type;
    return fits ? LOBE_OK : out_of_memory(job);
}

static lobe_result differs(const sweep_job *job, const char *what, const char *former,
                           const char *now) {
    return lobe_log_fail(job->bench.log, LOBE_ERROR_INVALID_ARGUMENT,
                         "%s: measured with %s %s, now it is %s: --resume cannot mix them",
                         job->json, what, former, now);
}

static lobe_result same_text(const sweep_job *job, const char *what, const char *former,
                             const char *now) {
    return strcmp(former, now) == 0 ? LOBE_OK : differs(job, what, former, now);
}

static lobe_result same_number(const sweep_job *job, const char *what, uint32_t former,
                               uint32_t now) {
    char texts[2][16];
    snprintf(texts[0], sizeof *texts, "%u", former);
    snprintf(texts[1], sizeof *texts, "%u", now);
    return same_text(job, what, texts[0], texts[1]);
}

static lobe_result check_same(const sweep_job *job, const sweep_results *former,
                              const sweep_results *now) {
    char sizes[2][32];
    snprintf(sizes[0], sizeof *sizes, "%ux%u", former->size[0], former->size[1]);
    snprintf(sizes[1], sizeof *sizes, "%ux%u", now->size[0], now->size[1]);
    lobe_result result = same_text(job, "version", former->version, now->version);
    if (result == LOBE_OK)
        result = same_text(job, "device", former->device, now->device);
    if (result == LOBE_OK)
        result = same_text(job, "driver", former->driver, now->driver);
    if (result == LOBE_OK)
        result = same_text(job, "size", sizes[0], sizes[1]);
    if (result == LOBE_OK)
        result = same_number(job, "samples", former->reference_samples, now->reference_samples);
    if (result == LOBE_OK)
        result = same_number(job, "path samples", former->path_samples, now->path_samples);
    if (result == LOBE_OK)
        result = same_number(job, "stations", former->stations, now->stations);
    if (result == LOBE_OK)
        result = same_number(job, "frames", former->frames, now->frames);
    return result;
}

/// Empty results, or those of the file that the sweep goes on from, where there is one.
static lobe_result start_results(const sweep_job *job, sweep_results *results) {
    sweep_results former;
    lobe_result result = describe_sweep(job, results);
    if (result != LOBE_OK || !job->resume || access(job->json, F_OK) != 0)
        return result;
    result = sweep_results_read(job->json, job->bench.log, &former);
    if (result != LOBE_OK)
        return result;
    result = check_same(job, &former, results);
    sweep_results_free(result == LOBE_OK ? results : &former);
    if (result == LOBE_OK)
        *results = former;
    return result;
}

/// Whether a scene was skipped, or has all rows of the plan.
static bool is_done(const sweep_job *job, const sweep_results *results, const char *name) {
    const sweep_scene *scene = sweep_results_scene(results, name);
    if (!scene || scene->skipped)
        return scene != NULL;
    bool measured = true;
    for (size_t i = 0; measured && i < job->plan.count; ++i) {
        sweep_setting settings[LOBE_MAXIMUM_KNOBS];
        const sweep_variant *variant = &job->plan.variants[i];
        size_t count = sweep_variant_settings(variant, settings);
        measured = sweep_results_row(results, name, lobe_filter_name(variant->filter.filter),
                                     settings, count) != NULL;
    }
    return measured;
}

static void remove_scene(sweep_results *results, const char *name) {
    size_t rows = 0, scenes = 0;
    for (size_t i = 0; i < results->row_count; ++i) {
        if (strcmp(results->rows[i].scene, name) == 0)
            sweep_row_free(&results->rows[i]);
        else
            results->rows[rows++] = results->rows[i];
    }
    for (size_t i = 0; i < results->scene_count; ++i) {
        if (strcmp(results->scenes[i].name, name) == 0)
            sweep_scene_free(&results->scenes[i]);
        else
            results->scenes[scenes++] = results->scenes[i];
    }
    results->row_count = rows;
    results->scene_count = scenes;
}

/// Takes over the entry, and so many rows; on failure they stay the caller's.
static lobe_result add_scene(const sweep_job *job, sweep_results *results, const sweep_scene *entry,
                             const sweep_row *rows, size_t count) {
    sweep_scene *scenes =
        realloc(results->scenes, (results->scene_count + 1) * sizeof *results->scenes);
    results->scenes = scenes ? scenes : results->scenes;
    sweep_row *all =
        realloc(results->rows, (results->row_count + count + 1) * sizeof *results->rows);
    results->rows = all ? all : results->rows;
    if (!scenes || !all)
        return out_of_memory(job);
    results->scenes[results->scene_count++] = *entry;
    memcpy(&results->rows[results->row_count], rows, count * sizeof *rows);
    results->row_count += count;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// A scene

/// A log that keeps the line of a failure instead of handing it on.
typedef struct reason_log {
    const lobe_log *log;
    char reason[1024];
} reason_log;

static void keep_reason(void *user, lobe_log_level level, const char *message) {
    reason_log *kept = user;
    if (level == LOBE_LOG_ERROR)
        snprintf(kept->reason, sizeof kept->reason, "%s", message);
    else
        lobe_log_print(kept->log, level, "%s", message);
}

/// A scene that the device takes.
static lobe_result try_scene(const sweep_job *job, const char *name, const lobe_log *log,
                             lobe_scene **scene) {
    lobe_renderer *renderer = NULL;
    lobe_result result = scene_options_open(job->opening, name, job->bench.size, log, scene);
    if (result == LOBE_OK)
        result = lobe_renderer_create(job->bench.device, log, &renderer);
    if (result == LOBE_OK)
        result = lobe_renderer_set_scene(renderer, *scene);
    lobe_renderer_destroy(&renderer);
    return result;
}

/// NULL, and the entry says why, where the scene cannot be opened or drawn.
static lobe_result open_scene(const sweep_job *job, sweep_scene *entry, lobe_scene **scene) {
    reason_log kept = {.log = job->bench.log};
    const lobe_log log = {.write = keep_reason, .user = &kept};
    if (try_scene(job, entry->name, &log, scene) == LOBE_OK) {
        for (size_t i = 0; i < (*scene)->instance_count; ++i)
            entry->triangles += (*scene)->meshes[(*scene)->instances[i].mesh].index_count / 3;
        return LOBE_OK;
    }
    lobe_scene_destroy(scene);
    progress_spare(job->bench.progress, sweep_scene_work(job));
    lobe_log_print(job->bench.log, LOBE_LOG_WARNING, "%s: skipped: %s", entry->name, kept.reason);
    entry->skipped = strdup(kept.reason);
    return entry->skipped ? LOBE_OK : out_of_memory(job);
}

/// The results get the scene, unless the sweep was stopped meanwhile.
static lobe_result measure_scene(const sweep_job *job, const char *name, sweep_results *results) {
    const size_t count = job->plan.count;
    lobe_scene *scene = NULL;
    sweep_scene entry = {.name = strdup(name)};
    sweep_row *rows = calloc(count, sizeof *rows);
    lobe_result result = entry.name && rows ? LOBE_OK : out_of_memory(job);
    if (result == LOBE_OK)
        result = open_scene(job, &entry, &scene);
    if (result == LOBE_OK && scene)
        result = sweep_measure(job, scene, &entry, rows);
    bool kept = result == LOBE_OK && !sweep_stopped(job);
    if (kept) {
        remove_scene(results, name);
        result = add_scene(job, results, &entry, rows, scene ? count : 0);
        kept = result == LOBE_OK;
    }
    for (size_t i = 0; rows && !(kept && scene) && i < count; ++i)
        sweep_row_free(&rows[i]);
    if (!kept)
        sweep_scene_free(&entry);
    free(rows);
    lobe_scene_destroy(&scene);
    return result;
}

// ---------------------------------------------------------------------------------------------
// All scenes

static size_t count_done(const sweep_job *job, const sweep_results *results,
                         const char *const *scenes, size_t count) {
    size_t done = 0;
    for (size_t i = 0; i < count; ++i)
        done += is_done(job, results, scenes[i]);
    return done;
}

/// What was missing then may be there now.
static void forget_skipped(sweep_results *results, const char *const *scenes, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const sweep_scene *scene = sweep_results_scene(results, scenes[i]);
        if (scene && scene->skipped)
            remove_scene(results, scenes[i]);
    }
}

static lobe_result write_results(const sweep_job *job, const char *const *scenes, size_t count,
                                 sweep_results *results) {
    results->complete = count_done(job, results, scenes, count) == count;
    return sweep_results_write(job->json, results, job->bench.log);
}

static lobe_result measure_scenes(const sweep_job *job, const char *const *scenes, size_t count,
                                  sweep_results *results) {
    forget_skipped(results, scenes, count);
    size_t left = count - count_done(job, results, scenes, count);
    progress_expect(job->bench.progress, (double)left * sweep_scene_work(job));
    lobe_result result = left > 0 ? LOBE_OK : write_results(job, scenes, count, results);
    for (size_t i = 0; result == LOBE_OK && i < count && !sweep_stopped(job); ++i) {
        if (is_done(job, results, scenes[i]))
            continue;
        result = measure_scene(job, scenes[i], results);
        if (result == LOBE_OK)
            result = device_options_check(job->bench.device, job->bench.log);
        if (result == LOBE_OK)
            result = write_results(job, scenes, count, results);
    }
    progress_end(job->bench.progress);
    return result;
}

lobe_result sweep_run(sweep_job *job, const char *const *scenes, size_t scene_count) {
    sweep_results results = {0};
    lobe_result result =
        sweep_plan_make(job->bench.filters, job->bench.filter_count, job->bench.log, &job->plan);
    if (result == LOBE_OK)
        result = start_results(job, &results);
    if (result == LOBE_OK)
        result = sweep_pictures_open(job);
    if (result == LOBE_OK)
        result = measure_scenes(job, scenes, scene_count, &results);
    if (result == LOBE_OK)
        sweep_print(&results);
    if (result == LOBE_OK && !results.complete)
        lobe_log_print(job->bench.log, LOBE_LOG_WARNING,
                       "interrupted: %s holds %zu of %zu scenes, --resume goes on", job->json,
                       count_done(job, &results, scenes, scene_count), scene_count);
    if (result == LOBE_OK && results.complete && results.row_count == 0)
        result = lobe_log_fail(job->bench.log, LOBE_ERROR_NOT_FOUND,
                               "%s: no scene could be measured", job->json);
    sweep_results_free(&results);
    sweep_pictures_close(job);
    sweep_plan_free(&job->plan);
    return result;
}
