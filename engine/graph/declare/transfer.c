#include "engine/graph/declare/declare.h"

#include <string.h>

static const engine_access_state copy_source = {
    .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
    .access = VK_ACCESS_2_TRANSFER_READ_BIT,
    .layout = ENGINE_LAYOUT_COPY_SOURCE,
};

static const engine_access_state copy_target = {
    .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
    .access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
    .layout = ENGINE_LAYOUT_COPY_TARGET,
};

/// The access of one side of a transfer; buffers have no layout and no levels.
static uint32_t transfer_access(lobe_pass *pass, lobe_resource *resource, lobe_range range,
                                bool target) {
    engine_graph_resource *used = &pass->graph->frame.resources[resource->index];
    engine_access_state state = target ? copy_target : copy_source;
    if (used->is_image) {
        used->usage |= target ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    } else {
        used->usage |= target ? VK_BUFFER_USAGE_TRANSFER_DST_BIT : VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
        state.layout = ENGINE_LAYOUT_UNDEFINED;
        range = (lobe_range){0};
    }
    return engine_graph_add_access(pass, resource, range,
                                   target ? ENGINE_ACCESS_WRITE : ENGINE_ACCESS_READ, state);
}

static bool same_shape(const lobe_graph *graph, const engine_dependency_access *from,
                       const engine_dependency_access *to) {
    const engine_graph_resource *source = &graph->frame.resources[from->resource];
    const engine_graph_resource *target = &graph->frame.resources[to->resource];
    if (!source->is_image || !target->is_image)
        return !source->is_image && !target->is_image && source->size == target->size;
    bool depths =
        (source->format == LOBE_FORMAT_D32_FLOAT) == (target->format == LOBE_FORMAT_D32_FLOAT);
    bool same = depths && lobe_format_size(source->format) > 0 &&
                source->samples == target->samples &&
                lobe_format_size(source->format) == lobe_format_size(target->format) &&
                from->range.level_count == to->range.level_count &&
                from->range.layer_count == to->range.layer_count;
    for (uint32_t i = 0; same && i < from->range.level_count; i++)
        same = engine_graph_level_extent(source->width, from->range.first_level + i) ==
                   engine_graph_level_extent(target->width, to->range.first_level + i) &&
               engine_graph_level_extent(source->height, from->range.first_level + i) ==
                   engine_graph_level_extent(target->height, to->range.first_level + i);
    return same;
}

lobe_resource lobe_pass_copy(lobe_pass *pass, lobe_resource source, lobe_range source_range,
                             lobe_resource target, lobe_range target_range) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_TRANSFER, "a copy", pass) ||
        !engine_graph_find_resource(pass, source) || !engine_graph_find_resource(pass, target))
        return target;
    engine_graph_command *command = engine_graph_add_command(pass, ENGINE_GRAPH_COPY);
    if (!command)
        return target;
    lobe_graph *graph = pass->graph;
    command->source_access = transfer_access(pass, &source, source_range, false);
    command->target_access = transfer_access(pass, &target, target_range, true);
    if (graph->frame.result == LOBE_OK &&
        !same_shape(graph, &graph->frame.dependencies.accesses[command->source_access],
                    &graph->frame.dependencies.accesses[command->target_access]))
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s' copies '%s' to '%s', which differ in kind, extent, texel "
                        "size, samples, or number of levels and layers",
                        pass->name, graph->frame.resources[source.index].name,
                        graph->frame.resources[target.index].name);
    return target;
}

lobe_resource lobe_pass_fill(lobe_pass *pass, lobe_resource target, lobe_range range,
                             const float value[4]) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_TRANSFER, "a fill", value) ||
        !engine_graph_find_resource(pass, target))
        return target;
    engine_graph_command *command = engine_graph_add_command(pass, ENGINE_GRAPH_FILL);
    if (!command)
        return target;
    memcpy(command->value, value, sizeof command->value);
    command->target_access = transfer_access(pass, &target, range, true);
    return target;
}

// ---------------------------------------------------------------------------------------------
// Outputs

void lobe_graph_output(lobe_graph *graph, lobe_resource resource) {
    if (engine_graph_can_declare(graph, "an output") &&
        !engine_dependency_add_output(&graph->frame.dependencies, resource))
        engine_graph_fail_dependency(graph);
}

/// Adds an internal pass, so that dependencies and barriers need no special case.
static void read_back(lobe_graph *graph, lobe_resource resource, lobe_range range,
                      uint64_t late_number) {
    if (!engine_graph_can_declare(graph, "a read back"))
        return;
    lobe_pass *pass = engine_graph_add_pass(graph, LOBE_PASS_TRANSFER, "read back");
    if (!pass || !engine_graph_find_resource(pass, resource))
        return;
    pass->internal = true;
    graph->frame.dependencies.passes[pass->index].keep = true;
    const engine_graph_resource *source = &graph->frame.resources[resource.index];
    engine_graph_command *command = engine_graph_add_command(pass, ENGINE_GRAPH_READ_BACK);
    if (!command)
        return;
    command->read_back = resource;
    command->late_number = late_number;
    command->source_access = transfer_access(pass, &resource, range, false);
    if (graph->frame.result != LOBE_OK)
        return;
    command->read_back_size = engine_graph_range_bytes(
        source, &graph->frame.dependencies.accesses[command->source_access].range);
    if (source->is_image && lobe_format_size(source->format) == 0)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "resource '%s' is compressed: it cannot be read back", source->name);
    else if (source->is_image && source->samples > 1)
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "resource '%s' is multisampled: resolve it before reading it back",
                        source->name);
}

void lobe_graph_read_back(lobe_graph *graph, lobe_resource resource, lobe_range range) {
    read_back(graph, resource, range, 0);
}

uint64_t lobe_graph_read_back_late(lobe_graph *graph, lobe_resource resource, lobe_range range) {
    if (!graph)
        return 0;
    read_back(graph, resource, range, ++graph->kept.late_number);
    return graph->frame.result == LOBE_OK ? graph->kept.late_number : 0;
}
