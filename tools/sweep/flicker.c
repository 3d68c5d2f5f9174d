#include "tools/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>

/// Between two frames, and for the whole path.
static const double step_seconds = 1.0 / 30, path_seconds = 20;

static size_t pixel_count(const sweep_job *job) {
    return (size_t)job->bench.size[0] * job->bench.size[1];
}

/// Two frames at a station of the path. Both are empty if the sweep should stop.
static lobe_result render_pair(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, lobe_render_parameters parameters,
                               uint32_t station, lobe_frame pair[2]) {
    lobe_result result = LOBE_OK;
    parameters.discard = false;
    for (int i = 0; i < 2; i++) {
        lobe_camera camera;
        const double seconds = (station + 0.5) / job->stations * path_seconds + i * step_seconds;
        if (result == LOBE_OK)
            result = animation_set_time(job->bench.animation, seconds);
        lobe_scene_path(scene, seconds / path_seconds, &camera);
        parameters.camera = &camera;
        pair[i] = (lobe_frame){0};
        if (result == LOBE_OK && !sweep_stopped(job))
            result = lobe_renderer_render(renderer, &parameters, &pair[i]);
    }
    const lobe_result back = animation_set_time(job->bench.animation, 0);
    return result == LOBE_OK ? back : result;
}

static void free_pair(lobe_frame pair[2]) {
    lobe_frame_free(&pair[0]);
    lobe_frame_free(&pair[1]);
}

// ---------------------------------------------------------------------------------------------
// The references

/// The second frames are replaced by their difference from the first.
static void keep_changes(const sweep_job *job, lobe_frame pairs[2][2], uint32_t station,
                         sweep_path *path) {
    const float *before[2] = {pairs[0][0].radiance.texels, pairs[1][0].radiance.texels};
    for (size_t i = 0; i < 4 * pixel_count(job); i++)
        path->squares += i % 4 != 3 ? (double)before[0][i] * before[1][i] : 0;
    for (int k = 0; k < 2; k++) {
        float *after = pairs[k][1].radiance.texels;
        for (size_t i = 0; i < 4 * pixel_count(job); i++)
            after[i] -= before[k][i];
        path->changes[k][station] = pairs[k][1].radiance;
        pairs[k][1].radiance = (lobe_image){0};
    }
}

static lobe_result render_station(const sweep_job *job, const lobe_scene *scene,
                                  lobe_renderer *renderer, lobe_render_parameters parameters,
                                  uint32_t station, sweep_path *path) {
    lobe_frame pairs[2][2] = {0};
    lobe_result result = LOBE_OK;
    for (uint32_t k = 0; result == LOBE_OK && k < 2; k++) {
        parameters.reference.pattern = k;
        result = render_pair(job, scene, renderer, parameters, station, pairs[k]);
    }
    if (result == LOBE_OK && !sweep_stopped(job))
        keep_changes(job, pairs, station, path);
    free_pair(pairs[0]);
    free_pair(pairs[1]);
    return result;
}

lobe_result sweep_path_render(const sweep_job *job, const lobe_scene *scene,
                              lobe_renderer *renderer, sweep_path *path) {
    *path = (sweep_path){0};
    for (int k = 0; k < 2; k++) {
        path->changes[k] = calloc(job->stations + 1, sizeof *path->changes[k]);
        if (!path->changes[k])
            return lobe_host_fail(job->bench.host, LOBE_ERROR_OUT_OF_MEMORY,
                                  "sweep: out of memory");
    }
    sweep_variant reference = {.filter.settings = job->bench.truth};
    lobe_result result = lobe_filter_find("reference", job->bench.host, &reference.filter.filter);
    lobe_render_parameters parameters = sweep_parameters(job, &reference);
    parameters.reference.samples = job->path_samples;
    for (uint32_t i = 0; result == LOBE_OK && i < job->stations && !sweep_stopped(job); i++) {
        progress_step(job->bench.progress, "%s: references along the path, %u of %u", scene->name,
                      i + 1, job->stations);
        progress_weigh(job->bench.progress, 4.0 * job->path_samples);
        result = render_station(job, scene, renderer, parameters, i, path);
    }
    return result;
}

void sweep_path_free(const sweep_job *job, sweep_path *path) {
    for (int k = 0; k < 2; k++) {
        for (uint32_t i = 0; path->changes[k] && i < job->stations; i++)
            lobe_image_free(&path->changes[k][i]);
        free(path->changes[k]);
    }
    *path = (sweep_path){0};
}

// ---------------------------------------------------------------------------------------------
// A filter

static double excess_products(const sweep_job *job, const lobe_frame pair[2],
                              const sweep_path *path, uint32_t station) {
    const float *before = pair[0].radiance.texels, *after = pair[1].radiance.texels;
    const float *first = path->changes[0][station].texels;
    const float *second = path->changes[1][station].texels;
    double sum = 0;
    for (size_t i = 0; i < 4 * pixel_count(job); i++) {
        double change = (double)after[i] - before[i];
        sum += i % 4 != 3 ? (change - first[i]) * (change - second[i]) : 0;
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
    for (uint32_t i = 0; result == LOBE_OK && i < job->stations && !sweep_stopped(job); i++) {
        lobe_frame pair[2];
        result = render_pair(job, scene, renderer, sweep_parameters(job, variant), i, pair);
        if (result == LOBE_OK && !sweep_stopped(job))
            squares += excess_products(job, pair, path, i);
        free_pair(pair);
    }
    *flicker = squares <= 0 ? 0 : sqrt(squares / path->squares);
    return result;
}
