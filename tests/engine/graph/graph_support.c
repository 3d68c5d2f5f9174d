#include "tests/engine/graph/graph_support.h"

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/test_shaders.h"

int graph_fixture_open(void **state) {
    graph_fixture *fixture = calloc(1, sizeof *fixture);
    *state = fixture;
    log_recorder_start(&fixture->recorder);
    return open_device_with_test_shaders(&fixture->recorder.host, NULL, &fixture->device) !=
               LOBE_OK ||
           lobe_graph_create(fixture->device, &fixture->graph) != LOBE_OK;
}

int graph_fixture_close(void **state) {
    graph_fixture *fixture = *state;
    lobe_device_memory memory;
    lobe_graph_destroy(&fixture->graph);
    lobe_device_memory_query(fixture->device, &memory);
    uint64_t mistakes = lobe_device_validation_count(fixture->device);
    if (mistakes)
        print_error("%s\n", fixture->recorder.last_error);
    lobe_device_destroy(&fixture->device);
    free(fixture);
    return mistakes || memory.used_bytes;
}

lobe_resource graph_fixture_buffer(graph_fixture *fixture, const char *name, size_t size) {
    return lobe_graph_buffer(fixture->graph,
                             &(lobe_buffer_description){.name = name, .size = size});
}

lobe_resource graph_fixture_image(graph_fixture *fixture, const char *name, lobe_format format,
                                  uint32_t width, uint32_t height) {
    return lobe_graph_image(fixture->graph,
                            &(lobe_image_description){
                                .name = name, .format = format, .width = width, .height = height});
}

lobe_resource graph_fixture_count(graph_fixture *fixture, const char *name, lobe_resource target,
                                  float factor, uint32_t count) {
    struct {
        float factor;
        uint32_t count;
    } constants = {factor, count};
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, name);
    target = lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = target});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_count.comp",
                                              .threads = {count},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return target;
}

lobe_resource graph_fixture_add(graph_fixture *fixture, const char *name, lobe_resource source,
                                lobe_resource target, float offset, uint32_t count) {
    struct {
        float offset;
        uint32_t count;
    } constants = {offset, count};
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = source});
    target = lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = target});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_add.comp",
                                              .threads = {count},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return target;
}

lobe_pass_state graph_fixture_state(const graph_fixture *fixture, const char *pass) {
    const lobe_graph_report *report = lobe_graph_describe(fixture->graph);
    for (size_t i = 0; i < report->pass_count; i++)
        if (strcmp(report->passes[i].name, pass) == 0)
            return report->passes[i].state;
    fail_msg("no pass '%s' was reported", pass);
    return LOBE_PASS_CULLED;
}

void graph_fixture_execute(graph_fixture *fixture) {
    if (lobe_graph_execute(fixture->graph) != LOBE_OK)
        fail_msg("%s", fixture->recorder.last_error);
    assert_int_equal(fixture->recorder.errors, 0);
}

void graph_fixture_expect(graph_fixture *fixture, lobe_result expected, const char *const words[]) {
    lobe_result result = lobe_graph_execute(fixture->graph);
    assert_string_equal(lobe_result_name(result), lobe_result_name(expected));
    assert_int_equal(fixture->recorder.errors, 1);
    for (; *words; words++)
        if (!strstr(fixture->recorder.last_error, *words))
            fail_msg("no '%s' in: %s", *words, fixture->recorder.last_error);
}

// ---------------------------------------------------------------------------------------------
// Gates

graph_gate graph_gate_close(const graph_fixture *fixture) {
    lobe_vulkan_device vulkan;
    lobe_vulkan_export_device(fixture->device, &vulkan);
    graph_gate made = {.device = vulkan.device};
    const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                            .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo create = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                          .pNext = &type};
    assert_int_equal(vkCreateSemaphore(made.device, &create, NULL, &made.semaphore), VK_SUCCESS);
    return made;
}

void graph_gate_destroy(const graph_gate *gate) {
    vkDestroySemaphore(gate->device, gate->semaphore, NULL);
}

void graph_gate_submit_behind(graph_fixture *fixture, const graph_gate *gate, uint64_t value) {
    const lobe_vulkan_semaphore wait = {.semaphore = gate->semaphore, .value = value};
    assert_int_equal(lobe_graph_submit(fixture->graph,
                                       &(lobe_vulkan_submission){.waits = &wait, .wait_count = 1}),
                     LOBE_OK);
}

void graph_gate_open(const graph_gate *gate, uint64_t value) {
    const VkSemaphoreSignalInfo signal = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO,
                                          .semaphore = gate->semaphore,
                                          .value = value};
    assert_int_equal(vkSignalSemaphore(gate->device, &signal), VK_SUCCESS);
}
