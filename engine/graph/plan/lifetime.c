#include "engine/graph/plan/dependency_graph.h"

static void extend(engine_dependency_resource *resource, uint32_t position) {
    if (resource->first_position == ENGINE_DEPENDENCY_NONE || position < resource->first_position)
        resource->first_position = position;
    if (resource->last_position == ENGINE_DEPENDENCY_NONE || position > resource->last_position)
        resource->last_position = position;
}

/// An output lives until after the last pass, if a running pass uses it at all.
static void extend_output(engine_dependency_graph *graph, const engine_dependency_access *access) {
    engine_dependency_resource *resource = &graph->resources[access->resource];
    if (resource->first_position != ENGINE_DEPENDENCY_NONE)
        extend(resource, graph->running_count);
}

void engine_dependency_find_lifetimes(engine_dependency_graph *graph) {
    for (uint32_t i = 0; i < graph->resource_count; i++) {
        graph->resources[i].first_position = ENGINE_DEPENDENCY_NONE;
        graph->resources[i].last_position = ENGINE_DEPENDENCY_NONE;
    }
    for (uint32_t i = 0; i < graph->access_count; i++) {
        const engine_dependency_access *access = &graph->accesses[i];
        if (access->pass != ENGINE_DEPENDENCY_NONE &&
            graph->passes[access->pass].position != ENGINE_DEPENDENCY_NONE)
            extend(&graph->resources[access->resource], graph->passes[access->pass].position);
    }
    for (uint32_t i = 0; i < graph->access_count; i++)
        if (graph->accesses[i].pass == ENGINE_DEPENDENCY_NONE)
            extend_output(graph, &graph->accesses[i]);
}
