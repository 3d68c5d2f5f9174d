#include "tools/sweep.h"

#include <math.h>
#include <stdlib.h>

/// From one frame to the next, as part of the path: 1/30 s of 20 s.
static const double step = 1.0 / (30 * 20);

static size_t pixel_count(const sweep_job *job) {
    return (size_t)job->bench.size[0] * job->bench.size[1];
}

/// Two frames at a station of the path. Both are empty where the sweep is to stop.
static lobe_result render_pair(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, lobe_render_parameters parameters,
                               uint32_t station, lobe_frame pair[2]) {
    lobe_result result = LOBE_OK;
    parameters.discard = false;
    for (int i = 0; i < 2; ++i) {
        lobe_camera camera;
        lobe_scene_path(scene, (station + 0.5) / job->stations + i * step, &camera);
        parameters.camera = &camera;
        pair[i] = (lobe_frame){0};
        if (result == LOBE_OK && !sweep_stopped(job))
            result = lobe_renderer_render(renderer, &parameters, &pair[i]);
    }
    return result;
}

static void free_pair(lobe_frame pair[2]) {
    lobe_frame_free(&pair[0]);
    lobe_frame_free(&pair[1]);
}

// ---------------------------------------------------------------------------------------------
// The reference

/// The second frame becomes the change to it.
static void keep_change(const sweep_job *job, lobe_frame pair[2], uint32_t station,
                        sweep_path *path) {
    const float *before = pair[0].radiance.texels;
    float *after = pair[1].radiance.texels;
    for (size_t i = 0; i < 4 * pixel_count(job); ++i) {
        if (i % 4 != 3)
            path->squares += (double)before[i] * before[i];
        after[i] -= before[i];
    }
    path->changes[station] = pair[1].radiance;
    pair[1].radiance = (lobe_image){0};
}

lobe_result sweep_path_render(const sweep_job *job, const lobe_scene *scene,
                              lobe_renderer *renderer, sweep_path *path) {
    *path = (sweep_path){.changes = calloc(job->stations + 1, sizeof *path->changes)};
    if (!path->changes)
        return lobe_log_fail(job->bench.log, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
    sweep_variant reference = {.filter.settings = job->bench.truth};
    lobe_result result = lobe_filter_find("reference", job->bench.log, &reference.filter.filter);
    lobe_render_parameters parameters = sweep_parameters(job, &reference);
    parameters.samples = job->path_samples;
    for (uint32_t i = 0; result == LOBE_OK && i < job->stations && !sweep_stopped(job); ++i) {
        progress_step(job->bench.progress, "%s: reference along the path, %u of %u", scene->name,
                      i + 1, job->stations);
        progress_weigh(job->bench.progress, 2.0 * job->path_samples);
        lobe_frame pair[2];
        result = render_pair(job, scene, renderer, parameters, i, pair);
        if (result == LOBE_OK && !sweep_stopped(job))
            keep_change(job, pair, i, path);
        free_pair(pair);
    }
    return result;
}

void sweep_path_free(const sweep_job *job, sweep_path *path) {
    for (uint32_t i = 0; path->changes && i < job->stations; ++i)
        lobe_image_free(&path->changes[i]);
    free(path->changes);
    *path = (sweep_path){0};
}

// ---------------------------------------------------------------------------------------------
// A filter

static double excess_squares(const sweep_job *job, const lobe_frame pair[2],
                             const lobe_image *change) {
    const float *before = pair[0].radiance.texels, *after = pair[1].radiance.texels;
    const float *expected = change->texels;
    double sum = 0;
    for (size_t i = 0; i < 4 * pixel_count(job); ++i) {
        double excess = ((double)after[i] - before[i]) - expected[i];
        sum += i % 4 != 3 ? excess * excess : 0;
    }
    return sum;
}

lobe_result sweep_path_flicker(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, const sweep_variant *variant,
                               const sweep_path *path, double *flicker) {
    *flicker = -1;
    if (lobe_filter_supersamples(variant->filter.filter) || job->stations == 0)
        return LOBE_OK;
    lobe_result result = LOBE_OK;
    double squares = 0;
    for (uint32_t i = 0; result == LOBE_OK && i < job->stations && !sweep_stopped(job); ++i) {
        lobe_frame pair[2];
        result = render_pair(job, scene, renderer, sweep_parameters(job, variant), i, pair);
        if (result == LOBE_OK && !sweep_stopped(job))
            squares += excess_squares(job, pair, &path->changes[i]);
        free_pair(pair);
    }
    *flicker = squares == 0 ? 0 : sqrt(squares / path->squares);
    return result;
}
