#include "engine/graph/plan/dependency_graph.h"

#include <stdio.h>
#include <string.h>

#include "engine/base/growing_array.h"

void engine_dependency_graph_free(engine_dependency_graph *graph) {
    lobe_release(graph->resources);
    lobe_release(graph->passes);
    lobe_release(graph->accesses);
    lobe_release(graph->sources);
    lobe_release(graph->edges);
    lobe_release(graph->order);
    lobe_release(graph->running);
    lobe_release(graph->cycle);
    lobe_release(graph->barriers);
    lobe_release(graph->end_layouts);
    engine_arena_free(&graph->scratch);
    *graph = (engine_dependency_graph){0};
}

void engine_dependency_graph_reset(engine_dependency_graph *graph) {
    graph->resource_count = 0;
    graph->pass_count = 0;
    graph->access_count = 0;
    graph->source_count = 0;
    graph->edge_count = 0;
    graph->order_count = 0;
    graph->running_count = 0;
    graph->cycle_count = 0;
    graph->barrier_count = 0;
    graph->subresource_count = 0;
    graph->numbers = false;
    engine_arena_reset(&graph->scratch);
    graph->fault = (engine_dependency_fault){0};
}

bool engine_dependency_fail(engine_dependency_graph *graph, engine_dependency_fault fault) {
    if (graph->fault.kind == ENGINE_FAULT_NONE)
        graph->fault = fault;
    return false;
}

static bool fail_memory(engine_dependency_graph *graph) {
    return engine_dependency_fail(graph,
                                  (engine_dependency_fault){.kind = ENGINE_FAULT_MEMORY,
                                                            .pass = ENGINE_DEPENDENCY_NONE,
                                                            .resource = ENGINE_DEPENDENCY_NONE,
                                                            .other_pass = ENGINE_DEPENDENCY_NONE});
}

uint32_t engine_dependency_add_resource(engine_dependency_graph *graph,
                                        const engine_dependency_resource *resource) {
    if (!engine_array_reserve(graph->scratch.allocator, (void **)&graph->resources,
                              &graph->resource_capacity, (uint64_t)graph->resource_count + 1,
                              sizeof *graph->resources)) {
        fail_memory(graph);
        return ENGINE_DEPENDENCY_NONE;
    }
    engine_dependency_resource *added = &graph->resources[graph->resource_count];
    *added = *resource;
    added->version = added->settled_version = 1;
    added->last_writer = added->numbered_by = ENGINE_DEPENDENCY_NONE;
    added->number = ENGINE_STAMP_NONE;
    added->first_subresource = graph->subresource_count;
    added->first_position = added->last_position = ENGINE_DEPENDENCY_NONE;
    graph->subresource_count += added->levels * added->layers;
    return graph->resource_count++;
}

uint32_t engine_dependency_add_pass(engine_dependency_graph *graph, const char *name) {
    if (!engine_array_reserve(graph->scratch.allocator, (void **)&graph->passes,
                              &graph->pass_capacity, (uint64_t)graph->pass_count + 1,
                              sizeof *graph->passes)) {
        fail_memory(graph);
        return ENGINE_DEPENDENCY_NONE;
    }
    graph->passes[graph->pass_count] =
        (engine_dependency_pass){.name = name,
                                 .position = ENGINE_DEPENDENCY_NONE,
                                 .first_access = ENGINE_DEPENDENCY_NONE,
                                 .last_access = ENGINE_DEPENDENCY_NONE};
    return graph->pass_count++;
}

/// Whether `pass` may name this version: the newest one, or the one before the pass's own writes.
static bool version_is_current(const engine_dependency_resource *resource, uint32_t version,
                               uint32_t pass) {
    if (version == resource->version)
        return true;
    return pass != ENGINE_DEPENDENCY_NONE && pass == resource->last_writer &&
           version >= resource->settled_version && version < resource->version;
}

static engine_dependency_fault_kind check_handle(const engine_dependency_graph *graph,
                                                 uint32_t pass, lobe_resource handle) {
    if (handle.version == 0 || handle.index >= graph->resource_count)
        return ENGINE_FAULT_UNKNOWN_RESOURCE;
    const engine_dependency_resource *resource = &graph->resources[handle.index];
    if (handle.version > resource->version)
        return ENGINE_FAULT_UNKNOWN_RESOURCE;
    return version_is_current(resource, handle.version, pass) ? ENGINE_FAULT_NONE
                                                              : ENGINE_FAULT_STALE;
}

/// Replaces counts of 0; false if the resource does not have the range.
static bool resolve_range(const engine_dependency_resource *resource, lobe_range *range) {
    if (range->first_level >= resource->levels || range->first_layer >= resource->layers)
        return false;
    if (range->level_count == 0)
        range->level_count = resource->levels - range->first_level;
    if (range->layer_count == 0)
        range->layer_count = resource->layers - range->first_layer;
    return range->level_count <= resource->levels - range->first_level &&
           range->layer_count <= resource->layers - range->first_layer;
}

static void append_to_pass(engine_dependency_graph *graph, uint32_t pass, uint32_t access) {
    if (pass == ENGINE_DEPENDENCY_NONE)
        return;
    engine_dependency_pass *owner = &graph->passes[pass];
    if (owner->last_access == ENGINE_DEPENDENCY_NONE)
        owner->first_access = access;
    else
        graph->accesses[owner->last_access].next = access;
    owner->last_access = access;
}

static uint32_t append_access(engine_dependency_graph *graph,
                              const engine_dependency_access *access) {
    uint64_t sources = (uint64_t)graph->source_count + engine_access_size(access);
    if (!engine_array_reserve(graph->scratch.allocator, (void **)&graph->accesses,
                              &graph->access_capacity, (uint64_t)graph->access_count + 1,
                              sizeof *graph->accesses) ||
        !engine_array_reserve(graph->scratch.allocator, (void **)&graph->sources,
                              &graph->source_capacity, sources, sizeof *graph->sources)) {
        fail_memory(graph);
        return ENGINE_DEPENDENCY_NONE;
    }
    engine_dependency_access *added = &graph->accesses[graph->access_count];
    *added = *access;
    added->next = ENGINE_DEPENDENCY_NONE;
    added->first_source = graph->source_count;
    graph->source_count = (uint32_t)sources;
    append_to_pass(graph, access->pass, graph->access_count);
    return graph->access_count++;
}

static void bump_version(engine_dependency_resource *resource, uint32_t pass) {
    if (resource->last_writer != pass) {
        resource->settled_version = resource->version;
        resource->last_writer = pass;
    }
    resource->version++;
}

static engine_dependency_fault_kind check_access(const engine_dependency_graph *graph,
                                                 uint32_t pass, lobe_resource handle,
                                                 engine_access_kind kind, lobe_range *range) {
    engine_dependency_fault_kind fault = check_handle(graph, pass, handle);
    if (fault != ENGINE_FAULT_NONE)
        return fault;
    const engine_dependency_resource *resource = &graph->resources[handle.index];
    if (!resolve_range(resource, range))
        return ENGINE_FAULT_RANGE;
    if (kind != ENGINE_ACCESS_READ && resource->imported)
        return ENGINE_FAULT_IMPORTED_WRITTEN;
    return ENGINE_FAULT_NONE;
}

static engine_dependency_fault access_fault(const engine_dependency_graph *graph,
                                            engine_dependency_fault_kind kind, uint32_t pass,
                                            lobe_resource handle, lobe_range range) {
    bool known = handle.index < graph->resource_count;
    bool stale = kind == ENGINE_FAULT_STALE;
    return (engine_dependency_fault){
        .kind = kind,
        .pass = pass,
        .resource = known ? handle.index : ENGINE_DEPENDENCY_NONE,
        .other_pass = stale ? graph->resources[handle.index].last_writer : ENGINE_DEPENDENCY_NONE,
        .level = range.first_level,
        .layer = range.first_layer};
}

uint32_t engine_dependency_add_access(engine_dependency_graph *graph, uint32_t pass,
                                      lobe_resource handle, lobe_range range,
                                      engine_access_kind kind, uint32_t *version) {
    engine_dependency_fault_kind fault = check_access(graph, pass, handle, kind, &range);
    if (fault != ENGINE_FAULT_NONE) {
        engine_dependency_fail(graph, access_fault(graph, fault, pass, handle, range));
        return ENGINE_DEPENDENCY_NONE;
    }
    engine_dependency_access access = {
        .pass = pass, .resource = handle.index, .range = range, .kind = kind};
    uint32_t index = append_access(graph, &access);
    if (index == ENGINE_DEPENDENCY_NONE)
        return index;
    engine_dependency_resource *resource = &graph->resources[handle.index];
    if (kind != ENGINE_ACCESS_READ)
        bump_version(resource, pass);
    if (version)
        *version = resource->version;
    return index;
}

bool engine_dependency_add_output(engine_dependency_graph *graph, lobe_resource resource) {
    return engine_dependency_add_access(graph, ENGINE_DEPENDENCY_NONE, resource, (lobe_range){0},
                                        ENGINE_ACCESS_READ, NULL) != ENGINE_DEPENDENCY_NONE;
}

bool engine_dependency_add_edge(engine_dependency_graph *graph, uint32_t from, uint32_t to,
                                engine_hazard hazard) {
    if (from == to)
        return true;
    engine_dependency_edge *last = graph->edge_count ? &graph->edges[graph->edge_count - 1] : NULL;
    if (last && last->from == from &&
        last->to == to) { // often repeated for neighbouring subresources
        last->hazards |= hazard;
        return true;
    }
    if (!engine_array_reserve(graph->scratch.allocator, (void **)&graph->edges,
                              &graph->edge_capacity, (uint64_t)graph->edge_count + 1,
                              sizeof *graph->edges))
        return fail_memory(graph);
    graph->edges[graph->edge_count++] = (engine_dependency_edge){from, to, hazard};
    return true;
}

uint32_t engine_access_subresource(const engine_dependency_graph *graph,
                                   const engine_dependency_access *access, uint32_t n) {
    uint32_t level = access->range.first_level + n / access->range.layer_count;
    uint32_t layer = access->range.first_layer + n % access->range.layer_count;
    return engine_subresource_index(&graph->resources[access->resource], level, layer);
}

engine_stamp engine_dependency_content(const engine_dependency_graph *graph, uint32_t writer,
                                       uint32_t resource, uint32_t subresource) {
    if (writer == ENGINE_DEPENDENCY_NONE) {
        const engine_dependency_resource *start = &graph->resources[resource];
        engine_stamp held = start->recorded ? start->recorded[subresource] : start->identity;
        return engine_stamp_mix(held, subresource);
    }
    const engine_dependency_pass *pass = &graph->passes[graph->accesses[writer].pass];
    uint32_t ordinal = 0; // of the access within its pass
    for (uint32_t access = pass->first_access; access != writer;
         access = graph->accesses[access].next)
        ordinal++;
    return engine_stamp_mix(engine_stamp_mix(pass->stamp, ordinal), subresource);
}

static const char *resource_name(const engine_dependency_graph *graph, uint32_t resource) {
    return resource < graph->resource_count ? graph->resources[resource].name : "(none)";
}

static const char *pass_name(const engine_dependency_graph *graph, uint32_t pass) {
    return pass < graph->pass_count ? graph->passes[pass].name : "(the frame's outputs)";
}

static void explain_cycle(const engine_dependency_graph *graph, char *text, size_t size) {
    int length = snprintf(text, size, "passes depend on each other in a cycle:");
    for (uint32_t i = 0; i <= graph->cycle_count && length >= 0 && (size_t)length < size; i++) {
        uint32_t pass = graph->cycle[i % graph->cycle_count];
        length += snprintf(text + length, size - (size_t)length, "%s '%s'", i ? " before" : "",
                           pass_name(graph, pass));
    }
    size_t used = strlen(text);
    const engine_dependency_fault *fault = &graph->fault;
    if (fault->resource != ENGINE_DEPENDENCY_NONE)
        snprintf(text + used, size - used, ", among others through resource '%s'",
                 resource_name(graph, fault->resource));
}

void engine_dependency_explain(const engine_dependency_graph *graph, char *text, size_t size) {
    const engine_dependency_fault *fault = &graph->fault;
    const char *pass = pass_name(graph, fault->pass);
    const char *resource = resource_name(graph, fault->resource);
    const char *other = pass_name(graph, fault->other_pass);
    switch (fault->kind) {
    case ENGINE_FAULT_NONE:
        snprintf(text, size, "no fault");
        break;
    case ENGINE_FAULT_MEMORY:
        snprintf(text, size, "render graph: out of host memory");
        break;
    case ENGINE_FAULT_UNKNOWN_RESOURCE:
        snprintf(text, size, "pass '%s' uses a resource handle that is not of this frame (%s)",
                 pass, resource);
        break;
    case ENGINE_FAULT_STALE:
        snprintf(text, size,
                 "pass '%s' uses a stale version of resource '%s', which pass '%s' has overwritten",
                 pass, resource, other);
        break;
    case ENGINE_FAULT_RANGE:
        snprintf(text, size,
                 "pass '%s' uses levels or layers that resource '%s' does not have (from level %u, "
                 "layer %u)",
                 pass, resource, fault->level, fault->layer);
        break;
    case ENGINE_FAULT_IMPORTED_WRITTEN:
        snprintf(text, size, "pass '%s' writes resource '%s', which was imported for reading only",
                 pass, resource);
        break;
    case ENGINE_FAULT_NEVER_WRITTEN:
        snprintf(text, size,
                 "pass '%s' reads resource '%s' (level %u, layer %u), which no pass has written",
                 pass, resource, fault->level, fault->layer);
        break;
    case ENGINE_FAULT_CONFLICT:
        snprintf(text, size,
                 "pass '%s' reads and writes resource '%s' (level %u, layer %u) at once", pass,
                 resource, fault->level, fault->layer);
        break;
    case ENGINE_FAULT_WRITTEN_TWICE:
        snprintf(text, size, "pass '%s' writes resource '%s' (level %u, layer %u) twice", pass,
                 resource, fault->level, fault->layer);
        break;
    case ENGINE_FAULT_OVERWRITTEN:
        snprintf(text, size, "pass '%s' overwrites resource '%s' after it was marked as an output",
                 pass, resource);
        break;
    case ENGINE_FAULT_CYCLE:
        explain_cycle(graph, text, size);
        break;
    }
}
