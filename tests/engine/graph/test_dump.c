#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include "tests/engine/graph/graph_support.h"

static void assert_contains(const char *text, const char *part) {
    assert_non_null(text);
    if (text && !strstr(text, part))
        fail_msg("no \"%s\" in:\n%s", part, text);
}

static void assert_lacks(const char *text, const char *part) {
    if (strstr(text, part))
        fail_msg("\"%s\" in:\n%s", part, text);
}

static int count_of(const char *text, const char *part) {
    int count = 0;
    for (; (text = strstr(text, part)); text += strlen(part))
        count++;
    return count;
}

/// An upload, retained levels made from each other, a transient that reads them, and a pass that
/// nothing needs.
static void declare(graph_fixture *fixture) {
    lobe_graph_begin(fixture->graph);
    const float numbers[16] = {0};
    lobe_resource upload = lobe_graph_upload(fixture->graph, "numbers", numbers, sizeof numbers);
    lobe_resource levels =
        lobe_graph_image(fixture->graph, &(lobe_image_description){.name = "levels",
                                                                   .format = LOBE_FORMAT_R32_FLOAT,
                                                                   .width = 8,
                                                                   .height = 8,
                                                                   .layers = 3,
                                                                   .levels = 2,
                                                                   .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "paint");
    levels = lobe_pass_write(
        pass, &(lobe_binding){.name = "target", .resource = levels, .range = {0, 1, 0, 0}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_paint.comp", .threads = {8, 8, 3}});
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "halve");
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "source", .resource = levels, .range = {0, 1, 0, 0}});
    levels = lobe_pass_write(
        pass, &(lobe_binding){.name = "target", .resource = levels, .range = {1, 1, 0, 0}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_halve.comp", .threads = {4, 4, 3}});
    lobe_graph_output(fixture->graph, levels);
    lobe_resource odd = graph_fixture_buffer(fixture, "a \"name\" with \\ and \n in it", 64);
    odd = graph_fixture_add(fixture, "add", upload, odd, 1, 16);
    lobe_graph_output(fixture->graph, odd);
    graph_fixture_count(fixture, "useless", graph_fixture_buffer(fixture, "waste", 64), 1, 16);
}

static void text_tells_what_happened(void **state) {
    graph_fixture *fixture = *state;
    declare(fixture);
    graph_fixture_execute(fixture);
    char *text = lobe_graph_dump_text(fixture->graph);
    assert_contains(text, "run     compute  'paint' ");
    assert_contains(text, " ms\n");
    assert_contains(text, "culled  compute  'useless'\n");
    assert_contains(text, "reads 'levels' level 0\n");
    assert_contains(text, "writes 'levels' level 1\n");
    assert_contains(text, "barrier 'levels' level 0: undefined to general\n");
    assert_contains(text, "barrier 'levels' level 0: general to sampled\n");
    assert_contains(text, "retained  'levels' R32_FLOAT 8x8, 3 layers, 2 levels");
    assert_contains(text, "uploaded  'numbers' 64 bytes");
    assert_contains(text, "'waste' 64 bytes; 0 bytes of memory, not used");
    assert_contains(text, "without aliasing");
    assert_contains(text, "'a \"name\" with \\ and ? in it'");
    lobe_release(text);
    declare(fixture);
    graph_fixture_execute(fixture);
    text = lobe_graph_dump_text(fixture->graph);
    assert_contains(text, "skipped compute  'paint'\n");
    assert_contains(text, "skipped compute  'halve'\n");
    assert_contains(text, "run     compute  'add'");
    lobe_release(text);
}

static void graphviz_has_passes_and_contents(void **state) {
    graph_fixture *fixture = *state;
    declare(fixture);
    graph_fixture_execute(fixture);
    char *text = lobe_graph_dump_graphviz(fixture->graph);
    assert_contains(text, "digraph lobe {");
    assert_contains(text, "label=\"paint\\ncompute, run, ");
    assert_contains(text, "label=\"useless\\ncompute, culled");
    assert_contains(text, "a \\\"name\\\" with \\\\ and ? in it");
    assert_contains(text, "without aliasing");
    // Level 0 goes from paint to halve, both levels to the output.
    assert_contains(text, "w0 -> p1;");
    assert_int_equal(count_of(text, "-> output;"), 3);
    assert_int_equal(count_of(text, "{"), 1);
    assert_int_equal(count_of(text, "\n}\n"), 1);
    lobe_release(text);
}

static void a_compiled_graph_has_no_times(void **state) {
    graph_fixture *fixture = *state;
    declare(fixture);
    assert_int_equal(lobe_graph_compile(fixture->graph), LOBE_OK);
    char *text = lobe_graph_dump_graphviz(fixture->graph);
    assert_contains(text, "label=\"paint\\ncompute, run\\n");
    lobe_release(text);
}

static void what_was_not_compiled_is_no_picture(void **state) {
    graph_fixture *fixture = *state;
    declare(fixture);
    char *text = lobe_graph_dump_graphviz(fixture->graph);
    assert_contains(text, "digraph lobe {");
    assert_lacks(text, "paint");
    lobe_release(text);
    text = lobe_graph_dump_text(fixture->graph);
    assert_contains(text, "'levels'");
    lobe_release(text);
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(text_tells_what_happened),
        TEST(graphviz_has_passes_and_contents),
        TEST(a_compiled_graph_has_no_times),
        TEST(what_was_not_compiled_is_no_picture),
    };
    return cmocka_run_group_tests_name("graph_dump", tests, NULL, NULL);
}
