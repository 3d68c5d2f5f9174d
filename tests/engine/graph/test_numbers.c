// Numbers of what passes make something from (lobe_dispatch.numbered).

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tests/engine/graph/graph_support.h"

#define COUNT 64
#define BYTES (COUNT * sizeof(float))

/// Where frames differ.
typedef struct making {
    float source[COUNT]; ///< upload
    float before, offset, factor;
    uint32_t selection; ///< in the list that the pass with the number writes
    bool without_last, beside;
} making;

/// Two records of arguments; the number is the first word.
static lobe_resource declare_list(graph_fixture *fixture, lobe_resource kept, const making *frame) {
    const struct {
        uint32_t first[4], second[4], offset;
    } constants = {{7, frame->selection}, {1, 1, 1}, 5};
    const lobe_resource list = lobe_graph_buffer(
        fixture->graph, &(lobe_buffer_description){.name = "list", .size = 40, .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "number");
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_arguments.comp",
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .numbered = kept});
    return lobe_pass_write(pass, &(lobe_binding){.name = "argument_block", .resource = list});
}

/// A pass that changes what is kept, as the list says.
static lobe_resource change(graph_fixture *fixture, const char *name, const lobe_resource *source,
                            lobe_resource kept, bool keeps, float value, lobe_resource list) {
    const struct {
        float value;
        uint32_t count;
    } constants = {value, COUNT};
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, name);
    if (source)
        lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = *source});
    const lobe_binding target = {.name = "target_block", .resource = kept};
    kept = keeps ? lobe_pass_modify(pass, &target) : lobe_pass_write(pass, &target);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = source ? "graph_add.comp" : "graph_count.comp",
                                        .constants = &constants,
                                        .constants_size = sizeof constants,
                                        .indirect = list,
                                        .indirect_offset = 20});
    return kept;
}

/// upload -> "before" -> "first" -> kept -> "last" -> kept, after the pass with kept's number.
static uint32_t number_of(graph_fixture *fixture, const making *frame) {
    lobe_graph *graph = fixture->graph;
    lobe_graph_begin(graph);
    lobe_resource kept = lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = "kept", .size = BYTES, .retained = true});
    const bool keeps = lobe_graph_has_content(graph, kept);
    const lobe_resource list = declare_list(fixture, kept, frame);
    if (frame->beside)
        lobe_graph_output(graph, graph_fixture_count(fixture, "beside",
                                                     graph_fixture_buffer(fixture, "others", BYTES),
                                                     2, COUNT));
    const lobe_resource source = graph_fixture_add(
        fixture, "before", lobe_graph_upload(graph, "source", frame->source, sizeof frame->source),
        graph_fixture_buffer(fixture, "middle", BYTES), frame->before, COUNT);
    kept = change(fixture, "first", &source, kept, keeps, frame->offset, list);
    if (!frame->without_last)
        kept = change(fixture, "last", NULL, kept, true, frame->factor, list);
    lobe_graph_output(graph, kept);
    lobe_graph_read_back(graph, list, (lobe_range){0});
    graph_fixture_execute(fixture);
    return *(const uint32_t *)lobe_graph_data(graph, list, NULL);
}

static void numbers_say_what_is_made(void **state) {
    const making same = {.source = {1, 2}, .offset = 3, .factor = 4};
    making frames[7] = {same, same, same, same, same, same, same};
    uint32_t numbers[7];
    frames[1].source[1] = 5;
    frames[2].before = 1;
    frames[3].offset = 5;
    frames[4].factor = 5;
    frames[5].without_last = true;
    frames[6].source[0] = 2;
    for (int i = 0; i < 7; i++) {
        numbers[i] = number_of(*state, &frames[i]);
        assert_true(numbers[i] > 0);
        for (int j = 0; j < i; j++)
            assert_true(numbers[i] != numbers[j]);
    }
    for (int i = 0; i < 7; i++)
        assert_int_equal(number_of(*state, &frames[i]), numbers[i]);
}

/// What was there before, what the shader sees itself, and passes of something else.
static void other_things_do_not_count(void **state) {
    making frame = {.source = {1, 2}, .offset = 3, .factor = 4};
    const uint32_t number = number_of(*state, &frame);
    assert_int_equal(number_of(*state, &frame), number);
    frame.selection = 6;
    assert_int_equal(number_of(*state, &frame), number);
    frame.beside = true;
    assert_int_equal(number_of(*state, &frame), number);
    lobe_graph_invalidate(((graph_fixture *)*state)->graph);
    assert_int_equal(number_of(*state, &frame), number);
}

/// It counts as a constant: the pass that has it is skipped while it stays.
static void the_pass_runs_with_another_number(void **state) {
    making frame = {.source = {1, 2}, .offset = 3, .factor = 4};
    const uint32_t number = number_of(*state, &frame);
    assert_int_equal(graph_fixture_state(*state, "number"), LOBE_PASS_RUN);
    assert_int_equal(number_of(*state, &frame), number);
    assert_int_equal(graph_fixture_state(*state, "number"), LOBE_PASS_SKIPPED);
    frame.factor = 5;
    assert_int_not_equal(number_of(*state, &frame), number);
    assert_int_equal(graph_fixture_state(*state, "number"), LOBE_PASS_RUN);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void dispatch_with(graph_fixture *fixture, const char *name, lobe_resource numbered,
                          size_t offset) {
    const struct {
        float factor;
        uint32_t count;
    } constants = {2, COUNT};
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_count.comp",
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .numbered = numbered,
                                              .number_offset = offset});
}

static void a_number_needs_room(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    dispatch_with(fixture, "wrong", graph_fixture_buffer(fixture, "made", BYTES), 5);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'made'", "byte 5 of 8");
}

static void a_number_has_one_place(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    const lobe_resource made = graph_fixture_buffer(fixture, "made", BYTES);
    dispatch_with(fixture, "right", made, 0);
    dispatch_with(fixture, "wrong", made, 0);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'made'", "'right'");
}

static void a_number_is_of_something(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    dispatch_with(fixture, "wrong", (lobe_resource){.index = 99, .version = 1}, 0);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "handle");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(numbers_say_what_is_made, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(other_things_do_not_count, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(the_pass_runs_with_another_number, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(a_number_needs_room, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(a_number_has_one_place, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(a_number_is_of_something, graph_fixture_open,
                                        graph_fixture_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
