// Every call to Vulkan that can fail fails once: each time the call of ours that needed it says so
// by its code and one line, and all that was made is destroyed.

#include "tests/engine/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#include <lobe/graph.h>

#include "engine/vulkan_check.h"
#include "tests/engine/log_recorder.h"
#include "tests/engine/test_shaders.h"
#include "tests/engine/vulkan_faults.h"

// ---------------------------------------------------------------------------------------------
// Something of everything

typedef struct work {
    log_recorder recorder;
    lobe_device *device;
    lobe_texture *texture;
    lobe_buffer *vertices;
    lobe_graph *graph;
} work;

static const float triangle[] = {-1, -1, -1, 3, 3, -1};

static lobe_result open_work(work *w) {
    float texels[4][4] = {{0}};
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 2, 2, texels};
    lobe_result result =
        lobe_device_create(&(lobe_device_parameters){.log = &w->recorder.log}, &w->device);
    result = result ? result : add_test_shaders(w->device);
    result = result ? result
                    : lobe_texture_create(w->device, &(lobe_texture_parameters){.image = &image},
                                          &w->texture);
    result = result ? result
                    : lobe_buffer_create(
                          w->device,
                          &(lobe_buffer_parameters){.size = sizeof triangle, .data = triangle},
                          &w->vertices);
    return result ? result : lobe_graph_create(w->device, &w->graph);
}

/// A raster pass, a compute pass with upload, a copy of the texture, and results read back.
static lobe_result run_frame(work *w, uint32_t extent) {
    const struct {
        float colour[4];
        float depth;
    } constants = {{1, 1, 1, 1}, 0};
    const struct {
        float offset;
        uint32_t count;
    } offset = {1, 4};
    lobe_graph_begin(w->graph);
    lobe_image_description description = {
        .name = "colour", .format = LOBE_FORMAT_RGBA32_FLOAT, .width = extent, .height = extent};
    lobe_resource colour = lobe_graph_image(w->graph, &description);
    lobe_pass *pass = lobe_graph_add_pass(w->graph, LOBE_PASS_RASTER, "triangle");
    colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
    const lobe_binding vertices = {.name = "vertex_block",
                                   .resource = lobe_graph_import_buffer(w->graph, w->vertices)};
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "graph_triangle.vert",
                                      .fragment_shader = "graph_triangle.frag",
                                      .index_count = 3,
                                      .constants = &constants,
                                      .constants_size = 20,
                                      .bindings = &vertices,
                                      .binding_count = 1});
    description = (lobe_image_description){.name = "copy",
                                           .format = LOBE_FORMAT_RGBA32_FLOAT,
                                           .width = 2,
                                           .height = 2,
                                           .retained = true};
    lobe_resource copy = lobe_graph_image(w->graph, &description);
    pass = lobe_graph_add_pass(w->graph, LOBE_PASS_TRANSFER, "copy");
    copy = lobe_pass_copy(pass, lobe_graph_import_texture(w->graph, w->texture), (lobe_range){0},
                          copy, (lobe_range){0});
    lobe_resource sums = lobe_graph_buffer(
        w->graph, &(lobe_buffer_description){.name = "sums", .size = 16, .retained = true});
    pass = lobe_graph_add_pass(w->graph, LOBE_PASS_COMPUTE, "add");
    const float values[4] = {(float)extent, 2, 3, 4};
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block",
                                         .resource = lobe_graph_upload(w->graph, "values", values,
                                                                       sizeof values)});
    sums = lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = sums});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_add.comp",
                                              .threads = {4},
                                              .constants = &offset,
                                              .constants_size = sizeof offset});
    lobe_graph_read_back(w->graph, colour, (lobe_range){0});
    lobe_graph_read_back(w->graph, copy, (lobe_range){0});
    lobe_graph_read_back(w->graph, sums, (lobe_range){0});
    return lobe_graph_execute(w->graph);
}

static void close_work(work *w) {
    lobe_graph_destroy(&w->graph);
    lobe_buffer_destroy(&w->vertices);
    lobe_texture_destroy(&w->texture);
    lobe_device_destroy(&w->device);
}

/// Two frames, the second of another size. `*torn_down`: the fault came only at the end.
static lobe_result run(work *w, bool *torn_down) {
    faults.calls = 0;
    faults.failed = NULL;
    *w = (work){0};
    log_recorder_start(&w->recorder);
    lobe_result result = open_work(w);
    result = result ? result : run_frame(w, 4);
    result = result ? result : run_frame(w, 8);
    *torn_down = faults.failed == NULL;
    return result;
}

static void check_fault(VkResult with) {
    work w;
    bool torn_down;
    faults.fault = with;
    lobe_result result = run(&w, &torn_down);
    const char *name = faults.failed ? faults.failed : "(teardown)";
    lobe_result expected = torn_down ? LOBE_OK : engine_vulkan_result(with);
    if (result != expected || w.recorder.errors != !torn_down)
        fail_msg("call %d, %s: %s instead of %s, %d lines, the last '%s'", faults.failing, name,
                 lobe_result_name(result), lobe_result_name(expected), w.recorder.errors,
                 w.recorder.last_error);
    // Once more on the same objects, where there are any: nothing is left half-built.
    if (w.graph && with != VK_ERROR_DEVICE_LOST && run_frame(&w, 4) != LOBE_OK)
        fail_msg("call %d, %s: %s", faults.failing, name, w.recorder.last_error);
    close_work(&w);
    if (faults.alive)
        fail_msg("call %d, %s: %d objects are left", faults.failing, name, faults.alive);
}

static void each_call_fails_once(void **state) {
    (void)state;
    work w;
    bool torn_down;
    faults.failing = 0;
    assert_int_equal(run(&w, &torn_down), LOBE_OK);
    const int during = faults.calls;
    close_work(&w);
    assert_int_equal(faults.alive, 0);
    assert_true(during > 60);
    for (faults.failing = 1; faults.failing <= during; faults.failing++) {
        check_fault(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        // The way back is the same for any code: every other call is enough.
        if (faults.failing % 2)
            check_fault(VK_ERROR_DEVICE_LOST);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_call_fails_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
