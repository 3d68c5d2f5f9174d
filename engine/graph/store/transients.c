#include "engine/graph/store/store.h"

#include <stdio.h>

#include "engine/graph/declare/declare.h"
#include "engine/graph/plan/alias.h"

// ---------------------------------------------------------------------------------------------
// Whether the transients are those of the last frame

static bool is_placed(const lobe_graph *graph, uint32_t index) {
    return graph->frame.resources[index].origin == ENGINE_GRAPH_TRANSIENT &&
           graph->frame.dependencies.resources[index].first_position != ENGINE_DEPENDENCY_NONE;
}

static bool has_transients(const lobe_graph *graph) {
    bool has = false;
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++)
        has = has || is_placed(graph, i);
    return has;
}

/// Mixes in which of the transients declared before this one are alive at the same time as it: the
/// placement depends on nothing else about their lifetimes.
static engine_stamp mix_neighbours(engine_stamp stamp, const lobe_graph *graph, uint32_t index) {
    const engine_dependency_resource *resources = graph->frame.dependencies.resources;
    uint32_t rank = 0;
    for (uint32_t i = 0; i < index; i++) {
        if (!is_placed(graph, i))
            continue;
        rank++;
        if (resources[i].first_position <= resources[index].last_position &&
            resources[index].first_position <= resources[i].last_position)
            stamp = engine_stamp_mix(stamp, rank);
    }
    return stamp;
}

static engine_stamp plan_stamp(const lobe_graph *graph) {
    engine_stamp stamp = engine_stamp_mix(ENGINE_STAMP_NONE, 0);
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        const engine_graph_resource *resource = &graph->frame.resources[i];
        const engine_dependency_resource *dependency = &graph->frame.dependencies.resources[i];
        if (!is_placed(graph, i))
            continue;
        stamp = engine_stamp_text(stamp, resource->name);
        stamp = engine_stamp_mix(stamp, dependency->identity);
        stamp = engine_stamp_mix(stamp, resource->usage);
        stamp = engine_stamp_mix(stamp, resource->cube);
        stamp = mix_neighbours(stamp, graph, i);
    }
    return stamp;
}

void engine_graph_free_transients(lobe_graph *graph, engine_graph_transients *transients) {
    for (uint32_t i = 0; i < transients->count; i++)
        engine_graph_free_object(graph->device, &transients->objects[i]);
    for (uint32_t i = 0; i < transients->block_count; i++)
        engine_memory_free(graph->device->memory, &transients->memory[i]);
    lobe_release(transients->objects);
    lobe_release(transients->requests);
    lobe_release(transients->blocks);
    lobe_release(transients->memory);
    *transients = (engine_graph_transients){0};
}

static lobe_result allocate_tables(lobe_graph *graph) {
    engine_graph_transients *transients = &graph->kept.transients;
    uint32_t count = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++)
        count += is_placed(graph, i);
    transients->objects =
        lobe_allocate(graph->device->host.allocator, count + 1, sizeof *transients->objects);
    transients->requests =
        lobe_allocate(graph->device->host.allocator, count + 1, sizeof *transients->requests);
    transients->blocks =
        lobe_allocate(graph->device->host.allocator, count + 1, sizeof *transients->blocks);
    transients->memory =
        lobe_allocate(graph->device->host.allocator, count + 1, sizeof *transients->memory);
    if (!transients->objects || !transients->requests || !transients->blocks || !transients->memory)
        return engine_graph_fail_memory(graph);
    transients->count = count;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Blocks: one for each kind of memory

typedef struct block_plan {
    uint32_t memory_types;
    bool linear;
    uint64_t alignment, size;
    const char *largest; ///< name, for the error line
    uint64_t largest_size;
    uint32_t members;
} block_plan;

static uint32_t find_block(block_plan *blocks, uint32_t *block_count, uint32_t memory_types,
                           bool linear) {
    for (uint32_t i = 0; i < *block_count; i++)
        if (blocks[i].memory_types == memory_types && blocks[i].linear == linear)
            return i;
    blocks[*block_count] =
        (block_plan){.memory_types = memory_types, .linear = linear, .alignment = 1};
    return (*block_count)++;
}

static void join_block(block_plan *block, const char *name,
                       const VkMemoryRequirements *requirements) {
    block->members++;
    if (requirements->alignment > block->alignment)
        block->alignment = requirements->alignment;
    if (requirements->size > block->largest_size) {
        block->largest_size = requirements->size;
        block->largest = name;
    }
}

static lobe_result create_objects(lobe_graph *graph, block_plan *blocks) {
    engine_graph_transients *transients = &graph->kept.transients;
    uint32_t made = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        engine_graph_resource *resource = &graph->frame.resources[i];
        if (!is_placed(graph, i))
            continue;
        VkMemoryRequirements requirements = {0};
        lobe_result result = engine_graph_create_object(graph->device, resource,
                                                        &transients->objects[made], &requirements);
        if (result != LOBE_OK)
            return result;
        transients->requests[made] =
            (engine_alias_request){.size = requirements.size,
                                   .alignment = requirements.alignment,
                                   .first = graph->frame.dependencies.resources[i].first_position,
                                   .last = graph->frame.dependencies.resources[i].last_position};
        uint32_t block = find_block(blocks, &transients->block_count, requirements.memoryTypeBits,
                                    !resource->is_image);
        join_block(&blocks[block], resource->name, &requirements);
        transients->blocks[made++] = block;
    }
    return LOBE_OK;
}

/// Plans one block; leaves the requests of other blocks alone.
static bool plan_block(lobe_graph *graph, uint32_t block, block_plan *plan,
                       engine_alias_request *scratch) {
    engine_graph_transients *transients = &graph->kept.transients;
    uint32_t count = 0;
    uint64_t shared = 0, separate = 0;
    for (uint32_t i = 0; i < transients->count; i++)
        if (transients->blocks[i] == block)
            scratch[count++] = transients->requests[i];
    if (!engine_alias_plan(graph->device->host.allocator, scratch, count, &shared, &separate))
        return false;
    for (uint32_t i = 0, j = 0; i < transients->count; i++)
        if (transients->blocks[i] == block)
            transients->requests[i] = scratch[j++];
    plan->size = shared;
    transients->shared_bytes += shared;
    transients->separate_bytes += separate;
    return true;
}

static lobe_result allocate_block(lobe_graph *graph, uint32_t block, const block_plan *plan) {
    char name[256];
    if (plan->members > 1)
        snprintf(name, sizeof name, "%s (and %u more transients)", plan->largest,
                 plan->members - 1);
    else
        snprintf(name, sizeof name, "%s", plan->largest);
    engine_memory_request request = {
        .name = name,
        .requirements = {.size = plan->size,
                         .alignment = plan->alignment,
                         .memoryTypeBits = plan->memory_types},
        .place = ENGINE_MEMORY_DEVICE,
        .linear = plan->linear,
    };
    return engine_memory_allocate(graph->device->memory, &request,
                                  &graph->kept.transients.memory[block]);
}

static lobe_result allocate_blocks(lobe_graph *graph, block_plan *blocks) {
    engine_graph_transients *transients = &graph->kept.transients;
    engine_alias_request *scratch =
        lobe_allocate(graph->device->host.allocator, transients->count + 1, sizeof *scratch);
    lobe_result result = scratch ? LOBE_OK : engine_graph_fail_memory(graph);
    for (uint32_t i = 0; result == LOBE_OK && i < transients->block_count; i++) {
        if (!plan_block(graph, i, &blocks[i], scratch))
            result = engine_graph_fail_memory(graph);
        else
            result = allocate_block(graph, i, &blocks[i]);
    }
    lobe_release(scratch);
    return result;
}

static lobe_result bind_objects(lobe_graph *graph) {
    engine_graph_transients *transients = &graph->kept.transients;
    for (uint32_t i = 0, made = 0; i < graph->frame.dependencies.resource_count; i++) {
        if (!is_placed(graph, i))
            continue;
        lobe_result result = engine_graph_bind_object(
            graph->device, graph->frame.resources[i].name, &transients->objects[made],
            &transients->memory[transients->blocks[made]], transients->requests[made].offset);
        if (result != LOBE_OK)
            return result;
        made++;
    }
    return LOBE_OK;
}

static lobe_result make_transients(lobe_graph *graph) {
    lobe_result result = allocate_tables(graph);
    block_plan *blocks = lobe_allocate(graph->device->host.allocator,
                                       graph->kept.transients.count + 1, sizeof *blocks);
    if (result == LOBE_OK && !blocks)
        result = engine_graph_fail_memory(graph);
    if (result == LOBE_OK)
        result = create_objects(graph, blocks);
    if (result == LOBE_OK)
        result = allocate_blocks(graph, blocks);
    if (result == LOBE_OK)
        result = bind_objects(graph);
    lobe_release(blocks);
    return result;
}

static void publish_transients(lobe_graph *graph) {
    engine_graph_transients *transients = &graph->kept.transients;
    for (uint32_t i = 0, made = 0; i < graph->frame.dependencies.resource_count; i++) {
        if (!is_placed(graph, i))
            continue;
        engine_dependency_resource *dependency = &graph->frame.dependencies.resources[i];
        dependency->placed = true;
        dependency->block = transients->blocks[made];
        dependency->offset = transients->requests[made].offset;
        dependency->size = transients->requests[made].size;
        graph->frame.resources[i].object = &transients->objects[made];
        graph->frame.resources[i].bytes = transients->requests[made].size;
        made++;
    }
}

/// Whether there is memory for the frame's transients, even if none shared it, beside what there
/// is.
static bool has_room_beside(const lobe_graph *graph) {
    lobe_device_memory memory;
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        const engine_graph_resource *resource = &graph->frame.resources[i];
        const lobe_range whole = {0, resource->levels, 0, resource->layers};
        if (is_placed(graph, i))
            bytes += engine_graph_range_bytes(resource, &whole) *
                     (resource->samples > 1 ? resource->samples : 1);
    }
    lobe_device_memory_query(graph->device, &memory);
    return memory.budget_bytes > memory.allocated_bytes &&
           2 * bytes <= memory.budget_bytes - memory.allocated_bytes;
}

/// What the last frame may still use goes when the device has finished it. Where there is little
/// memory for both, frames are waited for.
static lobe_result release_transients(lobe_graph *graph) {
    engine_graph_transients *transients = &graph->kept.transients;
    engine_graph_flight *last = graph->kept.last;
    lobe_result result = LOBE_OK;
    if (last && last->busy && last->transients.count == 0 && has_room_beside(graph)) {
        last->transients = *transients;
        *transients = (engine_graph_transients){0};
        return LOBE_OK;
    }
    if (transients->count > 0)
        result = engine_graph_finish_frames(graph);
    if (result == LOBE_OK)
        engine_graph_free_transients(graph, transients);
    return result;
}

lobe_result engine_graph_place_transients(lobe_graph *graph) {
    if (graph->frame.aside && !has_transients(graph))
        return LOBE_OK; // the next frame finds those of the last one
    engine_stamp plan = plan_stamp(graph);
    if (graph->kept.transients.plan != plan) {
        lobe_result result = release_transients(graph);
        if (result == LOBE_OK)
            result = make_transients(graph);
        if (result != LOBE_OK) {
            engine_graph_free_transients(graph, &graph->kept.transients);
            return result;
        }
        graph->kept.transients.plan = plan;
    }
    publish_transients(graph);
    return LOBE_OK;
}
