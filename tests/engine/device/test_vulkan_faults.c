// Every Vulkan call that can fail fails once, on lobe's own device and on a host's: each time, the
// lobe call that needed it returns the right code and logs one line, and everything that was
// created is destroyed. The same for each allocation of host memory.

#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/graph.h>

#include "engine/device/vulkan_check.h"
#include "engine/device/vulkan_functions.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/engine/support/test_shaders.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/long_runs.h"

// ---------------------------------------------------------------------------------------------
// A frame that uses everything

typedef struct work {
    log_recorder recorder;
    lobe_device *device;
    lobe_texture *texture;
    lobe_buffer *vertices;
    lobe_graph *graph;
    lobe_texture *large; ///< of the graph
    int opening;         ///< calls until the device was there
} work;

/// A host with its own Vulkan device, which lobe imports many times.
typedef struct host {
    host_device vulkan;
    host_image image;
    VkSemaphore timeline;
    uint64_t reached;      ///< by the timeline, or soon
    uint64_t memory_limit; ///< of lobe's device; 0: none
} host;

static const float triangle[] = {-1, -1, -1, 3, 3, -1};

/// `host`: whose device to use; NULL: one of lobe's own.
static lobe_result open_device(work *w, host *host) {
    const lobe_device_parameters parameters = {.get_instance_proc_addr =
                                                   host ? NULL : test_vulkan_loader,
                                               .memory_limit = host ? host->memory_limit : 0,
                                               .host = &w->recorder.host};
    return host ? lobe_vulkan_import_device(&host->vulkan.vulkan, &parameters, &w->device)
                : lobe_device_create(&parameters, &w->device);
}

static lobe_result open_work(work *w, host *host) {
    float texels[4][4] = {{0}};
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 2, 2, texels};
    lobe_result result = open_device(w, host);
    w->opening = faults.calls;
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

/// A raster pass, compute passes with an upload and with a sampler, a copy of the texture, and
/// results read back.
static void declare_frame(work *w, uint32_t extent) {
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
    description = (lobe_image_description){
        .name = "half", .format = LOBE_FORMAT_RGBA32_FLOAT, .width = 1, .height = 1};
    lobe_resource half = lobe_graph_image(w->graph, &description);
    pass = lobe_graph_add_pass(w->graph, LOBE_PASS_COMPUTE, "halve");
    lobe_pass_read(pass, &(lobe_binding){.name = "source", .resource = copy});
    half = lobe_pass_write(pass, &(lobe_binding){.name = "target", .resource = half});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_halve.comp", .threads = {1, 1, 1}});
    lobe_graph_output(w->graph, half);
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
}

static lobe_result run_frame(work *w, uint32_t extent) {
    declare_frame(w, extent);
    return lobe_graph_execute(w->graph);
}

static void close_work(work *w) {
    lobe_texture_destroy(&w->large);
    lobe_graph_destroy(&w->graph);
    lobe_buffer_destroy(&w->vertices);
    lobe_texture_destroy(&w->texture);
    lobe_device_destroy(&w->device);
}

// ---------------------------------------------------------------------------------------------
// Ways to work

/// Two frames, the second of another size; what is on the device changes between them.
static lobe_result run_on_own_device(work *w, host *host) {
    float texels[4][4] = {{1}};
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 2, 2, texels};
    lobe_result result = open_work(w, host);
    result = result ? result : run_frame(w, 4);
    result = result ? result : lobe_texture_update(w->texture, &image);
    result = result ? result : lobe_buffer_update(w->vertices, triangle);
    return result ? result : run_frame(w, 8);
}

/// The same frame, which also clears the host's image.
static void declare_frame_for_host(work *w, const host *host, uint32_t extent) {
    const lobe_vulkan_image lent = {.image = host->image.image,
                                    .format = host->image.format,
                                    .width = host->image.width,
                                    .height = host->image.height,
                                    .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    declare_frame(w, extent);
    lobe_pass *pass = lobe_graph_add_pass(w->graph, LOBE_PASS_TRANSFER, "clear");
    lobe_resource image = lobe_graph_import_image(w->graph, &lent);
    image = lobe_pass_fill(pass, image, (lobe_range){0}, (float[4]){(float)extent});
    lobe_graph_output(w->graph, image);
}

/// Waits for the host's previous frame, and signals this one.
static lobe_result submit_frame(work *w, host *host, uint32_t extent) {
    const lobe_vulkan_semaphore wait = {.semaphore = host->timeline, .value = host->reached};
    const lobe_vulkan_semaphore signal = {.semaphore = host->timeline, .value = host->reached + 1};
    declare_frame_for_host(w, host, extent);
    const lobe_result result = lobe_graph_submit(
        w->graph, &(lobe_vulkan_submission){
                      .waits = &wait, .wait_count = 1, .signals = &signal, .signal_count = 1});
    host->reached += result == LOBE_OK;
    return result;
}

static lobe_result record_frame(work *w, host *host, uint32_t extent) {
    VkCommandBuffer commands = host_begin(&host->vulkan);
    declare_frame_for_host(w, host, extent);
    const lobe_result result =
        lobe_graph_submit(w->graph, &(lobe_vulkan_submission){.commands = commands});
    if (result == LOBE_OK)
        host_finish(&host->vulkan, commands);
    else
        vkFreeCommandBuffers(host->vulkan.vulkan.device, host->vulkan.pool, 1, &commands);
    return result;
}

/// Two frames of different sizes in flight, and one in the host's command buffer.
static lobe_result run_on_hosts_device(work *w, host *host) {
    lobe_result result = open_work(w, host);
    if (result == LOBE_OK)
        lobe_graph_set_frames_in_flight(w->graph, 2);
    result = result ? result : submit_frame(w, host, 4);
    result = result ? result : submit_frame(w, host, 4);
    result = result ? result : submit_frame(w, host, 8);
    result = result ? result : lobe_graph_wait(w->graph);
    return result ? result : record_frame(w, host, 8);
}

enum { LITTLE = 7 << 19 }; ///< bytes: 1.5 MiB more than the texture below

/// A texture for whose new content there is no memory, except in steps; some of it waits already.
static lobe_result run_with_little_memory(work *w, host *host) {
    static uint8_t texels[724][724][4];
    const lobe_image image = {LOBE_FORMAT_RGBA8_UNORM, 724, 724, texels};
    const lobe_rectangle part = {1, 2, 300, 300};
    lobe_result result = open_work(w, host);
    result = result ? result
                    : lobe_graph_create_texture(
                          w->graph, &(lobe_texture_parameters){.image = &image}, &w->large);
    result = result ? result : run_frame(w, 4);
    result = result ? result : lobe_texture_update_part(w->large, &image, &part);
    result = result ? result : lobe_texture_update(w->large, &image);
    result = result ? result : lobe_texture_update_part(w->large, &image, &part);
    return result ? result : run_frame(w, 4);
}

/// A device with every option, and a named object on it.
static lobe_result run_with_validation(work *w, host *host) {
    (void)host;
    const char *cache = temporary_folder_file(&test_folder, "pipelines");
    const lobe_device_parameters parameters = {.validation = true,
                                               .pipeline_cache = cache,
                                               .get_instance_proc_addr = test_vulkan_loader,
                                               .host = &w->recorder.host};
    const lobe_result result = lobe_device_create(&parameters, &w->device);
    return result
               ? result
               : lobe_buffer_create(w->device, &(lobe_buffer_parameters){.size = 16}, &w->vertices);
}

typedef lobe_result (*run_function)(work *w, host *host);

// ---------------------------------------------------------------------------------------------
// Faults

/// lobe can do without these: names for tools, an extension that is only recommended.
static bool is_done_without(const char *function) {
    static const char *const functions[] = {"vkSetDebugUtilsObjectNameEXT",
                                            "vkEnumerateDeviceExtensionProperties"};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strcmp(function, functions[i]) == 0)
            return true;
    return false;
}

/// Of memory that content passes through, less does too. (tests/passes/renderer/test_faults.c
/// checks the picture.)
static bool has_another_way(const char *function) {
    static const char *const functions[] = {"vkAllocateMemory", "vkBindBufferMemory",
                                            "vkCreateBuffer", "vkMapMemory"};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strcmp(function, functions[i]) == 0)
            return true;
    return false;
}

static lobe_result start_and_run(run_function run, work *w, host *host) {
    faults.calls = 0;
    faults.failed = NULL;
    *w = (work){0};
    log_recorder_start(&w->recorder);
    return run(w, host);
}

static void check_fault(run_function run, host *host, VkResult with, int alive) {
    work w;
    faults.fault = with;
    const lobe_result result = start_and_run(run, &w, host);
    const bool went_on = result == LOBE_OK && with == VK_ERROR_OUT_OF_DEVICE_MEMORY &&
                         faults.failed && has_another_way(faults.failed);
    // Otherwise the failure comes only on destruction, or at the end of the test.
    const bool matters = faults.failed && !is_done_without(faults.failed) && !went_on;
    const char *name = faults.failed ? faults.failed : "(teardown)";
    const lobe_result expected = matters ? engine_vulkan_result(with) : LOBE_OK;
    if (result != expected || w.recorder.errors != matters)
        fail_msg("call %d, %s: %s instead of %s, %d lines, the last '%s'", faults.failing, name,
                 lobe_result_name(result), lobe_result_name(expected), w.recorder.errors,
                 w.recorder.last_error);
    // Once more on the same objects, if there are any: nothing may be left half-built.
    if (w.graph && with != VK_ERROR_DEVICE_LOST && faults.failed && run_frame(&w, 4) != LOBE_OK)
        fail_msg("call %d, %s: %s", faults.failing, name, w.recorder.last_error);
    close_work(&w);
    if (faults.alive != alive)
        fail_msg("call %d, %s: %d objects are left", faults.failing, name, faults.alive - alive);
}

/// `step`: after the device has been opened, one call in so many fails.
static void check_calls(run_function run, host *host, int least, int step) {
    work w;
    const int alive = faults.alive;
    faults.failing = 0;
    assert_int_equal(start_and_run(run, &w, host), LOBE_OK);
    close_work(&w);
    const int during = faults.calls, opening = w.opening;
    assert_int_equal(faults.alive, alive);
    assert_true(during >= least);
    int checked = 0;
    for (faults.failing = 1; faults.failing <= during;
         faults.failing += faults.failing < opening ? 1 : step) {
        check_fault(run, host, VK_ERROR_OUT_OF_DEVICE_MEMORY, alive);
        // Clean-up is the same for every code: some calls are enough.
        if (checked++ % 4 == 0)
            check_fault(run, host, VK_ERROR_DEVICE_LOST, alive);
    }
    faults.failing = 0;
}

static void check_each_call(run_function run, host *host, int least) {
    check_calls(run, host, least, 1);
}

/// Opening devices takes longest. What follows is the same code as on a host's device, where every
/// call fails.
static void each_call_fails_once(void **state) {
    (void)state;
    check_calls(run_on_own_device, NULL, 60, long_runs() ? 1 : 3);
}

static void each_call_fails_once_with_validation(void **state) {
    (void)state;
    faults.names = true;
    check_each_call(run_with_validation, NULL, 10);
    faults.names = false;
}

static void open_host(host *host, bool validated) {
    *host = (struct host){.reached = 0};
    faults.failing = 0;
    if (validated)
        host_device_open(&host->vulkan);
    else
        host_device_open_unvalidated(&host->vulkan);
    host->image = host_image_create(&host->vulkan, VK_FORMAT_R32G32B32A32_SFLOAT, 4, 4,
                                    VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    host->timeline = host_semaphore(&host->vulkan, true);
}

static void close_host(host *host) {
    // The host's own objects remain.
    host_finish(&host->vulkan, host_begin(&host->vulkan));
    vkDestroySemaphore(host->vulkan.vulkan.device, host->timeline, NULL);
    host_image_destroy(&host->vulkan, &host->image);
    host_device_close(&host->vulkan);
}

static void each_call_fails_once_on_a_hosts_device(void **state) {
    (void)state;
    host host;
    open_host(&host, true);
    check_each_call(run_on_hosts_device, &host, 60);
    close_host(&host);
}

static void each_call_fails_once_with_little_memory(void **state) {
    (void)state;
    host host;
    open_host(&host, true);
    host.memory_limit = LITTLE;
    check_each_call(run_with_little_memory, &host, 60);
    close_host(&host);
}

// ---------------------------------------------------------------------------------------------
// Loaders

static bool loader_is_missing;

/// The linker calls this instead of the C library's function.
void *__real_dlopen(const char *file, int mode);
void *__wrap_dlopen(const char *file, int mode);
void *__wrap_dlopen(const char *file, int mode) {
    return loader_is_missing ? NULL : __real_dlopen(file, mode);
}

static void a_missing_loader_is_named(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    const lobe_device_parameters parameters = {.host = &recorder.host};
    const lobe_vulkan_device host = {0};
    lobe_vulkan_features features;
    const char *names[LOBE_VULKAN_MAXIMUM_EXTENSIONS];
    char text[256];
    lobe_device *device = NULL;
    loader_is_missing = true;
    assert_int_equal(lobe_device_create(&parameters, &device), LOBE_ERROR_NO_DEVICE);
    assert_int_equal(lobe_vulkan_missing(&host, NULL, text, sizeof text), 1);
    assert_int_equal(lobe_vulkan_queue_family(&host), UINT32_MAX);
    assert_int_equal(lobe_vulkan_extensions_fill(&host, NULL, names), 0);
    lobe_vulkan_features_fill(&host, &features);
    loader_is_missing = false;
    assert_null(device);
    assert_int_equal(recorder.errors, 1);
    assert_string_equal(recorder.last_error,
                        "Vulkan loader libvulkan.so.1 not found: install libvulkan1");
    assert_non_null(strstr(text, "libvulkan.so.1"));
    assert_false(features.vulkan_1_3.synchronization2);
}

#define NAME(function) #function,

/// Only objects that the missing function would have destroyed remain.
static int left_without(const char *function) {
    return strcmp(function, "vkDestroyInstance") == 0 || strcmp(function, "vkDestroyDevice") == 0;
}

static void a_function_that_the_loader_lacks_is_named(void **state) {
    (void)state;
    static const char *const functions[] = {ENGINE_LOADER_FUNCTIONS(NAME) ENGINE_INSTANCE_FUNCTIONS(
        NAME) ENGINE_DEBUG_FUNCTIONS(NAME) ENGINE_DEVICE_FUNCTIONS(NAME)};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        work w = {0};
        log_recorder_start(&w.recorder);
        const int alive = faults.alive;
        faults.absent = functions[i];
        assert_int_equal(open_device(&w, NULL), LOBE_ERROR_NO_DEVICE);
        faults.absent = NULL;
        assert_null(w.device);
        assert_int_equal(w.recorder.errors, 1);
        if (!strstr(w.recorder.last_error, functions[i]))
            fail_msg("%s: %s", functions[i], w.recorder.last_error);
        assert_int_equal(faults.alive, alive + left_without(functions[i]));
    }
}

// ---------------------------------------------------------------------------------------------
// Memory of the host

typedef struct way {
    run_function run;
    host *host;
} way;

static lobe_result run_with_allocator(void *user, const lobe_host *host) {
    const way *way = user;
    work w = {.recorder.host = *host};
    const lobe_result result = way->run(&w, way->host);
    if (result != LOBE_OK && w.graph && run_frame(&w, 4) != LOBE_OK)
        fail_msg("something is left half-built");
    close_work(&w);
    return result;
}

static void check_each_allocation(run_function run, host *host, size_t least) {
    const int alive = faults.alive;
    way way = {run, host};
    assert_true(fail_each_allocation(run_with_allocator, &way) >= least);
    assert_int_equal(faults.alive, alive);
}

/// Objects created on it are the same as on a host's device.
static void each_allocation_of_an_own_device_fails_once(void **state) {
    (void)state;
    faults.failing = 0;
    check_each_allocation(open_device, NULL, 10);
}

static void each_allocation_fails_once_with_little_memory(void **state) {
    (void)state;
    host host;
    open_host(&host, false);
    host.memory_limit = LITTLE;
    check_each_allocation(run_with_little_memory, &host, 90);
    close_host(&host);
}

static void each_allocation_fails_once_on_a_hosts_device(void **state) {
    (void)state;
    host host;
    open_host(&host, false);
    check_each_allocation(run_on_hosts_device, &host, 90);
    close_host(&host);
}

/// The tests above made each of the stand-ins fail.
static void each_function_failed(void **state) {
    (void)state;
    const char *name = vulkan_fault_left_out();
    if (name)
        fail_msg("%s never failed", name);
}

/// Lavapipe of Mesa 22.3 can corrupt memory when threads of its own draw, which is probably why one
/// run in dozens was aborted on busy processors: lp_fence_signalled reads a fence's count without
/// its mutex, so lp_setup_get_empty_scene may free the fence while the thread in lp_fence_signal
/// has yet to unlock that mutex. The tests' environment turns such threads off.
static void leave_out_threads_of_the_driver(void) {
    setenv("LP_NUM_THREADS", "0", 0);
}

int main(void) {
    leave_out_threads_of_the_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_call_fails_once),
        IN_TEST_FOLDER(each_call_fails_once_with_validation),
        cmocka_unit_test(each_call_fails_once_on_a_hosts_device),
        cmocka_unit_test(each_call_fails_once_with_little_memory),
        cmocka_unit_test(each_function_failed),
        cmocka_unit_test(a_missing_loader_is_named),
        cmocka_unit_test(a_function_that_the_loader_lacks_is_named),
        cmocka_unit_test(each_allocation_of_an_own_device_fails_once),
        cmocka_unit_test(each_allocation_fails_once_with_little_memory),
        cmocka_unit_test(each_allocation_fails_once_on_a_hosts_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
