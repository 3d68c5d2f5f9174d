#include "tests/shaders/support/harness.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/device.h>
#include <lobe/graph.h>

#include "engine/shader/shaders.h"
#include "tests/engine/support/cmocka_all.h"

// The shaders of tests/shaders, embedded by the build.
extern const engine_shader_code function_test_shaders[];
extern const size_t function_test_shaders_count;

typedef struct harness {
    lobe_device *device;
    lobe_graph *graph;
} harness;

static void print_line(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level <= LOBE_LOG_WARNING)
        print_error("# %s\n", message);
}

int harness_set_up(void **state) {
    static const lobe_host host = {.write = print_line};
    const lobe_device_parameters parameters = {.validation = true, .host = &host};
    harness *made = calloc(1, sizeof *made);
    *state = made;
    if (!made || lobe_device_create(&parameters, &made->device) != LOBE_OK ||
        engine_shaders_add(made->device, function_test_shaders, function_test_shaders_count,
                           TEST_SHADER_FOLDER) != LOBE_OK)
        return 1;
    return lobe_graph_create(made->device, &made->graph) == LOBE_OK ? 0 : 1;
}

int harness_tear_down(void **state) {
    harness *made = *state;
    bool silent = lobe_device_validation_count(made->device) == 0;
    lobe_graph_destroy(&made->graph);
    lobe_device_destroy(&made->device);
    free(made);
    return silent ? 0 : 1;
}

static lobe_resource declare_call(lobe_graph *graph, const char *shader, uint32_t function,
                                  const lobe_buffer *arguments, size_t count) {
    const lobe_buffer_description description = {.name = "results",
                                                 .size = count * sizeof(harness_result)};
    lobe_resource results = lobe_graph_buffer(graph, &description);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, shader);
    lobe_pass_read(pass, &(lobe_binding){.name = "argument_block",
                                         .resource = lobe_graph_import_buffer(graph, arguments)});
    results = lobe_pass_write(pass, &(lobe_binding){.name = "result_block", .resource = results});
    const lobe_specialisation specialisation = {.id = 0, .bits = function};
    const lobe_dispatch dispatch = {.shader = shader,
                                    .threads = {(uint32_t)count},
                                    .specialisation = &specialisation,
                                    .specialisation_count = 1};
    lobe_pass_dispatch(pass, &dispatch);
    lobe_graph_read_back(graph, results, (lobe_range){0});
    return results;
}

void harness_evaluate(void **state, const char *shader, uint32_t function,
                      const harness_arguments *arguments, size_t count, harness_result *results) {
    harness *made = *state;
    const lobe_buffer_parameters parameters = {
        .name = "arguments", .size = count * sizeof *arguments, .data = arguments};
    lobe_buffer *buffer = NULL;
    assert_int_equal(lobe_buffer_create(made->device, &parameters, &buffer), LOBE_OK);
    lobe_graph_begin(made->graph);
    lobe_resource values = declare_call(made->graph, shader, function, buffer, count);
    lobe_result done = lobe_graph_execute(made->graph);
    size_t size = 0;
    const void *data = lobe_graph_data(made->graph, values, &size);
    if (done == LOBE_OK && data && size == count * sizeof *results)
        memcpy(results, data, size);
    lobe_buffer_destroy(&buffer);
    assert_int_equal(done, LOBE_OK);
    assert_non_null(data);
    assert_int_equal(size, count * sizeof *results);
}
