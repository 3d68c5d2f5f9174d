#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tests/engine/graph/graph_support.h"

#define COUNT 64
#define BYTES (COUNT * sizeof(float))

static lobe_resource retained(graph_fixture *fixture, const char *name, size_t size) {
    return lobe_graph_buffer(
        fixture->graph, &(lobe_buffer_description){.name = name, .size = size, .retained = true});
}

/// Where the frames of these tests differ.
typedef struct chain {
    float source[COUNT], other[COUNT]; ///< uploads
    float offset;                      ///< of the first pass
    bool without_second;
} chain;

/// uploads -> "first" -> kept_1 -> "second" -> kept_2 -> "last" (transient) -> read back; and
/// "side" from the other upload.
static lobe_resource declare_chain(graph_fixture *fixture, const chain *frame) {
    lobe_graph_begin(fixture->graph);
    lobe_resource source =
        lobe_graph_upload(fixture->graph, "source", frame->source, sizeof frame->source);
    lobe_resource other =
        lobe_graph_upload(fixture->graph, "other", frame->other, sizeof frame->other);
    lobe_resource middle = graph_fixture_buffer(fixture, "middle", BYTES);
    middle = graph_fixture_add(fixture, "before", source, middle, 0.0f, COUNT);
    lobe_resource kept = retained(fixture, "kept_1", BYTES);
    kept = graph_fixture_add(fixture, "first", middle, kept, frame->offset, COUNT);
    lobe_resource side = retained(fixture, "side", BYTES);
    side = graph_fixture_add(fixture, "side", other, side, 1.0f, COUNT);
    lobe_graph_output(fixture->graph, side);
    if (!frame->without_second)
        kept = graph_fixture_add(fixture, "second", kept, retained(fixture, "kept_2", BYTES), 1.0f,
                                 COUNT);
    lobe_resource result = graph_fixture_buffer(fixture, "result", BYTES);
    result = graph_fixture_add(fixture, "last", kept, result, 1.0f, COUNT);
    lobe_graph_read_back(fixture->graph, result, (lobe_range){0});
    return result;
}

static float run_chain(graph_fixture *fixture, const chain *frame) {
    lobe_resource result = declare_chain(fixture, frame);
    graph_fixture_execute(fixture);
    const float *data = lobe_graph_data(fixture->graph, result, NULL);
    assert_non_null(data);
    return data[1];
}

/// In the order "before", "first", "side", "second", "last".
static void assert_states(const graph_fixture *fixture, lobe_pass_state before,
                          lobe_pass_state first, lobe_pass_state side, lobe_pass_state second) {
    assert_int_equal(graph_fixture_state(fixture, "before"), before);
    assert_int_equal(graph_fixture_state(fixture, "first"), first);
    assert_int_equal(graph_fixture_state(fixture, "side"), side);
    assert_int_equal(graph_fixture_state(fixture, "second"), second);
    assert_int_equal(graph_fixture_state(fixture, "last"), LOBE_PASS_RUN);
}

static void unchanged_passes_are_skipped(void **state) {
    graph_fixture *fixture = *state;
    const chain frame = {.source = {0, 5}};
    assert_true(run_chain(fixture, &frame) == 7.0f);
    assert_states(fixture, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_RUN);
    for (int i = 0; i < 2; i++) {
        assert_true(run_chain(fixture, &frame) == 7.0f);
        // A pass that only a skipped pass needs is culled, and its resources take no memory.
        assert_states(fixture, LOBE_PASS_CULLED, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED,
                      LOBE_PASS_SKIPPED);
    }
}

static void only_dependents_of_a_change_run_again(void **state) {
    graph_fixture *fixture = *state;
    chain frame = {.source = {0, 5}};
    run_chain(fixture, &frame);
    frame.other[3] = 1.0f;
    assert_true(run_chain(fixture, &frame) == 7.0f);
    assert_states(fixture, LOBE_PASS_CULLED, LOBE_PASS_SKIPPED, LOBE_PASS_RUN, LOBE_PASS_SKIPPED);
    frame.source[1] = 6.0f;
    assert_true(run_chain(fixture, &frame) == 8.0f);
    assert_states(fixture, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_SKIPPED, LOBE_PASS_RUN);
    // A push constant counts like content.
    frame.offset = 100.0f;
    assert_true(run_chain(fixture, &frame) == 108.0f);
    assert_states(fixture, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_SKIPPED, LOBE_PASS_RUN);
}

static void invalidation_runs_all_again(void **state) {
    graph_fixture *fixture = *state;
    chain frame = {.source = {0, 5}};
    run_chain(fixture, &frame);
    lobe_device_memory first, second;
    lobe_device_memory_query(fixture->device, &first);
    lobe_graph_invalidate(fixture->graph);
    run_chain(fixture, &frame);
    assert_states(fixture, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_RUN);
    lobe_device_memory_query(fixture->device, &second);
    assert_int_equal(first.used_bytes, second.used_bytes);
    run_chain(fixture, &frame);
    assert_states(fixture, LOBE_PASS_CULLED, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED,
                  LOBE_PASS_SKIPPED);
    // Invalidation after the declaration counts, too.
    declare_chain(fixture, &frame);
    lobe_graph_invalidate(fixture->graph);
    graph_fixture_execute(fixture);
    assert_states(fixture, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_RUN, LOBE_PASS_RUN);
}

static void invalidation_may_spare_some(void **state) {
    graph_fixture *fixture = *state;
    chain frame = {.source = {0, 5}};
    run_chain(fixture, &frame);
    lobe_graph_invalidate_except(fixture->graph, "kept");
    assert_true(run_chain(fixture, &frame) == 7.0f);
    assert_states(fixture, LOBE_PASS_CULLED, LOBE_PASS_SKIPPED, LOBE_PASS_RUN, LOBE_PASS_SKIPPED);
}

static void what_is_not_declared_again_is_freed(void **state) {
    graph_fixture *fixture = *state;
    chain frame = {.source = {0, 5}};
    run_chain(fixture, &frame);
    uint64_t with_second = lobe_graph_describe(fixture->graph)->retained_bytes;
    frame.without_second = true;
    assert_true(run_chain(fixture, &frame) == 6.0f);
    uint64_t without_second = lobe_graph_describe(fixture->graph)->retained_bytes;
    assert_int_equal(3 * without_second, 2 * with_second);
    frame.without_second = false;
    assert_true(run_chain(fixture, &frame) == 7.0f);
    assert_states(fixture, LOBE_PASS_CULLED, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED, LOBE_PASS_RUN);
}

/// A table, which a pass fills, if `declared`; and a buffer, so that the frame has an output.
static void run_table(graph_fixture *fixture, bool declared) {
    const chain frame = {.source = {0, 5}};
    (void)declare_chain(fixture, &frame);
    if (declared) {
        lobe_resource table = lobe_graph_image(
            fixture->graph, &(lobe_image_description){.name = "table",
                                                      .format = LOBE_FORMAT_R32_FLOAT,
                                                      .width = 4,
                                                      .height = 4,
                                                      .retained = true,
                                                      .permanent = true});
        table =
            lobe_pass_fill(lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill table"),
                           table, (lobe_range){0}, (float[4]){3});
        lobe_graph_output(fixture->graph, table);
    }
    graph_fixture_execute(fixture);
}

static void permanent_images_are_made_once(void **state) {
    graph_fixture *fixture = *state;
    run_table(fixture, true);
    assert_int_equal(graph_fixture_state(fixture, "fill table"), LOBE_PASS_RUN);
    run_table(fixture, false);
    lobe_graph_invalidate(fixture->graph);
    run_table(fixture, true);
    assert_int_equal(graph_fixture_state(fixture, "fill table"), LOBE_PASS_SKIPPED);
    assert_int_equal(graph_fixture_state(fixture, "first"), LOBE_PASS_RUN);
}

static void another_size_means_another_resource(void **state) {
    graph_fixture *fixture = *state;
    for (int i = 0; i < 4; i++) {
        size_t size = i < 2 ? BYTES : 2 * BYTES;
        lobe_graph_begin(fixture->graph);
        lobe_resource kept = retained(fixture, "kept", size);
        kept = graph_fixture_count(fixture, "count", kept, 1.0f, COUNT);
        lobe_graph_output(fixture->graph, kept);
        graph_fixture_execute(fixture);
        assert_int_equal(graph_fixture_state(fixture, "count"),
                         i % 2 ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
    }
}

static void imports_count_by_their_content(void **state) {
    graph_fixture *fixture = *state;
    lobe_buffer *buffer = NULL;
    float data[COUNT] = {1, 2, 3};
    const lobe_buffer_parameters parameters = {.name = "held", .size = BYTES, .data = data};
    assert_int_equal(lobe_buffer_create(fixture->device, &parameters, &buffer), LOBE_OK);
    const lobe_pass_state expected[] = {LOBE_PASS_RUN, LOBE_PASS_SKIPPED, LOBE_PASS_RUN,
                                        LOBE_PASS_SKIPPED};
    for (int i = 0; i < 4; i++) {
        data[0] = (float)i;
        if (i == 2)
            assert_int_equal(lobe_buffer_update(buffer, data), LOBE_OK);
        lobe_graph_begin(fixture->graph);
        lobe_resource kept = retained(fixture, "kept", BYTES);
        kept = graph_fixture_add(fixture, "add", lobe_graph_import_buffer(fixture->graph, buffer),
                                 kept, 1, COUNT);
        lobe_graph_read_back(fixture->graph, kept, (lobe_range){0});
        graph_fixture_execute(fixture);
        assert_int_equal(graph_fixture_state(fixture, "add"), expected[i]);
        const float *result = lobe_graph_data(fixture->graph, kept, NULL);
        assert_true(result[0] == (i < 2 ? 2.0f : 3.0f));
    }
    lobe_buffer_destroy(&buffer);
}

static lobe_resource declare_levels(graph_fixture *fixture, float value) {
    lobe_graph_begin(fixture->graph);
    lobe_resource image =
        lobe_graph_image(fixture->graph, &(lobe_image_description){.name = "levels",
                                                                   .format = LOBE_FORMAT_R32_FLOAT,
                                                                   .width = 4,
                                                                   .height = 4,
                                                                   .levels = 3,
                                                                   .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "base");
    image = lobe_pass_fill(pass, image, (lobe_range){0, 1, 0, 0}, (const float[4]){value});
    for (uint32_t level = 1; level < 3; level++) {
        pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "halve");
        lobe_pass_read(
            pass,
            &(lobe_binding){.name = "source", .resource = image, .range = {level - 1, 1, 0, 0}});
        image = lobe_pass_write(
            pass, &(lobe_binding){.name = "target", .resource = image, .range = {level, 1, 0, 0}});
        lobe_pass_dispatch(pass,
                           &(lobe_dispatch){.shader = "graph_halve.comp", .threads = {4, 4, 1}});
    }
    lobe_graph_read_back(fixture->graph, image, (lobe_range){2, 1, 0, 1});
    return image;
}

/// The layout of each level is kept between frames.
static void levels_are_retained(void **state) {
    graph_fixture *fixture = *state;
    const float values[] = {3.0f, 3.0f, 3.0f, 4.0f, 4.0f};
    for (int i = 0; i < 5; i++) {
        bool same = i > 0 && values[i] == values[i - 1];
        lobe_resource image = declare_levels(fixture, values[i]);
        graph_fixture_execute(fixture);
        const float *texel = lobe_graph_data(fixture->graph, image, NULL);
        assert_true(texel[0] == values[i]);
        assert_int_equal(graph_fixture_state(fixture, "base"),
                         same ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
        assert_int_equal(graph_fixture_state(fixture, "halve"),
                         same ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
    }
}

/// Content of an earlier version that is no longer in memory is written again, and so is everything
/// after it.
static void overwritten_content_is_made_again(void **state) {
    graph_fixture *fixture = *state;
    const float offsets[] = {1.0f, 1.0f, 2.0f, 2.0f};
    for (int i = 0; i < 4; i++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource kept = retained(fixture, "kept", BYTES);
        kept = graph_fixture_count(fixture, "early", kept, 1.0f, COUNT);
        lobe_resource seen = graph_fixture_buffer(fixture, "seen", BYTES);
        seen = graph_fixture_add(fixture, "look", kept, seen, offsets[i], COUNT);
        lobe_resource copy = retained(fixture, "copy", BYTES);
        copy = graph_fixture_add(fixture, "hold", seen, copy, 0.0f, COUNT);
        kept = graph_fixture_count(fixture, "late", kept, 10.0f, COUNT);
        lobe_graph_read_back(fixture->graph, copy, (lobe_range){0});
        lobe_graph_read_back(fixture->graph, kept, (lobe_range){0});
        graph_fixture_execute(fixture);
        bool again = i % 2 == 0;
        assert_int_equal(graph_fixture_state(fixture, "early"),
                         again ? LOBE_PASS_RUN : LOBE_PASS_SKIPPED);
        assert_int_equal(graph_fixture_state(fixture, "late"),
                         again ? LOBE_PASS_RUN : LOBE_PASS_SKIPPED);
        const float *held = lobe_graph_data(fixture->graph, copy, NULL);
        assert_true(held[7] == 7.0f + offsets[i]);
        const float *late = lobe_graph_data(fixture->graph, kept, NULL);
        assert_true(late[7] == 70.0f);
    }
}

static lobe_resource accumulate(graph_fixture *fixture, bool start) {
    lobe_graph_begin(fixture->graph);
    lobe_resource sum =
        lobe_graph_image(fixture->graph, &(lobe_image_description){.name = "sum",
                                                                   .format = LOBE_FORMAT_R32_FLOAT,
                                                                   .width = 8,
                                                                   .height = 8,
                                                                   .retained = true});
    lobe_resource sample = graph_fixture_image(fixture, "sample", LOBE_FORMAT_R32_FLOAT, 8, 8);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "sample");
    sample = lobe_pass_fill(pass, sample, (lobe_range){0}, (const float[4]){1.5f});
    if (start) {
        pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "start");
        sum = lobe_pass_fill(pass, sum, (lobe_range){0}, (const float[4]){100.0f});
    }
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "accumulate");
    lobe_pass_read(pass, &(lobe_binding){.name = "sample_image", .resource = sample});
    sum = lobe_pass_modify(pass, &(lobe_binding){.name = "sum", .resource = sum});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "graph_accumulate.comp", .threads = {8, 8}});
    lobe_graph_output(fixture->graph, sum);
    return sum;
}

static void sums_run_over_frames(void **state) {
    graph_fixture *fixture = *state;
    lobe_resource sum;
    for (int i = 0; i < 5; i++) {
        sum = accumulate(fixture, i == 0);
        if (i == 4)
            lobe_graph_read_back(fixture->graph, sum, (lobe_range){0});
        graph_fixture_execute(fixture);
        assert_int_equal(graph_fixture_state(fixture, "accumulate"), LOBE_PASS_RUN);
    }
    const float *texels = lobe_graph_data(fixture->graph, sum, NULL);
    assert_true(texels[63] == 107.5f);
    // To start again, the whole chain runs, although it is the same as in the first frame.
    accumulate(fixture, true);
    graph_fixture_execute(fixture);
    assert_int_equal(graph_fixture_state(fixture, "start"), LOBE_PASS_RUN);
}

static void a_sum_needs_a_start(void **state) {
    graph_fixture *fixture = *state;
    accumulate(fixture, false);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'accumulate'", "'sum'");
}

/// "add" adds an upload to a buffer that evolves, and "look" adds 1 to it, into a retained buffer.
/// Returns that.
static float run_settling(graph_fixture *fixture, float number, uint32_t settles) {
    float numbers[COUNT] = {0, number};
    lobe_graph_begin(fixture->graph);
    const lobe_resource source =
        lobe_graph_upload(fixture->graph, "source", numbers, sizeof numbers);
    lobe_resource sum = lobe_graph_buffer(
        fixture->graph,
        &(lobe_buffer_description){
            .name = "sum", .size = BYTES, .retained = true, .evolves = true, .settles = settles});
    if (!lobe_graph_has_content(fixture->graph, sum)) {
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "empty");
        sum = lobe_pass_fill(pass, sum, (lobe_range){0}, (const float[4]){0});
    }
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "add");
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = source});
    sum = lobe_pass_modify(pass, &(lobe_binding){.name = "sum_block", .resource = sum});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "graph_add_up.comp", .threads = {COUNT, 1, 1}});
    const lobe_resource result =
        graph_fixture_add(fixture, "look", sum, retained(fixture, "result", BYTES), 1.0f, COUNT);
    lobe_graph_read_back(fixture->graph, result, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *data = lobe_graph_data(fixture->graph, result, NULL);
    assert_non_null(data);
    return data[1];
}

static float run_evolving(graph_fixture *fixture, float number) {
    return run_settling(fixture, number, 0);
}

static void what_evolves_goes_on_when_something_else_changes(void **state) {
    graph_fixture *fixture = *state;
    assert_true(run_evolving(fixture, 2) == 3);
    for (int i = 0; i < 3; i++) {
        assert_true(run_evolving(fixture, 2) == 3);
        assert_int_equal(graph_fixture_state(fixture, "add"), LOBE_PASS_SKIPPED);
        assert_int_equal(graph_fixture_state(fixture, "look"), LOBE_PASS_SKIPPED);
    }
    assert_true(run_evolving(fixture, 5) == 8);
    assert_true(run_evolving(fixture, 5) == 8);
    assert_true(run_evolving(fixture, 2) == 10);
}

static void what_evolves_may_begin_again(void **state) {
    graph_fixture *fixture = *state;
    assert_true(run_evolving(fixture, 2) == 3);
    lobe_graph_forget_buffer(fixture->graph, "result of another");
    assert_true(run_evolving(fixture, 4) == 7);
    lobe_graph_forget_buffer(fixture->graph, "sum");
    // Until a pass needs it.
    assert_true(run_evolving(fixture, 4) == 7);
    assert_true(run_evolving(fixture, 5) == 6);
    assert_true(run_evolving(fixture, 6) == 12);
    lobe_graph_invalidate(fixture->graph);
    assert_true(run_evolving(fixture, 6) == 7);
}

static void what_settles_runs_again_after_the_last_change(void **state) {
    graph_fixture *fixture = *state;
    // What begins has nothing to settle.
    for (int i = 0; i < 2; i++) {
        assert_true(run_settling(fixture, 2, 3) == 3);
        assert_false(lobe_graph_settles(fixture->graph));
    }
    assert_true(run_settling(fixture, 5, 3) == 8);
    assert_true(run_settling(fixture, 5, 3) == 13);
    // Another change: from the start again.
    assert_true(run_settling(fixture, 1, 3) == 14);
    for (int i = 1; i <= 3; i++) {
        assert_true(lobe_graph_settles(fixture->graph));
        assert_true(run_settling(fixture, 1, 3) == (float)(14 + i));
        assert_int_equal(graph_fixture_state(fixture, "add"), LOBE_PASS_RUN);
    }
    for (int i = 0; i < 2; i++) {
        assert_false(lobe_graph_settles(fixture->graph));
        assert_true(run_settling(fixture, 1, 3) == 17);
        assert_int_equal(graph_fixture_state(fixture, "add"), LOBE_PASS_SKIPPED);
    }
}

/// "approach" goes a step towards a goal, and says when it is there; it settles in 20 frames at
/// most.
static void declare_approach(graph_fixture *fixture, uint32_t goal) {
    lobe_graph_begin(fixture->graph);
    lobe_resource state =
        lobe_graph_buffer(fixture->graph, &(lobe_buffer_description){.name = "state",
                                                                     .size = 2 * sizeof goal,
                                                                     .retained = true,
                                                                     .evolves = true,
                                                                     .settles = 20,
                                                                     .rest_offset = sizeof goal});
    if (!lobe_graph_has_content(fixture->graph, state)) {
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "empty");
        state = lobe_pass_fill(pass, state, (lobe_range){0}, (const float[4]){0});
    }
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "approach");
    const lobe_resource source = lobe_graph_upload(fixture->graph, "source", &goal, sizeof goal);
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = source});
    state = lobe_pass_modify(pass, &(lobe_binding){.name = "state_block", .resource = state});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "graph_approach.comp", .threads = {1, 1, 1}});
    lobe_graph_output(fixture->graph, state);
}

static void approach(graph_fixture *fixture, uint32_t goal) {
    declare_approach(fixture, goal);
    graph_fixture_execute(fixture);
}

/// The number of frames after the last one in which "approach" runs: none of the next twenty others
/// may.
static int count_settling(graph_fixture *fixture, uint32_t goal) {
    int count = 0;
    for (int i = 0; i < 20; i++) {
        const bool settles = lobe_graph_settles(fixture->graph);
        approach(fixture, goal);
        const bool ran = graph_fixture_state(fixture, "approach") == LOBE_PASS_RUN;
        assert_true(ran == settles && (!ran || count == i));
        count += ran;
    }
    return count;
}

static void what_settles_stops_where_the_device_says_so(void **state) {
    graph_fixture *fixture = *state;
    approach(fixture, 2);
    assert_int_equal(count_settling(fixture, 2), 0);
    // A step with the change, three more, and one that changes nothing.
    approach(fixture, 5);
    assert_int_equal(count_settling(fixture, 5), 4);
    // The device says so at once, but is asked in the second frame after a change.
    approach(fixture, 5);
    approach(fixture, 4);
    assert_int_equal(count_settling(fixture, 4), 2);
    // It says so of what is no longer the last change.
    approach(fixture, 5);
    approach(fixture, 5);
    approach(fixture, 5);
    assert_false(lobe_graph_settles(fixture->graph));
    approach(fixture, 9);
    assert_true(lobe_graph_settles(fixture->graph));
    assert_int_equal(count_settling(fixture, 9), 4);
    // It never says so.
    approach(fixture, 100);
    assert_int_equal(count_settling(fixture, 100), 20);
}

/// Nobody waits to hear it.
static void the_device_says_late_that_something_rests(void **state) {
    graph_fixture *fixture = *state;
    const lobe_vulkan_submission plain = {0};
    int runs = 0;
    lobe_graph_set_frames_in_flight(fixture->graph, 3);
    for (int i = 0; i < 20; i++) {
        declare_approach(fixture, i == 0 ? 1 : 4);
        assert_int_equal(lobe_graph_submit(fixture->graph, &plain), LOBE_OK);
        runs += graph_fixture_state(fixture, "approach") == LOBE_PASS_RUN;
    }
    assert_false(lobe_graph_settles(fixture->graph));
    // Asked in the second and the fifth frame after the change, heard three frames later.
    assert_int_equal(runs, 1 + 8);
    assert_int_equal(lobe_graph_wait(fixture->graph), LOBE_OK);
}

static void a_kept_pass_is_skipped_while_its_results_are_valid(void **state) {
    graph_fixture *fixture = *state;
    for (int i = 0; i < 2; i++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource kept = retained(fixture, "kept", BYTES);
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
        lobe_pass_fill(pass, kept, (lobe_range){0}, (const float[4]){1.0f});
        lobe_pass_keep(pass);
        graph_fixture_execute(fixture);
        assert_int_equal(graph_fixture_state(fixture, "fill"),
                         i ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
    }
}

/// A frame that fails does not change retained content.
static void a_failed_frame_changes_nothing(void **state) {
    graph_fixture *fixture = *state;
    const chain frame = {.source = {0, 5}};
    run_chain(fixture, &frame);
    lobe_resource result = declare_chain(fixture, &frame);
    lobe_graph_output(fixture->graph, (lobe_resource){.index = result.index, .version = 99});
    assert_int_equal(lobe_graph_execute(fixture->graph), LOBE_ERROR_GRAPH);
    fixture->recorder.errors = 0;
    run_chain(fixture, &frame);
    assert_states(fixture, LOBE_PASS_CULLED, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED,
                  LOBE_PASS_SKIPPED);
}

/// Any change to a draw makes its pass run again.
static void raster_passes_are_compared(void **state) {
    graph_fixture *fixture = *state;
    static const float vertices[] = {-1, -1, -1, 3, 3, -1};
    lobe_draw draws[] = {{.index_count = 3},
                         {.index_count = 3},
                         {.index_count = 3, .cull = LOBE_CULL_BACK},
                         {.index_count = 3, .cull = LOBE_CULL_BACK},
                         {.index_count = 3, .cull = LOBE_CULL_BACK, .blend = LOBE_BLEND_ADD}};
    const float constants[5] = {1, 1, 1, 1, 0};
    for (int i = 0; i < 7; i++) {
        lobe_draw draw = draws[i < 5 ? i : 4];
        lobe_graph_begin(fixture->graph);
        lobe_resource picture = lobe_graph_image(
            fixture->graph, &(lobe_image_description){.name = "picture",
                                                      .format = LOBE_FORMAT_RGBA16_FLOAT,
                                                      .width = 8,
                                                      .height = 8,
                                                      .retained = true});
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "draw");
        lobe_pass_read(pass,
                       &(lobe_binding){.name = "vertex_block",
                                       .resource = lobe_graph_upload(fixture->graph, "vertices",
                                                                     vertices, sizeof vertices)});
        picture = lobe_pass_colour(
            pass, 0, &(lobe_attachment){.resource = picture, .clear = {i == 6 ? 1.0f : 0.0f}});
        draw.vertex_shader = "graph_triangle.vert";
        draw.fragment_shader = "graph_triangle.frag";
        draw.constants = constants;
        draw.constants_size = sizeof constants;
        lobe_pass_draw(pass, &draw);
        lobe_graph_output(fixture->graph, picture);
        graph_fixture_execute(fixture);
        bool same = i == 1 || i == 3 || i == 5;
        assert_int_equal(graph_fixture_state(fixture, "draw"),
                         same ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
    }
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(unchanged_passes_are_skipped),
        TEST(only_dependents_of_a_change_run_again),
        TEST(invalidation_runs_all_again),
        TEST(invalidation_may_spare_some),
        TEST(what_is_not_declared_again_is_freed),
        TEST(permanent_images_are_made_once),
        TEST(another_size_means_another_resource),
        TEST(imports_count_by_their_content),
        TEST(levels_are_retained),
        TEST(overwritten_content_is_made_again),
        TEST(sums_run_over_frames),
        TEST(a_sum_needs_a_start),
        TEST(what_evolves_goes_on_when_something_else_changes),
        TEST(what_evolves_may_begin_again),
        TEST(what_settles_runs_again_after_the_last_change),
        TEST(what_settles_stops_where_the_device_says_so),
        TEST(the_device_says_late_that_something_rests),
        TEST(a_kept_pass_is_skipped_while_its_results_are_valid),
        TEST(a_failed_frame_changes_nothing),
        TEST(raster_passes_are_compared),
    };
    return cmocka_run_group_tests_name("graph_retain", tests, NULL, NULL);
}
