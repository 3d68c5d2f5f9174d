#include "tools/sweep/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lobe/lobe.h>

#include "tools/cli/device_options.h"

static lobe_result out_of_memory(const sweep_job *job) {
    return lobe_host_fail(job->bench.host, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
}

// ---------------------------------------------------------------------------------------------
// Results of this sweep, and of a previous one that it resumes

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
    return lobe_host_fail(job->bench.host, LOBE_ERROR_INVALID_ARGUMENT,
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

/// Empty results, or those of the file that the sweep resumes, if there is one.
static lobe_result start_results(const sweep_job *job, sweep_results *results) {
    sweep_results former;
    lobe_result result = describe_sweep(job, results);
    if (result != LOBE_OK || !job->resume || access(job->json, F_OK) != 0)
        return result;
    result = sweep_results_read(job->json, job->bench.host, &former);
    if (result != LOBE_OK)
        return result;
    result = check_same(job, &former, results);
    sweep_results_free(result == LOBE_OK ? results : &former);
    if (result == LOBE_OK)
        *results = former;
    return result;
}

static const sweep_plan *plan_for(const sweep_job *job, bool environment) {
    return environment ? &job->environment_plan : &job->plan;
}

/// Whether a scene was skipped, or has all rows of its plan.
static bool is_done(const sweep_job *job, const sweep_results *results,
                    const sweep_subject *subject) {
    const sweep_scene *scene = sweep_results_scene(results, subject->name);
    if (!scene || scene->skipped)
        return scene != NULL;
    const sweep_plan *plan = plan_for(job, scene->environment != NULL);
    bool measured = true;
    for (size_t i = 0; measured && i < plan->count; i++) {
        sweep_setting settings[LOBE_MAXIMUM_KNOBS];
        const sweep_variant *variant = &plan->variants[i];
        size_t count = sweep_variant_settings(variant, settings);
        measured =
            sweep_results_row(results, subject->name, lobe_filter_name(variant->filter.filter),
                              settings, count) != NULL;
    }
    return measured;
}

static void remove_scene(sweep_results *results, const char *name) {
    size_t rows = 0, scenes = 0;
    for (size_t i = 0; i < results->row_count; i++) {
        if (strcmp(results->rows[i].scene, name) == 0)
            sweep_row_free(&results->rows[i]);
        else
            results->rows[rows++] = results->rows[i];
    }
    for (size_t i = 0; i < results->scene_count; i++) {
        if (strcmp(results->scenes[i].name, name) == 0)
            sweep_scene_free(&results->scenes[i]);
        else
            results->scenes[scenes++] = results->scenes[i];
    }
    results->row_count = rows;
    results->scene_count = scenes;
}

/// Takes ownership of the entry and this many rows; on failure the caller keeps it.
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

/// A log that stores the message of a failure instead of passing it on.
typedef struct reason_log {
    const lobe_host *host;
    char reason[1024];
} reason_log;

static void keep_reason(void *user, lobe_log_level level, const char *message) {
    reason_log *kept = user;
    if (level == LOBE_LOG_ERROR)
        snprintf(kept->reason, sizeof kept->reason, "%s", message);
    else
        lobe_host_log(kept->host, level, "%s", message);
}

/// A copy of the job for scenes with or without an environment.
static sweep_job job_for(const sweep_job *job, bool environment) {
    sweep_job result = *job;
    result.plan = *plan_for(job, environment);
    return result;
}

static double work_of(const sweep_job *job, const sweep_subject *subject) {
    const sweep_job expected = job_for(job, sweep_subject_has_environment(subject));
    return sweep_scene_work(&expected);
}

/// A scene that the device accepts.
static lobe_result try_scene(const sweep_job *job, const sweep_subject *subject,
                             const lobe_host *host, lobe_scene **scene) {
    lobe_renderer *renderer = NULL;
    scene_options opening = *job->opening;
    opening.environment = subject->environment;
    lobe_result result = scene_options_open(&opening, subject->scene, job->bench.size, host, scene);
    if (result == LOBE_OK)
        result = lobe_renderer_create(job->bench.device, host, &renderer);
    if (result == LOBE_OK)
        result = lobe_renderer_set_scene(renderer, *scene);
    lobe_renderer_destroy(&renderer);
    return result;
}

/// NULL, with the reason in the entry, if the scene cannot be opened or drawn.
static lobe_result open_scene(const sweep_job *job, const sweep_subject *subject,
                              sweep_scene *entry, lobe_scene **scene) {
    reason_log kept = {.host = job->bench.host};
    const lobe_host host = {.write = keep_reason, .user = &kept};
    if (try_scene(job, subject, &host, scene) == LOBE_OK) {
        for (size_t i = 0; i < (*scene)->instance_count; i++)
            entry->triangles += (*scene)->meshes[(*scene)->instances[i].mesh].index_count / 3;
        return LOBE_OK;
    }
    lobe_scene_destroy(scene);
    progress_spare(job->bench.progress, work_of(job, subject));
    lobe_host_log(job->bench.host, LOBE_LOG_WARNING, "%s: skipped: %s", entry->name, kept.reason);
    entry->skipped = strdup(kept.reason);
    return entry->skipped ? LOBE_OK : out_of_memory(job);
}

static char *copy_text(const char *text, bool *copied) {
    char *copy = text && text[0] ? strdup(text) : NULL;
    *copied = *copied && (copy || !text || !text[0]);
    return copy;
}

/// `scene` may be NULL. Free the entry with sweep_scene_free, also after a failure.
static lobe_result describe_light(const sweep_job *job, const lobe_scene *scene,
                                  sweep_scene *entry) {
    char lighting[SCENE_OPTIONS_DESCRIPTION];
    bool copied = true;
    scene_options_describe(job->opening, lighting);
    entry->lighting = copy_text(lighting, &copied);
    if (scene && scene->environment)
        entry->environment = copy_text(scene->environment->name, &copied);
    return copied ? LOBE_OK : out_of_memory(job);
}

static lobe_result describe_scene(const sweep_job *job, const sweep_subject *subject,
                                  sweep_scene *entry, lobe_scene **scene) {
    bool copied = true;
    *entry = (sweep_scene){.noise = (double)NAN};
    entry->name = copy_text(subject->name, &copied);
    entry->scene = copy_text(subject->scene, &copied);
    if (!copied)
        return out_of_memory(job);
    lobe_result result = open_scene(job, subject, entry, scene);
    return result == LOBE_OK ? describe_light(job, *scene, entry) : result;
}

/// Adds the scene to the results unless the sweep was stopped.
static lobe_result measure_scene(const sweep_job *job, const sweep_subject *subject,
                                 sweep_results *results) {
    lobe_scene *scene = NULL;
    sweep_scene entry;
    lobe_result result = describe_scene(job, subject, &entry, &scene);
    const sweep_job scene_job = job_for(job, scene && scene->environment);
    const size_t count = scene ? scene_job.plan.count : 0;
    sweep_row *rows = calloc(count + 1, sizeof *rows);
    if (result == LOBE_OK && !rows)
        result = out_of_memory(job);
    if (result == LOBE_OK && scene)
        result = sweep_measure(&scene_job, scene, &entry, rows);
    bool kept = result == LOBE_OK && !sweep_stopped(job);
    if (kept) {
        remove_scene(results, subject->name);
        result = add_scene(job, results, &entry, rows, count);
        kept = result == LOBE_OK;
    }
    for (size_t i = 0; rows && !kept && i < count; i++)
        sweep_row_free(&rows[i]);
    if (!kept)
        sweep_scene_free(&entry);
    free(rows);
    lobe_scene_destroy(&scene);
    return result;
}

// ---------------------------------------------------------------------------------------------
// All scenes

typedef struct subject_list {
    sweep_subject *subjects;
    size_t count;
} subject_list;

static size_t count_done(const sweep_job *job, const sweep_results *results,
                         const subject_list *list) {
    size_t done = 0;
    for (size_t i = 0; i < list->count; i++)
        done += is_done(job, results, &list->subjects[i]);
    return done;
}

/// Skipped scenes are tried again: what was missing may be there now.
static lobe_result check_former(const sweep_job *job, const subject_list *list,
                                sweep_results *results) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < list->count; i++) {
        const char *name = list->subjects[i].name;
        const sweep_scene *scene = sweep_results_scene(results, name);
        if (scene && scene->skipped)
            remove_scene(results, name);
        else if (scene)
            result = sweep_subject_check(job, &list->subjects[i], scene);
    }
    return result;
}

static lobe_result write_results(const sweep_job *job, const subject_list *list,
                                 sweep_results *results) {
    results->complete = count_done(job, results, list) == list->count;
    return sweep_results_write(job->json, results, job->bench.host);
}

static void expect_work(const sweep_job *job, const sweep_results *results,
                        const subject_list *list) {
    double work = 0;
    for (size_t i = 0; i < list->count; i++) {
        if (!is_done(job, results, &list->subjects[i]))
            work += work_of(job, &list->subjects[i]);
    }
    progress_expect(job->bench.progress, work);
}

static lobe_result measure_scenes(const sweep_job *job, const subject_list *list,
                                  sweep_results *results) {
    expect_work(job, results, list);
    bool measured = count_done(job, results, list) == list->count;
    lobe_result result = measured ? write_results(job, list, results) : LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < list->count && !sweep_stopped(job); i++) {
        if (is_done(job, results, &list->subjects[i]))
            continue;
        result = measure_scene(job, &list->subjects[i], results);
        if (result == LOBE_OK)
            result = device_options_check(job->bench.device, job->bench.host);
        if (result == LOBE_OK)
            result = write_results(job, list, results);
    }
    progress_end(job->bench.progress);
    return result;
}

static lobe_result make_plans(sweep_job *job) {
    const bench_job *bench = &job->bench;
    sweep_plan_request request = {bench->filters, bench->filter_count, false, job->knobs};
    lobe_result result = sweep_plan_make(&request, bench->host, &job->plan);
    request.environment = true;
    return result == LOBE_OK ? sweep_plan_make(&request, bench->host, &job->environment_plan)
                             : result;
}

static lobe_result check_outcome(const sweep_job *job, const subject_list *list,
                                 const sweep_results *results) {
    if (!results->complete)
        lobe_host_log(job->bench.host, LOBE_LOG_WARNING,
                      "interrupted: %s has %zu of %zu scenes, continue with --resume", job->json,
                      count_done(job, results, list), list->count);
    if (results->complete && results->row_count == 0)
        return lobe_host_fail(job->bench.host, LOBE_ERROR_NOT_FOUND,
                              "%s: no scene could be measured", job->json);
    return LOBE_OK;
}

lobe_result sweep_run(sweep_job *job, const option_list *scenes, const option_list *environments) {
    sweep_results results = {0};
    subject_list list = {0};
    lobe_result result =
        sweep_subjects_list(scenes, environments, job->bench.host, &list.subjects, &list.count);
    if (result == LOBE_OK)
        result = make_plans(job);
    if (result == LOBE_OK)
        result = start_results(job, &results);
    if (result == LOBE_OK)
        result = check_former(job, &list, &results);
    if (result == LOBE_OK)
        result = sweep_pictures_open(job);
    if (result == LOBE_OK)
        result = measure_scenes(job, &list, &results);
    if (result == LOBE_OK)
        sweep_print(&results);
    if (result == LOBE_OK)
        result = check_outcome(job, &list, &results);
    sweep_results_free(&results);
    sweep_pictures_close(job);
    sweep_plan_free(&job->plan);
    sweep_plan_free(&job->environment_plan);
    sweep_subjects_free(&list.subjects, list.count);
    return result;
}
