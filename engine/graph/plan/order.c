#include "engine/graph/plan/dependency_graph.h"

#include <string.h>

#include "engine/base/growing_array.h"

static bool reserve(engine_dependency_graph *graph) {
    return engine_array_reserve(graph->scratch.allocator, (void **)&graph->order,
                                &graph->order_capacity, (uint64_t)graph->pass_count + 1,
                                sizeof *graph->order) &&
           engine_array_reserve(graph->scratch.allocator, (void **)&graph->cycle,
                                &graph->cycle_capacity, (uint64_t)graph->pass_count + 1,
                                sizeof *graph->cycle);
}

/// The first pass in order of declaration that waits for nothing; NONE if all wait.
static uint32_t next_ready(const engine_dependency_graph *graph, const uint32_t *waiting) {
    for (uint32_t pass = 0; pass < graph->pass_count; pass++)
        if (waiting[pass] == 0)
            return pass;
    return ENGINE_DEPENDENCY_NONE;
}

static void release_successors(const engine_dependency_graph *graph, uint32_t pass,
                               uint32_t *waiting) {
    for (uint32_t i = 0; i < graph->edge_count; i++)
        if (graph->edges[i].from == pass)
            waiting[graph->edges[i].to]--;
}

static uint32_t waiting_predecessor(const engine_dependency_graph *graph, const uint32_t *waiting,
                                    uint32_t pass) {
    for (uint32_t i = 0; i < graph->edge_count; i++)
        if (graph->edges[i].to == pass && waiting[graph->edges[i].from] != ENGINE_DEPENDENCY_NONE)
            return graph->edges[i].from;
    return ENGINE_DEPENDENCY_NONE;
}

static bool is_on_walk(const uint32_t *walk, uint32_t length, uint32_t pass) {
    for (uint32_t i = 0; i < length; i++)
        if (walk[i] == pass)
            return true;
    return false;
}

/// Every pass that still waits has a predecessor that still waits. Following those must return to a
/// pass already visited; from there on, the walk is the cycle in reverse.
static void find_cycle(engine_dependency_graph *graph, const uint32_t *waiting) {
    uint32_t *walk = graph->cycle, length = 0, pass = 0;
    while (waiting[pass] == ENGINE_DEPENDENCY_NONE)
        pass++;
    for (; !is_on_walk(walk, length, pass); pass = waiting_predecessor(graph, waiting, pass))
        walk[length++] = pass;
    uint32_t start = 0;
    while (walk[start] != pass)
        start++;
    graph->cycle_count = length - start;
    memmove(walk, walk + start, graph->cycle_count * sizeof *walk);
}

static void reverse(uint32_t *items, uint32_t count) {
    for (uint32_t i = 0; i < count / 2; i++) {
        uint32_t swapped = items[i];
        items[i] = items[count - 1 - i];
        items[count - 1 - i] = swapped;
    }
}

/// Puts the cycle in order of execution, starting with the pass declared first. Reversing both
/// parts and then everything is a rotation.
static void arrange_cycle(engine_dependency_graph *graph) {
    uint32_t *cycle = graph->cycle, count = graph->cycle_count, first = 0;
    reverse(cycle, count);
    for (uint32_t i = 1; i < count; i++)
        if (cycle[i] < cycle[first])
            first = i;
    reverse(cycle, first);
    reverse(cycle + first, count - first);
    reverse(cycle, count);
}

/// A resource that two neighbours in the cycle share, for the message.
static uint32_t cycle_resource(const engine_dependency_graph *graph) {
    uint32_t first = graph->cycle[0], second = graph->cycle[1 % graph->cycle_count];
    for (uint32_t i = graph->passes[first].first_access; i != ENGINE_DEPENDENCY_NONE;
         i = graph->accesses[i].next)
        for (uint32_t j = graph->passes[second].first_access; j != ENGINE_DEPENDENCY_NONE;
             j = graph->accesses[j].next)
            if (graph->accesses[i].resource == graph->accesses[j].resource &&
                (graph->accesses[i].kind != ENGINE_ACCESS_READ ||
                 graph->accesses[j].kind != ENGINE_ACCESS_READ))
                return graph->accesses[i].resource;
    return ENGINE_DEPENDENCY_NONE;
}

static bool fail_cycle(engine_dependency_graph *graph, const uint32_t *waiting) {
    find_cycle(graph, waiting);
    arrange_cycle(graph);
    return engine_dependency_fail(
        graph, (engine_dependency_fault){.kind = ENGINE_FAULT_CYCLE,
                                         .pass = graph->cycle[0],
                                         .resource = cycle_resource(graph),
                                         .other_pass = graph->cycle[1 % graph->cycle_count]});
}

bool engine_dependency_order(engine_dependency_graph *graph) {
    uint32_t *waiting = engine_arena_allocate(&graph->scratch, graph->pass_count * sizeof *waiting);
    bool ok = waiting && reserve(graph);
    if (!ok)
        engine_dependency_fail(graph, (engine_dependency_fault){.kind = ENGINE_FAULT_MEMORY});
    for (uint32_t i = 0; ok && i < graph->edge_count; i++)
        waiting[graph->edges[i].to]++;
    graph->order_count = 0;
    while (ok && graph->order_count < graph->pass_count) {
        uint32_t pass = next_ready(graph, waiting);
        ok = pass != ENGINE_DEPENDENCY_NONE || fail_cycle(graph, waiting);
        if (!ok)
            break;
        waiting[pass] = ENGINE_DEPENDENCY_NONE; // placed
        graph->order[graph->order_count++] = pass;
        release_successors(graph, pass, waiting);
    }
    return ok;
}
