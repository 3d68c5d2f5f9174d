#include "passes/renderer/host_passes.h"

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

void passes_host_passes_before(lobe_graph *graph, const lobe_render_host *host,
                               shading_targets *targets) {
    const shading_targets declared = *targets;
    add_passes(graph, host, LOBE_RENDER_BEFORE_SHADING, targets);
    targets->keep_radiance |= !is_same(targets->radiance, declared.radiance);
    targets->keep_depth |= !is_same(targets->depth, declared.depth);
}

void passes_host_passes_after(lobe_graph *graph, const lobe_render_host *host,
                              shading_targets *targets) {
    add_passes(graph, host, LOBE_RENDER_AFTER_SHADING, targets);
}
