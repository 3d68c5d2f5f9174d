#include "tools/sweep/sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void describe_settings(const sweep_row *row, char *text, size_t size) {
    const char *value = sweep_row_value(row, row->varied);
    snprintf(text, size, "%s%s%s", value ? row->varied : "", value ? "=" : "", value ? value : "");
}

static bool is_of(const sweep_row *row, const sweep_scene *scene) {
    return strcmp(row->scene, scene->name) == 0;
}

/// A number, or "-" if it was not measured.
static const char *known(double value, const char *format, char text[16]) {
    snprintf(text, 16, format, value);
    return isnan(value) ? "-" : text;
}

/// How many samples a row is worth; at least that many if it is better than all that were measured.
static const char *describe_worth(const sweep_scene *scene, const sweep_row *row, char text[16]) {
    const double worth = sweep_worth_in_samples(scene, row);
    const size_t last = scene->supersampling_count;
    const bool most = last > 0 && worth >= scene->supersampling[last - 1].samples;
    return known(worth, most ? ">=%.0f" : "%.1f", text);
}

static void print_row(const sweep_results *results, const sweep_scene *scene,
                      const sweep_row *row) {
    char settings[72], wall[16], cpu[16], inside[16], edges[16], flicker[16], worth[16], gain[16];
    describe_settings(row, settings, sizeof settings);
    printf("  %-10s %-20s %10.2f %10.2f %10.2f %10s %10s "
           "%8.1f %8.1f %9.4f %9s %11s %9.4f %9.4f %9.3f %9s %8s %8s\n",
           row->filter, settings, row->building_ms, row->shading_ms, row->retained_ms,
           known(row->changed_wall_ms, "%.2f", wall),
           known(row->changed_caller_cpu_ms, "%.2f", cpu), (double)row->memory_bytes / (1 << 20),
           row->bytes_per_texel, sweep_error_without_noise(scene, row),
           known(row->inside_relative_l2, "%.4f", inside),
           known(row->silhouettes_relative_l2, "%.4f", edges), row->error.relative_l1,
           row->error.flip, row->error.mean_ratio,
           known(row->flicker >= 0 ? row->flicker : (double)NAN, "%.4f", flicker),
           describe_worth(scene, row, worth),
           known(sweep_gain_in_time(results, scene, row), "%.2f", gain));
}

/// The noise of the reference, if it is more than a tenth of the smallest error shown.
static void warn_of_noise(const sweep_results *results, const sweep_scene *scene) {
    double smallest = INFINITY;
    for (size_t i = 0; i < results->row_count; i++)
        if (is_of(&results->rows[i], scene))
            smallest = fmin(smallest, sweep_error_without_noise(scene, &results->rows[i]));
    if (scene->noise > 0.1 * smallest)
        printf("  The reference's noise, %.4f (taken out of rel. L2), is more than a tenth of the "
               "smallest error.\n",
               scene->noise);
}

static double gigabytes_a_second(double bytes, double milliseconds) {
    return milliseconds > 0 ? bytes / milliseconds * 1e-6 : 0;
}

static void print_passes(const sweep_row *row) {
    for (size_t i = 0; i < row->pass_count; i++) {
        const sweep_pass *pass = &row->passes[i];
        if (pass->building)
            printf("  %-10s %-36s %10.2f %10.2f %10.2f %10.2f\n", row->filter, pass->name,
                   pass->milliseconds, pass->bytes / (1 << 20),
                   gigabytes_a_second(pass->bytes, pass->milliseconds),
                   gigabytes_a_second(pass->bytes, pass->copy_milliseconds));
    }
}

static void print_scene(const sweep_results *results, const sweep_scene *scene) {
    printf("\n%s, %ux%u\n", scene->name, results->size[0], results->size[1]);
    if (scene->skipped) {
        printf("  skipped: %s\n", scene->skipped);
        return;
    }
    printf("  %-10s %-20s %10s %10s %10s %10s %10s %8s %8s %9s %9s %11s %9s %9s %9s %9s %8s %8s\n",
           "filter", "setting", "building", "shading", "retained", "changed,", "caller's", "MiB",
           "bytes a", "rel. L2", "inside", "silhouettes", "rel. L1", "FLIP", "mean", "flicker",
           "worth", "gain in");
    printf("  %-10s %-20s %10s %10s %10s %10s %10s %8s %8s %9s %9s %11s %9s %9s %9s %9s %8s %8s\n",
           "", "", "ms", "ms", "ms", "wall ms", "CPU ms", "", "texel", "", "", "", "", "", "ratio",
           "", "samples", "time");
    for (size_t i = 0; i < results->row_count; i++) {
        if (is_of(&results->rows[i], scene))
            print_row(results, scene, &results->rows[i]);
    }
    warn_of_noise(results, scene);
    printf("  %-47s %10s %10s %10s %10s\n", "passes that build, at the defaults", "ms", "MiB",
           "GB/s", "copy GB/s");
    for (size_t i = 0; i < results->row_count; i++) {
        if (is_of(&results->rows[i], scene) && results->rows[i].varied[0] == '\0')
            print_passes(&results->rows[i]);
    }
}

void sweep_print(const sweep_results *results) {
    const bool software = strcmp(results->device_type, "CPU") == 0;
    printf("lobe %s on %s, %s (%s%s)\n", results->version, results->device, results->driver,
           results->device_type, software ? ": times are those of a software renderer" : "");
    printf(
        "Errors are against %u samples per pixel, flicker against twice %u; the filter reference "
        "takes "
        "%d.\n",
        results->reference_samples, results->path_samples, BENCH_TIMED_SAMPLES);
    for (size_t i = 0; i < results->scene_count; i++)
        print_scene(results, &results->scenes[i]);
}
