#include "engine/graph/store/store.h"

#include "engine/device/vulkan_check.h"
#include "engine/pipeline/pipelines.h"

static lobe_result create_commands(lobe_graph *graph, engine_graph_flight *flight) {
    lobe_device *device = graph->device;
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
        .queueFamilyIndex = device->queue_family,
    };
    if (flight->commands)
        return LOBE_OK;
    lobe_result result = LOBE_OK;
    if (!flight->command_pool)
        result = VULKAN_CHECK(&device->host,
                              device->api.vkCreateCommandPool(
                                  device->vulkan, &pool, device->callbacks, &flight->command_pool),
                              "render graph");
    if (result != LOBE_OK)
        return result;
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = flight->command_pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1,
    };
    return VULKAN_CHECK(
        &device->host,
        device->api.vkAllocateCommandBuffers(device->vulkan, &commands, &flight->commands),
        "render graph");
}

lobe_result engine_graph_create_flights(lobe_graph *graph) {
    graph->frame.flight = graph->kept.flights;
    graph->kept.flight_count = 1;
    return create_commands(graph, graph->frame.flight);
}

void engine_graph_retire_flight(lobe_graph *graph, engine_graph_flight *flight) {
    engine_graph_object imported = {.views = flight->views};
    engine_graph_free_views(graph->device, &imported);
    flight->views = NULL;
    engine_graph_free_released(graph, flight);
    engine_graph_free_transients(graph, &flight->transients);
    engine_uploads_release(&graph->kept.uploads, flight->copied);
    if (flight->busy)
        engine_pipelines_end_use(graph->device, &flight->pipelines);
    flight->busy = false;
    flight->submission = 0;
}

/// A host with several frames in flight may have waited already.
static lobe_result wait_unless_finished(lobe_device *device, uint64_t submission) {
    return engine_device_finished(device) >= submission ? LOBE_OK
                                                        : engine_device_wait(device, submission);
}

lobe_result engine_graph_begin_aside_flight(lobe_graph *graph) {
    engine_graph_flight *aside = &graph->kept.aside;
    if (graph->frame.flight != aside)
        graph->kept.resumed = graph->frame.flight;
    graph->frame.flight = aside;
    engine_pipelines_end_use(graph->device, &aside->pipelines);
    return create_commands(graph, aside);
}

lobe_result engine_graph_begin_flight(lobe_graph *graph) {
    lobe_result result = LOBE_OK;
    if (graph->frame.flight == &graph->kept.aside)
        graph->frame.flight = graph->kept.resumed;
    if (graph->frame.flight->busy) {
        // Round robin: the next one is the oldest.
        uint32_t index = (uint32_t)(graph->frame.flight - graph->kept.flights);
        graph->frame.flight = &graph->kept.flights[(index + 1) % graph->kept.flight_count];
    }
    // If the host submitted the frame itself, it guarantees that the frame has finished.
    if (graph->frame.flight->submission)
        result = wait_unless_finished(graph->device, graph->frame.flight->submission);
    if (result != LOBE_OK)
        return result;
    engine_graph_retire_flight(graph, graph->frame.flight);
    // Of a frame that was compiled, but not executed.
    engine_pipelines_end_use(graph->device, &graph->frame.flight->pipelines);
    return create_commands(graph, graph->frame.flight);
}

lobe_result engine_graph_finish_flights(lobe_graph *graph) {
    bool busy = false;
    for (uint32_t i = 0; i < LOBE_MAXIMUM_FRAMES_IN_FLIGHT; i++)
        busy = busy || graph->kept.flights[i].busy;
    const lobe_result result = busy ? engine_device_wait_queue(graph->device) : LOBE_OK;
    for (uint32_t i = 0; busy && result == LOBE_OK && i < LOBE_MAXIMUM_FRAMES_IN_FLIGHT; i++)
        engine_graph_retire_flight(graph, &graph->kept.flights[i]);
    return result;
}

lobe_result engine_graph_finish_frames(lobe_graph *graph) {
    uint64_t last = 0;
    bool recorded = false; // into commands that the host submitted
    for (uint32_t i = 0; i < LOBE_MAXIMUM_FRAMES_IN_FLIGHT; i++) {
        const engine_graph_flight *flight = &graph->kept.flights[i];
        recorded = recorded || (flight->busy && flight->submission == 0);
        if (flight->busy && flight->submission > last)
            last = flight->submission;
    }
    const lobe_result result = recorded   ? engine_device_wait_queue(graph->device)
                               : last > 0 ? wait_unless_finished(graph->device, last)
                                          : LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < LOBE_MAXIMUM_FRAMES_IN_FLIGHT; i++)
        if (graph->kept.flights[i].busy)
            engine_graph_retire_flight(graph, &graph->kept.flights[i]);
    return result;
}

void lobe_graph_set_frames_in_flight(lobe_graph *graph, uint32_t count) {
    if (!graph)
        return;
    if (count < 1)
        count = 1;
    if (count > LOBE_MAXIMUM_FRAMES_IN_FLIGHT)
        count = LOBE_MAXIMUM_FRAMES_IN_FLIGHT;
    if (count < graph->kept.flight_count)
        (void)engine_graph_finish_flights(graph);
    graph->kept.flight_count = count;
}

static void free_flight(lobe_graph *graph, engine_graph_flight *flight) {
    lobe_device *device = graph->device;
    engine_graph_retire_flight(graph, flight);
    engine_pipelines_end_use(device, &flight->pipelines);
    engine_buffer_destroy_placed(device, &flight->uploads.buffer, &flight->upload_memory);
    engine_staging_destroy(device, &flight->read_back);
    lobe_release(flight->late_data);
    device->api.vkDestroyDescriptorPool(device->vulkan, flight->descriptors, device->callbacks);
    lobe_release(flight->sets);
    device->api.vkDestroyQueryPool(device->vulkan, flight->timestamps, device->callbacks);
    device->api.vkDestroyCommandPool(device->vulkan, flight->command_pool, device->callbacks);
}

void engine_graph_free_flights(lobe_graph *graph) {
    for (uint32_t i = 0; i < LOBE_MAXIMUM_FRAMES_IN_FLIGHT; i++)
        free_flight(graph, &graph->kept.flights[i]);
    free_flight(graph, &graph->kept.aside);
}
