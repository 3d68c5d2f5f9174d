#include "passes/renderer/host_frame.h"

bool passes_host_frame_delivers(const lobe_render_parameters *parameters) {
    return !parameters->discard && !parameters->host.submission;
}

// ---------------------------------------------------------------------------------------------
// Images

static lobe_result check_extent(const lobe_render_parameters *parameters, const lobe_host *host,
                                const shading_targets *imported) {
    uint32_t width = parameters->width ? parameters->width : imported->width;
    uint32_t height = parameters->height ? parameters->height : imported->height;
    if (width == imported->width && height == imported->height)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                          "render: %ux%u pixels for a target of %ux%u", width, height,
                          imported->width, imported->height);
}

lobe_result passes_host_frame_import(lobe_graph *graph, const lobe_render_parameters *parameters,
                                     const lobe_host *host, shading_targets *imported) {
    const lobe_render_target *target = parameters->host.target;
    *imported = (shading_targets){0};
    if (!target)
        return LOBE_OK;
    if (!target->radiance)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: a target without radiance");
    imported->radiance = lobe_graph_import_image(graph, target->radiance);
    if (target->depth)
        imported->depth = lobe_graph_import_image(graph, target->depth);
    imported->keep_radiance = target->keep;
    imported->keep_depth = target->keep && target->depth;
    lobe_graph_extent(graph, imported->radiance, &imported->width, &imported->height);
    return imported->radiance.version ? check_extent(parameters, host, imported) : LOBE_OK;
}

void passes_host_frame_replace(const shading_targets *imported, shading_targets *targets) {
    if (imported->radiance.version)
        targets->radiance = imported->radiance;
    if (imported->depth.version)
        targets->depth = imported->depth;
    targets->keep_radiance = imported->keep_radiance;
    targets->keep_depth = imported->keep_depth;
}

// ---------------------------------------------------------------------------------------------
// Passes

static void add_passes(lobe_graph *graph, const lobe_render_parameters *parameters,
                       lobe_render_stage stage, shading_targets *targets) {
    lobe_render_resources resources = {
        .width = targets->width,
        .height = targets->height,
        .radiance = targets->radiance,
        .depth = targets->depth,
        .normal_depth = targets->normal_depth,
        .lobes_level = targets->lobes_level,
    };
    if (!parameters->host.add_passes)
        return;
    parameters->host.add_passes(parameters->host.user, graph, stage, &resources);
    targets->radiance = resources.radiance;
    targets->depth = resources.depth;
    targets->normal_depth = resources.normal_depth;
    targets->lobes_level = resources.lobes_level;
}

static bool is_same(lobe_resource a, lobe_resource b) {
    return a.index == b.index && a.version == b.version;
}

void passes_host_frame_before(lobe_graph *graph, const lobe_render_parameters *parameters,
                              shading_targets *targets) {
    const shading_targets declared = *targets;
    add_passes(graph, parameters, LOBE_RENDER_BEFORE_SHADING, targets);
    targets->keep_radiance |= !is_same(targets->radiance, declared.radiance);
    targets->keep_depth |= !is_same(targets->depth, declared.depth);
}

void passes_host_frame_after(lobe_graph *graph, const lobe_render_parameters *parameters,
                             shading_targets *targets) {
    add_passes(graph, parameters, LOBE_RENDER_AFTER_SHADING, targets);
}

// ---------------------------------------------------------------------------------------------
// Execution

lobe_result passes_host_frame_run(lobe_graph *graph, const lobe_render_parameters *parameters) {
    return parameters->host.submission ? lobe_graph_submit(graph, parameters->host.submission)
                                       : lobe_graph_execute(graph);
}
