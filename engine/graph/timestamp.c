#include "engine/graph/record/record.h"

#include "engine/device/vulkan_check.h"

static bool can_time(const lobe_graph *graph) {
    return graph->device->timestamp_bits > 0 && graph->dependencies.running_count > 0;
}

lobe_result engine_graph_prepare_timestamps(lobe_graph *graph) {
    lobe_device *device = graph->device;
    uint32_t needed = 2 * graph->dependencies.running_count;
    if (!can_time(graph) || needed <= graph->flight->timestamp_capacity)
        return LOBE_OK;
    device->api.vkDestroyQueryPool(device->vulkan, graph->flight->timestamps, device->callbacks);
    graph->flight->timestamps = VK_NULL_HANDLE;
    graph->flight->timestamp_capacity = 0;
    const VkQueryPoolCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
        .queryType = VK_QUERY_TYPE_TIMESTAMP,
        .queryCount = needed,
    };
    lobe_result result =
        VULKAN_CHECK(&device->host,
                     device->api.vkCreateQueryPool(device->vulkan, &create, device->callbacks,
                                                   &graph->flight->timestamps),
                     "render graph");
    if (result == LOBE_OK)
        graph->flight->timestamp_capacity = needed;
    return result;
}

void engine_graph_reset_timestamps(lobe_graph *graph) {
    if (can_time(graph))
        graph->device->api.vkCmdResetQueryPool(graph->commands, graph->flight->timestamps, 0,
                                               graph->flight->timestamp_capacity);
}

/// After all commands so far are done, on both sides of a pass: else passes that overlap would
/// count twice, and on a CPU driver, where commands run one after the other, nothing would count.
void engine_graph_write_timestamp(lobe_graph *graph, uint32_t position, bool after) {
    if (can_time(graph))
        graph->device->api.vkCmdWriteTimestamp2(graph->commands,
                                                VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                                graph->flight->timestamps, 2 * position + after);
}

static double milliseconds_between(const lobe_graph *graph, uint64_t first, uint64_t last) {
    uint32_t bits = graph->device->timestamp_bits;
    uint64_t mask = bits >= 64 ? UINT64_MAX : ((uint64_t)1 << bits) - 1;
    return (double)((last - first) & mask) * graph->device->limits.timestampPeriod * 1e-6;
}

lobe_result engine_graph_read_timestamps(lobe_graph *graph) {
    uint32_t count = graph->dependencies.running_count;
    if (!can_time(graph))
        return LOBE_OK;
    uint64_t *ticks = engine_arena_allocate(&graph->arena, 2 * count * sizeof *ticks);
    if (!ticks)
        return engine_graph_fail_memory(graph);
    lobe_result result =
        VULKAN_CHECK(&graph->device->host,
                     graph->device->api.vkGetQueryPoolResults(
                         graph->device->vulkan, graph->flight->timestamps, 0, 2 * count,
                         2 * count * sizeof *ticks, ticks, sizeof *ticks,
                         VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                     "render graph");
    if (result != LOBE_OK)
        return result;
    for (uint32_t n = 0; n < count; n++)
        graph->passes[graph->dependencies.running[n]]->milliseconds =
            milliseconds_between(graph, ticks[2 * n], ticks[2 * n + 1]);
    graph->report.milliseconds = milliseconds_between(graph, ticks[0], ticks[2 * count - 1]);
    return LOBE_OK;
}
