#include "engine/graph/report.h"

#include <string.h>

#include "engine/base/growing_array.h"
#include "engine/device/vulkan_check.h"
#include "engine/graph/declare/declare.h"

// ---------------------------------------------------------------------------------------------
// Bytes that each pass moves

enum { COUNTED_READ = 1, COUNTED_WRITTEN = 2 };

/// `counted` holds for each subresource the last pass that was counted (plus one, times four) and
/// the directions that were counted, so that it needs no clearing between passes.
static void count_access(lobe_pass *pass, const engine_dependency_access *access,
                         uint64_t *counted) {
    const lobe_graph *graph = pass->graph;
    const engine_graph_resource *resource = &graph->frame.resources[access->resource];
    const uint32_t first = graph->frame.dependencies.resources[access->resource].first_subresource;
    // Of a copy's target, what it modifies is not read.
    const uint64_t directions = access->kind == ENGINE_ACCESS_READ ? COUNTED_READ
                                : access->kind == ENGINE_ACCESS_WRITE || access->part_bytes
                                    ? COUNTED_WRITTEN
                                    : COUNTED_READ | COUNTED_WRITTEN;
    const uint64_t mine = ((uint64_t)pass->index + 1) << 2;
    for (uint32_t i = 0; i < engine_access_size(access); i++) {
        const uint32_t index = engine_access_subresource(&graph->frame.dependencies, access, i);
        const uint32_t layers = graph->frame.dependencies.resources[access->resource].layers;
        const lobe_range one = {.first_level = index / layers, .level_count = 1, .layer_count = 1};
        const uint64_t bytes =
            access->part_bytes ? access->part_bytes : engine_graph_range_bytes(resource, &one);
        uint64_t *mark = &counted[first + index];
        const uint64_t former = *mark >> 2 == mine >> 2 ? *mark & 3 : 0;
        pass->read_bytes += (directions & ~former & COUNTED_READ) ? bytes : 0;
        pass->written_bytes += (directions & ~former & COUNTED_WRITTEN) ? bytes : 0;
        *mark = mine | former | directions;
    }
}

lobe_result engine_graph_count_traffic(lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    const uint32_t count = dependencies->subresource_count;
    uint64_t *counted =
        engine_arena_allocate(&graph->frame.arena, (count + (size_t)1) * sizeof *counted);
    if (!counted)
        return engine_graph_fail_memory(graph);
    memset(counted, 0, count * sizeof *counted);
    for (uint32_t i = 0; i < dependencies->pass_count; i++) {
        uint32_t index = dependencies->passes[i].first_access;
        for (; index != ENGINE_DEPENDENCY_NONE; index = dependencies->accesses[index].next)
            count_access(graph->frame.passes[i], &dependencies->accesses[index], counted);
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Device times

static bool can_time(const lobe_graph *graph) {
    return graph->device->timestamp_bits > 0 && graph->frame.dependencies.running_count > 0;
}

lobe_result engine_graph_prepare_timestamps(lobe_graph *graph) {
    lobe_device *device = graph->device;
    uint32_t needed = 2 * graph->frame.dependencies.running_count;
    if (!can_time(graph) || needed <= graph->frame.flight->timestamp_capacity)
        return LOBE_OK;
    device->api.vkDestroyQueryPool(device->vulkan, graph->frame.flight->timestamps,
                                   device->callbacks);
    graph->frame.flight->timestamps = VK_NULL_HANDLE;
    graph->frame.flight->timestamp_capacity = 0;
    const VkQueryPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
        .queryType = VK_QUERY_TYPE_TIMESTAMP,
        .queryCount = needed,
    };
    lobe_result result =
        VULKAN_CHECK(&device->host,
                     device->api.vkCreateQueryPool(device->vulkan, &create, device->callbacks,
                                                   &graph->frame.flight->timestamps),
                     "render graph");
    if (result == LOBE_OK)
        graph->frame.flight->timestamp_capacity = needed;
    return result;
}

void engine_graph_reset_timestamps(lobe_graph *graph) {
    if (can_time(graph))
        graph->device->api.vkCmdResetQueryPool(graph->frame.commands,
                                               graph->frame.flight->timestamps, 0,
                                               graph->frame.flight->timestamp_capacity);
}

/// The timestamps on both sides of a pass wait for all previous commands. Otherwise overlapping
/// passes would count twice, and on a CPU driver, which executes commands one after the other,
/// every pass would appear to take no time.
void engine_graph_write_timestamp(lobe_graph *graph, uint32_t position, bool after) {
    if (can_time(graph))
        graph->device->api.vkCmdWriteTimestamp2(
            graph->frame.commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            graph->frame.flight->timestamps, 2 * position + after);
}

static double milliseconds_between(const lobe_graph *graph, uint64_t first, uint64_t last) {
    uint32_t bits = graph->device->timestamp_bits;
    uint64_t mask = bits >= 64 ? UINT64_MAX : ((uint64_t)1 << bits) - 1;
    return (double)((last - first) & mask) * graph->device->limits.timestampPeriod * 1e-6;
}

lobe_result engine_graph_read_timestamps(lobe_graph *graph) {
    uint32_t count = graph->frame.dependencies.running_count;
    if (!can_time(graph))
        return LOBE_OK;
    uint64_t *ticks = engine_arena_allocate(&graph->frame.arena, 2 * count * sizeof *ticks);
    if (!ticks)
        return engine_graph_fail_memory(graph);
    lobe_result result =
        VULKAN_CHECK(&graph->device->host,
                     graph->device->api.vkGetQueryPoolResults(
                         graph->device->vulkan, graph->frame.flight->timestamps, 0, 2 * count,
                         2 * count * sizeof *ticks, ticks, sizeof *ticks,
                         VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                     "render graph");
    if (result != LOBE_OK)
        return result;
    for (uint32_t i = 0; i < count; i++)
        graph->frame.passes[graph->frame.dependencies.running[i]]->milliseconds =
            milliseconds_between(graph, ticks[2 * i], ticks[2 * i + 1]);
    graph->frame.report.milliseconds = milliseconds_between(graph, ticks[0], ticks[2 * count - 1]);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// The report

static void add_pass(lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->frame.passes[index];
    if (pass->internal)
        return;
    graph->frame.pass_reports[graph->frame.report.pass_count++] =
        (lobe_pass_report){.name = pass->name,
                           .kind = pass->kind,
                           .state = graph->frame.dependencies.passes[index].state,
                           .milliseconds = pass->milliseconds,
                           .read_bytes = pass->read_bytes,
                           .written_bytes = pass->written_bytes};
}

static lobe_result list_passes(lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    if (!engine_array_reserve(graph->device->host.allocator, (void **)&graph->frame.pass_reports,
                              &graph->frame.report_capacity, (uint64_t)dependencies->pass_count + 1,
                              sizeof *graph->frame.pass_reports))
        return engine_graph_fail_memory(graph);
    graph->frame.report.passes = graph->frame.pass_reports;
    graph->frame.report.pass_count = 0;
    for (uint32_t i = 0; i < dependencies->running_count; i++)
        add_pass(graph, dependencies->running[i]);
    for (uint32_t i = 0; i < dependencies->order_count; i++)
        if (dependencies->passes[dependencies->order[i]].state != LOBE_PASS_RUN)
            add_pass(graph, dependencies->order[i]);
    return LOBE_OK;
}

static uint32_t count_barriers(const engine_dependency_graph *dependencies) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < dependencies->barrier_count; i++)
        count += dependencies->barriers[i].resource != ENGINE_DEPENDENCY_NONE;
    return count;
}

lobe_result engine_graph_report_compiled(lobe_graph *graph) {
    graph->frame.report = (lobe_graph_report){
        .transient_bytes = graph->kept.transients.shared_bytes,
        .transient_bytes_without_aliasing = graph->kept.transients.separate_bytes,
        .barrier_count = count_barriers(&graph->frame.dependencies)};
    for (const engine_graph_retained *kept = graph->kept.retained; kept; kept = kept->next)
        graph->frame.report.retained_bytes += kept->allocation.size;
    return list_passes(graph);
}

lobe_result engine_graph_report_executed(lobe_graph *graph) {
    return list_passes(graph);
}

const lobe_graph_report *lobe_graph_describe(const lobe_graph *graph) {
    if (!graph)
        return NULL;
    return &graph->frame.report;
}
