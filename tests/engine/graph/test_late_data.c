// What frames read back for later ones, and what they leave behind: nobody waits for either. Frames
// aside, between the others, are waited for and leave everything else alone.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tests/engine/graph/graph_support.h"

enum { COUNT = 64, FLIGHT = 2 };

static lobe_resource retained(graph_fixture *f, const char *name, uint32_t count) {
    return lobe_graph_buffer(
        f->graph,
        &(lobe_buffer_description){.name = name, .size = count * sizeof(float), .retained = true});
}

/// A frame that reads back multiples of `factor` for a later one.
static uint64_t declare(graph_fixture *f, float factor) {
    lobe_graph_begin(f->graph);
    const lobe_resource counted =
        graph_fixture_count(f, "count", retained(f, "counted", COUNT), factor, COUNT);
    return lobe_graph_read_back_late(f->graph, counted, (lobe_range){0});
}

static void assert_pending(const graph_fixture *f, uint64_t number) {
    bool pending = false;
    assert_null(lobe_graph_late_data(f->graph, number, &pending));
    assert_true(pending);
}

static void assert_gone(const graph_fixture *f, uint64_t number) {
    bool pending = true;
    assert_null(lobe_graph_late_data(f->graph, number, &pending));
    assert_false(pending);
}

static void assert_there(const graph_fixture *f, uint64_t number, float factor) {
    bool pending = true;
    const float *data = lobe_graph_late_data(f->graph, number, &pending);
    assert_non_null(data);
    assert_false(pending);
    for (int i = 0; i < COUNT; i++)
        assert_true(data[i] == factor * (float)i);
}

/// Each is there while the frame is declared that takes its frame's place.
static void late_data_are_there_when_the_place_is_free(void **state) {
    graph_fixture *f = *state;
    const graph_gate gate = graph_gate_close(f);
    uint64_t numbers[FLIGHT];
    lobe_graph_set_frames_in_flight(f->graph, FLIGHT);
    for (int n = 0; n < FLIGHT; n++) {
        numbers[n] = declare(f, (float)(n + 1));
        graph_gate_submit_behind(f, &gate, 1);
        assert_pending(f, numbers[n]);
    }
    assert_true(numbers[0] > 0 && numbers[1] != numbers[0]);
    graph_gate_open(&gate, 1);
    for (int n = 0; n < FLIGHT; n++) {
        const uint64_t next = declare(f, 10);
        assert_there(f, numbers[n], (float)(n + 1));
        assert_gone(f, next);
        assert_int_equal(lobe_graph_submit(f->graph, &(lobe_vulkan_submission){0}), LOBE_OK);
        assert_gone(f, numbers[n]);
        numbers[n] = next;
    }
    assert_int_equal(lobe_graph_wait(f->graph), LOBE_OK);
    assert_there(f, numbers[1], 10);
    assert_gone(f, 0);
    lobe_graph_destroy(&f->graph);
    graph_gate_destroy(&gate);
}

static uint64_t used_bytes(const graph_fixture *f) {
    lobe_device_memory memory;
    lobe_device_memory_query(f->device, &memory);
    return memory.used_bytes;
}

static void declare_kept(graph_fixture *f, bool large) {
    lobe_graph_begin(f->graph);
    lobe_graph_output(f->graph,
                      graph_fixture_count(f, "small", retained(f, "small", COUNT), 1, COUNT));
    if (large)
        lobe_graph_output(f->graph,
                          graph_fixture_count(f, "large", retained(f, "large", 1 << 18), 1, COUNT));
}

/// What a frame does not declare is freed when the frames that use it have finished.
static void what_is_left_behind_is_not_waited_for(void **state) {
    graph_fixture *f = *state;
    const graph_gate gate = graph_gate_close(f);
    lobe_graph_set_frames_in_flight(f->graph, FLIGHT);
    declare_kept(f, true);
    graph_gate_submit_behind(f, &gate, 1);
    const uint64_t before = used_bytes(f);
    declare_kept(f, false);
    graph_gate_submit_behind(f, &gate, 1);
    assert_true(used_bytes(f) >= before);
    graph_gate_open(&gate, 1);
    declare_kept(f, false);
    assert_true(used_bytes(f) + (1 << 20) <= before);
    graph_fixture_execute(f);
    lobe_graph_destroy(&f->graph);
    graph_gate_destroy(&gate);
}

static lobe_resource declare_passing(graph_fixture *f, uint32_t count) {
    lobe_graph_begin(f->graph);
    const lobe_resource passing = graph_fixture_count(
        f, "count", graph_fixture_buffer(f, "passing", count * sizeof(float)), 1, COUNT);
    const lobe_resource result =
        graph_fixture_add(f, "add", passing, retained(f, "result", COUNT), 1, COUNT);
    lobe_graph_read_back(f->graph, result, (lobe_range){0});
    return result;
}

/// What frames do not keep may have another size in each: what a frame uses is freed once it has
/// finished.
static void memory_of_other_frames_is_not_waited_for(void **state) {
    static const uint32_t counts[] = {1 << 18, 1 << 16, 1 << 17, COUNT};
    graph_fixture *f = *state;
    const graph_gate gate = graph_gate_close(f);
    lobe_graph_set_frames_in_flight(f->graph, 3);
    for (int n = 0; n < 3; n++) {
        declare_passing(f, counts[n]);
        graph_gate_submit_behind(f, &gate, 1);
    }
    const uint64_t all = used_bytes(f);
    assert_true(all >= 4 * (counts[0] + counts[1] + counts[2]));
    graph_gate_open(&gate, 1);
    assert_int_equal(lobe_graph_wait(f->graph), LOBE_OK);
    lobe_resource result = {0};
    for (int n = 0; n < 3; n++) {
        result = declare_passing(f, counts[3]);
        graph_fixture_execute(f);
    }
    assert_true(used_bytes(f) + 4 * (counts[0] + counts[1] + counts[2]) <= all + 4096);
    const float *data = lobe_graph_data(f->graph, result, NULL);
    assert_true(data[COUNT - 1] == COUNT);
    lobe_graph_destroy(&f->graph);
    graph_gate_destroy(&gate);
}

static void frames_aside_leave_the_others_alone(void **state) {
    graph_fixture *f = *state;
    for (int n = 0; n < 2; n++) {
        declare_kept(f, true);
        lobe_graph_output(f->graph,
                          graph_fixture_count(f, "own",
                                              graph_fixture_buffer(f, "own", COUNT * sizeof(float)),
                                              1, COUNT));
        graph_fixture_execute(f);
        assert_int_equal(graph_fixture_state(f, "large"), n ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
        const uint64_t before = used_bytes(f);
        lobe_graph_begin_aside(f->graph);
        const uint64_t number = lobe_graph_read_back_late(
            f->graph, graph_fixture_count(f, "aside", retained(f, "aside", COUNT), 3, COUNT),
            (lobe_range){0});
        graph_fixture_execute(f);
        assert_there(f, number, 3);
        assert_true(used_bytes(f) >= before && used_bytes(f) <= before + 4096);
    }
    lobe_graph_begin_aside(f->graph);
    assert_int_equal(lobe_graph_submit(f->graph, &(lobe_vulkan_submission){0}), LOBE_ERROR_GRAPH);
    assert_non_null(strstr(f->recorder.last_error, "can only be executed"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(late_data_are_there_when_the_place_is_free,
                                        graph_fixture_open, graph_fixture_close),
        cmocka_unit_test_setup_teardown(what_is_left_behind_is_not_waited_for, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(memory_of_other_frames_is_not_waited_for,
                                        graph_fixture_open, graph_fixture_close),
        cmocka_unit_test_setup_teardown(frames_aside_leave_the_others_alone, graph_fixture_open,
                                        graph_fixture_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
