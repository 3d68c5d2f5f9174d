#include "engine/graph/plan/dependency_graph.h"

#include "engine/base/sort.h"

/// State of one subresource while walking the accesses in order of declaration.
typedef struct subresource_history {
    uint32_t writer;       ///< newest access that wrote it, or NONE
    uint32_t first_reader; ///< list in `readers`: passes that have read it since, or NONE
    bool is_output;        ///< its present content is an output
} subresource_history;

typedef struct reader_entry {
    uint32_t pass, next;
} reader_entry;

typedef struct history {
    subresource_history *subresources;
    reader_entry *readers;
    uint32_t reader_count;
} history;

static bool history_create(engine_dependency_graph *graph, history *past) {
    const size_t subresources = graph->subresource_count, readers = graph->source_count;
    past->subresources =
        engine_arena_allocate(&graph->scratch, subresources * sizeof *past->subresources);
    past->readers = engine_arena_allocate(&graph->scratch, readers * sizeof *past->readers);
    past->reader_count = 0;
    if (!past->subresources || !past->readers)
        return false;
    for (size_t i = 0; i < subresources; i++)
        past->subresources[i] = (subresource_history){.writer = ENGINE_DEPENDENCY_NONE,
                                                      .first_reader = ENGINE_DEPENDENCY_NONE};
    return true;
}

static bool fail(engine_dependency_graph *graph, engine_dependency_fault_kind kind,
                 const engine_dependency_access *access, uint32_t subresource) {
    uint32_t layers = graph->resources[access->resource].layers;
    return engine_dependency_fail(graph,
                                  (engine_dependency_fault){.kind = kind,
                                                            .pass = access->pass,
                                                            .resource = access->resource,
                                                            .other_pass = ENGINE_DEPENDENCY_NONE,
                                                            .level = subresource / layers,
                                                            .layer = subresource % layers});
}

static bool pass_reads(const history *past, const subresource_history *subresource, uint32_t pass) {
    for (uint32_t i = subresource->first_reader; i != ENGINE_DEPENDENCY_NONE;
         i = past->readers[i].next)
        if (past->readers[i].pass == pass)
            return true;
    return false;
}

/// Content from the host, or from an earlier frame.
static bool has_content_at_start(const engine_dependency_resource *resource, uint32_t subresource) {
    return resource->imported ||
           (resource->borrowed && resource->before.layout != ENGINE_LAYOUT_UNDEFINED) ||
           (resource->retained && resource->recorded &&
            resource->recorded[subresource] != ENGINE_STAMP_NONE);
}

static bool link_read(engine_dependency_graph *graph, history *past,
                      const engine_dependency_access *access, uint32_t subresource) {
    const engine_dependency_resource *resource = &graph->resources[access->resource];
    subresource_history *now = &past->subresources[resource->first_subresource + subresource];
    if (now->writer == ENGINE_DEPENDENCY_NONE)
        return has_content_at_start(resource, subresource) ||
               fail(graph, ENGINE_FAULT_NEVER_WRITTEN, access, subresource);
    uint32_t producer = graph->accesses[now->writer].pass;
    if (producer == access->pass)
        return fail(graph, ENGINE_FAULT_CONFLICT, access, subresource);
    return engine_dependency_add_edge(graph, producer, access->pass,
                                      ENGINE_HAZARD_READ_AFTER_WRITE);
}

static void add_reader(history *past, subresource_history *now, uint32_t pass) {
    // All draws of a pass may read the same resource: list the pass once.
    if (now->first_reader != ENGINE_DEPENDENCY_NONE &&
        past->readers[now->first_reader].pass == pass)
        return;
    past->readers[past->reader_count] = (reader_entry){.pass = pass, .next = now->first_reader};
    now->first_reader = past->reader_count++;
}

static bool link_write(engine_dependency_graph *graph, history *past,
                       const engine_dependency_access *access, uint32_t subresource) {
    const engine_dependency_resource *resource = &graph->resources[access->resource];
    subresource_history *now = &past->subresources[resource->first_subresource + subresource];
    if (now->is_output)
        return fail(graph, ENGINE_FAULT_OVERWRITTEN, access, subresource);
    if (pass_reads(past, now, access->pass))
        return fail(graph, ENGINE_FAULT_CONFLICT, access, subresource);
    if (now->writer != ENGINE_DEPENDENCY_NONE) {
        uint32_t before = graph->accesses[now->writer].pass;
        if (before == access->pass)
            return fail(graph, ENGINE_FAULT_WRITTEN_TWICE, access, subresource);
        if (!engine_dependency_add_edge(graph, before, access->pass,
                                        ENGINE_HAZARD_WRITE_AFTER_WRITE))
            return false;
    }
    for (uint32_t i = now->first_reader; i != ENGINE_DEPENDENCY_NONE; i = past->readers[i].next)
        if (!engine_dependency_add_edge(graph, past->readers[i].pass, access->pass,
                                        ENGINE_HAZARD_WRITE_AFTER_READ))
            return false;
    now->writer = (uint32_t)(access - graph->accesses);
    now->first_reader = ENGINE_DEPENDENCY_NONE;
    return true;
}

static bool link_access(engine_dependency_graph *graph, history *past,
                        const engine_dependency_access *access) {
    const engine_dependency_resource *resource = &graph->resources[access->resource];
    for (uint32_t i = 0; i < engine_access_size(access); i++) {
        uint32_t subresource = engine_access_subresource(graph, access, i);
        subresource_history *now = &past->subresources[resource->first_subresource + subresource];
        graph->sources[access->first_source + i] = now->writer;
        if (access->kind != ENGINE_ACCESS_WRITE && !link_read(graph, past, access, subresource))
            return false;
        if (access->kind == ENGINE_ACCESS_READ)
            add_reader(past, now, access->pass);
        else if (!link_write(graph, past, access, subresource))
            return false;
    }
    return true;
}

/// An output is all content that the resource has; it must have some.
static bool link_output(engine_dependency_graph *graph, history *past,
                        const engine_dependency_access *access) {
    const engine_dependency_resource *resource = &graph->resources[access->resource];
    bool written = false;
    for (uint32_t i = 0; i < engine_access_size(access); i++) {
        uint32_t subresource = engine_access_subresource(graph, access, i);
        subresource_history *now = &past->subresources[resource->first_subresource + subresource];
        graph->sources[access->first_source + i] = now->writer;
        now->is_output = now->writer != ENGINE_DEPENDENCY_NONE;
        written = written || now->is_output || has_content_at_start(resource, subresource);
    }
    return written || fail(graph, ENGINE_FAULT_NEVER_WRITTEN, access, 0);
}

static int compare_edges(const void *a, const void *b) {
    const engine_dependency_edge *first = a, *second = b;
    if (first->to != second->to)
        return first->to < second->to ? -1 : 1;
    if (first->from != second->from)
        return first->from < second->from ? -1 : 1;
    return 0;
}

static void merge_edges(engine_dependency_graph *graph) {
    if (graph->edge_count == 0)
        return;
    engine_sort(graph->edges, graph->edge_count, sizeof *graph->edges, compare_edges);
    uint32_t kept = 0;
    for (uint32_t i = 1; i < graph->edge_count; i++) {
        if (compare_edges(&graph->edges[kept], &graph->edges[i]) == 0)
            graph->edges[kept].hazards |= graph->edges[i].hazards;
        else
            graph->edges[++kept] = graph->edges[i];
    }
    graph->edge_count = kept + 1;
}

bool engine_dependency_link(engine_dependency_graph *graph) {
    history past = {0};
    bool ok = history_create(graph, &past);
    if (!ok)
        engine_dependency_fail(graph, (engine_dependency_fault){.kind = ENGINE_FAULT_MEMORY});
    for (uint32_t i = 0; ok && i < graph->access_count; i++) {
        const engine_dependency_access *access = &graph->accesses[i];
        ok = access->pass == ENGINE_DEPENDENCY_NONE ? link_output(graph, &past, access)
                                                    : link_access(graph, &past, access);
    }
    if (ok)
        merge_edges(graph);
    return ok;
}
