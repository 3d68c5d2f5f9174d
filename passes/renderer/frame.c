#include "passes/renderer/delivery.h"
#include "passes/renderer/samples/samples.h"

// ---------------------------------------------------------------------------------------------
// The host's passes

static void add_passes(lobe_graph *graph, const lobe_render_host *host, lobe_render_stage stage,
                       shading_targets *targets) {
    lobe_render_resources resources = {
        .width = targets->width,
        .height = targets->height,
        .radiance = targets->radiance,
        .depth = targets->depth,
        .normal_depth = targets->normal_depth,
        .lobes_level = targets->lobes_level,
    };
    if (!host->add_passes)
        return;
    host->add_passes(host->user, graph, stage, &resources);
    targets->radiance = resources.radiance;
    targets->depth = resources.depth;
    targets->normal_depth = resources.normal_depth;
    targets->lobes_level = resources.lobes_level;
}

static bool is_same(lobe_resource a, lobe_resource b) {
    return a.index == b.index && a.version == b.version;
}

/// An image that the host's passes write is kept, not cleared.
static void add_passes_before(lobe_graph *graph, const lobe_render_host *host,
                              shading_targets *targets) {
    const shading_targets declared = *targets;
    add_passes(graph, host, LOBE_RENDER_BEFORE_SHADING, targets);
    targets->keep_radiance |= !is_same(targets->radiance, declared.radiance);
    targets->keep_depth |= !is_same(targets->depth, declared.depth);
}

// ---------------------------------------------------------------------------------------------
// The picture

static void draw(rendering *r, bool aov, const shading_targets *imported,
                 shading_targets *targets) {
    static const shading_sample centre = {.position = {0.5f, 0.5f}, .footprint = 1};
    lobe_graph *graph = r->renderer->graph;
    *targets = passes_shading_targets_declare(graph, r->width, r->height, aov);
    passes_delivery_replace(imported, targets);
    add_passes_before(graph, &r->parameters->host, targets);
    shading_light light = passes_shading_light_prepare(&r->context, &r->environment);
    if (passes_samples_several(&r->context))
        passes_samples(&r->context, &r->renderer->draws, &light, targets);
    else
        passes_shading(&r->context, &r->renderer->draws, &light, &centre, NULL, targets);
    add_passes(graph, &r->parameters->host, LOBE_RENDER_AFTER_SHADING, targets);
}

static void mark_outputs(const rendering *r, const frame_delivery *delivery,
                         const shading_targets *targets) {
    if (delivery->target)
        lobe_graph_output(r->renderer->graph, targets->radiance);
    else
        passes_delivery_mark_output(r, delivery, targets->radiance);
    if (delivery->aov) {
        passes_delivery_mark_output(r, delivery, targets->normal_depth);
        passes_delivery_mark_output(r, delivery, targets->lobes_level);
    }
}

static lobe_result take_images(const rendering *r, const frame_delivery *delivery,
                               const shading_targets *targets, lobe_frame *frame) {
    lobe_result result = LOBE_OK;
    if (!delivery->target)
        result = passes_delivery_take_image(r, targets->radiance, LOBE_FORMAT_RGBA32_FLOAT,
                                            &frame->radiance);
    if (result == LOBE_OK && delivery->aov)
        result = passes_delivery_take_image(r, targets->normal_depth, LOBE_FORMAT_RGBA32_FLOAT,
                                            &frame->normal_depth);
    if (result == LOBE_OK && delivery->aov)
        result = passes_delivery_take_image(r, targets->lobes_level, LOBE_FORMAT_RG32_FLOAT,
                                            &frame->lobes_level);
    return result;
}

lobe_result passes_frame_render(rendering *r, const frame_delivery *delivery, lobe_frame *frame) {
    shading_targets imported, targets;
    lobe_graph *graph = r->renderer->graph;
    lobe_graph_set_frames_in_flight(graph, r->parameters->host.frames_in_flight);
    lobe_graph_begin(graph);
    lobe_result result = passes_delivery_import(r, delivery, &imported);
    if (result != LOBE_OK)
        return result;
    passes_instance_maps_build(r, frame);
    draw(r, delivery->aov, &imported, &targets);
    mark_outputs(r, delivery, &targets);
    result = passes_delivery_run(r, delivery, frame);
    return result == LOBE_OK && delivery->reads_back ? take_images(r, delivery, &targets, frame)
                                                     : result;
}
