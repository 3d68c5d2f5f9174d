#include "tools/sweep/scene_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double still_work(const sweep_job *job, const sweep_variant *variant) {
    bool pairs = !lobe_filter_supersamples(variant->filter.filter);
    return 1 + scene_run_samples(variant) + (pairs ? 2 * job->stations : 0);
}

/// A pass builds if it runs in a frame that builds maps and not in the next, which retains them.
static lobe_result list_passes(const scene_run *run, const lobe_frame *built,
                               const lobe_frame *retained, sweep_row *row) {
    row->passes = calloc(built->pass_count + 1, sizeof *row->passes);
    if (!row->passes)
        return scene_run_out_of_memory(run);
    row->pass_count = built->pass_count;
    for (size_t i = 0; i < built->pass_count; i++) {
        const lobe_pass_time *time = &built->passes[i];
        sweep_pass *pass = &row->passes[i];
        snprintf(pass->name, sizeof pass->name, "%s", time->name);
        pass->count = time->count;
        pass->milliseconds = time->milliseconds; // replaced by the median later
        pass->building =
            strcmp(time->name, "shading") != 0 && !scene_run_find_pass(retained, time->name);
        // The texels that other passes fetch depend on the picture.
        pass->bytes = pass->building ? (double)(time->read_bytes + time->written_bytes) : 0;
    }
    return LOBE_OK;
}

static lobe_result measure_memory(const scene_run *run, const sweep_variant *variant,
                                  lobe_renderer **renderer, sweep_row *row, lobe_frame *built) {
    const bench_job *bench = &run->job->bench;
    const bool quiet = run->job->brief || variant->varied[0] != '\0';
    lobe_device_memory before, after;
    lobe_device_memory_reset_peak(bench->device);
    lobe_device_memory_query(bench->device, &before);
    lobe_result result = LOBE_OK;
    if (!*renderer)
        result = scene_run_renderer(run, quiet ? &run->errors : bench->host, renderer);
    lobe_render_parameters parameters = sweep_parameters(run->job, variant);
    parameters.rebuild = parameters.environment.keep = true;
    parameters.reference.samples = 1; // memory does not depend on samples
    if (result == LOBE_OK)
        result = lobe_renderer_render(*renderer, &parameters, built);
    lobe_device_memory_query(bench->device, &after);
    row->memory_bytes = after.peak_used_bytes - before.used_bytes;
    if (built->base_texels > 0)
        row->bytes_per_texel = (double)built->filtered_bytes / (double)built->base_texels;
    return result;
}

static lobe_result compare(const scene_run *run, const lobe_image *image, const lobe_image *truth,
                           const sweep_row *row, error_metrics *error) {
    return error_metrics_measure(image, truth,
                                 &(error_metrics_parameters){.test_name = row->filter,
                                                             .reference_name = row->scene,
                                                             .high_dynamic_range = true},
                                 run->job->bench.host, error, NULL);
}

static lobe_result measure_error(const scene_run *run, const sweep_variant *variant,
                                 const lobe_frame *still, sweep_row *row) {
    lobe_result result = compare(run, &still->radiance, &run->truth.image, row, &row->error);
    if (result != LOBE_OK || run->job->brief)
        return result;
    result = compare(run, &still->radiance, &run->truth.lobe_base, row, &row->error_lobe_base);
    if (result == LOBE_OK)
        result = sweep_parts_measure(run->job, &still->radiance, &run->truth, row);
    if (result == LOBE_OK && row->varied[0] == '\0')
        result = sweep_pictures_write(run->job, row->scene, variant, scene_run_samples(variant),
                                      row->filter, still, &row->picture);
    return result;
}

lobe_result still_measure(const scene_run *run, const sweep_variant *variant,
                          lobe_renderer **renderer, sweep_row *row) {
    lobe_frame built = {0}, still = {0};
    lobe_render_parameters parameters = sweep_parameters(run->job, variant);
    parameters.discard = false;
    lobe_result result = measure_memory(run, variant, renderer, row, &built);
    if (result == LOBE_OK)
        result = lobe_renderer_render(*renderer, &parameters, &still);
    if (result == LOBE_OK && !sweep_stopped(run->job))
        result = measure_error(run, variant, &still, row);
    if (result == LOBE_OK)
        result = list_passes(run, &built, &still, row);
    if (result == LOBE_OK)
        result =
            sweep_path_flicker(run->job, run->scene, *renderer, variant, &run->path, &row->flicker);
    lobe_frame_free(&still);
    lobe_frame_free(&built);
    return result;
}
