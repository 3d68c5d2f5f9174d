// Graphs of one device that are given the same content have it once: what one of them changes or
// destroys does not reach the others.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/vulkan.h>

#include "engine/device/device.h"
#include "engine/resource/resource.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/log_recorder.h"

#define TEST(function) cmocka_unit_test_setup_teardown(function, open_shared, close_fixture)

enum { EXTENT = 64, COUNT = EXTENT * EXTENT, BYTES = COUNT * 4 };

/// A graph, and what it holds.
typedef struct holder {
    lobe_graph *graph;
    lobe_texture *texture;
    lobe_buffer *buffer;
} holder;

typedef struct fixture {
    log_recorder recorder;
    lobe_device *device;
    float content[COUNT], changed[COUNT];
    holder first, second; ///< with the content
    uint64_t alone;       ///< bytes that the first one takes
} fixture;

static void fill(float *content, float start) {
    for (int i = 0; i < COUNT; i++)
        content[i] = start + (float)i;
}

static lobe_image image_of(float *content) {
    return (lobe_image){LOBE_FORMAT_R32_FLOAT, EXTENT, EXTENT, content};
}

static lobe_result hold(lobe_device *device, float *content, holder *made) {
    const lobe_image image = image_of(content);
    lobe_result result = lobe_graph_create(device, &made->graph);
    result = result ? result
                    : lobe_graph_create_texture(
                          made->graph, &(lobe_texture_parameters){"map", &image}, &made->texture);
    return result
               ? result
               : lobe_graph_create_buffer(made->graph,
                                          &(lobe_buffer_parameters){.size = BYTES, .data = content},
                                          &made->buffer);
}

static void destroy(holder *gone) {
    lobe_texture_destroy(&gone->texture);
    lobe_buffer_destroy(&gone->buffer);
    lobe_graph_destroy(&gone->graph);
}

static uint64_t used_bytes(const fixture *f) {
    lobe_device_memory memory;
    lobe_device_memory_query(f->device, &memory);
    return memory.used_bytes;
}

static int open_shared(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    fill(f->content, 1);
    fill(f->changed, 100000);
    log_recorder_start(&f->recorder);
    const lobe_device_parameters parameters = {.validation = true, .host = &f->recorder.host};
    lobe_result result = lobe_device_create(&parameters, &f->device);
    result = result ? result : hold(f->device, f->content, &f->first);
    result = result ? result : lobe_graph_submit_content(f->first.graph);
    f->alone = used_bytes(f);
    return result || hold(f->device, f->content, &f->second);
}

static int close_fixture(void **state) {
    fixture *f = *state;
    destroy(&f->first);
    destroy(&f->second);
    const uint64_t mistakes = lobe_device_validation_count(f->device), left = used_bytes(f);
    const int errors = f->recorder.errors;
    if (errors)
        print_error("%s\n", f->recorder.last_error);
    lobe_device_destroy(&f->device);
    free(f);
    return mistakes || left || errors;
}

/// A frame that reads both back.
static void declare_frame(const holder *h, lobe_resource seen[2]) {
    lobe_graph_begin(h->graph);
    seen[0] = lobe_graph_import_texture(h->graph, h->texture);
    seen[1] = lobe_graph_import_buffer(h->graph, h->buffer);
    for (int i = 0; i < 2; i++)
        lobe_graph_read_back(h->graph, seen[i], (lobe_range){0});
}

static void assert_seen(const holder *h, const lobe_resource seen[2], const float *texels,
                        const float *numbers) {
    assert_memory_equal(lobe_graph_data(h->graph, seen[0], NULL), texels, BYTES);
    assert_memory_equal(lobe_graph_data(h->graph, seen[1], NULL), numbers, BYTES);
}

static void assert_holds(const holder *h, const float *content) {
    lobe_resource seen[2];
    declare_frame(h, seen);
    assert_int_equal(lobe_graph_execute(h->graph), LOBE_OK);
    assert_seen(h, seen, content, content);
}

static void update(const holder *h, float *content) {
    const lobe_image image = image_of(content);
    assert_int_equal(lobe_texture_update(h->texture, &image), LOBE_OK);
    assert_int_equal(lobe_buffer_update(h->buffer, content), LOBE_OK);
}

static bool share(const holder *a, const holder *b) {
    const bool images = a->texture->image == b->texture->image;
    assert_int_equal(a->buffer->buffer == b->buffer->buffer, images);
    return images;
}

// ---------------------------------------------------------------------------------------------
// What is shared

static void another_graph_adds_nothing(void **state) {
    fixture *f = *state;
    const uint64_t submitted = f->device->submitted;
    holder third = {0};
    assert_true(share(&f->first, &f->second));
    assert_int_equal(hold(f->device, f->content, &third), LOBE_OK);
    assert_int_equal(used_bytes(f), f->alone);
    assert_int_equal(lobe_graph_submit_content(third.graph), LOBE_OK);
    assert_int_equal(f->device->submitted, submitted);
    assert_holds(&third, f->content);
    assert_holds(&f->first, f->content);
    assert_holds(&f->second, f->content);
    destroy(&third);
}

/// Neither textures of another shape, nor what differs in one byte, nor what changes often.
static void other_content_is_not_shared(void **state) {
    fixture *f = *state;
    lobe_image image = {LOBE_FORMAT_R32_FLOAT, EXTENT / 2, EXTENT * 2, f->content};
    lobe_texture *texture;
    holder other = {0};
    assert_int_equal(lobe_graph_create_texture(f->second.graph,
                                               &(lobe_texture_parameters){"map", &image}, &texture),
                     LOBE_OK);
    assert_ptr_not_equal(texture->image, f->first.texture->image);
    lobe_texture_destroy(&texture);
    ((unsigned char *)f->content)[BYTES - 1] ^= 1;
    assert_int_equal(hold(f->device, f->content, &other), LOBE_OK);
    assert_false(share(&f->first, &other));
    assert_holds(&other, f->content);
    destroy(&other);
}

/// One graph changes its textures one by one, and creates nothing then.
static void a_graph_does_not_share_with_itself(void **state) {
    fixture *f = *state;
    const lobe_image image = image_of(f->content);
    lobe_texture *again;
    assert_int_equal(lobe_graph_create_texture(f->first.graph,
                                               &(lobe_texture_parameters){"map", &image}, &again),
                     LOBE_OK);
    assert_ptr_not_equal(again->image, f->first.texture->image);
    lobe_texture_destroy(&again);
}

/// A frame of the host's may be submitted after those of other graphs.
static void what_the_host_submits_is_not_shared(void **state) {
    fixture *f = *state;
    host_device host = {0};
    holder other = {0};
    lobe_resource seen[2];
    lobe_vulkan_export_device(f->device, &host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(host.vulkan.device, &pool, NULL, &host.pool), VK_SUCCESS);
    assert_holds(&f->second, f->content);
    update(&f->second, f->changed);
    declare_frame(&f->second, seen);
    const lobe_vulkan_submission submission = {.commands = host_begin(&host)};
    assert_int_equal(lobe_graph_submit(f->second.graph, &submission), LOBE_OK);
    assert_int_equal(hold(f->device, f->changed, &other), LOBE_OK);
    assert_false(share(&f->second, &other));
    assert_holds(&other, f->changed);
    assert_holds(&f->first, f->content);
    host_finish(&host, submission.commands);
    assert_int_equal(lobe_graph_wait(f->second.graph), LOBE_OK);
    assert_seen(&f->second, seen, f->changed, f->changed);
    destroy(&other);
    vkDestroyCommandPool(host.vulkan.device, host.pool, NULL);
}

/// What waits for a graph's next frame is shared after that.
static void what_waits_for_a_frame_is_shared_after_it(void **state) {
    fixture *f = *state;
    holder early = {0}, late = {0};
    assert_holds(&f->first, f->content);
    update(&f->first, f->changed);
    assert_int_equal(hold(f->device, f->changed, &early), LOBE_OK);
    assert_false(share(&f->first, &early));
    assert_holds(&f->first, f->changed);
    assert_int_equal(hold(f->device, f->changed, &late), LOBE_OK);
    assert_true(share(&f->first, &late));
    assert_holds(&early, f->changed);
    assert_holds(&late, f->changed);
    destroy(&early);
    destroy(&late);
}

// ---------------------------------------------------------------------------------------------
// Changes

static void check_updates(fixture *f, const holder *changed, const holder *other) {
    assert_holds(changed, f->content);
    assert_holds(other, f->content);
    update(changed, f->changed);
    assert_false(share(changed, other));
    assert_holds(other, f->content);
    assert_holds(changed, f->changed);
    assert_holds(other, f->content);
    const uint64_t used = used_bytes(f);
    update(changed, f->content); // in memory of its own from now on
    assert_holds(changed, f->content);
    assert_int_equal(used_bytes(f), used);
}

static void the_first_graph_changes_its_own(void **state) {
    fixture *f = *state;
    check_updates(f, &f->first, &f->second);
}

static void the_second_graph_changes_its_own(void **state) {
    fixture *f = *state;
    check_updates(f, &f->second, &f->first);
}

/// The part is in an image that has all of the texture's content.
static void parts_stay_in_their_graph(void **state) {
    fixture *f = *state;
    const lobe_rectangle part = {3, 5, 7, 11};
    float *expected = f->changed;
    memcpy(expected, f->content, BYTES);
    for (uint32_t y = part.y; y < part.y + part.height; y++)
        for (uint32_t x = part.x; x < part.x + part.width; x++)
            expected[y * EXTENT + x] = -1;
    const lobe_image image = image_of(expected);
    assert_int_equal(lobe_texture_update_part(f->second.texture, &image, &part), LOBE_OK);
    lobe_resource seen[2];
    declare_frame(&f->second, seen);
    assert_int_equal(lobe_graph_execute(f->second.graph), LOBE_OK);
    assert_seen(&f->second, seen, expected, f->content);
    assert_holds(&f->first, f->content);
}

/// Whoever is left changes what it has, without memory of its own.
static void the_last_one_changes_what_was_shared(void **state) {
    fixture *f = *state;
    assert_holds(&f->first, f->content);
    assert_holds(&f->second, f->content);
    destroy(&f->first);
    const VkImage image = f->second.texture->image;
    update(&f->second, f->changed);
    assert_ptr_equal(f->second.texture->image, image);
    assert_holds(&f->second, f->changed);
    assert_int_equal(hold(f->device, f->content, &f->first), LOBE_OK);
    assert_holds(&f->first, f->content);
    assert_holds(&f->second, f->changed);
}

static void without_memory_both_keep_their_content(void **state) {
    fixture *f = *state;
    engine_staging occupied[64];
    size_t count = 0;
    log_recorder recorder;
    log_recorder_start(&recorder);
    fixture small = {.device = NULL};
    memcpy(small.content, f->content, BYTES);
    const lobe_device_parameters parameters = {.memory_limit = 8 << 20, .host = &recorder.host};
    assert_int_equal(lobe_device_create(&parameters, &small.device), LOBE_OK);
    assert_int_equal(hold(small.device, small.content, &small.first), LOBE_OK);
    assert_int_equal(lobe_graph_submit_content(small.first.graph), LOBE_OK);
    assert_int_equal(hold(small.device, small.content, &small.second), LOBE_OK);
    assert_holds(&small.first, small.content);
    assert_holds(&small.second, small.content);
    for (VkDeviceSize size = 1 << 20; size >= 1 << 10 && count < 64;)
        if (engine_staging_create(small.device, NULL, size, ENGINE_MEMORY_UPLOAD,
                                  &occupied[count]) == LOBE_OK)
            count++;
        else
            size /= 2;
    const lobe_image image = image_of(f->changed);
    assert_int_equal(lobe_texture_update(small.second.texture, &image),
                     LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(recorder.errors, 1);
    assert_true(share(&small.first, &small.second));
    assert_holds(&small.first, small.content);
    assert_holds(&small.second, small.content);
    while (count > 0)
        engine_staging_destroy(small.device, &occupied[--count]);
    update(&small.second, f->changed);
    assert_holds(&small.second, f->changed);
    assert_holds(&small.first, small.content);
    destroy(&small.first);
    destroy(&small.second);
    lobe_device_destroy(&small.device);
}

// ---------------------------------------------------------------------------------------------
// Frames in flight

/// Lets the device begin with a frame only when the test says so.
static VkSemaphore submit_closed(const fixture *f, const holder *h) {
    host_device host = {0};
    lobe_vulkan_export_device(f->device, &host.vulkan);
    const lobe_vulkan_semaphore wait = {.semaphore = host_semaphore(&host, true), .value = 1};
    const lobe_vulkan_submission submission = {.waits = &wait, .wait_count = 1};
    assert_int_equal(lobe_graph_submit(h->graph, &submission), LOBE_OK);
    return wait.semaphore;
}

static void open_semaphore(const fixture *f, VkSemaphore semaphore) {
    const VkSemaphoreSignalInfo signal = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, .semaphore = semaphore, .value = 1};
    assert_int_equal(vkSignalSemaphore(f->device->vulkan, &signal), VK_SUCCESS);
}

/// The first graph's frame has not begun when it destroys what the frame reads, and the second one
/// changes what both had. Whoever waited would wait forever.
static void frames_in_flight_keep_what_they_read(void **state) {
    fixture *f = *state;
    lobe_resource seen[2];
    assert_holds(&f->first, f->content);
    assert_holds(&f->second, f->content);
    declare_frame(&f->first, seen);
    const VkSemaphore semaphore = submit_closed(f, &f->first);
    lobe_texture_destroy(&f->first.texture);
    lobe_buffer_destroy(&f->first.buffer);
    update(&f->second, f->changed);
    open_semaphore(f, semaphore);
    assert_int_equal(lobe_graph_wait(f->first.graph), LOBE_OK);
    assert_seen(&f->first, seen, f->content, f->content);
    assert_holds(&f->second, f->changed);
    vkDestroySemaphore(f->device->vulkan, semaphore, NULL);
}

// ---------------------------------------------------------------------------------------------
// Host memory

static lobe_result share_and_change(lobe_device *device, float *content, float *changed) {
    holder first = {0}, second = {0};
    const lobe_image image = image_of(changed);
    lobe_result result = hold(device, content, &first);
    result = result ? result : lobe_graph_submit_content(first.graph);
    result = result ? result : hold(device, content, &second);
    result = result ? result : lobe_texture_update(second.texture, &image);
    result = result ? result : lobe_buffer_update(first.buffer, changed);
    destroy(&first);
    destroy(&second);
    return result;
}

static void each_allocation_fails_once(void **state) {
    fixture *f = *state;
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
    assert_int_equal(share_and_change(device, f->content, f->changed), LOBE_OK);
    const size_t count = counting.taken;
    assert_true(count > 20);
    for (size_t failing = 1; failing <= count; failing++) {
        recorder.errors = 0;
        counting.taken = 0;
        counting.failing = failing;
        assert_int_equal(share_and_change(device, f->content, f->changed),
                         LOBE_ERROR_OUT_OF_MEMORY);
        assert_int_equal(recorder.errors, 1);
        assert_int_equal(counting.blocks, blocks);
    }
    lobe_device_destroy(&device);
    assert_nothing_left(&counting);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(another_graph_adds_nothing),
        TEST(other_content_is_not_shared),
        TEST(a_graph_does_not_share_with_itself),
        TEST(what_the_host_submits_is_not_shared),
        TEST(what_waits_for_a_frame_is_shared_after_it),
        TEST(the_first_graph_changes_its_own),
        TEST(the_second_graph_changes_its_own),
        TEST(parts_stay_in_their_graph),
        TEST(the_last_one_changes_what_was_shared),
        TEST(without_memory_both_keep_their_content),
        TEST(frames_in_flight_keep_what_they_read),
        TEST(each_allocation_fails_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
