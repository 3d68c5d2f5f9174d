// Content goes with a graph's next frame where that costs little, and in steps where it does not:
// before the first frame, and where memory is too short. The last content counts either way.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/vulkan.h>

#include "engine/graph/state.h"
#include "engine/resource/content.h"
#include "tests/engine/graph/graph_support.h"
#include "tests/engine/support/host_device.h"

/// A map that takes several steps: 9 MiB.
enum { EXTENT = 768, COUNT = EXTENT * EXTENT * 4 };
enum { MEBIBYTE = 1 << 20, LIMIT = 32 * MEBIBYTE };

static const lobe_rectangle whole = {0, 0, EXTENT, EXTENT};

typedef struct fixture {
    graph_fixture graph;
    float *expected, *next; ///< texels
    lobe_texture *texture;  ///< of the graph; with the expected texels
} fixture;

static lobe_image image_of(float *texels) {
    return (lobe_image){LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT, texels};
}

static void fill(float *texels, float start) {
    for (size_t i = 0; i < COUNT; i++)
        texels[i] = start + (float)(i % 65537);
}

static lobe_texture *create(const fixture *f, float *texels) {
    lobe_texture *texture;
    const lobe_image image = image_of(texels);
    assert_int_equal(lobe_graph_create_texture(f->graph.graph,
                                               &(lobe_texture_parameters){"map", &image}, &texture),
                     LOBE_OK);
    return texture;
}

static void assert_holds(fixture *f, const lobe_texture *texture) {
    lobe_graph_begin(f->graph.graph);
    const lobe_resource seen = lobe_graph_import_texture(f->graph.graph, texture);
    lobe_graph_read_back(f->graph.graph, seen, (lobe_range){0});
    graph_fixture_execute(&f->graph);
    assert_memory_equal(lobe_graph_data(f->graph.graph, seen, NULL), f->expected, COUNT * 4);
}

static int open_device(void **state, uint64_t limit) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    log_recorder_start(&f->graph.recorder);
    f->expected = malloc(COUNT * sizeof *f->expected);
    f->next = malloc(COUNT * sizeof *f->next);
    const lobe_device_parameters parameters = {
        .memory_limit = limit, .validation = true, .host = &f->graph.recorder.host};
    return !f->expected || !f->next ||
           lobe_device_create(&parameters, &f->graph.device) != LOBE_OK ||
           lobe_graph_create(f->graph.device, &f->graph.graph) != LOBE_OK;
}

static int open_empty(void **state) {
    return open_device(state, 0);
}

/// After a frame with the texture, which has all other memory made.
static int open_scarce(void **state) {
    if (open_device(state, LIMIT) != 0)
        return 1;
    fixture *f = *state;
    fill(f->expected, 1);
    f->texture = create(f, f->expected);
    assert_holds(f, f->texture);
    return 0;
}

static int close_fixture(void **state) {
    fixture *f = *state;
    lobe_device_memory memory;
    lobe_texture_destroy(&f->texture);
    lobe_graph_destroy(&f->graph.graph);
    lobe_device_memory_query(f->graph.device, &memory);
    const uint64_t mistakes = lobe_device_validation_count(f->graph.device);
    if (f->graph.recorder.errors)
        print_error("%s\n", f->graph.recorder.last_error);
    const int errors = f->graph.recorder.errors;
    lobe_device_destroy(&f->graph.device);
    free(f->expected);
    free(f->next);
    free(f);
    return mistakes || memory.used_bytes || errors;
}

/// Gives a part of the texture other texels.
static lobe_result update(fixture *f, lobe_rectangle part, float start) {
    fill(f->next, start);
    const lobe_image image = image_of(f->next);
    const lobe_result result = lobe_texture_update_part(f->texture, &image, &part);
    for (uint32_t y = part.y; result == LOBE_OK && y < part.y + part.height; y++)
        memcpy(f->expected + 4 * (y * EXTENT + part.x), f->next + 4 * (y * EXTENT + part.x),
               part.width * 16);
    return result;
}

static size_t waiting(const fixture *f) {
    return f->graph.graph->kept.uploads.count;
}

static uint64_t submissions(const fixture *f) {
    return f->graph.device->submitted;
}

static uint64_t used_bytes(const fixture *f) {
    lobe_device_memory memory;
    lobe_device_memory_query(f->graph.device, &memory);
    return memory.used_bytes;
}

// ---------------------------------------------------------------------------------------------
// Too little memory

static void an_update_goes_in_steps(void **state) {
    fixture *f = *state;
    const uint64_t before = submissions(f), used = used_bytes(f);
    assert_int_equal(update(f, whole, 100), LOBE_OK);
    assert_int_equal(submissions(f) - before, 3); // of 4, 4 and 1 MiB
    assert_int_equal(waiting(f), 0);
    assert_int_equal(used_bytes(f), used); // its memory is the frames' again
    assert_holds(f, f->texture);
}

/// Takes the mapped memory that is left, in pieces from 1 MiB to `least`.
static size_t occupy(fixture *f, VkDeviceSize least, engine_staging staging[], size_t most) {
    size_t count = 0;
    for (VkDeviceSize size = MEBIBYTE; size >= least && count < most;)
        if (engine_staging_create(f->graph.device, NULL, size, ENGINE_MEMORY_UPLOAD,
                                  &staging[count]) == LOBE_OK)
            count++;
        else
            size /= 2;
    return count;
}

/// As long as there is any memory, an update does with it.
static void steps_get_smaller(void **state) {
    fixture *f = *state;
    engine_staging occupied[64];
    size_t count = occupy(f, 1 << 10, occupied, 64);
    assert_int_equal(occupied[0].size, MEBIBYTE);
    engine_staging_destroy(f->graph.device, &occupied[0]);
    const uint64_t before = submissions(f);
    assert_int_equal(update(f, whole, 100), LOBE_OK);
    assert_in_range(submissions(f) - before, 9, 40);
    assert_int_equal(update(f, (lobe_rectangle){3, 5, 7, 11}, 200), LOBE_OK);
    assert_int_equal(waiting(f), 1);
    assert_holds(f, f->texture);
    while (count > 0)
        engine_staging_destroy(f->graph.device, &occupied[--count]);
}

static void without_any_memory_content_stays(void **state) {
    fixture *f = *state;
    engine_staging occupied[64];
    size_t count = occupy(f, 1 << 10, occupied, 64);
    const lobe_rectangle parts[] = {whole, {0, 0, EXTENT, 5}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(update(f, parts[i], 100), LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
        assert_int_equal(f->graph.recorder.errors, 1);
        f->graph.recorder.errors = 0;
        assert_holds(f, f->texture);
    }
    while (count > 0)
        engine_staging_destroy(f->graph.device, &occupied[--count]);
    assert_int_equal(update(f, whole, 100), LOBE_OK);
    assert_holds(f, f->texture);
}

/// Small parts wait for the frame, large ones do not: they overlap in every order.
static void the_last_content_counts(void **state) {
    static const lobe_rectangle above = {0, 0, EXTENT, EXTENT - 40};
    static const lobe_rectangle below = {0, 40, EXTENT, EXTENT - 40};
    static const lobe_rectangle parts[] = {{5, 20, 30, 60}, {9, 700, 50, 60}};
    const struct {
        lobe_rectangle parts[4];
        size_t waiting; ///< in the end
    } orders[] = {
        {{parts[0], above, parts[1], below}, 0}, {{above, parts[0], parts[1], below}, 0},
        {{parts[0], parts[1], below, above}, 0}, {{above, parts[0], below, parts[1]}, 1},
        {{above, below, parts[0], parts[1]}, 2},
    };
    fixture *f = *state;
    for (size_t n = 0; n < sizeof orders / sizeof *orders; n++) {
        for (size_t i = 0; i < 4; i++)
            assert_int_equal(update(f, orders[n].parts[i], (float)(100 * n + 10 * i)), LOBE_OK);
        assert_int_equal(waiting(f), orders[n].waiting);
        assert_holds(f, f->texture);
    }
}

static void buffers_go_in_steps_too(void **state) {
    fixture *f = *state;
    const lobe_buffer_parameters parameters = {.name = "numbers", .size = COUNT * 4};
    lobe_buffer *buffer;
    fill(f->expected, 5);
    assert_int_equal(update(f, whole, 5), LOBE_OK);
    assert_int_equal(lobe_graph_create_buffer(f->graph.graph, &parameters, &buffer), LOBE_OK);
    const uint64_t before = submissions(f);
    assert_int_equal(lobe_buffer_update(buffer, f->expected), LOBE_OK);
    assert_in_range(submissions(f) - before, 3, 12);
    lobe_graph_begin(f->graph.graph);
    const lobe_resource seen = lobe_graph_import_buffer(f->graph.graph, buffer);
    lobe_graph_read_back(f->graph.graph, seen, (lobe_range){0});
    graph_fixture_execute(&f->graph);
    assert_memory_equal(lobe_graph_data(f->graph.graph, seen, NULL), f->expected, COUNT * 4);
    lobe_buffer_destroy(&buffer);
}

/// A frame in the host's commands, which are submitted and waited for.
static void record_frame(fixture *f, const host_device *host) {
    lobe_graph_begin(f->graph.graph);
    const lobe_vulkan_submission submission = {.commands = host_begin(host)};
    assert_int_equal(lobe_graph_submit(f->graph.graph, &submission), LOBE_OK);
    host_finish(host, submission.commands);
}

/// Content that went first would be overwritten by what the host has not submitted yet.
static void steps_do_not_overtake_the_host(void **state) {
    fixture *f = *state;
    host_device host = {0};
    lobe_vulkan_export_device(f->graph.device, &host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(host.vulkan.device, &pool, NULL, &host.pool), VK_SUCCESS);
    assert_int_equal(update(f, (lobe_rectangle){1, 1, 100, 100}, 300), LOBE_OK);
    lobe_graph_begin(f->graph.graph);
    const lobe_vulkan_submission submission = {.commands = host_begin(&host)};
    assert_int_equal(lobe_graph_submit(f->graph.graph, &submission), LOBE_OK);
    const uint64_t before = submissions(f);
    assert_int_equal(update(f, whole, 100), LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(f->graph.recorder.errors, 1);
    f->graph.recorder.errors = 0;
    assert_int_equal(submissions(f), before);
    // Parts that can wait do; what is new is not in that frame.
    assert_int_equal(update(f, (lobe_rectangle){50, 50, 100, 100}, 400), LOBE_OK);
    fill(f->next, 7);
    lobe_texture *fresh = create(f, f->next);
    assert_true(submissions(f) > before);
    host_finish(&host, submission.commands);
    assert_holds(f, f->texture);
    assert_int_equal(update(f, whole, 7), LOBE_OK);
    assert_holds(f, f->texture);
    assert_holds(f, fresh);
    record_frame(f, &host);
    assert_int_equal(lobe_graph_wait(f->graph.graph), LOBE_OK); // instead of another frame
    assert_int_equal(update(f, whole, 8), LOBE_OK);
    assert_holds(f, f->texture);
    lobe_texture_destroy(&fresh);
    vkDestroyCommandPool(host.vulkan.device, host.pool, NULL);
}

// ---------------------------------------------------------------------------------------------
// Before the first frame

static void many_objects_share_a_submission(void **state) {
    enum { OBJECTS = 200 };
    fixture *f = *state;
    lobe_buffer *buffers[OBJECTS];
    lobe_texture *textures[2];
    uint64_t bytes = 0;
    for (int n = 0; n < 2; n++) {
        fill(f->expected, (float)n);
        textures[n] = create(f, f->expected);
    }
    fill(f->expected, 1);
    for (int n = 0; n < OBJECTS; n++) {
        const lobe_buffer_parameters parameters = {.size = 4000 * (size_t)(n + 1),
                                                   .data = n % 10 == 9 ? NULL : f->expected + n};
        assert_int_equal(lobe_graph_create_buffer(f->graph.graph, &parameters, &buffers[n]),
                         LOBE_OK);
        bytes += parameters.data ? parameters.size : 0;
    }
    bytes += 2 * COUNT * 4;
    const uint64_t full = bytes / ENGINE_CONTENT_STEP;
    assert_in_range(submissions(f), full - 1, full + 4);
    assert_in_range(f->graph.graph->kept.uploads.ring.memory.size, 1,
                    ENGINE_CONTENT_MEMORY + (64 << 10));
    lobe_graph_begin(f->graph.graph);
    assert_int_equal(f->graph.graph->kept.uploads.ring.memory.size, 0);
    lobe_resource seen[OBJECTS];
    for (int n = 0; n < OBJECTS; n++) {
        seen[n] = lobe_graph_import_buffer(f->graph.graph, buffers[n]);
        lobe_graph_read_back(f->graph.graph, seen[n], (lobe_range){0});
    }
    graph_fixture_execute(&f->graph);
    float *zeroes = calloc(OBJECTS, 4000);
    for (int n = 0; n < OBJECTS; n++) {
        size_t size;
        const void *data = lobe_graph_data(f->graph.graph, seen[n], &size);
        assert_int_equal(size, 4000 * (n + 1));
        assert_memory_equal(data, n % 10 == 9 ? zeroes : f->expected + n, size);
    }
    free(zeroes);
    assert_holds(f, textures[1]);
    for (int n = 0; n < OBJECTS; n++)
        lobe_buffer_destroy(&buffers[n]);
    for (int n = 0; n < 2; n++)
        lobe_texture_destroy(&textures[n]);
}

/// Updates, and objects that go again, before there was a frame.
static void objects_change_before_the_first_frame(void **state) {
    fixture *f = *state;
    fill(f->expected, 1);
    lobe_texture *gone = create(f, f->expected);
    f->texture = create(f, f->expected);
    assert_int_equal(update(f, (lobe_rectangle){1, 2, 3, 4}, 100), LOBE_OK);
    lobe_texture_destroy(&gone);
    assert_int_equal(update(f, whole, 200), LOBE_OK);
    assert_int_equal(update(f, (lobe_rectangle){0, 700, EXTENT, 60}, 300), LOBE_OK);
    assert_holds(f, f->texture);
}

static void a_graph_without_frames_goes(void **state) {
    fixture *f = *state;
    f->texture = create(f, f->expected);
    assert_true(submissions(f) > 0);
}

#define SCARCE(test) cmocka_unit_test_setup_teardown(test, open_scarce, close_fixture)
#define EMPTY(test)  cmocka_unit_test_setup_teardown(test, open_empty, close_fixture)

int main(void) {
    const struct CMUnitTest tests[] = {
        SCARCE(an_update_goes_in_steps),          SCARCE(steps_get_smaller),
        SCARCE(without_any_memory_content_stays), SCARCE(the_last_content_counts),
        SCARCE(buffers_go_in_steps_too),          SCARCE(steps_do_not_overtake_the_host),
        EMPTY(many_objects_share_a_submission),   EMPTY(objects_change_before_the_first_frame),
        EMPTY(a_graph_without_frames_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
