#include "engine/graph/traffic.h"

#include <string.h>

#include "engine/base/growing_array.h"

enum { COUNTED_READ = 1, COUNTED_WRITTEN = 2 };

static uint32_t level_extent(uint32_t extent, uint32_t level) {
    return extent >> level ? extent >> level : 1;
}

uint64_t engine_graph_range_bytes(const engine_graph_resource *resource, const lobe_range *range) {
    if (!resource->is_image)
        return resource->size;
    uint64_t texels = 0;
    for (uint32_t n = 0; n < range->level_count; n++)
        texels += (uint64_t)level_extent(resource->width, range->first_level + n) *
                  level_extent(resource->height, range->first_level + n);
    return texels * range->layer_count * lobe_format_size(resource->format) *
           (resource->samples > 1 ? resource->samples : 1);
}

/// `counted` holds, by subresource, the pass that was counted last (plus one, times four) and the
/// directions: no clearing between passes.
static void count_access(lobe_pass *pass, const engine_dependency_access *access,
                         uint64_t *counted) {
    const lobe_graph *graph = pass->graph;
    const engine_graph_resource *resource = &graph->resources[access->resource];
    const uint32_t first = graph->dependencies.resources[access->resource].first_subresource;
    const uint64_t directions = access->kind == ENGINE_ACCESS_READ ? COUNTED_READ
                                : access->kind == ENGINE_ACCESS_WRITE
                                    ? COUNTED_WRITTEN
                                    : COUNTED_READ | COUNTED_WRITTEN;
    const uint64_t mine = ((uint64_t)pass->index + 1) << 2;
    for (uint32_t n = 0; n < engine_access_size(access); n++) {
        const uint32_t index = engine_access_subresource(&graph->dependencies, access, n);
        const uint32_t layers = graph->dependencies.resources[access->resource].layers;
        const uint64_t bytes = engine_graph_range_bytes(
            resource,
            &(lobe_range){.first_level = index / layers, .level_count = 1, .layer_count = 1});
        uint64_t *mark = &counted[first + index];
        const uint64_t former = *mark >> 2 == mine >> 2 ? *mark & 3 : 0;
        pass->read_bytes += (directions & ~former & COUNTED_READ) ? bytes : 0;
        pass->written_bytes += (directions & ~former & COUNTED_WRITTEN) ? bytes : 0;
        *mark = mine | former | directions;
    }
}

lobe_result engine_graph_count_traffic(lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    const uint32_t count = dependencies->subresource_count;
    uint64_t *counted = engine_arena_allocate(&graph->arena, (count + (size_t)1) * sizeof *counted);
    if (!counted)
        return engine_graph_fail_memory(graph);
    memset(counted, 0, count * sizeof *counted);
    for (uint32_t n = 0; n < dependencies->pass_count; n++) {
        uint32_t index = dependencies->passes[n].first_access;
        for (; index != ENGINE_DEPENDENCY_NONE; index = dependencies->accesses[index].next)
            count_access(graph->passes[n], &dependencies->accesses[index], counted);
    }
    return LOBE_OK;
}
