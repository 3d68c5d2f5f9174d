#include "engine/graph/plan/dependency_graph.h"

#include "engine/base/growing_array.h"

/// Demand propagates backwards: from the outputs to the passes that write them, and from each of
/// those to what it reads. It stops at retained content that is still valid.

static uint32_t source_before(const engine_dependency_graph *graph, uint32_t writer,
                              uint32_t subresource) {
    const engine_dependency_access *access = &graph->accesses[writer];
    const engine_dependency_resource *resource = &graph->resources[access->resource];
    uint32_t level = subresource / resource->layers - access->range.first_level;
    uint32_t layer = subresource % resource->layers - access->range.first_layer;
    return engine_access_source(graph, access, level * access->range.layer_count + layer);
}

/// Whether the subresource already has the content that `writer` would give it, and no running pass
/// overwrites that content first.
static bool still_valid(const engine_dependency_graph *graph, uint32_t writer,
                        uint32_t subresource) {
    uint32_t index = graph->accesses[writer].resource;
    const engine_dependency_resource *resource = &graph->resources[index];
    if (!resource->retained || !resource->recorded ||
        resource->recorded[subresource] !=
            engine_dependency_content(graph, writer, index, subresource))
        return false;
    for (uint32_t before = source_before(graph, writer, subresource);
         before != ENGINE_DEPENDENCY_NONE; before = source_before(graph, before, subresource))
        if (graph->passes[graph->accesses[before].pass].state == LOBE_PASS_RUN)
            return false;
    return true;
}

/// Marks the pass that writes this content as running unless the content is still valid. Returns
/// whether that is new.
static bool demand_content(engine_dependency_graph *graph, uint32_t writer, uint32_t subresource,
                           bool use_retained) {
    if (writer == ENGINE_DEPENDENCY_NONE)
        return false;
    engine_dependency_pass *pass = &graph->passes[graph->accesses[writer].pass];
    if (pass->state == LOBE_PASS_RUN)
        return false;
    if (use_retained && still_valid(graph, writer, subresource))
        return false;
    pass->state = LOBE_PASS_RUN;
    return true;
}

static bool demand_read(engine_dependency_graph *graph, const engine_dependency_access *access,
                        bool use_retained) {
    bool changed = false;
    for (uint32_t i = 0; i < engine_access_size(access); i++)
        changed |= demand_content(graph, engine_access_source(graph, access, i),
                                  engine_access_subresource(graph, access, i), use_retained);
    return changed;
}

static bool demand_written(engine_dependency_graph *graph, uint32_t access, bool use_retained) {
    bool changed = false;
    for (uint32_t i = 0; i < engine_access_size(&graph->accesses[access]); i++)
        changed |= demand_content(graph, access,
                                  engine_access_subresource(graph, &graph->accesses[access], i),
                                  use_retained);
    return changed;
}

/// Everything that a kept pass writes counts as an output; one that writes nothing always runs.
static bool demand_kept(engine_dependency_graph *graph, engine_dependency_pass *pass,
                        bool use_retained) {
    bool changed = false, written = false;
    for (uint32_t i = pass->first_access; i != ENGINE_DEPENDENCY_NONE; i = graph->accesses[i].next)
        if (engine_access_writes(&graph->accesses[i])) {
            written = true;
            changed |= demand_written(graph, i, use_retained);
        }
    if (!written && pass->state != LOBE_PASS_RUN) {
        pass->state = LOBE_PASS_RUN;
        changed = true;
    }
    return changed;
}

static bool demand_of_pass(engine_dependency_graph *graph, engine_dependency_pass *pass,
                           bool use_retained) {
    bool changed = pass->keep && demand_kept(graph, pass, use_retained);
    if (pass->state != LOBE_PASS_RUN)
        return changed;
    for (uint32_t i = pass->first_access; i != ENGINE_DEPENDENCY_NONE; i = graph->accesses[i].next)
        if (engine_access_reads(&graph->accesses[i]))
            changed |= demand_read(graph, &graph->accesses[i], use_retained);
    return changed;
}

static bool demand_outputs(engine_dependency_graph *graph, bool use_retained) {
    bool changed = false;
    for (uint32_t i = 0; i < graph->access_count; i++)
        if (graph->accesses[i].pass == ENGINE_DEPENDENCY_NONE)
            changed |= demand_read(graph, &graph->accesses[i], use_retained);
    return changed;
}

/// A running pass may destroy retained content that counted as valid, so repeat until nothing
/// changes. It ends because the set of running passes only grows.
static void propagate_demand(engine_dependency_graph *graph, bool use_retained) {
    for (uint32_t i = 0; i < graph->pass_count; i++)
        graph->passes[i].state = LOBE_PASS_CULLED;
    for (bool changed = true; changed;) {
        changed = demand_outputs(graph, use_retained);
        for (uint32_t i = graph->order_count; i-- > 0;)
            changed |= demand_of_pass(graph, &graph->passes[graph->order[i]], use_retained);
    }
}

static bool writes_retained(const engine_dependency_graph *graph,
                            const engine_dependency_pass *pass) {
    for (uint32_t i = pass->first_access; i != ENGINE_DEPENDENCY_NONE; i = graph->accesses[i].next)
        if (engine_access_writes(&graph->accesses[i]) &&
            graph->resources[graph->accesses[i].resource].retained)
            return true;
    return false;
}

static void mark_live(engine_dependency_graph *graph) {
    propagate_demand(graph, false);
    for (uint32_t i = 0; i < graph->pass_count; i++)
        graph->passes[i].live = graph->passes[i].state == LOBE_PASS_RUN;
}

static void mark_skipped(engine_dependency_graph *graph) {
    for (uint32_t i = 0; i < graph->pass_count; i++) {
        engine_dependency_pass *pass = &graph->passes[i];
        if (pass->live && pass->state != LOBE_PASS_RUN && writes_retained(graph, pass))
            pass->state = LOBE_PASS_SKIPPED;
    }
}

static void list_running(engine_dependency_graph *graph) {
    graph->running_count = 0;
    for (uint32_t i = 0; i < graph->order_count; i++) {
        engine_dependency_pass *pass = &graph->passes[graph->order[i]];
        pass->position = ENGINE_DEPENDENCY_NONE;
        if (pass->state != LOBE_PASS_RUN)
            continue;
        pass->position = graph->running_count;
        graph->running[graph->running_count++] = graph->order[i];
    }
}

bool engine_dependency_cull(engine_dependency_graph *graph) {
    if (!engine_array_reserve(graph->scratch.allocator, (void **)&graph->running,
                              &graph->running_capacity, (uint64_t)graph->pass_count + 1,
                              sizeof *graph->running))
        return engine_dependency_fail(graph,
                                      (engine_dependency_fault){.kind = ENGINE_FAULT_MEMORY});
    engine_dependency_stamp(graph);
    mark_live(graph);
    propagate_demand(graph, true);
    mark_skipped(graph);
    list_running(graph);
    return true;
}
