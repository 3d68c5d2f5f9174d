#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tests/engine/graph/graph_support.h"

static const lobe_pass_report *report_of(const graph_fixture *fixture, const char *name) {
    const lobe_graph_report *report = lobe_graph_describe(fixture->graph);
    for (size_t i = 0; i < report->pass_count; i++)
        if (strcmp(report->passes[i].name, name) == 0)
            return &report->passes[i];
    fail_msg("no pass '%s'", name);
    return NULL;
}

static void assert_traffic(const graph_fixture *fixture, const char *name, uint64_t read,
                           uint64_t written) {
    const lobe_pass_report *pass = report_of(fixture, name);
    assert_int_equal(pass->read_bytes, read);
    assert_int_equal(pass->written_bytes, written);
}

static lobe_resource pyramid(graph_fixture *fixture, uint32_t width, uint32_t height,
                             uint32_t layers, uint32_t levels) {
    return lobe_graph_image(fixture->graph,
                            &(lobe_image_description){.name = "pyramid",
                                                      .format = LOBE_FORMAT_RGBA16_FLOAT,
                                                      .width = width,
                                                      .height = height,
                                                      .layers = layers,
                                                      .levels = levels});
}

static lobe_resource fill(graph_fixture *fixture, lobe_resource target, lobe_range range) {
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
    return lobe_pass_fill(pass, target, range, (const float[4]){1.0f});
}

// ---------------------------------------------------------------------------------------------
// Cases

static void buffers_count_whole(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource source = graph_fixture_buffer(fixture, "source", 1000);
    lobe_resource target = graph_fixture_buffer(fixture, "target", 400);
    source = graph_fixture_count(fixture, "count", source, 1.0f, 64);
    target = graph_fixture_add(fixture, "add", source, target, 1.0f, 64);
    lobe_graph_output(fixture->graph, target);
    graph_fixture_execute(fixture);
    assert_traffic(fixture, "count", 0, 1000);
    assert_traffic(fixture, "add", 1000, 400);
}

/// Only the levels and layers that a range names, each with its own extent: 13x5, 6x2, 3x1, 1x1.
static void ranges_count_their_texels(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource source = fill(fixture, pyramid(fixture, 13, 5, 3, 4), (lobe_range){0});
    lobe_resource target = pyramid(fixture, 3, 1, 2, 1);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "copy");
    target = lobe_pass_copy(pass, source, (lobe_range){2, 1, 1, 2}, target, (lobe_range){0});
    lobe_graph_output(fixture->graph, target);
    graph_fixture_execute(fixture);
    assert_traffic(fixture, "fill", 0, (65 + 12 + 3 + 1) * 3 * 8);
    assert_traffic(fixture, "copy", 3 * 2 * 8, 3 * 2 * 8);
}

/// Of a part of an image, what is copied, not what stays.
static void parts_count_their_texels(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource source = fill(fixture, pyramid(fixture, 13, 5, 1, 1), (lobe_range){0});
    lobe_resource target = fill(fixture, pyramid(fixture, 7, 7, 1, 1), (lobe_range){0});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "copy");
    target = lobe_pass_copy_part(pass, source, &(lobe_rectangle){8, 1, 4, 3}, target, 2, 4);
    lobe_graph_output(fixture->graph, target);
    graph_fixture_execute(fixture);
    assert_traffic(fixture, "copy", 4 * 3 * 8, 4 * 3 * 8);
}

/// Two bindings of one image count as one read.
static void what_is_bound_twice_counts_once(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_R32_FLOAT, 16, 8);
    lobe_resource sum = graph_fixture_image(fixture, "sum", LOBE_FORMAT_R32_FLOAT, 16, 8);
    image = fill(fixture, image, (lobe_range){0});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "twice");
    lobe_pass_read(pass, &(lobe_binding){.name = "sampled", .resource = image});
    lobe_pass_read(pass, &(lobe_binding){.name = "stored", .resource = image});
    sum = lobe_pass_write(pass, &(lobe_binding){.name = "sum", .resource = sum});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_two_ways.comp", .threads = {16, 8}});
    lobe_graph_output(fixture->graph, sum);
    graph_fixture_execute(fixture);
    assert_traffic(fixture, "twice", 16 * 8 * 4, 16 * 8 * 4);
}

/// Modifying counts as read and written, clearing only as written; all samples count.
static void attachments_count_as_they_load(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = lobe_graph_image(
        fixture->graph, &(lobe_image_description){.name = "colour",
                                                  .format = LOBE_FORMAT_RGBA8_UNORM,
                                                  .width = 10,
                                                  .height = 6,
                                                  .samples = 4});
    lobe_pass *clear = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "clear");
    colour =
        lobe_pass_colour(clear, 0, &(lobe_attachment){.resource = colour, .load = LOBE_LOAD_CLEAR});
    lobe_pass *keep = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "keep");
    colour =
        lobe_pass_colour(keep, 0, &(lobe_attachment){.resource = colour, .load = LOBE_LOAD_KEEP});
    lobe_graph_output(fixture->graph, colour);
    graph_fixture_execute(fixture);
    assert_traffic(fixture, "clear", 0, 10 * 6 * 4 * 4);
    assert_traffic(fixture, "keep", 10 * 6 * 4 * 4, 10 * 6 * 4 * 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(buffers_count_whole, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(ranges_count_their_texels, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(parts_count_their_texels, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(what_is_bound_twice_counts_once, graph_fixture_open,
                                        graph_fixture_close),
        cmocka_unit_test_setup_teardown(attachments_count_as_they_load, graph_fixture_open,
                                        graph_fixture_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
