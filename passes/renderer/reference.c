#include "passes/context/sample_pattern.h"
#include "passes/renderer/accumulation.h"
#include "passes/renderer/delivery.h"
#include "passes/renderer/picture_drawing.h"

/// Few enough that one submission stays short on a slow device.
#define SAMPLES_PER_SUBMISSION 8

/// The sum of the samples so far.
typedef struct sample_sum {
    uint32_t samples, pattern; ///< as in lobe_render_reference
    bool without_background;   ///< the picture will be blended over what the host drew
    double *texels;            ///< RGBA; NULL: the samples are discarded
} sample_sum;

// ---------------------------------------------------------------------------------------------
// Samples

static lobe_resource declare_sum(const rendering *r) {
    lobe_graph *graph = r->renderer->graph;
    lobe_resource sum =
        lobe_graph_image(graph, &(lobe_image_description){.name = "sum of samples",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = r->width,
                                                          .height = r->height});
    lobe_pass *clear = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "clear");
    return lobe_pass_fill(clear, sum, (lobe_range){0}, (float[4]){0});
}

/// Adds the passes that add up samples [first, first + count) of every pixel.
static lobe_resource declare_samples(rendering *r, const sample_sum *sum, uint32_t first,
                                     uint32_t count) {
    lobe_graph *graph = r->renderer->graph;
    shading_targets targets = passes_shading_targets_declare(graph, r->width, r->height, false);
    targets.without_background = sum->without_background;
    shading_light light = passes_shading_light_prepare(&r->context, &r->environment);
    lobe_resource resource = declare_sum(r);
    for (uint32_t i = 0; i < count; i++) {
        shading_sample sample = {.footprint = 1, .number = first + i, .pattern = sum->pattern};
        passes_sample_position(sample.number, sum->samples, sample.position);
        passes_sample_position_in_pattern(sum->pattern, sample.position);
        light.shadows = passes_shadow_maps(&r->context, &r->renderer->draws, &sample);
        passes_shading(&r->context, &r->renderer->draws, &light, &sample, NULL, NULL, &targets);
        resource = passes_accumulation(graph, targets.radiance, resource, r->width, r->height);
    }
    return resource;
}

/// Adds samples [first, first + count) of every pixel to the sum.
static lobe_result render_samples(rendering *r, const frame_delivery *delivery, sample_sum *sum,
                                  uint32_t first, uint32_t count, lobe_frame *frame) {
    lobe_graph *graph = r->renderer->graph;
    lobe_graph_begin(graph);
    passes_instances_list(r);
    passes_instance_maps_build(r, NULL, frame);
    lobe_resource resource = declare_samples(r, sum, first, count);
    passes_delivery_mark_output(r, delivery, resource);
    lobe_result result = passes_delivery_run(r, delivery, frame);
    if (result != LOBE_OK || !sum->texels)
        return result;
    // Sums of few samples in float32, the sum of those in double: no bias at any count.
    const float *data = lobe_graph_data(graph, resource, NULL);
    for (size_t i = 0; data && i < (size_t)r->width * r->height * 4; i++)
        sum->texels[i] += data[i];
    return LOBE_OK;
}

static bool report_progress(const rendering *r, double part) {
    const lobe_render_host *host = &r->parameters->host;
    return !host->progress || host->progress(host->user, part);
}

/// Takes all samples, unless the host stops: `*stopped`.
static lobe_result render_all_samples(rendering *r, const frame_delivery *delivery, sample_sum *sum,
                                      lobe_frame *frame, bool *stopped) {
    lobe_result result = LOBE_OK;
    *stopped = false;
    for (uint32_t done = 0; result == LOBE_OK && !*stopped && done < sum->samples;) {
        uint32_t left = sum->samples - done;
        uint32_t count = left < SAMPLES_PER_SUBMISSION ? left : SAMPLES_PER_SUBMISSION;
        result = render_samples(r, delivery, sum, done, count, frame);
        done += count;
        *stopped = result == LOBE_OK && !report_progress(r, (double)done / sum->samples);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// The mean in host memory

static lobe_result take_mean(const rendering *r, const sample_sum *sum, lobe_frame *frame) {
    lobe_result result = lobe_image_allocate(&frame->radiance, LOBE_FORMAT_RGBA32_FLOAT, r->width,
                                             r->height, r->context.host);
    float *texels = frame->radiance.texels;
    for (size_t i = 0; result == LOBE_OK && i < (size_t)r->width * r->height * 4; i++)
        texels[i] = (float)(sum->texels[i] / sum->samples);
    return result;
}

/// Takes the samples, and their mean if the delivery reads back; the frame is empty if the host
/// stops.
static lobe_result render_mean(rendering *r, const frame_delivery *delivery,
                               bool without_background, lobe_frame *frame) {
    const lobe_render_reference *reference = &r->parameters->reference;
    sample_sum sum = {.samples = reference->samples ? reference->samples : 64,
                      .pattern = reference->pattern,
                      .without_background = without_background};
    lobe_result result = LOBE_OK;
    bool stopped = false;
    if (delivery->reads_back) {
        sum.texels = lobe_allocate(r->context.host->allocator, (size_t)r->width * r->height,
                                   4 * sizeof *sum.texels);
        if (!sum.texels)
            return lobe_host_fail(r->context.host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                                  r->context.scene->scene->name);
    }
    if (delivery->aov || delivery->motion) {
        result = passes_frame_render(r, delivery, frame);
        lobe_image_free(&frame->radiance);
    }
    if (result == LOBE_OK)
        result = render_all_samples(r, delivery, &sum, frame, &stopped);
    if (result == LOBE_OK && stopped)
        lobe_frame_free(frame);
    else if (result == LOBE_OK && sum.texels)
        result = take_mean(r, &sum, frame);
    lobe_release(sum.texels);
    return result;
}

// ---------------------------------------------------------------------------------------------
// The mean in the host's image

/// Adds the passes that draw the mean, RGBA of each pixel, into the target.
static void declare_mean(const rendering *r, const frame_delivery *delivery,
                         const delivery_target *imported, const float *texels) {
    lobe_graph *graph = r->renderer->graph;
    shading_targets targets = {.width = r->width, .height = r->height};
    passes_delivery_replace(imported, &targets);
    passes_picture_drawing(graph, texels, &targets);
    passes_delivery_place(r, delivery, imported, &targets);
    lobe_graph_output(graph, targets.radiance);
}

/// Takes over the target's extent, and reports errors in it, before any sample is taken.
static lobe_result measure_target(rendering *r, const frame_delivery *delivery) {
    lobe_graph *graph = r->renderer->graph;
    delivery_target imported;
    lobe_image black;
    lobe_graph_begin(graph);
    lobe_result result = passes_delivery_import(r, delivery, &imported);
    // An error in the image itself stays in the graph, until it is compiled.
    if (result != LOBE_OK || imported.drawn.width == 0)
        return result ? result : lobe_graph_compile(graph);
    result =
        lobe_image_allocate(&black, LOBE_FORMAT_RGBA32_FLOAT, r->width, r->height, r->context.host);
    if (result != LOBE_OK)
        return result;
    declare_mean(r, delivery, &imported, black.texels);
    lobe_image_free(&black);
    return lobe_graph_prepare(graph, NULL, NULL);
}

/// Draws the mean into the target instead of delivering it.
static lobe_result draw_mean(rendering *r, const frame_delivery *delivery, lobe_frame *frame) {
    lobe_graph *graph = r->renderer->graph;
    delivery_target imported;
    lobe_graph_set_frames_in_flight(graph, r->parameters->host.frames_in_flight);
    lobe_graph_begin(graph);
    lobe_result result = passes_delivery_import(r, delivery, &imported);
    if (result != LOBE_OK)
        return result;
    // Redeclare the samples' retained resources; the graph frees any it does not see.
    passes_instances_list(r);
    passes_instance_maps_build(r, NULL, frame);
    (void)passes_shading_light_prepare(&r->context, &r->environment);
    declare_mean(r, delivery, &imported, frame->radiance.texels);
    lobe_image_free(&frame->radiance);
    return passes_delivery_run(r, delivery, frame);
}

/// Makes the pipelines of one sample, of what is drawn beside the samples, and of the mean in the
/// host's image.
static lobe_result prepare(rendering *r, const frame_delivery *delivery, lobe_frame *frame) {
    sample_sum one = {.samples = 1,
                      .without_background = delivery->target && delivery->target->keep};
    const frame_delivery beside = {
        .aov = delivery->aov, .motion = delivery->motion, .prepares = true};
    lobe_result result = delivery->target ? measure_target(r, delivery) : LOBE_OK;
    if (result == LOBE_OK && (beside.aov || beside.motion))
        result = passes_frame_render(r, &beside, frame);
    if (result == LOBE_OK)
        result = render_samples(r, &beside, &one, 0, 1, frame);
    if (result != LOBE_OK || !delivery->target)
        return result;
    result = lobe_image_allocate(&frame->radiance, LOBE_FORMAT_RGBA32_FLOAT, r->width, r->height,
                                 r->context.host);
    return result ? result : draw_mean(r, delivery, frame);
}

lobe_result passes_reference_render(rendering *r, const frame_delivery *delivery,
                                    lobe_frame *frame) {
    if (delivery->prepares)
        return prepare(r, delivery, frame);
    if (!delivery->target)
        return render_mean(r, delivery, false, frame);
    // The samples are read back as for a picture in host memory; the host's submission draws their
    // mean.
    const frame_delivery samples = {.reads_back = !r->parameters->discard,
                                    .aov = delivery->aov && !delivery->submission,
                                    .motion = delivery->motion && !delivery->submission};
    lobe_result result = measure_target(r, delivery);
    if (result == LOBE_OK)
        result = render_mean(r, &samples, delivery->target->keep, frame);
    // There is no mean if it is discarded or the host stopped.
    return result == LOBE_OK && frame->radiance.texels ? draw_mean(r, delivery, frame) : result;
}
