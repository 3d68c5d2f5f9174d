// Graphs of one device whose passes would write the same retained image have it once, and what one
// of them writes later does not reach the others.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/vulkan.h>

#include "engine/graph/state.h"
#include "tests/engine/graph/graph_support.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/test_shaders.h"

#define TEST(function) cmocka_unit_test_setup_teardown(function, open_graphs, close_graphs)

enum { EXTENT = 64, TEXELS = EXTENT * EXTENT + EXTENT * EXTENT / 4 };

/// Two graphs of one device.
typedef struct fixture {
    graph_fixture first, second;
    host_device host; ///< the same device, for command buffers
} fixture;

static int open_graphs(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    log_recorder_start(&f->first.recorder);
    log_recorder_start(&f->second.recorder);
    const lobe_device_parameters parameters = {.validation = true, .host = &f->first.recorder.host};
    if (lobe_device_create(&parameters, &f->first.device) != LOBE_OK)
        return 1;
    f->second.device = f->first.device;
    lobe_vulkan_export_device(f->first.device, &f->host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = f->host.vulkan.queue_family};
    return vkCreateCommandPool(f->host.vulkan.device, &pool, NULL, &f->host.pool) != VK_SUCCESS ||
           add_test_shaders(f->first.device) != LOBE_OK ||
           lobe_graph_create(f->first.device, &f->first.graph) != LOBE_OK ||
           lobe_graph_create(f->first.device, &f->second.graph) != LOBE_OK;
}

static int close_graphs(void **state) {
    fixture *f = *state;
    lobe_device_memory memory;
    lobe_graph_destroy(&f->first.graph);
    lobe_graph_destroy(&f->second.graph);
    vkDestroyCommandPool(f->host.vulkan.device, f->host.pool, NULL);
    lobe_device_memory_query(f->first.device, &memory);
    const uint64_t mistakes = lobe_device_validation_count(f->first.device);
    if (f->first.recorder.errors)
        print_error("%s\n", f->first.recorder.last_error);
    const int errors = f->first.recorder.errors;
    lobe_device_destroy(&f->first.device);
    free(f);
    return mistakes || memory.used_bytes || errors;
}

static lobe_resource declare_image(lobe_graph *graph, const char *name) {
    return lobe_graph_image(graph, &(lobe_image_description){
                                       .name = name,
                                       .format = LOBE_FORMAT_R32_FLOAT,
                                       .width = EXTENT,
                                       .height = EXTENT,
                                       .levels = 2,
                                       .retained = true,
                                       .shared = true,
                                   });
}

static lobe_resource fill_level(lobe_graph *graph, const char *pass, lobe_resource image,
                                uint32_t level, float value) {
    return lobe_pass_fill(lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, pass), image,
                          (lobe_range){.first_level = level, .level_count = 1}, (float[4]){value});
}

/// A frame that reads an image back, after passes that fill its two levels.
static lobe_resource declare_frame(lobe_graph *graph, float first_level, float second_level) {
    lobe_graph_begin(graph);
    lobe_resource image = declare_image(graph, "map");
    image = fill_level(graph, "first level", image, 0, first_level);
    image = fill_level(graph, "second level", image, 1, second_level);
    lobe_graph_read_back(graph, image, (lobe_range){0});
    return image;
}

static void assert_levels(const graph_fixture *g, lobe_resource image, float first_level,
                          float second_level) {
    size_t size = 0;
    const float *data = lobe_graph_data(g->graph, image, &size);
    assert_int_equal(size, TEXELS * sizeof *data);
    for (size_t i = 0; i < TEXELS; i++)
        assert_float_equal(data[i], i < EXTENT * EXTENT ? first_level : second_level, 0);
}

static void run(graph_fixture *g, float first_level, float second_level) {
    const lobe_resource image = declare_frame(g->graph, first_level, second_level);
    graph_fixture_execute(g);
    assert_levels(g, image, first_level, second_level);
}

static void assert_states(const graph_fixture *g, lobe_pass_state first_level,
                          lobe_pass_state second_level) {
    assert_int_equal(graph_fixture_state(g, "first level"), first_level);
    assert_int_equal(graph_fixture_state(g, "second level"), second_level);
}

static VkImage image_of(const graph_fixture *g) {
    return g->graph->kept.retained->object.image;
}

static uint64_t used_bytes(const fixture *f) {
    lobe_device_memory memory;
    lobe_device_memory_query(f->first.device, &memory);
    return memory.used_bytes;
}

// ---------------------------------------------------------------------------------------------
// What is shared

static void another_graph_makes_nothing(void **state) {
    fixture *f = *state;
    const uint64_t nothing = used_bytes(f);
    run(&f->first, 1, 2);
    const uint64_t alone = used_bytes(f) - nothing;
    assert_states(&f->first, LOBE_PASS_RUN, LOBE_PASS_RUN);
    for (int n = 0; n < 2; n++) {
        run(&f->second, 1, 2);
        assert_states(&f->second, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
        run(&f->first, 1, 2);
        assert_states(&f->first, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
    }
    assert_ptr_equal(image_of(&f->first), image_of(&f->second));
    // Each has its own memory to read back.
    const uint64_t image = f->first.graph->kept.retained->allocation.size;
    assert_int_equal(used_bytes(f) - nothing, alone + alone - image);
}

/// A driver may lose the content of images that come from an undefined layout.
static void another_graph_keeps_the_content(void **state) {
    fixture *f = *state;
    run(&f->first, 1, 2);
    run(&f->second, 1, 2);
    char *dump = lobe_graph_dump_text(f->second.graph);
    assert_non_null(strstr(dump, "barrier 'map': sampled to copy source"));
    lobe_release(dump);
}

static void other_content_is_not_shared(void **state) {
    fixture *f = *state;
    run(&f->first, 1, 2);
    run(&f->second, 1, 3);
    assert_states(&f->second, LOBE_PASS_RUN, LOBE_PASS_RUN);
    run(&f->first, 1, 2);
    assert_ptr_not_equal(image_of(&f->first), image_of(&f->second));
}

/// Whoever wrote more would take it from the other graph, which would have to begin again.
static void what_is_not_finished_is_not_shared(void **state) {
    fixture *f = *state;
    graph_fixture *const both[] = {&f->first, &f->second};
    for (int n = 0; n < 2; n++) {
        lobe_graph_begin(both[n]->graph);
        lobe_resource image = declare_image(both[n]->graph, "map");
        image = fill_level(both[n]->graph, "first level", image, 0, 1);
        lobe_graph_output(both[n]->graph, image);
        graph_fixture_execute(both[n]);
        assert_int_equal(graph_fixture_state(both[n], "first level"), LOBE_PASS_RUN);
    }
    for (int n = 0; n < 2; n++) {
        run(both[n], 1, 2);
        assert_states(both[n], LOBE_PASS_SKIPPED, LOBE_PASS_RUN);
    }
    run(&f->second, 1, 2);
    assert_ptr_equal(image_of(&f->first), image_of(&f->second));
}

/// Two images of one graph change separately.
static void a_graph_does_not_share_with_itself(void **state) {
    fixture *f = *state;
    run(&f->first, 1, 2);
    lobe_graph_begin(f->first.graph);
    lobe_resource images[2];
    for (int n = 0; n < 2; n++) {
        images[n] = declare_image(f->first.graph, n ? "other" : "map");
        images[n] = fill_level(f->first.graph, "first level", images[n], 0, 1);
        images[n] = fill_level(f->first.graph, "second level", images[n], 1, 2);
        lobe_graph_read_back(f->first.graph, images[n], (lobe_range){0});
    }
    graph_fixture_execute(&f->first);
    const engine_graph_retained *kept = f->first.graph->kept.retained;
    assert_ptr_not_equal(kept->object.image, kept->next->object.image);
    for (int n = 0; n < 2; n++)
        assert_levels(&f->first, images[n], 1, 2);
}

// ---------------------------------------------------------------------------------------------
// Changes

static void check_change(graph_fixture *changed, graph_fixture *other) {
    run(changed, 1, 2);
    run(other, 1, 2);
    assert_ptr_equal(image_of(changed), image_of(other));
    run(changed, 1, 5);
    // What was valid of the image stays with the other graph.
    assert_states(changed, LOBE_PASS_RUN, LOBE_PASS_RUN);
    run(other, 1, 2);
    assert_states(other, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
    run(changed, 1, 6);
    assert_states(changed, LOBE_PASS_SKIPPED, LOBE_PASS_RUN); // its own by now
    run(other, 1, 2);
    assert_ptr_not_equal(image_of(changed), image_of(other));
}

static void the_first_graph_changes_its_own(void **state) {
    fixture *f = *state;
    check_change(&f->first, &f->second);
}

static void the_second_graph_changes_its_own(void **state) {
    fixture *f = *state;
    run(&f->first, 1, 2);
    check_change(&f->second, &f->first);
}

static void whoever_is_left_writes_in_place(void **state) {
    fixture *f = *state;
    run(&f->first, 1, 2);
    run(&f->second, 1, 2);
    lobe_graph_destroy(&f->first.graph);
    const VkImage image = image_of(&f->second);
    run(&f->second, 1, 5);
    assert_states(&f->second, LOBE_PASS_SKIPPED, LOBE_PASS_RUN);
    assert_ptr_equal(image_of(&f->second), image);
    assert_int_equal(lobe_graph_create(f->first.device, &f->first.graph), LOBE_OK);
    run(&f->first, 1, 2);
    assert_states(&f->first, LOBE_PASS_RUN, LOBE_PASS_RUN);
    run(&f->second, 1, 5);
}

static void rebuilding_stays_in_its_graph(void **state) {
    fixture *f = *state;
    run(&f->first, 1, 2);
    run(&f->second, 1, 2);
    lobe_graph_invalidate(f->second.graph);
    run(&f->second, 1, 2);
    assert_states(&f->second, LOBE_PASS_RUN, LOBE_PASS_RUN);
    const VkImage image = image_of(&f->second);
    for (int n = 0; n < 2; n++) {
        run(&f->first, 1, 2);
        assert_states(&f->first, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
        assert_ptr_not_equal(image_of(&f->first), image);
        run(&f->second, 1, 2); // neither takes it back to rebuild it again
        assert_ptr_equal(image_of(&f->second), image);
    }
}

/// One pass fills two images.
static void run_two(graph_fixture *g) {
    lobe_resource images[2];
    lobe_graph_begin(g->graph);
    lobe_pass *pass = lobe_graph_add_pass(g->graph, LOBE_PASS_TRANSFER, "both");
    for (int n = 0; n < 2; n++) {
        images[n] = lobe_pass_fill(pass, declare_image(g->graph, n ? "other" : "map"),
                                   (lobe_range){0}, (float[4]){(float)n});
        lobe_graph_read_back(g->graph, images[n], (lobe_range){0});
    }
    graph_fixture_execute(g);
    for (int n = 0; n < 2; n++)
        assert_levels(g, images[n], (float)n, (float)n);
}

/// The other graph has only one of the images that the pass writes.
static void a_pass_that_runs_writes_nothing_shared(void **state) {
    fixture *f = *state;
    run_two(&f->first);
    lobe_graph_begin(f->first.graph);
    lobe_graph_read_back(f->first.graph, declare_image(f->first.graph, "map"), (lobe_range){0});
    graph_fixture_execute(&f->first); // "other" is gone
    run_two(&f->second);
    assert_int_equal(graph_fixture_state(&f->second, "both"), LOBE_PASS_RUN);
    assert_ptr_not_equal(image_of(&f->first), image_of(&f->second));
    run_two(&f->first);
}

// ---------------------------------------------------------------------------------------------
// The host's command buffers

static VkCommandBuffer record(const fixture *f, const graph_fixture *g, float first_level,
                              lobe_resource *image) {
    *image = declare_frame(g->graph, first_level, 2);
    const lobe_vulkan_submission submission = {.commands = host_begin(&f->host)};
    assert_int_equal(lobe_graph_submit(g->graph, &submission), LOBE_OK);
    return submission.commands;
}

/// Until the next frame of its graph, an image may be in commands that were not submitted.
static void what_the_host_submits_is_shared_later(void **state) {
    fixture *f = *state;
    lobe_resource image;
    VkCommandBuffer commands = record(f, &f->first, 1, &image);
    run(&f->second, 1, 2);
    assert_states(&f->second, LOBE_PASS_RUN, LOBE_PASS_RUN);
    lobe_graph_destroy(&f->second.graph);
    host_finish(&f->host, commands);
    lobe_graph_begin(f->first.graph);
    assert_int_equal(lobe_graph_create(f->first.device, &f->second.graph), LOBE_OK);
    run(&f->second, 1, 2);
    assert_states(&f->second, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
}

/// The host's frame draws two views, whose images are equal, and shared as soon as both are known.
static void what_was_made_at_once_becomes_one(void **state) {
    fixture *f = *state;
    lobe_resource images[2];
    VkCommandBuffer first = record(f, &f->first, 1, &images[0]);
    VkCommandBuffer second = record(f, &f->second, 1, &images[1]);
    host_finish(&f->host, second);
    host_finish(&f->host, first);
    assert_ptr_not_equal(image_of(&f->first), image_of(&f->second));
    const uint64_t used = used_bytes(f), image = f->first.graph->kept.retained->allocation.size;
    for (int n = 0; n < 2; n++) {
        run(&f->first, 1, 2);
        run(&f->second, 1, 2);
        assert_states(&f->first, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
        assert_states(&f->second, LOBE_PASS_SKIPPED, LOBE_PASS_SKIPPED);
        assert_ptr_equal(image_of(&f->first), image_of(&f->second));
        assert_int_equal(used_bytes(f), used - image);
    }
    check_change(&f->first, &f->second);
}

/// What was valid in it stays valid.
static void what_changes_meanwhile_stays_apart(void **state) {
    fixture *f = *state;
    lobe_resource images[2];
    VkCommandBuffer first = record(f, &f->first, 1, &images[0]);
    VkCommandBuffer second = record(f, &f->second, 1, &images[1]);
    host_finish(&f->host, first);
    host_finish(&f->host, second);
    run(&f->first, 1, 2);
    run(&f->second, 1, 5);
    assert_states(&f->second, LOBE_PASS_SKIPPED, LOBE_PASS_RUN);
}

/// Each finds the layout that it assumes, in whatever order the host submits them.
static void frames_may_overtake_each_other(void **state) {
    fixture *f = *state;
    lobe_resource images[2];
    run(&f->first, 1, 2);
    run(&f->second, 1, 2);
    for (float value = 1; value < 3; value++) {
        VkCommandBuffer first = record(f, &f->first, 1, &images[0]);
        VkCommandBuffer second = record(f, &f->second, value, &images[1]);
        host_finish(&f->host, second);
        host_finish(&f->host, first);
        assert_int_equal(lobe_graph_wait(f->first.graph), LOBE_OK);
        assert_int_equal(lobe_graph_wait(f->second.graph), LOBE_OK);
        assert_levels(&f->first, images[0], 1, 2);
        assert_levels(&f->second, images[1], value, 2);
    }
}

// ---------------------------------------------------------------------------------------------
// Frames in flight

/// Lets the device begin with a frame when lobe next submits something.
typedef struct gate {
    VkDevice device;
    VkSemaphore semaphore;
    bool open;
} gate;

static void open_gate(void *user) {
    gate *closed = user;
    const VkSemaphoreSignalInfo signal = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO,
                                          .semaphore = closed->semaphore,
                                          .value = 1};
    if (!closed->open)
        assert_int_equal(vkSignalSemaphore(closed->device, &signal), VK_SUCCESS);
    closed->open = true;
}

/// A frame that runs finds the gate closed until it submits something: to wait, or itself.
static void run_behind(const fixture *f, graph_fixture *g, gate *closed, float second_level) {
    f->first.device->import.lock_queue = open_gate;
    f->first.device->import.user = closed;
    run(g, 1, second_level);
    f->first.device->import.lock_queue = NULL;
    assert_true(closed->open);
    vkDestroySemaphore(closed->device, closed->semaphore, NULL);
}

/// A frame that samples the image, behind a closed gate.
static void submit_sampling(fixture *f, graph_fixture *g, const gate *closed) {
    const lobe_vulkan_semaphore wait = {.semaphore = closed->semaphore, .value = 1};
    lobe_resource image = declare_frame(g->graph, 1, 2);
    lobe_resource half =
        graph_fixture_image(g, "half", LOBE_FORMAT_R32_FLOAT, EXTENT / 2, EXTENT / 2);
    lobe_pass *pass = lobe_graph_add_pass(g->graph, LOBE_PASS_COMPUTE, "halve");
    lobe_pass_read(pass, &(lobe_binding){"source", image, .range = {.level_count = 1}});
    half = lobe_pass_write(pass, &(lobe_binding){.name = "target", .resource = half});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "graph_halve.comp", .threads = {EXTENT / 2, EXTENT / 2}});
    lobe_graph_output(g->graph, half);
    assert_int_equal(
        lobe_graph_submit(g->graph, &(lobe_vulkan_submission){.waits = &wait, .wait_count = 1}),
        LOBE_OK);
    assert_int_equal(f->first.recorder.errors, 0);
}

/// The graph leaves the image to the other one while its own last frame still samples it.
static void frames_in_flight_keep_what_they_sample(void **state) {
    fixture *f = *state;
    gate closed = {f->host.vulkan.device, host_semaphore(&f->host, true), false};
    lobe_graph_set_frames_in_flight(f->second.graph, 2);
    run(&f->first, 1, 2);
    run(&f->second, 1, 2);
    submit_sampling(f, &f->second, &closed);
    run_behind(f, &f->second, &closed, 5);
    run(&f->first, 1, 2);
}

/// The host's commands wait for the gate.
static void submit_closed(const fixture *f, const gate *closed, VkCommandBuffer commands) {
    const VkSemaphoreSubmitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                        .semaphore = closed->semaphore,
                                        .value = 1,
                                        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkCommandBufferSubmitInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                              .commandBuffer = commands};
    const VkSubmitInfo2 submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                                  .waitSemaphoreInfoCount = 1,
                                  .pWaitSemaphoreInfos = &wait,
                                  .commandBufferInfoCount = 1,
                                  .pCommandBufferInfos = &buffer};
    assert_int_equal(vkEndCommandBuffer(commands), VK_SUCCESS);
    assert_int_equal(vkQueueSubmit2(f->host.vulkan.queue, 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
}

/// The graph takes the other one's image while its own last frame still writes its own.
static void frames_in_flight_keep_what_they_write(void **state) {
    fixture *f = *state;
    lobe_resource image;
    gate closed = {f->host.vulkan.device, host_semaphore(&f->host, true), false};
    lobe_graph_set_frames_in_flight(f->first.graph, 2);
    VkCommandBuffer commands = record(f, &f->first, 1, &image);
    submit_closed(f, &closed, commands);
    (void)declare_frame(f->second.graph, 1, 2);
    assert_int_equal(lobe_graph_submit(f->second.graph, &(lobe_vulkan_submission){0}), LOBE_OK);
    run_behind(f, &f->first, &closed, 2);
    assert_ptr_equal(image_of(&f->first), image_of(&f->second));
    vkFreeCommandBuffers(closed.device, f->host.pool, 1, &commands);
}

// ---------------------------------------------------------------------------------------------
// Host memory

static lobe_result run_both(lobe_device *device) {
    lobe_graph *graphs[2] = {NULL, NULL};
    lobe_result result = LOBE_OK;
    for (int n = 0; result == LOBE_OK && n < 4; n++) {
        lobe_graph **graph = &graphs[n % 2];
        result = *graph ? LOBE_OK : lobe_graph_create(device, graph);
        if (result != LOBE_OK)
            break;
        (void)declare_frame(*graph, n == 3 ? 4 : 1, 2);
        result = lobe_graph_execute(*graph);
    }
    for (int n = 0; n < 2; n++)
        lobe_graph_destroy(&graphs[n]);
    return result;
}

static void each_allocation_fails_once(void **state) {
    (void)state;
    counting_allocator counting;
    log_recorder recorder;
    lobe_device *device;
    counting_allocator_start(&counting);
    log_recorder_start(&recorder);
    recorder.host.allocator = &counting.allocator;
    assert_int_equal(lobe_device_create(&(lobe_device_parameters){.host = &recorder.host}, &device),
                     LOBE_OK);
    const size_t blocks = counting.blocks;
    counting.taken = 0;
    assert_int_equal(run_both(device), LOBE_OK);
    const size_t count = counting.taken;
    for (size_t failing = 1; failing <= count; failing++) {
        recorder.errors = 0;
        counting.taken = 0;
        counting.failing = failing;
        assert_int_equal(run_both(device), LOBE_ERROR_OUT_OF_MEMORY);
        assert_int_equal(recorder.errors, 1);
        assert_int_equal(counting.blocks, blocks);
    }
    lobe_device_destroy(&device);
    assert_nothing_left(&counting);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(another_graph_makes_nothing),
        TEST(another_graph_keeps_the_content),
        TEST(other_content_is_not_shared),
        TEST(what_is_not_finished_is_not_shared),
        TEST(a_graph_does_not_share_with_itself),
        TEST(the_first_graph_changes_its_own),
        TEST(the_second_graph_changes_its_own),
        TEST(whoever_is_left_writes_in_place),
        TEST(rebuilding_stays_in_its_graph),
        TEST(a_pass_that_runs_writes_nothing_shared),
        TEST(what_the_host_submits_is_shared_later),
        TEST(what_was_made_at_once_becomes_one),
        TEST(what_changes_meanwhile_stays_apart),
        TEST(frames_may_overtake_each_other),
        TEST(frames_in_flight_keep_what_they_sample),
        TEST(frames_in_flight_keep_what_they_write),
        cmocka_unit_test(each_allocation_fails_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
