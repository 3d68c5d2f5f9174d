// Frames declared like the one before allocate no host memory and create no Vulkan objects.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>

#include "engine/graph/report.h"
#include "tests/engine/graph/graph_frame.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/test_shaders.h"
#include "tests/engine/support/vulkan_faults.h"

#define SETTLING 4 ///< frames until everything has its size
#define STEADY   6 ///< frames that are counted

// ---------------------------------------------------------------------------------------------
// A function that the linker calls instead of the C library's

static int sorted;

/// qsort allocates for more than a few items.
void __real_qsort(void *items, size_t count, size_t size,
                  int (*compare)(const void *, const void *));
void __wrap_qsort(void *items, size_t count, size_t size,
                  int (*compare)(const void *, const void *));
void __wrap_qsort(void *items, size_t count, size_t size,
                  int (*compare)(const void *, const void *)) {
    sorted++;
    __real_qsort(items, count, size, compare);
}

// ---------------------------------------------------------------------------------------------

typedef struct fixture {
    counting_allocator counting;
    log_recorder recorder;
    lobe_device *device;
    graph_frame frame;
} fixture;

static int open_fixture(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    counting_allocator_start(&f->counting);
    log_recorder_start(&f->recorder);
    f->recorder.host.allocator = &f->counting.allocator;
    return open_device_with_test_shaders(&f->recorder.host, NULL, &f->device) != LOBE_OK ||
           graph_frame_open(f->device, &f->frame) != LOBE_OK;
}

static int close_fixture(void **state) {
    fixture *f = *state;
    graph_frame_close(&f->frame);
    uint64_t mistakes = lobe_device_validation_count(f->device);
    if (mistakes)
        print_error("%s\n", f->recorder.last_error);
    lobe_device_destroy(&f->device);
    assert_nothing_left(&f->counting);
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
    for (size_t i = 0; i < report->pass_count; i++)
        count += report->passes[i].state == state;
    return count;
}

/// The time of each frame is `step` after that of the previous one.
static void check_steady(fixture *f, float step) {
    graph_frame *frame = &f->frame;
    float time = 1.0f;
    for (int i = 0; i < SETTLING; i++, time += step)
        run_frame(frame, time);
    f->counting.taken = 0;
    faults.made = 0;
    sorted = 0;
    for (int i = 0; i < STEADY; i++, time += step)
        run_frame(frame, time);
    if (f->counting.taken || sorted || faults.made)
        fail_msg("%zu allocations, %d calls of qsort and %d objects in %d frames",
                 f->counting.taken, sorted, faults.made, STEADY);
}

static void the_first_frame_is_counted(void **state) {
    fixture *f = *state;
    f->counting.taken = 0;
    faults.made = 0;
    run_frame(&f->frame, 1.0f);
    assert_true(f->counting.taken > 50);
    assert_true(faults.made > 50);
    assert_int_equal(count_passes(f->frame.graph, LOBE_PASS_RUN), GRAPH_FRAME_PASSES);
}

static void frames_of_other_content_take_nothing(void **state) {
    fixture *f = *state;
    check_steady(f, 1.0f);
    assert_int_equal(count_passes(f->frame.graph, LOBE_PASS_RUN), GRAPH_FRAME_PASSES);
}

static void frames_of_the_same_content_take_nothing(void **state) {
    fixture *f = *state;
    check_steady(f, 0.0f);
    assert_true(count_passes(f->frame.graph, LOBE_PASS_SKIPPED) > 0);
}

static void frames_in_flight_take_nothing(void **state) {
    fixture *f = *state;
    lobe_graph_set_frames_in_flight(f->frame.graph, 2);
    check_steady(f, 1.0f);
}

static void images_of_the_host_with_views_take_nothing(void **state) {
    fixture *f = *state;
    host_device host = {0};
    lobe_vulkan_export_device(f->device, &host.vulkan);
    host_image image = host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, 8, 8,
                                         VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    const VkImageViewCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image.image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = image.format,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    lobe_vulkan_image target = {.image = image.image,
                                .format = image.format,
                                .width = 8,
                                .height = 8,
                                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
    assert_int_equal(vkCreateImageView(host.vulkan.device, &create, NULL, &target.view), 0);
    f->frame.target = &target;
    check_steady(f, 1.0f);
    vkDestroyImageView(host.vulkan.device, target.view, NULL);
    host_image_destroy(&host, &image);
}

/// A retained pass that comes and goes before them moves transients in time, but not in memory.
static void what_lies_the_same_way_is_kept(void **state) {
    fixture *f = *state;
    lobe_graph *graph = f->frame.graph;
    for (int i = 0; i < SETTLING + STEADY; i++) {
        if (i == SETTLING)
            faults.made = 0;
        const float half = (float)(i / 2);
        lobe_graph_begin(graph);
        lobe_resource kept = lobe_graph_buffer(
            graph, &(lobe_buffer_description){.name = "kept", .size = 16, .retained = true});
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "retained");
        kept = lobe_pass_fill(pass, kept, (lobe_range){0}, (float[4]){half});
        lobe_resource copy =
            lobe_graph_buffer(graph, &(lobe_buffer_description){.name = "copy", .size = 16});
        pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "copy");
        copy = lobe_pass_copy(pass, kept, (lobe_range){0}, copy, (lobe_range){0});
        lobe_graph_read_back(graph, copy, (lobe_range){0});
        assert_int_equal(lobe_graph_execute(graph), LOBE_OK);
        assert_int_equal(count_passes(graph, LOBE_PASS_SKIPPED), i % 2);
        assert_true(*(const float *)lobe_graph_data(graph, copy, NULL) == half);
    }
    assert_int_equal(faults.made, 0);
}

static void the_times_of_the_host_are_its_own(void **state) {
    fixture *f = *state;
    const lobe_graph_report *report = lobe_graph_describe(f->frame.graph);
    for (int i = 0; i < 2; i++) {
        double start = engine_host_milliseconds();
        run_frame(&f->frame, (float)i);
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
        cmocka_unit_test_setup_teardown(images_of_the_host_with_views_take_nothing, open_fixture,
                                        close_fixture),
        cmocka_unit_test_setup_teardown(what_lies_the_same_way_is_kept, open_fixture,
                                        close_fixture),
        cmocka_unit_test_setup_teardown(the_times_of_the_host_are_its_own, open_fixture,
                                        close_fixture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
