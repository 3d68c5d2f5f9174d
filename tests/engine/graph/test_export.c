// What a frame exports to shaders of the host: descriptors for the variables of a shader of lobe's,
// which stay the same from frame to frame.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include <lobe/vulkan.h>

#include "tests/engine/graph/graph_support.h"

#define SIZE 8

/// A retained image that a pass paints.
static lobe_resource painted(graph_fixture *fixture, bool retained) {
    lobe_resource image = lobe_graph_image(
        fixture->graph, &(lobe_image_description){.name = "painted",
                                                  .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                  .width = SIZE,
                                                  .height = SIZE,
                                                  .retained = retained});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "paint");
    image = lobe_pass_write(pass, &(lobe_binding){.name = "target", .resource = image});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "graph_paint.comp", .threads = {SIZE, SIZE, 1}});
    return image;
}

static void export_to(lobe_pass *pass, const char *shader, const char *name,
                      lobe_resource resource) {
    const lobe_binding binding = {.name = name, .resource = resource};
    lobe_pass_export(pass, &(lobe_export){shader, &binding, 1});
}

/// An image for the variable `source`, and a block, in two exports.
static void declare(graph_fixture *fixture, float value) {
    const float block[8] = {value};
    lobe_graph_begin(fixture->graph);
    lobe_resource settings = lobe_graph_upload(fixture->graph, "settings", block, sizeof block);
    lobe_resource image = painted(fixture, true);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_EXPORT, "export");
    export_to(pass, "graph_halve.comp", "source", image);
    export_to(pass, "graph_settings.comp", "settings_block", settings);
}

static lobe_vulkan_descriptor exported(const graph_fixture *fixture, size_t index) {
    size_t count = 0;
    const lobe_vulkan_descriptor *descriptors = lobe_graph_exported(fixture->graph, index, &count);
    assert_non_null(descriptors);
    assert_int_equal(count, 1);
    return descriptors[0];
}

static void descriptors_fit_the_shader(void **state) {
    graph_fixture *fixture = *state;
    declare(fixture, 1);
    graph_fixture_execute(fixture);
    const lobe_vulkan_descriptor image = exported(fixture, 0), block = exported(fixture, 1);
    assert_int_equal(image.binding, 0);
    assert_int_equal(image.type, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    assert_int_equal(image.image.imageLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    assert_true(image.image.imageView != VK_NULL_HANDLE && image.image.sampler != VK_NULL_HANDLE);
    assert_int_equal(block.type, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    assert_int_equal(block.buffer.range, 32);
    size_t count;
    assert_null(lobe_graph_exported(fixture->graph, 2, &count));
}

static void handles_stay_while_content_changes(void **state) {
    graph_fixture *fixture = *state;
    declare(fixture, 1);
    graph_fixture_execute(fixture);
    assert_int_equal(graph_fixture_state(fixture, "paint"), LOBE_PASS_RUN);
    const lobe_vulkan_descriptor image = exported(fixture, 0), block = exported(fixture, 1);
    for (int frame = 0; frame < 3; frame++) {
        // The second frame is as the first one.
        declare(fixture, (float)(frame + 1));
        graph_fixture_execute(fixture);
        const lobe_vulkan_descriptor image_now = exported(fixture, 0),
                                     block_now = exported(fixture, 1);
        assert_true(image_now.image.imageView == image.image.imageView);
        assert_true(block_now.buffer.buffer == block.buffer.buffer);
        assert_int_equal(block_now.buffer.offset, block.buffer.offset);
        assert_int_equal(graph_fixture_state(fixture, "paint"), LOBE_PASS_SKIPPED);
        assert_int_equal(graph_fixture_state(fixture, "export_copy"),
                         frame == 0 ? LOBE_PASS_SKIPPED : LOBE_PASS_RUN);
    }
}

static void nothing_is_exported_before_the_frame_runs(void **state) {
    graph_fixture *fixture = *state;
    size_t count;
    declare(fixture, 1);
    assert_null(lobe_graph_exported(fixture->graph, 0, &count));
    graph_fixture_execute(fixture);
    lobe_graph_begin(fixture->graph);
    assert_null(lobe_graph_exported(fixture->graph, 0, &count));
}

static lobe_pass *begin(graph_fixture *fixture) {
    log_recorder_start(&fixture->recorder);
    lobe_graph_begin(fixture->graph);
    return lobe_graph_add_pass(fixture->graph, LOBE_PASS_EXPORT, "export");
}

static void mistakes_are_named(void **state) {
    graph_fixture *fixture = *state;
    lobe_pass *pass = begin(fixture);
    export_to(pass, "graph_halve.comp", "source", painted(fixture, false));
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'painted'", "only retained images");
    pass = begin(fixture);
    export_to(pass, "graph_halve.comp", "nowhere", painted(fixture, true));
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'painted'", "'nowhere'", "graph_halve.comp");
    pass = begin(fixture);
    export_to(pass, NULL, "source", painted(fixture, true));
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'export'", "no shader");
    begin(fixture);
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "other");
    export_to(pass, "graph_halve.comp", "source", painted(fixture, true));
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'other'", "export pass");
    pass = begin(fixture);
    lobe_pass_write(pass, &(lobe_binding){.name = "source", .resource = painted(fixture, true)});
    export_to(pass, "graph_halve.comp", "target", painted(fixture, true));
    assert_int_not_equal(lobe_graph_execute(fixture->graph), LOBE_OK);
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(descriptors_fit_the_shader),
        TEST(handles_stay_while_content_changes),
        TEST(nothing_is_exported_before_the_frame_runs),
        TEST(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
