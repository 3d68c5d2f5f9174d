#include "tools/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>

// ---------------------------------------------------------------------------------------------
// References

/// A reference consists of one or two parts with independent samples.
typedef struct truth_parts {
    const sweep_variant *reference;
    const char *scene, *kind; ///< for people
    uint32_t samples[2];
    bool depth; ///< the first part also delivers depth
} truth_parts;

/// Pictures of the filter reference, pattern 0, are compared with those of two parts, which use
/// patterns of their own: their errors are then independent.
static uint32_t pattern_of(const truth_parts *parts, uint32_t part) {
    return parts->samples[1] > 0 ? part + 1 : 0;
}

static lobe_result render_part(const sweep_job *job, lobe_renderer *renderer,
                               const truth_parts *parts, uint32_t part, lobe_frame *frame) {
    const bench_job *bench = &job->bench;
    const uint32_t samples = parts->samples[part];
    *frame = (lobe_frame){0};
    if (samples == 0 || sweep_stopped(job))
        return LOBE_OK;
    progress_step(bench->progress, "%s: %s, samples per pixel: %u", parts->scene, parts->kind,
                  samples);
    progress_weigh(bench->progress, samples);
    lobe_render_parameters parameters = sweep_parameters(job, parts->reference);
    parameters.reference.samples = samples;
    parameters.reference.pattern = pattern_of(parts, part);
    parameters.discard = false;
    parameters.aov = parts->depth && part == 0;
    parameters.host.progress = sweep_show_progress;
    return lobe_renderer_render(renderer, &parameters, frame);
}

/// What the second part counts in the mean of all samples.
static double weight_of_second(const uint32_t samples[2]) {
    return samples[1] / ((double)samples[0] + samples[1]);
}

/// The noise that remains in the mean of all samples, as relative L2 over these pixels (NULL: all):
/// with n and m samples, the squared distance of the parts is on average 1/n + 1/m times a sample's
/// variance, and that of the mean is 1/(n + m) times the variance.
static double noise_of(const lobe_image *first, const lobe_image *second, const uint32_t samples[2],
                       const bool *pixels) {
    const double weight = weight_of_second(samples);
    const float *a = first->texels, *b = second->texels;
    double distances = 0, squares = 0;
    for (size_t i = 0; i < 4 * (size_t)first->width * first->height; i++) {
        if (i % 4 == 3 || (pixels && !pixels[i / 4]))
            continue;
        const double difference = (double)b[i] - a[i], mean = a[i] + weight * difference;
        distances += difference * difference;
        squares += mean * mean;
    }
    return sqrt(weight * (1 - weight) * distances / squares);
}

/// `first` becomes the mean of all samples.
static void merge_parts(lobe_image *first, const lobe_image *second, const uint32_t samples[2]) {
    const double weight = weight_of_second(samples);
    const float *other = second->texels;
    float *texels = first->texels;
    for (size_t i = 0; i < 4 * (size_t)first->width * first->height; i++)
        texels[i] += (float)(weight * ((double)other[i] - texels[i]));
}

/// `truth` gets the noise, and what `parts->depth` shows.
static lobe_result render_parts(const sweep_job *job, lobe_renderer *renderer,
                                const truth_parts *parts, lobe_frame *frame, sweep_truth *truth) {
    for (int part = 0; part < COMPARE_PART_COUNT; part++)
        truth->noise[part] = (double)NAN;
    lobe_frame second = {0};
    lobe_result result = render_part(job, renderer, parts, 0, frame);
    if (result == LOBE_OK)
        result = render_part(job, renderer, parts, 1, &second);
    if (result == LOBE_OK && frame->normal_depth.texels)
        result = sweep_parts_find(job, &frame->normal_depth, truth);
    lobe_image_free(&frame->normal_depth); // the picture holds radiance alone
    lobe_image_free(&frame->lobes_level);
    if (result == LOBE_OK && second.radiance.texels) {
        for (int part = 0; part < COMPARE_PART_COUNT; part++)
            truth->noise[part] =
                noise_of(&frame->radiance, &second.radiance, parts->samples, truth->pixels[part]);
        merge_parts(&frame->radiance, &second.radiance, parts->samples);
    }
    lobe_frame_free(&second);
    return result;
}

/// Whether the reference has two parts, which show how much of it is noise. Brief sweeps do without
/// unless each sample sees an environment in a random direction.
static bool has_parts(const sweep_job *job, const lobe_scene *scene) {
    return (!job->brief || scene->environment) && job->bench.samples > 1;
}

static lobe_result find_reference(const sweep_job *job, const lobe_settings *settings,
                                  sweep_variant *reference) {
    *reference = (sweep_variant){.filter.settings = *settings, .varied = ""};
    return lobe_filter_find("reference", job->bench.host, &reference->filter.filter);
}

/// `entry` gets noise and picture; NULL: neither is needed. `truth` gets all but the image.
static lobe_result render_reference(const sweep_job *job, const lobe_scene *scene,
                                    lobe_renderer *renderer, const lobe_settings *settings,
                                    truth_parts parts, sweep_scene *entry, sweep_truth *truth,
                                    lobe_image *image) {
    const uint32_t samples = job->bench.samples;
    sweep_variant reference;
    lobe_result result = find_reference(job, settings, &reference);
    if (result != LOBE_OK)
        return result;
    parts.reference = &reference;
    parts.samples[1] = has_parts(job, scene) ? samples / 2 : 0;
    parts.samples[0] = samples - parts.samples[1];
    lobe_frame frame = {0};
    result = render_parts(job, renderer, &parts, &frame, truth);
    if (entry)
        entry->noise = truth->noise[COMPARE_PART_ALL];
    if (result == LOBE_OK && entry && !job->brief && !sweep_stopped(job))
        result = sweep_pictures_write(job, entry->name, &reference, samples, "", &frame,
                                      &entry->reference);
    *image = frame.radiance;
    frame.radiance = (lobe_image){0};
    lobe_frame_free(&frame);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Supersampling

/// 1, 2, 4, ... samples per pixel, up to as many as the reference has.
static uint32_t supersampling_steps(const sweep_job *job) {
    uint32_t count = 0;
    while (job->bench.samples >> count)
        count++;
    return count;
}

static double error_of(const lobe_image *image, const lobe_image *truth, double noise) {
    const float *a = image->texels, *b = truth->texels;
    double distances = 0, squares = 0;
    for (size_t i = 0; i < 4 * (size_t)truth->width * truth->height; i++) {
        const double difference = (double)a[i] - b[i];
        distances += i % 4 != 3 ? difference * difference : 0;
        squares += i % 4 != 3 ? (double)b[i] * b[i] : 0;
    }
    const double excess = distances / squares - noise * noise;
    return excess > 0 ? sqrt(excess) : 0;
}

static lobe_result add_step(const sweep_job *job, lobe_renderer *renderer, uint32_t samples,
                            const sweep_truth *truth, sweep_scene *entry) {
    sweep_variant reference;
    lobe_result result = find_reference(job, &job->bench.truth, &reference);
    const truth_parts parts = {&reference, entry->name, "supersampling", {samples, 0}, false};
    lobe_frame frame = {0};
    if (result == LOBE_OK)
        result = render_part(job, renderer, &parts, 0, &frame);
    if (result == LOBE_OK && frame.radiance.texels)
        entry->supersampling[entry->supersampling_count++] =
            (sweep_supersampling){samples, error_of(&frame.radiance, &truth->image, entry->noise)};
    lobe_frame_free(&frame);
    return result;
}

static lobe_result measure_supersampling(const sweep_job *job, lobe_renderer *renderer,
                                         const sweep_truth *truth, sweep_scene *entry) {
    const uint32_t count = supersampling_steps(job);
    entry->supersampling = calloc(count, sizeof *entry->supersampling);
    if (!entry->supersampling)
        return lobe_host_fail(job->bench.host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              entry->name);
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < count && !sweep_stopped(job); i++)
        result = add_step(job, renderer, 1u << i, truth, entry);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Interface

double sweep_truth_work(const sweep_job *job) {
    const double samples = job->bench.samples;
    return job->brief ? samples : 2 * samples + (1u << supersampling_steps(job)) - 1;
}

lobe_result sweep_truth_render(const sweep_job *job, const lobe_scene *scene,
                               lobe_renderer *renderer, sweep_scene *entry, sweep_truth *truth) {
    const truth_parts parts = {.scene = entry->name, .kind = "reference", .depth = !job->brief};
    const truth_parts converted = {.scene = entry->name,
                                   .kind = "reference with base lobes converted"};
    lobe_result result = render_reference(job, scene, renderer, &job->bench.truth, parts, entry,
                                          truth, &truth->image);
    if (result != LOBE_OK || job->brief)
        return result;
    sweep_truth unused = {0};
    result = render_reference(job, scene, renderer, &job->bench.truth_lobe_base, converted, NULL,
                              &unused, &truth->lobe_base);
    if (result == LOBE_OK && !isnan(entry->noise))
        result = measure_supersampling(job, renderer, truth, entry);
    return result;
}

void sweep_truth_free(sweep_truth *truth) {
    lobe_image_free(&truth->image);
    lobe_image_free(&truth->lobe_base);
    sweep_parts_free(truth);
}
