// A device keeps a bounded number of pipelines: the least recently used are evicted, but none that
// a frame in progress may still need, and an evicted one is recreated.

#include "tests/engine/support/cmocka_all.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include <lobe/graph.h>
#include <lobe/vulkan.h>

#include "engine/pipeline/pipelines.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/test_shaders.h"
#include "tests/engine/support/vulkan_faults.h"

enum { NUMBERS = 8, MANY = ENGINE_MAXIMUM_PIPELINES + 12 };

static log_recorder recorder;
static lobe_device *device;

static int open_device(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    faults.pipelines = 0;
    return open_device_with_test_shaders(&recorder.host, NULL, &device) != LOBE_OK;
}

static int close_device(void **state) {
    (void)state;
    const uint64_t mistakes = lobe_device_validation_count(device);
    if (mistakes)
        print_error("%s\n", recorder.last_error);
    lobe_device_destroy(&device);
    return mistakes || recorder.errors || faults.pipelines_alive || faults.alive;
}

// ---------------------------------------------------------------------------------------------
// Frames: each factor has its own pipeline

/// A pass that writes multiples of a factor.
static lobe_resource declare_fill(lobe_graph *graph, const char *name, uint32_t factor) {
    static const uint32_t count = NUMBERS;
    const float value = (float)factor;
    lobe_specialisation values[] = {{0, NUMBERS}, {1, 0}};
    memcpy(&values[1].bits, &value, sizeof value);
    lobe_resource target = lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name, .size = NUMBERS * sizeof(float)});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, name);
    target = lobe_pass_write(pass, &(lobe_binding){.name = "Target", .resource = target});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "fill.comp",
                                              .threads = {NUMBERS},
                                              .constants = &count,
                                              .constants_size = sizeof count,
                                              .specialisation = values,
                                              .specialisation_count = 2});
    lobe_graph_read_back(graph, target, (lobe_range){0});
    return target;
}

static bool is_filled(const lobe_graph *graph, lobe_resource target, uint32_t factor) {
    const float *numbers = lobe_graph_data(graph, target, NULL);
    for (uint32_t n = 0; numbers && n < NUMBERS; n++)
        if (numbers[n] != (float)factor * (float)n)
            return false;
    return numbers != NULL;
}

static bool run_frame(lobe_graph *graph, uint32_t factor) {
    lobe_graph_begin(graph);
    const lobe_resource target = declare_fill(graph, "numbers", factor);
    return lobe_graph_execute(graph) == LOBE_OK && is_filled(graph, target, factor);
}

/// The number of pipelines that a frame creates.
static int made_by(lobe_graph *graph, uint32_t factor) {
    faults.pipelines = 0;
    assert_true(run_frame(graph, factor));
    return faults.pipelines;
}

static lobe_graph *create_graph(void) {
    lobe_graph *graph = NULL;
    assert_int_equal(lobe_graph_create(device, &graph), LOBE_OK);
    return graph;
}

// ---------------------------------------------------------------------------------------------

static void the_longest_unused_go(void **state) {
    (void)state;
    lobe_graph *graph = create_graph();
    for (uint32_t factor = 0; factor < MANY; factor++) {
        assert_true(run_frame(graph, factor));
        assert_true(faults.pipelines_alive <= ENGINE_MAXIMUM_PIPELINES);
        assert_true(run_frame(graph, 7)); // used all the time
    }
    assert_int_equal(faults.pipelines, MANY);
    assert_int_equal(faults.pipelines_alive, ENGINE_MAXIMUM_PIPELINES);
    assert_int_equal(made_by(graph, 7), 0);
    assert_int_equal(made_by(graph, MANY - ENGINE_MAXIMUM_PIPELINES + 1), 0);
    assert_int_equal(made_by(graph, 0), 1);
    assert_int_equal(made_by(graph, 0), 0);
    assert_int_equal(faults.pipelines_alive, ENGINE_MAXIMUM_PIPELINES);
    lobe_graph_destroy(&graph);
}

/// More than are kept, in one frame.
static lobe_resource declare_many(lobe_graph *graph, uint32_t first) {
    lobe_resource target = {0};
    for (uint32_t n = 0; n < MANY; n++) {
        char name[32];
        snprintf(name, sizeof name, "numbers %u", n);
        target = declare_fill(graph, name, first + n);
    }
    return target;
}

static void a_frame_keeps_all_that_it_needs(void **state) {
    (void)state;
    lobe_graph *graph = create_graph();
    lobe_graph_begin(graph);
    const lobe_resource last = declare_many(graph, 0);
    assert_int_equal(lobe_graph_execute(graph), LOBE_OK);
    assert_true(is_filled(graph, last, MANY - 1));
    assert_int_equal(faults.pipelines_alive, MANY);
    // It is finished: creating the next pipeline makes room.
    assert_int_equal(made_by(graph, MANY), 1);
    assert_int_equal(faults.pipelines_alive, ENGINE_MAXIMUM_PIPELINES);
    lobe_graph_destroy(&graph);
}

static void frames_in_flight_keep_theirs(void **state) {
    (void)state;
    lobe_graph *graph = create_graph(), *other = create_graph();
    lobe_graph_set_frames_in_flight(graph, 2);
    lobe_graph_begin(graph);
    (void)declare_many(graph, 0);
    assert_int_equal(lobe_graph_submit(graph, &(lobe_vulkan_submission){0}), LOBE_OK);
    // Another graph's frames end meanwhile; the first frame is not known to have ended.
    faults.timeline_unknown = true;
    assert_int_equal(made_by(other, MANY), 1);
    assert_int_equal(made_by(other, MANY + 1), 1);
    assert_true(faults.pipelines_alive > MANY);
    assert_int_equal(lobe_graph_wait(graph), LOBE_OK);
    faults.timeline_unknown = false;
    assert_int_equal(made_by(other, MANY + 2), 1);
    assert_int_equal(faults.pipelines_alive, ENGINE_MAXIMUM_PIPELINES);
    lobe_graph_destroy(&other);
    lobe_graph_destroy(&graph);
}

/// A graph that submits a frame and then rests does not lift the bound for all others.
static void a_finished_frame_keeps_none(void **state) {
    (void)state;
    lobe_graph *graph = create_graph(), *other = create_graph();
    lobe_graph_set_frames_in_flight(graph, 2);
    lobe_graph_begin(graph);
    (void)declare_fill(graph, "numbers", 0);
    assert_int_equal(lobe_graph_submit(graph, &(lobe_vulkan_submission){0}), LOBE_OK);
    for (uint32_t factor = 1; factor < MANY; factor++) {
        assert_true(run_frame(other, factor));
        assert_true(faults.pipelines_alive <= ENGINE_MAXIMUM_PIPELINES);
    }
    assert_int_equal(lobe_graph_wait(graph), LOBE_OK);
    lobe_graph_destroy(&other);
    lobe_graph_destroy(&graph);
}

/// A graph whose frame is declared, with more pipelines than are kept, and compiled.
static lobe_graph *create_compiled_graph(void) {
    lobe_graph *graph = create_graph();
    lobe_graph_begin(graph);
    (void)declare_many(graph, 0);
    assert_int_equal(lobe_graph_compile(graph), LOBE_OK);
    return graph;
}

/// A frame that could not be recorded needs no pipeline, even if its graph never begins another.
static void a_failed_frame_keeps_none(void **state) {
    (void)state;
    lobe_graph *graph = create_compiled_graph(), *other = create_graph();
    faults.calls = 0;
    faults.failing = 1;
    faults.fault = VK_ERROR_OUT_OF_HOST_MEMORY;
    assert_int_equal(lobe_graph_execute(graph), LOBE_ERROR_OUT_OF_MEMORY);
    faults.failing = 0;
    recorder.errors = 0;
    assert_int_equal(made_by(other, MANY), 1);
    assert_int_equal(faults.pipelines_alive, ENGINE_MAXIMUM_PIPELINES);
    lobe_graph_destroy(&other);
    lobe_graph_destroy(&graph);
}

/// A frame that is declared and given up holds nothing for ever.
static void a_destroyed_graph_keeps_none(void **state) {
    (void)state;
    lobe_graph *graph = create_compiled_graph(), *other = create_graph();
    assert_int_equal(made_by(other, MANY), 1);
    assert_int_equal(faults.pipelines_alive, MANY + 1);
    lobe_graph_destroy(&graph);
    assert_int_equal(made_by(other, MANY + 1), 1);
    assert_int_equal(faults.pipelines_alive, ENGINE_MAXIMUM_PIPELINES);
    lobe_graph_destroy(&other);
}

typedef struct worker {
    lobe_graph *graph;
    uint32_t first;
    bool failed;
} worker;

static void *work(void *user) {
    worker *w = user;
    for (uint32_t n = 0; n < MANY / 2 + 8 && !w->failed; n++)
        w->failed = !run_frame(w->graph, w->first + n);
    return NULL;
}

static void threads_share_the_bound(void **state) {
    (void)state;
    worker workers[2];
    pthread_t threads[2];
    faults.paused = true; // nothing should fail
    for (uint32_t n = 0; n < 2; n++) {
        workers[n] = (worker){.graph = create_graph(), .first = n * MANY};
        assert_int_equal(pthread_create(&threads[n], NULL, work, &workers[n]), 0);
    }
    for (uint32_t n = 0; n < 2; n++) {
        assert_int_equal(pthread_join(threads[n], NULL), 0);
        assert_false(workers[n].failed);
    }
    // Each may have kept the other's last one alive.
    assert_true(faults.pipelines_alive <= ENGINE_MAXIMUM_PIPELINES + 1);
    for (uint32_t n = 0; n < 2; n++)
        lobe_graph_destroy(&workers[n].graph);
    faults.paused = false;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_longest_unused_go, open_device, close_device),
        cmocka_unit_test_setup_teardown(a_frame_keeps_all_that_it_needs, open_device, close_device),
        cmocka_unit_test_setup_teardown(frames_in_flight_keep_theirs, open_device, close_device),
        cmocka_unit_test_setup_teardown(a_finished_frame_keeps_none, open_device, close_device),
        cmocka_unit_test_setup_teardown(a_failed_frame_keeps_none, open_device, close_device),
        cmocka_unit_test_setup_teardown(a_destroyed_graph_keeps_none, open_device, close_device),
        cmocka_unit_test_setup_teardown(threads_share_the_bound, open_device, close_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
