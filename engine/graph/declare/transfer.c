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
                                engine_access_kind kind) {
    engine_graph_resource *used = &pass->graph->frame.resources[resource->index];
    const bool target = kind != ENGINE_ACCESS_READ;
    engine_access_state state = target ? copy_target : copy_source;
    if (used->is_image) {
        used->usage |= target ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    } else {
        used->usage |= target ? VK_BUFFER_USAGE_TRANSFER_DST_BIT : VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
        state.layout = ENGINE_LAYOUT_UNDEFINED;
        range = (lobe_range){0};
    }
    return engine_graph_add_access(pass, resource, range, kind, state);
}

/// Whether texels of one fit into the other as they are.
static bool same_texels(const engine_graph_resource *a, const engine_graph_resource *b) {
    return a->is_image && b->is_image &&
           (a->format == LOBE_FORMAT_D32_FLOAT) == (b->format == LOBE_FORMAT_D32_FLOAT) &&
           lobe_format_size(a->format) > 0 && a->samples == b->samples &&
           lobe_format_size(a->format) == lobe_format_size(b->format);
}

static bool same_shape(const lobe_graph *graph, const engine_dependency_access *from,
                       const engine_dependency_access *to) {
    const engine_graph_resource *source = &graph->frame.resources[from->resource];
    const engine_graph_resource *target = &graph->frame.resources[to->resource];
    if (!source->is_image || !target->is_image)
        return !source->is_image && !target->is_image && source->size == target->size;
    bool same = same_texels(source, target) && from->range.level_count == to->range.level_count &&
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
    command->source_access = transfer_access(pass, &source, source_range, ENGINE_ACCESS_READ);
    command->target_access = transfer_access(pass, &target, target_range, ENGINE_ACCESS_WRITE);
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
    command->target_access = transfer_access(pass, &target, range, ENGINE_ACCESS_WRITE);
    return target;
}

// ---------------------------------------------------------------------------------------------
// Parts of images

static bool check_part(lobe_pass *pass, const engine_graph_resource *source,
                       const lobe_rectangle *part, const engine_graph_resource *target,
                       const lobe_rectangle *place) {
    if (!same_texels(source, target))
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s' copies a part of '%s' to '%s', which differ in kind, texel size "
                        "or samples",
                        pass->name, source->name, target->name);
    else if (!lobe_rectangle_lies_within(part, source->width, source->height) ||
             !lobe_rectangle_lies_within(place, target->width, target->height))
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': %ux%u texels at (%u, %u) of '%s' (%ux%u) do not fit at "
                        "(%u, %u) of '%s' (%ux%u)",
                        pass->name, part->width, part->height, part->x, part->y, source->name,
                        source->width, source->height, place->x, place->y, target->name,
                        target->width, target->height);
    return pass->graph->frame.result == LOBE_OK;
}

/// A host that does not need an image's content does not need the rest of it either.
static bool keeps_rest(const engine_graph_resource *target, lobe_resource resource,
                       const lobe_rectangle *place) {
    const bool whole = place->width == target->width && place->height == target->height;
    const bool empty =
        target->host && target->host->layout == VK_IMAGE_LAYOUT_UNDEFINED && resource.version == 1;
    return !whole && !empty;
}

lobe_resource lobe_pass_copy_part(lobe_pass *pass, lobe_resource source, const lobe_rectangle *part,
                                  lobe_resource target, uint32_t x, uint32_t y) {
    static const lobe_range first = {0, 1, 0, 1};
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_TRANSFER, "a copy", part))
        return target;
    const engine_graph_resource *from = engine_graph_find_resource(pass, source);
    const engine_graph_resource *to = engine_graph_find_resource(pass, target);
    const lobe_rectangle place = {x, y, part->width, part->height};
    engine_graph_command *command = from && to && check_part(pass, from, part, to, &place)
                                        ? engine_graph_add_command(pass, ENGINE_GRAPH_COPY)
                                        : NULL;
    if (!command)
        return target;
    command->part = *part;
    command->target_x = x;
    command->target_y = y;
    const engine_access_kind kind =
        keeps_rest(to, target, &place) ? ENGINE_ACCESS_MODIFY : ENGINE_ACCESS_WRITE;
    const uint64_t bytes = (uint64_t)part->width * part->height * lobe_format_size(to->format);
    command->source_access = transfer_access(pass, &source, first, ENGINE_ACCESS_READ);
    command->target_access = transfer_access(pass, &target, first, kind);
    if (pass->graph->frame.result != LOBE_OK)
        return target;
    engine_dependency_access *accesses = pass->graph->frame.dependencies.accesses;
    accesses[command->source_access].part_bytes = bytes;
    accesses[command->target_access].part_bytes = bytes;
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
    command->source_access = transfer_access(pass, &resource, range, ENGINE_ACCESS_READ);
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
