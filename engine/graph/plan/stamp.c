#include "engine/graph/plan/dependency_graph.h"

/// Digests of what passes do and of what they do it with: which content is still valid (cull.c),
/// and numbers of content for passes that decide for themselves what is.

/// Of one that modifies what evolves, the graph's own number: what it leaves depends on frames of
/// this graph.
static engine_stamp stamp_read(const engine_dependency_graph *graph,
                               const engine_dependency_access *access, engine_stamp stamp) {
    if (access->kind == ENGINE_ACCESS_MODIFY && graph->resources[access->resource].evolves)
        return engine_stamp_mix(stamp, graph->number);
    for (uint32_t s = 0; s < engine_access_size(access); s++)
        stamp = engine_stamp_mix(
            stamp, engine_dependency_content(graph, engine_access_source(graph, access, s),
                                             access->resource,
                                             engine_access_subresource(graph, access, s)));
    return stamp;
}

/// The stamp of a pass that modifies what settles, from the one it has without that: another in
/// each frame until it has come to rest.
static engine_stamp stamp_settling(engine_dependency_graph *graph,
                                   const engine_dependency_access *access, engine_stamp change) {
    engine_dependency_resource *resource = &graph->resources[access->resource];
    const engine_settling *settled = &resource->settled;
    if (access->kind != ENGINE_ACCESS_MODIFY || resource->settles == 0)
        return change;
    const bool begins = engine_access_source(graph, access, 0) != ENGINE_DEPENDENCY_NONE;
    const bool same = settled->change == change;
    const bool rests = settled->rests || settled->runs == resource->settles;
    const uint32_t runs = begins ? resource->settles : same ? settled->runs + !rests : 0;
    resource->settling = (engine_settling){change, runs, same && settled->rests};
    return engine_stamp_mix(change, runs);
}

/// In topological order, so that the stamps of everything a pass reads are known.
void engine_dependency_stamp(engine_dependency_graph *graph) {
    for (uint32_t i = 0; i < graph->order_count; i++) {
        engine_dependency_pass *pass = &graph->passes[graph->order[i]];
        engine_stamp stamp = pass->signature;
        for (uint32_t a = pass->first_access; a != ENGINE_DEPENDENCY_NONE;
             a = graph->accesses[a].next) {
            const engine_dependency_access *access = &graph->accesses[a];
            stamp = engine_stamp_mix(stamp, access->kind);
            stamp = engine_stamp_bytes(stamp, &access->range, sizeof access->range);
            stamp = engine_stamp_mix(stamp, graph->resources[access->resource].identity);
            if (engine_access_reads(access))
                stamp = stamp_read(graph, access, stamp);
        }
        for (uint32_t a = pass->first_access; a != ENGINE_DEPENDENCY_NONE;
             a = graph->accesses[a].next)
            stamp = stamp_settling(graph, &graph->accesses[a], stamp);
        pass->stamp = stamp;
    }
}

// ---------------------------------------------------------------------------------------------
// Numbers of content

static bool uses(const engine_dependency_graph *graph, uint32_t pass, uint32_t resource) {
    uint32_t a = graph->passes[pass].first_access;
    while (a != ENGINE_DEPENDENCY_NONE && graph->accesses[a].resource != resource)
        a = graph->accesses[a].next;
    return a != ENGINE_DEPENDENCY_NONE;
}

/// A digest of what the pass makes of `made`, without what that held before, in which frames may
/// differ that would make the same, and without what the pass that uses the number sees itself.
static engine_stamp stamp_making(const engine_dependency_graph *graph,
                                 const engine_dependency_pass *pass, uint32_t made) {
    const engine_dependency_resource *resource = &graph->resources[made];
    engine_stamp stamp = pass->signature;
    for (uint32_t a = pass->first_access; a != ENGINE_DEPENDENCY_NONE;
         a = graph->accesses[a].next) {
        const engine_dependency_access *access = &graph->accesses[a];
        if (uses(graph, resource->numbered_by, access->resource))
            continue;
        stamp = engine_stamp_bytes(stamp, &access->range, sizeof access->range);
        stamp = engine_stamp_mix(stamp, graph->resources[access->resource].identity);
        if (access->resource == made) {
            stamp = engine_stamp_mix(stamp, engine_access_writes(access));
        } else {
            stamp = engine_stamp_mix(stamp, access->kind);
            if (engine_access_reads(access))
                stamp = stamp_read(graph, access, stamp);
        }
    }
    return stamp;
}

void engine_dependency_number(engine_dependency_graph *graph) {
    engine_dependency_stamp(graph);
    // In the order of declaration: that of execution may change with passes of other things.
    for (uint32_t i = 0; i < graph->pass_count; i++) {
        const engine_dependency_pass *pass = &graph->passes[i];
        for (uint32_t a = pass->first_access; a != ENGINE_DEPENDENCY_NONE;
             a = graph->accesses[a].next) {
            const uint32_t made = graph->accesses[a].resource;
            engine_dependency_resource *resource = &graph->resources[made];
            if (engine_access_writes(&graph->accesses[a]) &&
                resource->numbered_by != ENGINE_DEPENDENCY_NONE)
                resource->number =
                    engine_stamp_mix(resource->number, stamp_making(graph, pass, made));
        }
    }
}
