#include "engine/graph/plan/dependency_graph.h"

#include <string.h>

#include "engine/base/growing_array.h"
#include "engine/base/sort.h"

/// What one pass does to one subresource, united over all its accesses.
typedef struct subresource_use {
    uint32_t position;
    uint32_t resource;
    uint32_t subresource;
    bool writes, modifies;
    engine_access_state state;
    engine_access_state group; ///< reads: united with the reads that follow before the next write
} subresource_use;

/// What must be waited for before a subresource can be used in another way.
typedef struct subresource_tracker {
    engine_layout layout;
    uint64_t write_stages, write_access;     ///< the last write (or transition)
    uint64_t reader_stages;                  ///< reads since that write
    uint64_t visible_stages, visible_access; ///< where that write is visible
    bool took_memory; ///< its first use must wait for the resources that used the memory before
} subresource_tracker;

typedef struct barrier_builder {
    engine_dependency_graph *graph;
    subresource_use *uses; ///< sorted by position, resource, subresource
    uint32_t use_count;
    subresource_tracker *trackers; ///< by subresource
    bool *started;                 ///< by resource: something has used it
    uint32_t *slots;   ///< by subresource: index of its newest use; valid if that is of this pass
    uint32_t *general; ///< by resource: position + 1 of a pass whose reads differ in layout, or 0
} barrier_builder;

// ---------------------------------------------------------------------------------------------
// What each pass does to each subresource

static void append_use(barrier_builder *builder, uint32_t position,
                       const engine_dependency_access *access, uint32_t subresource) {
    builder->uses[builder->use_count++] =
        (subresource_use){.position = position,
                          .resource = access->resource,
                          .subresource = subresource,
                          .writes = access->kind != ENGINE_ACCESS_READ,
                          .modifies = access->kind == ENGINE_ACCESS_MODIFY,
                          .state = access->state};
}

/// Unites an access with the pass's other accesses of the subresource. If two reads need different
/// layouts, all reads of the resource by this pass use the general layout.
static void add_use(barrier_builder *builder, uint32_t position, uint32_t first,
                    const engine_dependency_access *access, uint32_t subresource) {
    const engine_dependency_resource *resource = &builder->graph->resources[access->resource];
    uint32_t *slot = &builder->slots[resource->first_subresource + subresource];
    if (*slot < first || *slot >= builder->use_count) {
        *slot = builder->use_count;
        append_use(builder, position, access, subresource);
        return;
    }
    engine_access_state *state = &builder->uses[*slot].state;
    state->stages |= access->state.stages;
    state->access |= access->state.access;
    if (state->layout != access->state.layout)
        builder->general[access->resource] = position + 1;
}

static void add_uses_of_access(barrier_builder *builder, uint32_t position, uint32_t first,
                               const engine_dependency_access *access) {
    for (uint32_t i = 0; i < engine_access_size(access); i++)
        add_use(builder, position, first, access,
                engine_access_subresource(builder->graph, access, i));
}

/// Gives reads of the resources marked in `general` the general layout.
static void unite_layouts(barrier_builder *builder, uint32_t position, uint32_t first) {
    engine_dependency_graph *graph = builder->graph;
    const engine_dependency_pass *pass = &graph->passes[graph->running[position]];
    for (uint32_t i = first; i < builder->use_count; i++)
        if (!builder->uses[i].writes && builder->general[builder->uses[i].resource] == position + 1)
            builder->uses[i].state.layout = ENGINE_LAYOUT_GENERAL;
    for (uint32_t i = pass->first_access; i != ENGINE_DEPENDENCY_NONE;
         i = graph->accesses[i].next) {
        engine_dependency_access *access = &graph->accesses[i];
        if (access->kind == ENGINE_ACCESS_READ &&
            builder->general[access->resource] == position + 1)
            access->state.layout = ENGINE_LAYOUT_GENERAL;
    }
}

static int compare_uses(const void *a, const void *b) {
    const subresource_use *first = a, *second = b;
    if (first->resource != second->resource)
        return first->resource < second->resource ? -1 : 1;
    return first->subresource < second->subresource ? -1 : first->subresource > second->subresource;
}

static void list_uses(barrier_builder *builder) {
    const engine_dependency_graph *graph = builder->graph;
    for (uint32_t position = 0; position < graph->running_count; position++) {
        const engine_dependency_pass *pass = &graph->passes[graph->running[position]];
        uint32_t first = builder->use_count;
        for (uint32_t i = pass->first_access; i != ENGINE_DEPENDENCY_NONE;
             i = graph->accesses[i].next)
            add_uses_of_access(builder, position, first, &graph->accesses[i]);
        unite_layouts(builder, position, first);
        // Neighbouring subresources become adjacent, so that they can share a barrier.
        engine_sort(builder->uses + first, builder->use_count - first, sizeof *builder->uses,
                    compare_uses);
    }
}

/// Backwards, so that a barrier before the first of several reads makes the content visible to all.
static bool group_reads(barrier_builder *builder) {
    const engine_dependency_graph *graph = builder->graph;
    const subresource_use **next =
        engine_arena_allocate(&builder->graph->scratch, graph->subresource_count * sizeof *next);
    if (!next)
        return false;
    for (uint32_t i = builder->use_count; i-- > 0;) {
        subresource_use *use = &builder->uses[i];
        const subresource_use **after =
            &next[graph->resources[use->resource].first_subresource + use->subresource];
        use->group = use->state;
        if (*after && !use->writes && !(*after)->writes &&
            (*after)->state.layout == use->state.layout) {
            use->group.stages |= (*after)->group.stages;
            use->group.access |= (*after)->group.access;
        }
        *after = use;
    }
    return true;
}

// ---------------------------------------------------------------------------------------------
// Memory that several resources share

static bool shared_memory(const engine_dependency_resource *a,
                          const engine_dependency_resource *b) {
    return a->placed && b->placed && a->block == b->block && a->offset < b->offset + b->size &&
           b->offset < a->offset + a->size;
}

/// Stages and writes of all resources that used this one's memory before.
static engine_access_state former_tenants(const barrier_builder *builder, uint32_t index) {
    const engine_dependency_graph *graph = builder->graph;
    const engine_dependency_resource *resource = &graph->resources[index];
    engine_access_state former = {0};
    for (uint32_t i = 0; i < graph->resource_count; i++) {
        const engine_dependency_resource *other = &graph->resources[i];
        if (i == index || !shared_memory(resource, other) ||
            other->last_position >= resource->first_position)
            continue;
        for (uint32_t s = 0; s < other->levels * other->layers; s++) {
            const subresource_tracker *last = &builder->trackers[other->first_subresource + s];
            former.stages |= last->write_stages | last->reader_stages;
            former.access |= last->write_access;
        }
    }
    return former;
}

static void start_resource(barrier_builder *builder, uint32_t index) {
    const engine_dependency_resource *resource = &builder->graph->resources[index];
    engine_access_state former = former_tenants(builder, index);
    for (uint32_t s = 0; s < resource->levels * resource->layers; s++) {
        subresource_tracker *tracker = &builder->trackers[resource->first_subresource + s];
        tracker->layout =
            resource->start_layouts ? resource->start_layouts[s] : ENGINE_LAYOUT_UNDEFINED;
        tracker->write_stages = former.stages;
        tracker->write_access = former.access;
        tracker->took_memory = former.stages != 0;
        if (resource->borrowed)
            *tracker = (subresource_tracker){.layout = resource->before.layout,
                                             .write_stages = resource->before.stages,
                                             .write_access = resource->before.access};
    }
    builder->started[index] = true;
}

// ---------------------------------------------------------------------------------------------
// Barriers

static bool add_barrier(engine_dependency_graph *graph, const engine_dependency_barrier *barrier) {
    if (!engine_array_reserve(graph->scratch.allocator, (void **)&graph->barriers,
                              &graph->barrier_capacity, (uint64_t)graph->barrier_count + 1,
                              sizeof *graph->barriers))
        return false;
    graph->barriers[graph->barrier_count++] = *barrier;
    return true;
}

static bool same_state(const engine_access_state *a, const engine_access_state *b) {
    return a->stages == b->stages && a->access == b->access && a->layout == b->layout;
}

static bool same_transition(const engine_dependency_barrier *a,
                            const engine_dependency_barrier *b) {
    return a->position == b->position && a->resource == b->resource &&
           same_state(&a->from, &b->from) && same_state(&a->to, &b->to);
}

/// Layers come in order within a level: adds this one to the previous barrier if it is the same.
static bool extend_layers(engine_dependency_barrier *last, const engine_dependency_barrier *next) {
    if (!same_transition(last, next) || last->range.level_count != 1 ||
        last->range.first_level != next->range.first_level ||
        last->range.first_layer + last->range.layer_count != next->range.first_layer)
        return false;
    last->range.layer_count++;
    return true;
}

/// Levels come in order: unites barriers that differ only in adjacent levels.
static void extend_levels(engine_dependency_graph *graph) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < graph->barrier_count; i++) {
        engine_dependency_barrier *barrier = &graph->barriers[i];
        engine_dependency_barrier *last = kept ? &graph->barriers[kept - 1] : NULL;
        if (last && last->resource != ENGINE_DEPENDENCY_NONE && same_transition(last, barrier) &&
            last->range.first_layer == barrier->range.first_layer &&
            last->range.layer_count == barrier->range.layer_count &&
            last->range.first_level + last->range.level_count == barrier->range.first_level)
            last->range.level_count += barrier->range.level_count;
        else
            graph->barriers[kept++] = *barrier;
    }
    graph->barrier_count = kept;
}

static bool emit(barrier_builder *builder, const subresource_use *use, engine_access_state from,
                 engine_access_state to) {
    engine_dependency_graph *graph = builder->graph;
    uint32_t layers = graph->resources[use->resource].layers;
    engine_dependency_barrier barrier = {
        .position = use->position,
        .resource = use->resource,
        .range = {use->subresource / layers, 1, use->subresource % layers, 1},
        .from = from,
        .to = to};
    if (graph->barrier_count > 0 &&
        extend_layers(&graph->barriers[graph->barrier_count - 1], &barrier))
        return true;
    return add_barrier(graph, &barrier);
}

/// Other resources wrote the same memory, which only a barrier on all memory can order. One per
/// pass is enough.
static bool emit_memory(barrier_builder *builder, uint32_t first_barrier,
                        const subresource_use *use, const subresource_tracker *tracker) {
    engine_dependency_graph *graph = builder->graph;
    engine_dependency_barrier *memory = NULL;
    for (uint32_t i = first_barrier; i < graph->barrier_count; i++)
        if (graph->barriers[i].resource == ENGINE_DEPENDENCY_NONE)
            memory = &graph->barriers[i];
    if (!memory) {
        engine_dependency_barrier added = {.position = use->position,
                                           .resource = ENGINE_DEPENDENCY_NONE};
        if (!add_barrier(graph, &added))
            return false;
        memory = &graph->barriers[graph->barrier_count - 1];
    }
    memory->from.stages |= tracker->write_stages;
    memory->from.access |= tracker->write_access;
    memory->to.stages |= use->state.stages;
    memory->to.access |= use->state.access;
    return true;
}

static bool track_write(barrier_builder *builder, const subresource_use *use,
                        subresource_tracker *tracker) {
    engine_access_state from = {.stages = tracker->write_stages | tracker->reader_stages,
                                .access = tracker->write_access,
                                .layout =
                                    use->modifies ? tracker->layout : ENGINE_LAYOUT_UNDEFINED};
    bool transition = tracker->layout != use->state.layout;
    // Without a layout transition, discarding the content gains nothing.
    if (!transition)
        from.layout = tracker->layout;
    bool image = use->state.layout != ENGINE_LAYOUT_UNDEFINED;
    bool needed = transition || (from.stages != 0 && (image || !tracker->took_memory));
    if (needed && !emit(builder, use, from, use->state))
        return false;
    *tracker = (subresource_tracker){.layout = use->state.layout,
                                     .write_stages = use->state.stages,
                                     .write_access = use->state.access};
    return true;
}

static bool is_visible(const subresource_use *use, const subresource_tracker *tracker) {
    if (tracker->write_stages == 0)
        return true; // from before this frame
    return (use->state.stages & ~tracker->visible_stages) == 0 &&
           (use->state.access & ~tracker->visible_access) == 0;
}

static bool track_read(barrier_builder *builder, const subresource_use *use,
                       subresource_tracker *tracker) {
    bool transition = tracker->layout != use->state.layout;
    if (transition || !is_visible(use, tracker)) {
        engine_access_state from = {.stages = tracker->write_stages,
                                    .access = tracker->write_access,
                                    .layout = tracker->layout};
        engine_access_state to = use->group;
        if (transition) {
            from.stages |= tracker->reader_stages; // a transition writes
        } else {
            to.stages |= tracker->visible_stages;
            to.access |= tracker->visible_access;
        }
        if (!emit(builder, use, from, to))
            return false;
        if (transition)
            *tracker = (subresource_tracker){.layout = to.layout, .write_stages = to.stages};
        tracker->visible_stages = to.stages;
        tracker->visible_access = to.access;
    }
    tracker->reader_stages |= use->state.stages;
    return true;
}

static bool track_use(barrier_builder *builder, uint32_t first_barrier,
                      const subresource_use *use) {
    const engine_dependency_resource *resource = &builder->graph->resources[use->resource];
    subresource_tracker *tracker =
        &builder->trackers[resource->first_subresource + use->subresource];
    if (tracker->took_memory && !emit_memory(builder, first_barrier, use, tracker))
        return false;
    return use->writes ? track_write(builder, use, tracker) : track_read(builder, use, tracker);
}

static bool derive(barrier_builder *builder) {
    uint32_t first_barrier = 0;
    for (uint32_t i = 0; i < builder->use_count; i++) {
        const subresource_use *use = &builder->uses[i];
        if (i > 0 && use->position != use[-1].position)
            first_barrier = builder->graph->barrier_count;
        if (!builder->started[use->resource])
            start_resource(builder, use->resource);
        if (!track_use(builder, first_barrier, use))
            return false;
    }
    return true;
}

/// Returns imported resources to the layout that they had at the start.
static bool restore_imports(barrier_builder *builder) {
    engine_dependency_graph *graph = builder->graph;
    for (uint32_t index = 0; index < graph->resource_count; index++) {
        const engine_dependency_resource *resource = &graph->resources[index];
        if (!resource->imported || !resource->start_layouts || !builder->started[index])
            continue;
        for (uint32_t s = 0; s < resource->levels * resource->layers; s++) {
            const subresource_tracker *last = &builder->trackers[resource->first_subresource + s];
            subresource_use use = {
                .position = graph->running_count, .resource = index, .subresource = s};
            engine_access_state from = {.stages = last->write_stages | last->reader_stages,
                                        .layout = last->layout};
            engine_access_state to = {.layout = resource->start_layouts[s]};
            if (from.layout != to.layout && !emit(builder, &use, from, to))
                return false;
        }
    }
    return true;
}

/// Brings one subresource to rest, if it has content.
static bool lay_to_rest(barrier_builder *builder, uint32_t index, uint32_t subresource) {
    const engine_dependency_resource *resource = &builder->graph->resources[index];
    subresource_tracker *last = &builder->trackers[resource->first_subresource + subresource];
    const subresource_use use = {
        .position = builder->graph->running_count, .resource = index, .subresource = subresource};
    const engine_access_state from = {.stages = last->write_stages | last->reader_stages,
                                      .access = last->write_access,
                                      .layout = last->layout};
    if (from.layout == ENGINE_LAYOUT_UNDEFINED || from.layout == resource->after.layout)
        return true;
    last->layout = resource->after.layout;
    return emit(builder, &use, from, resource->after);
}

static bool lay_all_to_rest(barrier_builder *builder) {
    const engine_dependency_graph *graph = builder->graph;
    for (uint32_t index = 0; index < graph->resource_count; index++) {
        const engine_dependency_resource *resource = &graph->resources[index];
        for (uint32_t s = 0; s < resource->levels * resource->layers; s++)
            if (resource->rests && builder->started[index] && !lay_to_rest(builder, index, s))
                return false;
    }
    return true;
}

/// Returns borrowed resources in the state that their owner asked for, whether used or not.
static bool return_borrowed(barrier_builder *builder) {
    engine_dependency_graph *graph = builder->graph;
    for (uint32_t index = 0; index < graph->resource_count; index++) {
        const engine_dependency_resource *resource = &graph->resources[index];
        if (!resource->borrowed)
            continue;
        if (!builder->started[index])
            start_resource(builder, index);
        for (uint32_t s = 0; s < resource->levels * resource->layers; s++) {
            const subresource_tracker *last = &builder->trackers[resource->first_subresource + s];
            subresource_use use = {
                .position = graph->running_count, .resource = index, .subresource = s};
            engine_access_state from = {.stages = last->write_stages | last->reader_stages,
                                        .access = last->write_access,
                                        .layout = last->layout};
            if (!emit(builder, &use, from, resource->after))
                return false;
        }
    }
    return true;
}

static void record_end_layouts(barrier_builder *builder) {
    engine_dependency_graph *graph = builder->graph;
    for (uint32_t index = 0; index < graph->resource_count; index++) {
        const engine_dependency_resource *resource = &graph->resources[index];
        for (uint32_t s = 0; s < resource->levels * resource->layers; s++) {
            engine_layout layout = builder->trackers[resource->first_subresource + s].layout;
            if (!builder->started[index] || resource->imported)
                layout =
                    resource->start_layouts ? resource->start_layouts[s] : ENGINE_LAYOUT_UNDEFINED;
            graph->end_layouts[resource->first_subresource + s] = layout;
        }
    }
}

static bool builder_create(barrier_builder *builder) {
    engine_dependency_graph *graph = builder->graph;
    engine_arena *scratch = &graph->scratch;
    const size_t subresources = graph->subresource_count, resources = graph->resource_count;
    // Each subresource of each access has one source, and makes at most one use.
    builder->uses = engine_arena_allocate(scratch, graph->source_count * sizeof *builder->uses);
    builder->trackers = engine_arena_allocate(scratch, subresources * sizeof *builder->trackers);
    builder->started = engine_arena_allocate(scratch, resources * sizeof *builder->started);
    builder->slots = engine_arena_allocate(scratch, subresources * sizeof *builder->slots);
    if (builder->slots)
        memset(builder->slots, 0xff, subresources * sizeof *builder->slots); // no use yet
    builder->general = engine_arena_allocate(scratch, resources * sizeof *builder->general);
    return builder->uses && builder->trackers && builder->started && builder->slots &&
           builder->general &&
           engine_array_reserve(graph->scratch.allocator, (void **)&graph->end_layouts,
                                &graph->end_layout_capacity, subresources + 1,
                                sizeof *graph->end_layouts);
}

bool engine_dependency_derive_barriers(engine_dependency_graph *graph) {
    barrier_builder builder = {.graph = graph};
    graph->barrier_count = 0;
    bool ok = builder_create(&builder);
    if (ok)
        list_uses(&builder);
    ok = ok && group_reads(&builder) && derive(&builder) && restore_imports(&builder) &&
         lay_all_to_rest(&builder) && return_borrowed(&builder);
    if (ok) {
        extend_levels(graph);
        record_end_layouts(&builder);
    } else {
        engine_dependency_fail(graph, (engine_dependency_fault){.kind = ENGINE_FAULT_MEMORY});
    }
    return ok;
}
