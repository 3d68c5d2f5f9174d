#include "engine/graph/record/record.h"

#include <string.h>

#include <lobe/vulkan.h>

#include "engine/base/growing_array.h"
#include "engine/device/vulkan_check.h"
#include "engine/graph/report.h"
#include "engine/graph/store/store.h"
#include "engine/pipeline/pipelines.h"

/// Image copies start at multiples of the texel size; this is the largest.
#define READ_BACK_ALIGNMENT 16

// ---------------------------------------------------------------------------------------------
// Read back

static engine_graph_command *read_back_of(const lobe_pass *pass) {
    return pass->internal ? pass->first_command : NULL;
}

static lobe_result place_read_backs(lobe_graph *graph) {
    engine_graph_flight *flight = graph->frame.flight;
    uint64_t size = 0;
    uint32_t late_count = 0;
    flight->late_count = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++) {
        engine_graph_command *command = read_back_of(graph->frame.passes[i]);
        if (!command)
            continue;
        late_count += command->late_number > 0;
        command->read_back_offset = size;
        size += (command->read_back_size + READ_BACK_ALIGNMENT - 1) / READ_BACK_ALIGNMENT *
                READ_BACK_ALIGNMENT;
    }
    if (!engine_array_reserve(graph->device->host.allocator, (void **)&flight->late_data,
                              &flight->late_capacity, late_count, sizeof *flight->late_data))
        return engine_graph_fail_memory(graph);
    if (size <= flight->read_back.size)
        return LOBE_OK;
    engine_staging_destroy(graph->device, &flight->read_back);
    return engine_staging_create(graph->device, "read back of the frame", size,
                                 ENGINE_MEMORY_READ_BACK, &flight->read_back);
}

/// The frame's declaration is gone when its late data are there.
static void note_late_data(lobe_graph *graph) {
    engine_graph_flight *flight = graph->frame.flight;
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++) {
        const engine_graph_command *command = read_back_of(graph->frame.passes[i]);
        if (command && command->late_number > 0)
            flight->late_data[flight->late_count++] =
                (engine_graph_late_data){command->late_number, command->read_back_offset};
    }
}

static const engine_graph_flight *find_late_data(const lobe_graph *graph, uint64_t number,
                                                 uint64_t *offset) {
    for (uint32_t f = 0; f <= LOBE_MAXIMUM_FRAMES_IN_FLIGHT; f++) {
        const engine_graph_flight *flight =
            f < LOBE_MAXIMUM_FRAMES_IN_FLIGHT ? &graph->kept.flights[f] : &graph->kept.aside;
        for (uint32_t i = 0; i < flight->late_count; i++)
            if (flight->late_data[i].number == number) {
                *offset = flight->late_data[i].offset;
                return flight;
            }
    }
    return NULL;
}

const void *lobe_graph_late_data(const lobe_graph *graph, uint64_t number, bool *pending) {
    uint64_t offset;
    const engine_graph_flight *flight = graph ? find_late_data(graph, number, &offset) : NULL;
    if (pending)
        *pending = flight && flight->busy;
    return flight && !flight->busy ? (const char *)flight->read_back.mapped + offset : NULL;
}

const void *lobe_graph_data(const lobe_graph *graph, lobe_resource resource, size_t *size) {
    if (!graph)
        return NULL;
    if (graph->frame.phase != ENGINE_GRAPH_EXECUTED || graph->frame.result != LOBE_OK)
        return NULL;
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++) {
        const engine_graph_command *command = read_back_of(graph->frame.passes[i]);
        if (!command || command->read_back.index != resource.index ||
            command->read_back.version != resource.version)
            continue;
        if (size)
            *size = command->read_back_size;
        return (const char *)graph->frame.flight->read_back.mapped + command->read_back_offset;
    }
    return NULL;
}

// ---------------------------------------------------------------------------------------------
// Recording

static lobe_result begin_recording(lobe_graph *graph) {
    lobe_device *device = graph->device;
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    lobe_result result = VULKAN_CHECK(
        &device->host,
        device->api.vkResetCommandPool(device->vulkan, graph->frame.flight->command_pool, 0),
        "render graph");
    if (result == LOBE_OK)
        result = VULKAN_CHECK(&device->host,
                              device->api.vkBeginCommandBuffer(graph->frame.commands, &begin),
                              "render graph");
    return result;
}

static lobe_result record_passes(lobe_graph *graph) {
    uint32_t next_barrier = 0, count = graph->frame.dependencies.running_count;
    lobe_result result = LOBE_OK;
    engine_graph_reset_timestamps(graph);
    engine_graph_record_first_barrier(graph);
    engine_uploads_record(&graph->kept.uploads, graph->frame.commands);
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++) {
        engine_graph_write_timestamp(graph, i, false);
        result = engine_graph_record_barriers(graph, i, &next_barrier);
        if (result == LOBE_OK)
            result = engine_graph_record_pass(
                graph, graph->frame.passes[graph->frame.dependencies.running[i]]);
        engine_graph_write_timestamp(graph, i, true);
    }
    if (result == LOBE_OK)
        result = engine_graph_record_barriers(graph, count, &next_barrier);
    engine_graph_record_last_barrier(graph);
    return result;
}

/// `host`: the host's command buffer to record into; VK_NULL_HANDLE: the flight's.
static lobe_result record(lobe_graph *graph, VkCommandBuffer host) {
    graph->frame.commands = host ? host : graph->frame.flight->commands;
    lobe_result result = host ? LOBE_OK : begin_recording(graph);
    if (result == LOBE_OK)
        result = record_passes(graph);
    if (result == LOBE_OK && !host)
        result = VULKAN_CHECK(&graph->device->host,
                              graph->device->api.vkEndCommandBuffer(graph->frame.commands),
                              "render graph");
    return result;
}

static lobe_result prepare(lobe_graph *graph) {
    lobe_result result = engine_graph_place_imports(graph);
    if (result == LOBE_OK)
        result = engine_graph_write_descriptors(graph);
    if (result == LOBE_OK)
        result = engine_graph_describe_exports(graph);
    if (result == LOBE_OK)
        result = place_read_backs(graph);
    if (result == LOBE_OK)
        result = engine_graph_prepare_timestamps(graph);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Execution

/// If the host submits, it does so before anything else that lobe submits: in both cases, retained
/// content counts as written.
static lobe_result submit(lobe_graph *graph, const lobe_vulkan_submission *submission) {
    engine_graph_flight *flight = graph->frame.flight;
    lobe_result result = LOBE_OK;
    engine_graph_invalidate_retained(graph);
    if (!submission || !submission->commands)
        result = engine_device_submit(graph->device, graph->frame.commands, submission,
                                      &flight->submission);
    if (result != LOBE_OK)
        return result;
    flight->busy = true;
    graph->kept.last = flight;
    note_late_data(graph);
    flight->copied = engine_uploads_commit(&graph->kept.uploads, !flight->submission);
    if (flight->submission)
        engine_pipelines_end_use_after(graph->device, &flight->pipelines, flight->submission);
    engine_graph_stamp_retained(graph);
    if (flight->submission)
        engine_graph_publish_retained(graph);
    return LOBE_OK;
}

lobe_result engine_graph_run(lobe_graph *graph, const lobe_vulkan_submission *submission) {
    const double start = engine_host_milliseconds();
    lobe_result result = prepare(graph);
    if (result == LOBE_OK)
        result = record(graph, submission ? submission->commands : VK_NULL_HANDLE);
    graph->frame.report.host_milliseconds += engine_host_milliseconds() - start;
    if (result == LOBE_OK)
        result = submit(graph, submission);
    graph->frame.phase = result == LOBE_OK ? ENGINE_GRAPH_SUBMITTED : ENGINE_GRAPH_EXECUTED;
    engine_graph_release_imports(graph);
    return result;
}

lobe_result engine_graph_finish(lobe_graph *graph) {
    engine_graph_flight *flight = graph->frame.flight;
    lobe_result result = LOBE_OK;
    if (flight->submission)
        result = engine_device_wait(graph->device, flight->submission);
    graph->frame.phase = ENGINE_GRAPH_EXECUTED;
    engine_graph_retire_flight(graph, flight);
    if (result == LOBE_OK)
        result = engine_graph_read_timestamps(graph);
    if (result == LOBE_OK)
        return engine_graph_report_executed(graph);
    engine_graph_invalidate_retained(graph);
    return result;
}
