#include "tools/bench/bench.h"

#include <stdio.h>
#include <stdlib.h>

#include <cjson/cJSON.h>
#include <lobe/lobe.h>

#include "tools/bench/changed_frame.h"

// ---------------------------------------------------------------------------------------------
// For people

static void print_times(const lobe_profile_times *times, const char *name) {
    printf("    %-36s %12.3f %12.3f\n", name, times->median_milliseconds, times->p95_milliseconds);
}

static void print_passes(const bench_result *result, const lobe_profile_summary *summary) {
    printf("  %s\n", lobe_filter_name(result->filter->filter));
    for (size_t i = 0; i < summary->pass_count; i++)
        print_times(&summary->passes[i], summary->passes[i].name);
    print_times(&summary->host, "(host: to compile and record all)");
}

static void print_changed(const bench_result *result) {
    const lobe_profile_times *device = &result->changed.frame, *cost = result->changed_cost.passes;
    printf("  %-10s %10.2f %10.2f", lobe_filter_name(result->filter->filter),
           device->median_milliseconds, device->p95_milliseconds);
    for (int part = 0; part < CHANGED_COSTS; part++)
        printf(" %10.2f %10.2f", cost[part].median_milliseconds, cost[part].p95_milliseconds);
    printf("\n");
}

/// What a frame costs after all texels changed, and its passes.
static void print_all_changed(const bench_job *job, const bench_result *results) {
    printf("  after all texels changed, with their upload and all that the host computes\n");
    printf("  %-10s %21s %21s %21s %21s\n", "", "device", "wall", "caller's CPU", "process's CPU");
    printf("  %-10s", "filter");
    for (int part = 0; part < 1 + CHANGED_COSTS; part++)
        printf(" %10s %10s", "median ms", "p95 ms");
    printf("\n");
    for (size_t i = 0; i < job->filter_count; i++)
        print_changed(&results[i]);
    printf("  passes after all texels changed %25s %12s\n", "median ms", "p95 ms");
    for (size_t i = 0; i < job->filter_count; i++)
        print_passes(&results[i], &results[i].changed);
}

static void print_summary(const bench_result *result) {
    const lobe_profile_times *rebuilt = &result->rebuilt.frame, *retained = &result->retained.frame;
    printf("  %-10s %10.2f %10.2f %10.2f %10.2f %8.1f %8.1f %9.4f %9.4f %9.4f %9.4f\n",
           lobe_filter_name(result->filter->filter), rebuilt->median_milliseconds,
           rebuilt->p95_milliseconds, retained->median_milliseconds, retained->p95_milliseconds,
           (double)result->memory_bytes / (1 << 20), result->bytes_per_texel,
           result->error.relative_l2, result->error.relative_l1, result->error.flip,
           result->error_lobe_base.relative_l2);
}

static void print_scene(const bench_job *job, const bench_result *results) {
    printf("\n%s, %ux%u\n", results[0].scene, job->size[0], job->size[1]);
    printf("  %-10s %21s %21s %8s %8s %29s %9s\n", "", "maps rebuilt", "maps retained", "",
           "bytes a", "error", "L2, lobes");
    printf("  %-10s %10s %10s %10s %10s %8s %8s %9s %9s %9s %9s\n", "filter", "median ms", "p95 ms",
           "median ms", "p95 ms", "MiB", "texel", "rel. L2", "rel. L1", "FLIP", "as base");
    for (size_t i = 0; i < job->filter_count; i++)
        print_summary(&results[i]);
    printf("  passes with maps rebuilt %28s %12s\n", "median ms", "p95 ms");
    for (size_t i = 0; i < job->filter_count; i++)
        print_passes(&results[i], &results[i].rebuilt);
    print_all_changed(job, results);
}

void bench_print(const bench_job *job, const bench_result *results, size_t count) {
    const lobe_device_information *device = lobe_device_describe(job->device);
    printf("lobe %s on %s, %s (%s%s)\n", lobe_version(), device->name, device->driver,
           lobe_device_type_name(device->type),
           device->type == LOBE_DEVICE_CPU ? ": times are those of a software renderer" : "");
    printf("Errors are against %u samples per pixel; the filter reference takes %u.\n",
           job->samples, BENCH_TIMED_SAMPLES);
    for (size_t i = 0; i < count; i += job->filter_count)
        print_scene(job, &results[i]);
}

// ---------------------------------------------------------------------------------------------
// For programs

/// Six digits exceed the precision of any measurement here.
static void add_number(cJSON *object, const char *name, double value) {
    char digits[32];
    snprintf(digits, sizeof digits, "%.6g", value);
    cJSON_AddNumberToObject(object, name, strtod(digits, NULL));
}

static void add_quantiles(cJSON *object, const char *name, const lobe_profile_times *times) {
    cJSON *quantiles = cJSON_AddObjectToObject(object, name);
    add_number(quantiles, "median", times->median_milliseconds);
    add_number(quantiles, "p95", times->p95_milliseconds);
}

static void add_error(cJSON *object, const char *name, const error_metrics *error) {
    cJSON *errors = cJSON_AddObjectToObject(object, name);
    add_number(errors, "relative_l2", error->relative_l2);
    add_number(errors, "relative_l1", error->relative_l1);
    add_number(errors, "flip", error->flip);
}

static void add_knobs(cJSON *object, const bench_filter *filter) {
    cJSON *knobs = cJSON_AddObjectToObject(object, "knobs");
    for (size_t i = 0; i < lobe_filter_knob_count(filter->filter); i++) {
        const lobe_knob *knob = lobe_filter_knob(filter->filter, i);
        double value = filter->settings.values[i];
        if (knob->kind == LOBE_KNOB_CHOICE)
            cJSON_AddStringToObject(knobs, knob->name, knob->choices[(size_t)value]);
        else
            cJSON_AddNumberToObject(knobs, knob->name, value);
    }
}

static void add_passes(cJSON *object, const char *name, const lobe_profile_summary *summary) {
    cJSON *passes = cJSON_AddArrayToObject(object, name);
    for (size_t i = 0; i < summary->pass_count; i++) {
        cJSON *pass = cJSON_CreateObject();
        cJSON_AddStringToObject(pass, "name", summary->passes[i].name);
        add_number(pass, "median_ms", summary->passes[i].median_milliseconds);
        add_number(pass, "p95_ms", summary->passes[i].p95_milliseconds);
        cJSON_AddItemToArray(passes, pass);
    }
}

static cJSON *describe_result(const bench_job *job, const bench_result *result) {
    const bench_filter *filter = result->filter;
    bool supersamples = lobe_filter_supersamples(filter->filter);
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "scene", result->scene);
    cJSON_AddStringToObject(object, "filter", lobe_filter_name(filter->filter));
    int size[2] = {(int)job->size[0], (int)job->size[1]};
    cJSON_AddItemToObject(object, "size", cJSON_CreateIntArray(size, 2));
    cJSON_AddNumberToObject(object, "samples", supersamples ? BENCH_TIMED_SAMPLES : 1);
    cJSON_AddNumberToObject(object, "frames", bench_frames(job, filter));
    add_knobs(object, filter);
    add_passes(object, "passes", &result->rebuilt);
    add_passes(object, "retained_passes", &result->retained);
    add_passes(object, "changed_passes", &result->changed);
    add_quantiles(object, "rebuilt_ms", &result->rebuilt.frame);
    add_quantiles(object, "retained_ms", &result->retained.frame);
    add_quantiles(object, "rebuilt_host_ms", &result->rebuilt.host);
    add_quantiles(object, "retained_host_ms", &result->retained.host);
    add_quantiles(object, "changed_ms", &result->changed.frame);
    add_quantiles(object, "changed_host_ms", &result->changed.host);
    const lobe_profile_times *cost = result->changed_cost.passes;
    add_quantiles(object, "changed_wall_ms", &cost[CHANGED_WALL]);
    add_quantiles(object, "changed_caller_cpu_ms", &cost[CHANGED_CALLER_CPU]);
    add_quantiles(object, "changed_process_cpu_ms", &cost[CHANGED_PROCESS_CPU]);
    cJSON_AddNumberToObject(object, "memory_bytes", (double)result->memory_bytes);
    add_number(object, "bytes_per_texel", result->bytes_per_texel);
    add_error(object, "error", &result->error);
    add_error(object, "error_lobe_base", &result->error_lobe_base);
    return object;
}

char *bench_describe(const bench_job *job, const bench_result *results, size_t count) {
    const lobe_device_information *information = lobe_device_describe(job->device);
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "lobe", lobe_version());
    cJSON *device = cJSON_AddObjectToObject(root, "device");
    cJSON_AddStringToObject(device, "name", information->name);
    cJSON_AddStringToObject(device, "driver", information->driver);
    cJSON_AddStringToObject(device, "type", lobe_device_type_name(information->type));
    cJSON_AddNumberToObject(root, "reference_samples", job->samples);
    cJSON *array = cJSON_AddArrayToObject(root, "results");
    for (size_t i = 0; i < count; i++)
        cJSON_AddItemToArray(array, describe_result(job, &results[i]));
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}
