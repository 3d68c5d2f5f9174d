#include "engine/graph/store/store.h"

#include "engine/resource/shared.h"

/// By which graphs find an image.
static engine_stamp stamp_of(engine_stamp identity, VkFlags usage, const engine_stamp *stamps,
                             uint32_t subresource_count) {
    engine_stamp stamp = engine_stamp_text(ENGINE_STAMP_NONE, "retained image");
    stamp = engine_stamp_mix(engine_stamp_mix(stamp, identity), usage);
    return engine_stamp_bytes(stamp, stamps, subresource_count * sizeof *stamps);
}

static engine_stamp stamp_of_kept(const engine_graph_retained *kept) {
    return stamp_of(kept->identity, kept->usage, kept->stamps, kept->subresource_count);
}

/// Whether it is finished and at rest, and other graphs do not know of it: while an image is made
/// over several frames, whoever shared it would have to begin again.
static bool is_private(const engine_graph_retained *kept) {
    for (uint32_t i = 0; kept->shared && i < kept->subresource_count; i++)
        if (kept->stamps[i] == ENGINE_STAMP_NONE || kept->layouts[i] != ENGINE_LAYOUT_SAMPLED)
            return false;
    return kept->shared && !kept->lent && !kept->separate;
}

void engine_graph_publish_retained(lobe_graph *graph) {
    for (engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next) {
        if (!is_private(kept))
            continue;
        kept->shared->stamp = stamp_of_kept(kept);
        kept->shared->object = (engine_object){
            .image = kept->object.image, .allocation = kept->allocation, .shared = kept->shared};
        kept->lent = engine_shared_publish(graph->device, kept->shared);
    }
}

// ---------------------------------------------------------------------------------------------
// What the frame writes

/// After a resource got other content.
static lobe_result find_running(lobe_graph *graph) {
    if (!engine_dependency_cull(&graph->frame.dependencies))
        return engine_graph_fail_dependency(graph);
    engine_dependency_find_lifetimes(&graph->frame.dependencies);
    return LOBE_OK;
}

/// By resource: whether a pass that runs writes it. NULL if out of memory.
static bool *find_written(lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    bool *written =
        engine_arena_allocate(&graph->frame.arena, dependencies->resource_count * sizeof *written);
    for (uint32_t i = 0; written && i < dependencies->running_count; i++)
        for (uint32_t a = dependencies->passes[dependencies->running[i]].first_access;
             a != ENGINE_DEPENDENCY_NONE; a = dependencies->accesses[a].next)
            if (dependencies->accesses[a].kind != ENGINE_ACCESS_READ)
                written[dependencies->accesses[a].resource] = true;
    return written;
}

/// By subresource of all resources: the stamp of what the frame's passes leave there. NULL if out
/// of memory.
static engine_stamp *find_content(lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    engine_stamp *stamps = engine_arena_allocate(&graph->frame.arena,
                                                 dependencies->subresource_count * sizeof *stamps);
    for (uint32_t i = 0; stamps && i < dependencies->access_count; i++) {
        const engine_dependency_access *access = &dependencies->accesses[i];
        if (access->kind == ENGINE_ACCESS_READ || !dependencies->passes[access->pass].live)
            continue;
        const uint32_t first = dependencies->resources[access->resource].first_subresource;
        for (uint32_t n = 0; n < engine_access_size(access); n++) {
            const uint32_t s = engine_access_subresource(dependencies, access, n);
            stamps[first + s] = engine_dependency_content(dependencies, i, access->resource, s);
        }
    }
    return stamps;
}

// ---------------------------------------------------------------------------------------------
// Taking what others have

static void hold(engine_graph_retained *kept, engine_shared *shared, const engine_stamp *stamps) {
    kept->shared = shared;
    kept->lent = true;
    kept->object.image = shared->object.image;
    kept->allocation = shared->object.allocation;
    for (uint32_t i = 0; i < kept->subresource_count; i++) {
        kept->stamps[i] = stamps[i];
        kept->layouts[i] = ENGINE_LAYOUT_SAMPLED;
    }
}

static void let_go(lobe_graph *graph, engine_shared *shared) {
    engine_object object = shared->object;
    engine_object_destroy(graph->device, &object);
}

/// `stamps`: of what the passes would write. `*taken` is true if another graph has it.
static lobe_result take(lobe_graph *graph, uint32_t index, const engine_stamp *stamps,
                        bool *taken) {
    engine_graph_resource *resource = &graph->frame.resources[index];
    const engine_stamp identity = graph->frame.dependencies.resources[index].identity;
    const VkFlags usage = resource->retained ? resource->retained->usage : resource->usage;
    const engine_stamp stamp =
        stamp_of(identity, usage, stamps, resource->levels * resource->layers);
    engine_shared *found = engine_shared_find(graph->device, stamp, graph->kept.uploads.number);
    if (!found)
        return LOBE_OK;
    const lobe_result result =
        resource->retained ? LOBE_OK : engine_graph_add_retained(graph, index);
    if (result == LOBE_OK)
        hold(resource->retained, found, stamps);
    else
        let_go(graph, found);
    *taken = true;
    return result;
}

/// Whether it could be taken: the graph has no object to write it to.
static bool is_wanted(const engine_graph_resource *resource) {
    return resource->shared && !(resource->retained && resource->retained->object.image);
}

static lobe_result take_all(lobe_graph *graph, const bool *written) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    const engine_stamp *stamps = NULL;
    bool taken = false;
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < dependencies->resource_count; i++) {
        if (!written[i] || !is_wanted(&graph->frame.resources[i]))
            continue;
        if (!stamps && !(stamps = find_content(graph)))
            return engine_graph_fail_memory(graph);
        result = take(graph, i, stamps + dependencies->resources[i].first_subresource, &taken);
    }
    return result == LOBE_OK && taken ? find_running(graph) : result;
}

/// Takes what another graph has in place of the same of this graph's own.
static lobe_result unite(lobe_graph *graph, engine_graph_retained *kept) {
    const engine_stamp *stamps = engine_arena_copy(&graph->frame.arena, kept->stamps,
                                                   kept->subresource_count * sizeof *stamps);
    if (!stamps)
        return engine_graph_fail_memory(graph);
    engine_shared *found =
        engine_shared_find(graph->device, stamp_of_kept(kept), graph->kept.uploads.number);
    if (!found)
        return LOBE_OK;
    const lobe_result result = engine_graph_finish_flights(graph);
    if (result != LOBE_OK) {
        let_go(graph, found);
        return result;
    }
    engine_graph_drop_retained(graph, kept);
    hold(kept, found, stamps);
    return LOBE_OK;
}

/// Graphs that began together made the same, and now one of them was first to publish it.
static lobe_result unite_all(lobe_graph *graph, const bool *written) {
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_retained *kept = graph->frame.resources[i].retained;
        if (kept && !written[i] && is_private(kept))
            result = unite(graph, kept);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// Writing

/// For this graph alone. Where others hold the object, they keep it: the passes make another one.
static lobe_result take_back(lobe_graph *graph, engine_graph_retained *kept, bool *lost) {
    kept->lent = !engine_shared_claim(graph->device, kept->shared);
    if (!kept->lent)
        return LOBE_OK;
    const lobe_result result = engine_graph_finish_flights(graph);
    if (result != LOBE_OK)
        return result;
    engine_graph_drop_retained(graph, kept);
    *lost = true;
    return LOBE_OK;
}

static lobe_result take_back_all(lobe_graph *graph, const bool *written, bool *lost) {
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_retained *kept = graph->frame.resources[i].retained;
        if (written[i] && kept && kept->lent)
            result = take_back(graph, kept, lost);
    }
    return result;
}

/// What was lost makes more passes run, and these may write more.
static lobe_result take_back_written(lobe_graph *graph) {
    lobe_result result = LOBE_OK;
    for (bool lost = true; result == LOBE_OK && lost;) {
        const bool *written = find_written(graph);
        if (!written)
            return engine_graph_fail_memory(graph);
        lost = false;
        result = take_back_all(graph, written, &lost);
        if (result == LOBE_OK && lost)
            result = find_running(graph);
    }
    return result;
}

lobe_result engine_graph_share_retained(lobe_graph *graph) {
    const bool *written = find_written(graph);
    if (!written)
        return engine_graph_fail_memory(graph);
    lobe_result result = unite_all(graph, written);
    if (result == LOBE_OK)
        result = take_all(graph, written);
    return result == LOBE_OK ? take_back_written(graph) : result;
}
