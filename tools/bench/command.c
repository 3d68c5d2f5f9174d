#include "tools/bench/bench.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/lobe.h>

#include "tools/cli/closest_name.h"
#include "tools/cli/console.h"
#include "tools/cli/device_options.h"
#include "tools/cli/output_file.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/subcommand.h"
#include "tools/sweep/sweep.h"

typedef struct bench_request {
    option_list scenes;
    const char *filters;     ///< "a,b,c"; NULL: all
    option_list assignments; ///< "KNOB=VALUE"
    option_list environments;
    const char *json;
    scene_options opening;
    device_options device;
    bench_job job;
    bool sweep, resume;
    const char *pictures, *knobs;
    uint32_t path_samples, stations;
    bool has_path_samples, has_stations;
} bench_request;

/// Ctrl-C asks a sweep to stop; a second one ends the program.
static volatile sig_atomic_t interrupted;

// ---------------------------------------------------------------------------------------------
// Usage

static int add_filter(const option_table *table, bench_job *job, const char *name,
                      const lobe_host *host) {
    if (job->filter_count == BENCH_MAXIMUM_FILTERS)
        return options_usage_error(table, "--filters: more than %d", BENCH_MAXIMUM_FILTERS);
    bench_filter *filter = &job->filters[job->filter_count++];
    if (lobe_filter_find(name, host, &filter->filter) != LOBE_OK)
        return 2;
    lobe_settings_default(filter->filter, &filter->settings);
    return 0;
}

static int choose_filters(const option_table *table, bench_request *request,
                          const lobe_host *host) {
    int status = 0;
    for (size_t i = 0; !request->filters && status == 0 && i < lobe_filter_count(); i++)
        status = add_filter(table, &request->job, lobe_filter_name(lobe_filter_get(i)), host);
    const char *rest = request->filters;
    while (rest && status == 0) {
        size_t length = strcspn(rest, ",");
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)length, rest);
        status = add_filter(table, &request->job, name, host);
        rest = rest[length] == ',' ? rest + length + 1 : NULL;
    }
    return status;
}

static const lobe_knob *find_knob(const lobe_filter *filter, const char *assignment) {
    size_t length = strcspn(assignment, "=");
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        const lobe_knob *knob = lobe_filter_knob(filter, i);
        if (strlen(knob->name) == length && memcmp(knob->name, assignment, length) == 0)
            return knob;
    }
    return NULL;
}

/// Sets a knob in every filter that has it; at least one must have it.
static int set_knob(bench_job *job, const char *assignment, const lobe_host *host) {
    bool known = false;
    for (size_t i = 0; i < job->filter_count; i++) {
        bench_filter *filter = &job->filters[i];
        if (!find_knob(filter->filter, assignment))
            continue;
        known = true;
        if (lobe_settings_set(filter->filter, &filter->settings, assignment, host) != LOBE_OK)
            return 2;
    }
    if (known)
        return 0;
    if (strchr(assignment, '='))
        lobe_host_log(host, LOBE_LOG_ERROR, "--set %s: none of these filters has that knob",
                      assignment);
    else
        lobe_host_log(host, LOBE_LOG_ERROR, "--set %s: write NAME=VALUE", assignment);
    return 2;
}

/// The references share the user's knobs, but differ in how they take base lobes.
static int choose_truths(bench_request *request, const lobe_host *host) {
    const lobe_filter *reference;
    bench_job *job = &request->job;
    if (lobe_filter_find("reference", host, &reference) != LOBE_OK)
        return 1;
    lobe_settings_default(reference, &job->truth);
    for (size_t i = 0; i < request->assignments.count; i++) {
        const char *assignment = request->assignments.values[i];
        if (find_knob(reference, assignment) &&
            lobe_settings_set(reference, &job->truth, assignment, host) != LOBE_OK)
            return 2;
    }
    job->truth_lobe_base = job->truth;
    return lobe_settings_set(reference, &job->truth_lobe_base, "base=lobe", host) == LOBE_OK ? 0
                                                                                             : 1;
}

/// A sweep sets the knobs that it varies itself.
static int check_set_beside_sweep(const option_table *table, const bench_request *request) {
    for (size_t i = 0; request->sweep && i < request->assignments.count; i++) {
        for (size_t k = 0; k < lobe_filter_count(); k++) {
            const lobe_knob *knob = find_knob(lobe_filter_get(k), request->assignments.values[i]);
            if (knob && knob->sweep && sweep_plan_lists(request->knobs, knob->name))
                return options_usage_error(table, "--set %s: --sweep sets that knob itself",
                                           request->assignments.values[i]);
        }
    }
    return 0;
}

static int check_sweep_usage(const option_table *table, const bench_request *request) {
    if (request->sweep && !request->json)
        return options_usage_error(table, "--sweep needs --json FILE");
    int status = check_set_beside_sweep(table, request);
    if (status != 0)
        return status;
    const char *alone = request->resume             ? "--resume"
                        : request->pictures         ? "--pictures"
                        : request->knobs            ? "--knobs"
                        : request->has_path_samples ? "--path-samples"
                        : request->has_stations     ? "--stations"
                                                    : NULL;
    if (!request->sweep && alone)
        return options_usage_error(table, "%s needs --sweep", alone);
    if (!request->sweep && request->environments.count > 1)
        return options_usage_error(table, "--environment: more than one needs --sweep");
    return 0;
}

static bool is_known_knob(const char *name) {
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        if (find_knob(lobe_filter_get(i), name))
            return true;
    }
    return strcmp(name, "none") == 0;
}

static int unknown_knob(const option_table *table, const char *name) {
    closest_name closest = {.name = name, .length = strlen(name)};
    char hint[CLOSEST_NAME_HINT_SIZE];
    for (size_t i = 0; i < lobe_filter_count(); i++)
        for (size_t j = 0; j < lobe_filter_knob_count(lobe_filter_get(i)); j++)
            closest_name_offer(&closest, lobe_filter_knob(lobe_filter_get(i), j)->name);
    return options_usage_error(table, "--knobs: no filter has a knob '%s'%s", name,
                               closest_name_hint(&closest, "", hint));
}

static int check_knobs(const option_table *table, const char *knobs) {
    for (const char *rest = knobs; rest; rest = strchr(rest, ',') ? strchr(rest, ',') + 1 : NULL) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(rest, ","), rest);
        if (!is_known_knob(name))
            return unknown_knob(table, name);
    }
    return 0;
}

static int check_usage(const option_table *table, bench_request *request, const lobe_host *host) {
    const uint32_t *size = request->job.size;
    if (size[0] == 0 || size[1] == 0)
        return options_usage_error(table, "--size: no pixels in %ux%u", size[0], size[1]);
    int status = check_sweep_usage(table, request);
    if (status == 0)
        status = check_knobs(table, request->knobs);
    if (status == 0)
        status = choose_filters(table, request, host);
    for (size_t i = 0; status == 0 && i < request->assignments.count; i++)
        status = set_knob(&request->job, request->assignments.values[i], host);
    return status == 0 ? choose_truths(request, host) : status;
}

// ---------------------------------------------------------------------------------------------
// Work

/// A scene whose assets are missing is left out; the log says why.
static lobe_result measure_scene(const bench_request *request, const char *name,
                                 bench_result *results, bool *left_out) {
    lobe_scene *scene;
    lobe_result result =
        scene_options_open(&request->opening, name, request->job.size, request->job.host, &scene);
    *left_out = scene_options_lack_assets(name, result);
    if (result == LOBE_OK)
        result = bench_measure(&request->job, scene, name, results);
    lobe_scene_destroy(&scene);
    return *left_out ? LOBE_OK : result;
}

/// `*count` receives the number of results.
static lobe_result measure_scenes(const bench_request *request, bench_result *results,
                                  size_t *count) {
    const bench_job *job = &request->job;
    size_t measured = 0;
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < request->scenes.count; i++) {
        bool left_out;
        result = measure_scene(request, request->scenes.values[i],
                               &results[measured * job->filter_count], &left_out);
        measured += !left_out;
    }
    progress_end(job->progress);
    *count = measured * job->filter_count;
    if (result != LOBE_OK || measured == request->scenes.count)
        return result;
    if (measured == 0)
        return LOBE_ERROR_NOT_FOUND;
    lobe_host_log(job->host, LOBE_LOG_WARNING,
                  "only %zu of %zu scenes were measured: the others need assets", measured,
                  request->scenes.count);
    return LOBE_OK;
}

static lobe_result write_json(const bench_request *request, const bench_result *results,
                              size_t count) {
    if (!request->json)
        return LOBE_OK;
    char *text = bench_describe(&request->job, results, count);
    lobe_result result = LOBE_ERROR_OUT_OF_MEMORY;
    if (text)
        result = output_file_write(request->json, text, request->job.host);
    else
        lobe_host_log(request->job.host, LOBE_LOG_ERROR, "%s: out of memory", request->json);
    free(text);
    return result;
}

static lobe_result measure_all(const bench_request *request, bench_result *results) {
    const bench_job *job = &request->job;
    size_t count;
    lobe_result result = measure_scenes(request, results, &count);
    if (result == LOBE_OK)
        result = device_options_check(job->device, job->host);
    if (result == LOBE_OK)
        result = write_json(request, results, count);
    if (result == LOBE_OK)
        bench_print(job, results, count);
    for (size_t i = 0; i < request->scenes.count * job->filter_count; i++)
        bench_result_free(&results[i]);
    return result;
}

static void interrupt(int signal) {
    (void)signal;
    interrupted = 1;
}

static lobe_result sweep(const bench_request *request) {
    sweep_job job = {
        .bench = request->job,
        .json = request->json,
        .pictures = request->pictures,
        .opening = &request->opening,
        .knobs = request->knobs,
        .path_samples = request->path_samples,
        .stations = request->stations,
        .resume = request->resume,
        .interrupted = &interrupted,
    };
    const struct sigaction action = {.sa_handler = interrupt, .sa_flags = SA_RESETHAND};
    sigaction(SIGINT, &action, NULL);
    return sweep_run(&job, &request->scenes, &request->environments);
}

static lobe_result compare_filters(const bench_request *request) {
    const bench_job *job = &request->job;
    lobe_result result;
    bench_result *results = calloc(request->scenes.count * job->filter_count, sizeof *results);
    if (results) {
        result = measure_all(request, results);
    } else {
        lobe_host_log(job->host, LOBE_LOG_ERROR, "bench: out of memory");
        result = LOBE_ERROR_OUT_OF_MEMORY;
    }
    free(results);
    return result;
}

static lobe_result bench(bench_request *request) {
    bench_job *job = &request->job;
    lobe_result result = output_file_check(request->json, job->host);
    if (result == LOBE_OK)
        result = device_options_open(&request->device, job->host, &job->device);
    if (result == LOBE_OK)
        result = request->sweep ? sweep(request) : compare_filters(request);
    lobe_device_destroy(&job->device);
    return result;
}

static int run_request(const option_table *table, bench_request *request) {
    const lobe_host host = console_host(false);
    progress progress = progress_begin(true);
    request->job.host = &host;
    request->job.progress = &progress;
    int status = check_usage(table, request, &host);
    if (status != 0)
        return status;
    if (request->environments.count > 0)
        request->opening.environment = request->environments.values[0];
    return bench(request) == LOBE_OK && !interrupted ? 0 : 1;
}

static int run(int argc, char **argv) {
    bench_request request = {0};
    const option options[] = {
        {.name = "filters",
         .kind = OPTION_TEXT,
         .argument = "A,B,C",
         .summary = "filters to measure, see 'lobe filters' (default: all)",
         .target = &request.filters,
         .values = OPTION_VALUES_FILTER_LIST},
        {.name = "frames",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "frames timed per filter, after a warm-up; at most 2 for the filter "
                    "reference",
         .target = &request.job.frames,
         .fallback = "20",
         .minimum = 1,
         .maximum = 10000},
        {.name = "size",
         .kind = OPTION_SIZE,
         .argument = "WxH",
         .summary = "picture size in pixels; the device sets the limit",
         .target = request.job.size,
         .fallback = "1280x720"},
        {.name = "samples",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "samples per pixel of the reference that errors are measured against",
         .target = &request.job.samples,
         .fallback = "256",
         .minimum = 1,
         .maximum = LOBE_MAXIMUM_SAMPLES},
        {.name = "set",
         .kind = OPTION_LIST,
         .argument = "KNOB=VALUE",
         .summary =
             "set a knob in every filter that has it; with --sweep, only knobs that it does not "
             "vary",
         .target = &request.assignments,
         .values = OPTION_VALUES_KNOB},
        {.name = "json",
         .kind = OPTION_TEXT,
         .argument = "FILE",
         .summary = "write all results as JSON",
         .target = &request.json},
        {.name = "sweep",
         .kind = OPTION_FLAG,
         .summary = "also measure each filter over the values of its knobs, varied one at a time; "
                    "split times into building and shading, and measure flicker along the "
                    "scene's path; Ctrl-C stops it after writing the scenes that are done",
         .target = &request.sweep},
        {.name = "knobs",
         .kind = OPTION_TEXT,
         .argument = "A,B,C",
         .summary = "with --sweep: knobs to vary, or 'none' (default: all that have values "
                    "worth comparing)",
         .target = &request.knobs},
        {.name = "resume",
         .kind = OPTION_FLAG,
         .summary = "with --sweep: if the JSON file exists, only measure scenes missing from it",
         .target = &request.resume},
        {.name = "pictures",
         .kind = OPTION_TEXT,
         .argument = "DIR",
         .summary = "with --sweep: folder for pictures of the filters at their defaults and of the "
                    "reference (default: the JSON file's name with .pictures instead of .json)",
         .target = &request.pictures},
        {.name = "path-samples",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "with --sweep: samples per pixel of each of the two references along the path",
         .target = &request.path_samples,
         .fallback = "64",
         .minimum = 1,
         .maximum = LOBE_MAXIMUM_SAMPLES,
         .given = &request.has_path_samples},
        {.name = "stations",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "with --sweep: places on the path where two frames 1/30 s apart are compared",
         .target = &request.stations,
         .fallback = "12",
         .minimum = 1,
         .maximum = 1000,
         .given = &request.has_stations},
        scene_option_assets(&request.opening),
        {.name = "environment",
         .kind = OPTION_LIST,
         .argument = "FILE",
         .summary = "environment light instead of the scene's own: an .exr or .hdr file, "
                    "'sky' or 'none'; if given more than once, with --sweep: measure every scene "
                    "in each",
         .target = &request.environments},
        scene_option_rotation(&request.opening),
        scene_option_intensity(&request.opening),
        scene_option_background(&request.opening),
        scene_option_no_lights(&request.opening),
        device_option_select(&request.device),
        device_option_validation(&request.device),
    };
    const option_table table = {
        .program = "lobe bench",
        .operands = "SCENE...",
        .summary =
            "Measures filters in scenes: milliseconds of each pass, of frames in which every map\n"
            "is rebuilt and of frames in which the maps are retained; CPU time of the host to\n"
            "compile and record a frame; what a frame costs after the texels of all maps really\n"
            "changed, with their upload, all CPU time of the call, and what a filter computes on\n"
            "the host; memory; and the error against a reference with many\n"
            "samples, once of the scene as it is, and once with its base lobes converted to von\n"
            "Mises-Fisher lobes, which leaves only the error of filtering.\n"
            "Frames of the filters alternate. If the filter reference is itself measured, it\n"
            "takes 64 samples per pixel. Scenes whose assets are missing are left out.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .minimum_operands = 1,
        .maximum_operands = 64,
        .operand_values = OPTION_VALUES_SCENE,
    };
    int status;
    if (options_parse(&table, argc, argv, &request.scenes, &status))
        status = run_request(&table, &request);
    options_free(&table, &request.scenes);
    return status;
}

const subcommand bench_subcommand = {"bench", "measure times, memory and errors of filters", run};
