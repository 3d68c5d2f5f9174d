#include "passes/renderer/deform.h"
#include "passes/renderer/delivery.h"
#include "passes/renderer/motion/motion.h"
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
        .motion = targets->motion,
    };
    if (!host->add_passes)
        return;
    host->add_passes(host->user, graph, stage, &resources);
    targets->radiance = resources.radiance;
    targets->depth = resources.depth;
    targets->normal_depth = resources.normal_depth;
    targets->lobes_level = resources.lobes_level;
    targets->motion = resources.motion;
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
    targets->keep_motion |= !is_same(targets->motion, declared.motion);
}

// ---------------------------------------------------------------------------------------------
// The picture

/// Where things were: what the host gives, then what the renderer remembers, then where they are.
static motion_start start_of_motion(const rendering *r) {
    const lobe_render_motion *motion = &r->parameters->motion;
    const motion_history *history = &r->renderer->motion;
    motion_start start = {r->context.view.camera, motion->previous_transforms};
    if (motion->previous_camera)
        start.camera = motion->previous_camera;
    else if (history->has_camera)
        start.camera = &history->camera;
    if (!start.transforms)
        start.transforms = (const float(*)[16])history->transforms;
    return start;
}

static shading_targets declare_targets(const rendering *r, const frame_delivery *delivery,
                                       const delivery_target *imported) {
    lobe_graph *graph = r->renderer->graph;
    shading_targets targets =
        passes_shading_targets_declare(graph, r->width, r->height, delivery->aov);
    if (delivery->motion)
        targets.motion = passes_motion_declare(graph, r->width, r->height);
    passes_delivery_replace(imported, &targets);
    add_passes_before(graph, &r->parameters->host, &targets);
    return targets;
}

static void draw(rendering *r, const frame_delivery *delivery, shading_targets *targets) {
    shading_light light = passes_shading_light_prepare(&r->context, &r->environment);
    light.shadows = passes_shadow_maps(&r->context, &r->renderer->draws, NULL);
    if (passes_samples_several(&r->context))
        passes_samples(&r->context, &r->renderer->draws, &light, targets);
    else
        passes_shading(&r->context, &r->renderer->draws, &light, &passes_pixel_centre, NULL,
                       r->surfaces.present ? &r->surfaces : NULL, targets);
    if (delivery->motion) {
        passes_deform_previous(&r->context, &r->renderer->motion.poses);
        passes_displacement_before(r->renderer->displacement, &r->context);
        const motion_start start = start_of_motion(r);
        passes_motion(&r->context, &r->renderer->draws, &start, targets);
    }
    add_passes(r->renderer->graph, &r->parameters->host, LOBE_RENDER_AFTER_SHADING, targets);
}

/// It goes to host memory like the other images, not to an image of the host's.
static bool takes_motion(const frame_delivery *delivery) {
    return delivery->motion && !(delivery->target && delivery->target->motion);
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
    if (takes_motion(delivery))
        passes_delivery_mark_output(r, delivery, targets->motion);
    else if (delivery->motion)
        lobe_graph_output(r->renderer->graph, targets->motion);
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
    if (result == LOBE_OK && takes_motion(delivery))
        result =
            passes_delivery_take_image(r, targets->motion, LOBE_FORMAT_RG32_FLOAT, &frame->motion);
    return result;
}

lobe_result passes_frame_render(rendering *r, const frame_delivery *delivery, lobe_frame *frame) {
    delivery_target imported;
    lobe_graph *graph = r->renderer->graph;
    const lobe_scene *scene = r->context.scene->scene;
    motion_history *history = &r->renderer->motion;
    if (delivery->motion &&
        !passes_motion_history_complete(history, scene, r->context.host->allocator))
        return lobe_host_fail(r->context.host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              scene->name);
    lobe_graph_set_frames_in_flight(graph, r->parameters->host.frames_in_flight);
    lobe_graph_begin(graph);
    lobe_result result = passes_delivery_import(r, delivery, &imported);
    if (result != LOBE_OK)
        return result;
    passes_instances_list(r);
    shading_targets targets = declare_targets(r, delivery, &imported);
    passes_instance_maps_build(r, &targets, frame);
    draw(r, delivery, &targets);
    passes_delivery_place(r, delivery, &imported, &targets);
    mark_outputs(r, delivery, &targets);
    result = passes_delivery_run(r, delivery, frame);
    if (result == LOBE_OK && delivery->motion && !delivery->prepares)
        passes_motion_history_keep(history, scene, r->context.view.camera);
    return result == LOBE_OK && delivery->reads_back ? take_images(r, delivery, &targets, frame)
                                                     : result;
}
