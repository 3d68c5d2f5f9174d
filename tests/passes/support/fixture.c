#include "tests/passes/support/fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/host_device.h"

static void record(void *user, lobe_log_level level, const char *message) {
    fixture *f = user;
    if (level == LOBE_LOG_WARNING)
        f->warnings++;
    if (level != LOBE_LOG_ERROR)
        return;
    f->errors++;
    snprintf(f->error, sizeof f->error, "%s", message);
}

lobe_device *fixture_device(fixture *f, lobe_device_parameters parameters) {
    lobe_device *device = NULL;
    parameters.host = &f->host;
    parameters.get_instance_proc_addr = test_vulkan_loader;
    if (lobe_device_create(&parameters, &device) != LOBE_OK)
        fail_msg("no device: %s", f->error);
    return device;
}

static int create(void **state, bool validation) {
    fixture *f = calloc(1, sizeof *f);
    if (!f)
        return -1;
    *state = f;
    f->host = (lobe_host){.write = record, .user = f};
    const lobe_device_parameters parameters = {
        .validation = validation, .get_instance_proc_addr = test_vulkan_loader, .host = &f->host};
    lobe_result result = lobe_device_create(&parameters, &f->device);
    if (result == LOBE_OK)
        result = lobe_graph_create(f->device, &f->graph);
    if (result == LOBE_OK)
        result = lobe_renderer_create(f->device, &f->host, &f->renderer);
    if (result == LOBE_OK)
        return 0;
    print_error("%s: %s\n", lobe_result_name(result), f->error);
    fixture_destroy(state);
    return -1;
}

int fixture_create(void **state) {
    return create(state, false);
}

int fixture_create_validated(void **state) {
    return create(state, true);
}

double fixture_sampler_error(const fixture *f) {
    return lobe_device_describe(f->device)->type == LOBE_DEVICE_CPU ? 0 : 1.0 / 128;
}

void fixture_need_exact_sampler(const fixture *f) {
    if (fixture_sampler_error(f) > 0)
        skip();
}

void validation_is_silent(void **state) {
    const fixture *f = *state;
    assert_int_equal(lobe_device_validation_count(f->device), 0);
    assert_int_equal(f->errors, 0);
}

int fixture_destroy(void **state) {
    fixture *f = *state;
    lobe_renderer_destroy(&f->renderer);
    lobe_graph_destroy(&f->graph);
    lobe_device_destroy(&f->device);
    free(f);
    *state = NULL;
    return 0;
}

void fixture_forget_messages(fixture *f) {
    f->errors = f->warnings = 0;
    f->error[0] = '\0';
}

void assert_failure(const fixture *f, lobe_result result, lobe_result expected, const char *words) {
    if (result != expected)
        fail_msg("%s instead of %s: %s", lobe_result_name(result), lobe_result_name(expected),
                 f->error);
    if (f->errors != 1)
        fail_msg("%u error lines instead of one, the last: %s", f->errors, f->error);
    if (!strstr(f->error, words))
        fail_msg("'%s' does not say '%s'", f->error, words);
}

size_t count_passes(const lobe_graph *graph, const char *name, lobe_pass_state state) {
    const lobe_graph_report *report = lobe_graph_describe(graph);
    size_t count = 0;
    for (size_t i = 0; i < report->pass_count; i++) {
        const lobe_pass_report *pass = &report->passes[i];
        count += pass->state == state && (!name || strcmp(pass->name, name) == 0);
    }
    return count;
}
