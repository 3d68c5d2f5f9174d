#include "tools/sweep/results.h"

#include <math.h>
#include <string.h>

#include "tools/bench/bench.h"

const sweep_scene *sweep_results_scene(const sweep_results *results, const char *name) {
    for (size_t i = 0; i < results->scene_count; i++) {
        if (strcmp(results->scenes[i].name, name) == 0)
            return &results->scenes[i];
    }
    return NULL;
}

/// A missing text equals an empty one.
static bool same_text(const char *a, const char *b) {
    return strcmp(a ? a : "", b ? b : "") == 0;
}

bool sweep_scene_is(const sweep_scene *entry, const char *scene, const char *environment,
                    const char *lighting) {
    return strcmp(entry->scene ? entry->scene : entry->name, scene) == 0 &&
           same_text(entry->environment, environment) && same_text(entry->lighting, lighting);
}

/// The reference is the mean of two independent ones. Products of a picture's distances from both
/// estimate its squared error; what exceeds that in the squared distance from the mean is noise
/// (see noise_of in truth.c).
double sweep_without_noise(double error, double noise) {
    if (isnan(noise) || isnan(error))
        return error;
    return error > noise ? sqrt(error * error - noise * noise) : 0;
}

double sweep_error_without_noise(const sweep_scene *scene, const sweep_row *row) {
    return sweep_without_noise(row->error.relative_l2, scene->noise);
}

/// The number of samples at which supersampling has an error, between two measured.
static double interpolate(const sweep_supersampling *a, const sweep_supersampling *b,
                          double error) {
    const double part = log(a->relative_l2 / error) / log(a->relative_l2 / b->relative_l2);
    return a->samples * pow((double)b->samples / a->samples, part);
}

double sweep_worth_in_samples(const sweep_scene *scene, const sweep_row *row) {
    const sweep_supersampling *steps = scene->supersampling;
    const size_t count = scene->supersampling_count;
    const double error = sweep_error_without_noise(scene, row);
    if (count == 0 || isnan(error))
        return (double)NAN;
    if (error >= steps[0].relative_l2)
        return steps[0].samples * pow(steps[0].relative_l2 / error, 2);
    for (size_t i = 1; i < count; i++)
        if (error >= steps[i].relative_l2)
            return interpolate(&steps[i - 1], &steps[i], error);
    return steps[count - 1].samples;
}

static const sweep_row *reference_row(const sweep_results *results, const sweep_scene *scene) {
    for (size_t i = 0; i < results->row_count; i++)
        if (strcmp(results->rows[i].scene, scene->name) == 0 &&
            strcmp(results->rows[i].filter, "reference") == 0)
            return &results->rows[i];
    return NULL;
}

double sweep_gain_in_time(const sweep_results *results, const sweep_scene *scene,
                          const sweep_row *row) {
    const sweep_row *reference = reference_row(results, scene);
    if (!reference || !(row->retained_ms > 0))
        return (double)NAN;
    const double sample_ms = reference->retained_ms / BENCH_TIMED_SAMPLES;
    return sweep_worth_in_samples(scene, row) * sample_ms / row->retained_ms;
}

const char *sweep_row_value(const sweep_row *row, const char *knob) {
    for (size_t i = 0; i < row->setting_count; i++) {
        if (strcmp(row->settings[i].name, knob) == 0)
            return row->settings[i].value;
    }
    return NULL;
}

static bool is_of(const sweep_row *row, const char *scene, const char *filter) {
    return strcmp(row->scene, scene) == 0 && strcmp(row->filter, filter) == 0;
}

static bool has_setting(const sweep_row *row, const sweep_setting *setting) {
    const char *value = sweep_row_value(row, setting->name);
    return value && strcmp(value, setting->value) == 0;
}

static bool has_settings(const sweep_row *row, const sweep_setting *settings, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!has_setting(row, &settings[i]))
            return false;
    }
    return row->setting_count == count;
}

const sweep_row *sweep_results_row(const sweep_results *results, const char *scene,
                                   const char *filter, const sweep_setting *settings,
                                   size_t setting_count) {
    for (size_t i = 0; i < results->row_count; i++) {
        const sweep_row *row = &results->rows[i];
        if (is_of(row, scene, filter) && has_settings(row, settings, setting_count))
            return row;
    }
    return NULL;
}
