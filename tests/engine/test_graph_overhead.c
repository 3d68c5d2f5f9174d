// Frames that are declared like the one before take no memory of the host, and make nothing of
// Vulkan's.

#include "tests/engine/cmocka_all.h"

#include <stdlib.h>

#include "engine/host_clock.h"
#include "tests/engine/graph_frame.h"
#include "tests/engine/log_recorder.h"
#include "tests/engine/test_shaders.h"
#include "tests/engine/vulkan_faults.h"

#define SETTLING 4 ///< frames until everything has its size
#define STEADY   6 ///< frames that are counted

// ---------------------------------------------------------------------------------------------
// Functions that the linker puts before the library's: they count what lobe takes

static int taken;

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    taken++;
    return __real_malloc(size);
}

void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size) {
    taken++;
    return __real_calloc(count, size);
}

void *__real_realloc(void *memory, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_realloc(void *memory, size_t size) {
    taken++;
    return __real_realloc(memory, size);
}

char *__real_strdup(const char *text);
char *__wrap_strdup(const char *text);
char *__wrap_strdup(const char *text) {
    taken++;
    return __real_strdup(text);
}

/// The C library's takes memory for more than a few items.
void __real_qsort(void *items, size_t count, size_t size,
                  int (*compare)(const void *, const void *));
void __wrap_qsort(void *items, size_t count, size_t size,
                  int (*compare)(const void *, const void *));
void __wrap_qsort(void *items, size_t count, size_t size,
                  int (*compare)(const void *, const void *)) {
    taken++;
    __real_qsort(items, count, size, compare);
}

// ---------------------------------------------------------------------------------------------

typedef struct fixture {
    log_recorder recorder;
    lobe_device *device;
    graph_frame frame;
} fixture;

static int open_fixture(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    log_recorder_start(&f->recorder);
    return open_device_with_test_shaders(&f->recorder.log, NULL, &f->device) != LOBE_OK ||
           graph_frame_open(f->device, &f->frame) != LOBE_OK;
}

static int close_fixture(void **state) {
    fixture *f = *state;
    graph_frame_close(&f->frame);
    uint64_t mistakes = lobe_device_validation_count(f->device);
    if (mistakes)
        print_error("%s\n", f->recorder.last_error);
    lobe_device_destroy(&f->device);
    free(f);
    return mistakes || faults.alive;
}

static void run_frame(graph_frame *frame, float time) {
    frame->time = time;
    graph_frame_declare(frame);
    assert_int_equal(lobe_graph_execute(frame->graph), LOBE_OK);
    const float *mean = lobe_graph_data(frame->graph, frame->mean, NULL);
    assert_non_null(mean);
    assert_true(mean[5] == time + 21.0f);
}

static uint32_t count_passes(const lobe_graph *graph, lobe_pass_state state) {
    const lobe_graph_report *report = lobe_graph_describe(graph);
    uint32_t count = 0;
    for (size_t n = 0; n < report->pass_count; n++)
        count += report->passes[n].state == state;
    return count;
}

/// Each frame's time is `step` after that of the one before.
static void check_steady(graph_frame *frame, float step) {
    float time = 1.0f;
    for (int n = 0; n < SETTLING; n++, time += step)
        run_frame(frame, time);
    taken = faults.made = 0;
    for (int n = 0; n < STEADY; n++, time += step)
        run_frame(frame, time);
    if (taken || faults.made)
        fail_msg("%d allocations and %d objects in %d frames", taken, faults.made, STEADY);
}

static void the_first_frame_is_counted(void **state) {
    fixture *f = *state;
    taken = faults.made = 0;
    run_frame(&f->frame, 1.0f);
    assert_true(taken > 50);
    assert_true(faults.made > 50);
    assert_int_equal(count_passes(f->frame.graph, LOBE_PASS_RUN), GRAPH_FRAME_PASSES);
}

static void frames_of_other_content_take_nothing(void **state) {
    fixture *f = *state;
    check_steady(&f->frame, 1.0f);
    assert_int_equal(count_passes(f->frame.graph, LOBE_PASS_RUN), GRAPH_FRAME_PASSES);
}

static void frames_of_the_same_content_take_nothing(void **state) {
    fixture *f = *state;
    check_steady(&f->frame, 0.0f);
    assert_true(count_passes(f->frame.graph, LOBE_PASS_SKIPPED) > 0);
}

static void frames_in_flight_take_nothing(void **state) {
    fixture *f = *state;
    lobe_graph_set_frames_in_flight(f->frame.graph, 2);
    check_steady(&f->frame, 1.0f);
}

static void the_times_of_the_host_are_its_own(void **state) {
    fixture *f = *state;
    const lobe_graph_report *report = lobe_graph_describe(f->frame.graph);
    for (int n = 0; n < 2; n++) {
        double start = engine_host_milliseconds();
        run_frame(&f->frame, (float)n);
        assert_true(report->host_milliseconds > 0.0);
        assert_true(report->host_milliseconds < engine_host_milliseconds() - start);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_first_frame_is_counted, open_fixture, close_fixture),
        cmocka_unit_test_setup_teardown(frames_of_other_content_take_nothing, open_fixture,
                                        close_fixture),
        cmocka_unit_test_setup_teardown(frames_of_the_same_content_take_nothing, open_fixture,
                                        close_fixture),
        cmocka_unit_test_setup_teardown(frames_in_flight_take_nothing, open_fixture, close_fixture),
        cmocka_unit_test_setup_teardown(the_times_of_the_host_are_its_own, open_fixture,
                                        close_fixture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
