#include <lobe/graph.h>
#include <lobe/vulkan.h>

#include "engine/graph/declare/declare.h"
#include "engine/graph/record/record.h"
#include "engine/graph/report.h"
#include "engine/graph/store/store.h"
#include "engine/pipeline/pipelines.h"

// ---------------------------------------------------------------------------------------------
// Creation and destruction

lobe_result lobe_graph_create(lobe_device *device, lobe_graph **graph) {
    if (graph)
        *graph = NULL;
    if (!device || !graph)
        return lobe_host_fail(device ? &device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_graph_create: device and graph must not be NULL");
    const lobe_allocator *allocator = device->host.allocator;
    lobe_graph *created = lobe_allocate(allocator, 1, sizeof *created);
    if (!created)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "render graph: out of memory");
    created->device = created->kept.uploads.device = device;
    created->kept.uploads.number = engine_device_stamp(device);
    created->frame.dependencies.number = created->kept.uploads.number;
    created->frame.arena.allocator = created->frame.dependencies.scratch.allocator = allocator;
    created->frame.nothing = (lobe_pass){.graph = created, .name = "(none)"};
    lobe_result result = engine_graph_create_flights(created);
    if (result != LOBE_OK)
        lobe_graph_destroy(&created);
    *graph = created;
    return result;
}

void lobe_graph_keep_apart(lobe_graph *graph) {
    if (graph)
        graph->kept.uploads.apart = true;
}

static void reset_frame(lobe_graph *graph) {
    engine_graph_release_imports(graph);
    engine_dependency_graph_reset(&graph->frame.dependencies);
    engine_arena_reset(&graph->frame.arena);
    graph->frame.report = (lobe_graph_report){0};
    graph->frame.exported_buffers = 0;
    graph->frame.result = LOBE_OK;
    graph->frame.phase = ENGINE_GRAPH_DECLARING;
    graph->frame.aside = false;
}

void lobe_graph_destroy(lobe_graph **graph) {
    lobe_graph *gone = graph ? *graph : NULL;
    if (!gone)
        return;
    // A failure is a lost device, which has finished too.
    (void)engine_graph_finish_flights(gone);
    reset_frame(gone);
    engine_graph_free_retained(gone);
    engine_graph_free_transients(gone, &gone->kept.transients);
    engine_graph_free_flights(gone);
    engine_uploads_free(&gone->kept.uploads);
    engine_dependency_graph_free(&gone->frame.dependencies);
    engine_arena_free(&gone->frame.arena);
    lobe_release(gone->frame.resources);
    lobe_release(gone->frame.passes);
    lobe_release(gone->frame.pass_reports);
    lobe_release(gone);
    *graph = NULL;
}

static void begin(lobe_graph *graph, bool aside) {
    reset_frame(graph);
    graph->frame.aside = aside;
    engine_graph_begin_retained(graph);
    lobe_result result =
        aside ? engine_graph_begin_aside_flight(graph) : engine_graph_begin_flight(graph);
    if (result == LOBE_OK)
        result = engine_uploads_begin_frame(&graph->kept.uploads);
    engine_graph_propagate(graph, result);
}

void lobe_graph_begin(lobe_graph *graph) {
    if (graph)
        begin(graph, false);
}

void lobe_graph_begin_aside(lobe_graph *graph) {
    if (graph)
        begin(graph, true);
}

// ---------------------------------------------------------------------------------------------
// Compilation

static lobe_result analyse(lobe_graph *graph) {
    engine_dependency_graph *dependencies = &graph->frame.dependencies;
    if (!engine_dependency_link(dependencies) || !engine_dependency_order(dependencies))
        return engine_graph_fail_dependency(graph);
    engine_graph_number_content(graph); // declare/signature.c
    if (!engine_dependency_cull(dependencies))
        return engine_graph_fail_dependency(graph);
    engine_dependency_find_lifetimes(dependencies);
    return LOBE_OK;
}

static lobe_result derive_barriers(lobe_graph *graph) {
    return engine_dependency_derive_barriers(&graph->frame.dependencies)
               ? LOBE_OK
               : engine_graph_fail_dependency(graph);
}

/// From the declaration (declare/) to a frame that can be recorded (record/). Nothing is recorded
/// here: lobe_graph_execute and lobe_graph_submit do that after compiling.
static lobe_result (*const compile_steps[])(lobe_graph *graph) = {
    engine_graph_ask_for_rest,       // store/retained.c      whether what settles rests
    engine_graph_check_rasters,      // declare/raster.c      attachments fit each other
    engine_graph_resolve_bindings,   // declare/binding.c     names meet shaders: uses of resources
    engine_graph_check_host_images,  // declare/host_image.c  host images allow these uses
    engine_graph_check_host_buffers, // declare/host_buffer.c  host buffers do
    engine_graph_check_retained,     // store/retained.c      retained objects allow these uses
    engine_graph_sign_passes,        // declare/signature.c   digest of what each pass does
    analyse,                         // plan/                 sources, order, what runs, lifetimes
    engine_graph_share_retained,     // store/sharing.c       content that other graphs have
    engine_graph_release_retained,   // store/retained.c      frees what this frame did not declare
    engine_graph_find_pipelines,     // declare/binding.c     of the passes that run
    engine_graph_place_retained,     // store/retained.c      objects with memory of their own
    engine_graph_place_transients,   // store/transients.c    objects that share memory
    derive_barriers,                 // plan/barrier.c        transitions, waits for shared memory
    engine_graph_count_traffic,      // report.c              bytes that each pass reads and writes
    engine_graph_report_compiled,    // report.c
};

/// Fails the frame, which then needs its pipelines no longer.
static lobe_result give_up(lobe_graph *graph, lobe_result result) {
    engine_pipelines_end_use(graph->device, &graph->frame.flight->pipelines);
    return engine_graph_propagate(graph, result);
}

static lobe_result take_steps(lobe_graph *graph, lobe_result (*const *steps)(lobe_graph *graph),
                              size_t count) {
    for (size_t i = 0; i < count; i++) {
        lobe_result result = steps[i](graph);
        if (result != LOBE_OK)
            return give_up(graph, result);
    }
    return LOBE_OK;
}

lobe_result lobe_graph_compile(lobe_graph *graph) {
    if (!graph)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (graph->frame.phase != ENGINE_GRAPH_DECLARING || graph->frame.result != LOBE_OK)
        return graph->frame.result;
    const double start = engine_host_milliseconds();
    const lobe_result result =
        take_steps(graph, compile_steps, sizeof compile_steps / sizeof *compile_steps);
    if (result != LOBE_OK)
        return result;
    graph->frame.report.host_milliseconds = engine_host_milliseconds() - start;
    graph->frame.phase = ENGINE_GRAPH_COMPILED;
    return LOBE_OK;
}

/// What must be known of a frame before its pipelines are.
static lobe_result (*const preparation_steps[])(lobe_graph *graph) = {
    engine_graph_check_rasters,      engine_graph_resolve_bindings, engine_graph_check_host_images,
    engine_graph_check_host_buffers, engine_graph_sign_passes,      analyse,
};

lobe_result lobe_graph_prepare(lobe_graph *graph, bool (*progress)(void *user, double part),
                               void *user) {
    if (!graph)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (graph->frame.result != LOBE_OK)
        return graph->frame.result;
    if (graph->frame.phase != ENGINE_GRAPH_DECLARING)
        return lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                               "render graph: a frame that was compiled cannot be prepared");
    lobe_result result =
        take_steps(graph, preparation_steps, sizeof preparation_steps / sizeof *preparation_steps);
    if (result != LOBE_OK)
        return result;
    graph->frame.phase = ENGINE_GRAPH_PREPARED;
    result = engine_graph_prepare_pipelines(graph, progress, user);
    engine_pipelines_end_use(graph->device, &graph->frame.flight->pipelines);
    return engine_graph_propagate(graph, result);
}

static lobe_result run(lobe_graph *graph, const lobe_vulkan_submission *submission) {
    if (graph->frame.phase > ENGINE_GRAPH_COMPILED)
        return lobe_graph_fail(
            graph, LOBE_ERROR_GRAPH,
            graph->frame.phase == ENGINE_GRAPH_PREPARED
                ? "render graph: a frame cannot be executed once it was prepared; begin a new one"
                : "render graph: a frame cannot be executed twice; begin a new one");
    lobe_result result = lobe_graph_compile(graph);
    if (result != LOBE_OK)
        return result;
    result = engine_graph_run(graph, submission);
    return result == LOBE_OK ? result : give_up(graph, result);
}

lobe_result lobe_graph_execute(lobe_graph *graph) {
    if (!graph)
        return LOBE_ERROR_INVALID_ARGUMENT;
    lobe_result result = run(graph, NULL);
    if (result == LOBE_OK)
        result = engine_graph_finish(graph);
    return engine_graph_propagate(graph, result);
}

static lobe_result check_submission(lobe_graph *graph, const lobe_vulkan_submission *submission) {
    uint32_t waits = submission->wait_count, signals = submission->signal_count;
    if (submission->commands && (waits || signals))
        return lobe_graph_fail(graph, LOBE_ERROR_INVALID_ARGUMENT,
                               "render graph: a submission with the host's command buffer "
                               "takes no semaphores");
    if (waits > LOBE_VULKAN_MAXIMUM_SEMAPHORES || signals > LOBE_VULKAN_MAXIMUM_SEMAPHORES)
        return lobe_graph_fail(graph, LOBE_ERROR_INVALID_ARGUMENT,
                               "render graph: %u semaphores to wait for and %u to signal, more "
                               "than %d each",
                               waits, signals, LOBE_VULKAN_MAXIMUM_SEMAPHORES);
    return LOBE_OK;
}

lobe_result lobe_graph_submit(lobe_graph *graph, const lobe_vulkan_submission *submission) {
    if (!graph)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (!submission)
        return lobe_graph_fail(graph, LOBE_ERROR_INVALID_ARGUMENT,
                               "lobe_graph_submit: submission must not be NULL");
    if (graph->frame.aside)
        return lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                               "render graph: a frame between others can only be executed");
    lobe_result result = check_submission(graph, submission);
    if (result == LOBE_OK)
        result = run(graph, submission);
    return engine_graph_propagate(graph, result);
}

lobe_result lobe_graph_wait(lobe_graph *graph) {
    if (!graph)
        return LOBE_ERROR_INVALID_ARGUMENT;
    if (graph->frame.phase != ENGINE_GRAPH_SUBMITTED)
        return graph->frame.result;
    return engine_graph_propagate(graph, engine_graph_finish(graph));
}
