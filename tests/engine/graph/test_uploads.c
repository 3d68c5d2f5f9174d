// Textures and buffers of a graph: what they are given reaches the device with the graph's next
// frame, whatever is in flight; nothing is submitted for it and nothing waits.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include <lobe/vulkan.h>

#include "engine/graph/state.h"
#include "engine/resource/content.h"
#include "tests/engine/graph/graph_support.h"
#include "tests/engine/support/counting_allocator.h"

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, open_after_a_frame, graph_fixture_close)

enum { WIDTH = 7, HEIGHT = 5, COUNT = WIDTH * HEIGHT };

/// What comes before its first frame is submitted by itself.
static int open_after_a_frame(void **state) {
    if (graph_fixture_open(state) != 0)
        return 1;
    graph_fixture *f = *state;
    lobe_graph_begin(f->graph);
    return lobe_graph_execute(f->graph) != LOBE_OK;
}

typedef struct contents {
    float texels[HEIGHT][WIDTH];
} contents;

static contents pattern(float start) {
    contents made;
    for (int i = 0; i < COUNT; i++)
        made.texels[i / WIDTH][i % WIDTH] = start + (float)i;
    return made;
}

static lobe_image image_of(contents *content) {
    return (lobe_image){LOBE_FORMAT_R32_FLOAT, WIDTH, HEIGHT, content->texels};
}

static lobe_texture *create_texture(graph_fixture *f, contents *content) {
    lobe_texture *texture;
    const lobe_image image = image_of(content);
    assert_int_equal(
        lobe_graph_create_texture(f->graph, &(lobe_texture_parameters){"map", &image}, &texture),
        LOBE_OK);
    return texture;
}

static lobe_buffer *create_buffer(graph_fixture *f, const contents *content) {
    lobe_buffer *buffer;
    const lobe_buffer_parameters parameters = {
        .name = "numbers", .size = sizeof *content, .data = content};
    assert_int_equal(lobe_graph_create_buffer(f->graph, &parameters, &buffer), LOBE_OK);
    return buffer;
}

static void update(lobe_texture *texture, contents *content, lobe_rectangle part) {
    const lobe_image image = image_of(content);
    assert_int_equal(lobe_texture_update_part(texture, &image, &part), LOBE_OK);
}

static size_t waiting(const graph_fixture *f) {
    return f->graph->kept.uploads.count;
}

static uint64_t submissions(const graph_fixture *f) {
    return f->device->submitted;
}

/// Copies a texture into a retained image of this name.
static lobe_resource declare_copy(graph_fixture *f, const lobe_texture *texture, const char *name) {
    lobe_resource copy = lobe_graph_image(f->graph, &(lobe_image_description){
                                                        .name = name,
                                                        .format = LOBE_FORMAT_R32_FLOAT,
                                                        .width = WIDTH,
                                                        .height = HEIGHT,
                                                        .retained = true,
                                                    });
    if (!texture)
        return copy;
    lobe_pass *pass = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "copy");
    return lobe_pass_copy(pass, lobe_graph_import_texture(f->graph, texture), (lobe_range){0}, copy,
                          (lobe_range){0});
}

static void assert_data(const graph_fixture *f, lobe_resource resource, const contents *expected) {
    size_t size = 0;
    const float *data = lobe_graph_data(f->graph, resource, &size);
    assert_non_null(data);
    assert_int_equal(size, sizeof *expected);
    assert_memory_equal(data, expected, sizeof *expected);
}

static void assert_texture(graph_fixture *f, const lobe_texture *texture,
                           const contents *expected) {
    lobe_graph_begin(f->graph);
    lobe_resource copy = declare_copy(f, texture, "seen");
    lobe_graph_read_back(f->graph, copy, (lobe_range){0});
    graph_fixture_execute(f);
    assert_data(f, copy, expected);
}

static void assert_buffer(graph_fixture *f, const lobe_buffer *buffer, const contents *expected) {
    lobe_graph_begin(f->graph);
    lobe_resource sums = graph_fixture_buffer(f, "sums", sizeof *expected);
    sums = graph_fixture_add(f, "add", lobe_graph_import_buffer(f->graph, buffer), sums, 0, COUNT);
    lobe_graph_read_back(f->graph, sums, (lobe_range){0});
    graph_fixture_execute(f);
    assert_data(f, sums, expected);
}

// ---------------------------------------------------------------------------------------------
// With the next frame

static void the_next_frame_copies(void **state) {
    graph_fixture *f = *state;
    contents first = pattern(1), second = pattern(100);
    lobe_texture *texture = create_texture(f, &first);
    lobe_buffer *buffer = create_buffer(f, &first);
    assert_int_equal(submissions(f), 1);
    assert_texture(f, texture, &first);
    assert_buffer(f, buffer, &first);
    assert_int_equal(submissions(f), 3);
    for (int n = 0; n < 3; n++) {
        contents *content = n % 2 ? &first : &second;
        update(texture, content, (lobe_rectangle){0, 0, WIDTH, HEIGHT});
        assert_int_equal(lobe_buffer_update(buffer, content), LOBE_OK);
        assert_int_equal(waiting(f), 2);
        assert_int_equal(submissions(f), (uint64_t)(3 + 2 * n));
        const contents copy = *content;
        memset(content, 0, sizeof *content); // it was copied during the call
        assert_texture(f, texture, &copy);
        assert_int_equal(waiting(f), 0);
        assert_buffer(f, buffer, &copy);
        *content = copy;
    }
    lobe_texture_destroy(&texture);
    lobe_buffer_destroy(&buffer);
}

static void a_buffer_without_data_is_zero(void **state) {
    graph_fixture *f = *state;
    const contents zeroes = {0}, numbers = pattern(1);
    lobe_buffer *buffer;
    for (int updated = 0; updated < 2; updated++) {
        assert_int_equal(lobe_graph_create_buffer(
                             f->graph, &(lobe_buffer_parameters){.size = sizeof zeroes}, &buffer),
                         LOBE_OK);
        if (updated)
            assert_int_equal(lobe_buffer_update(buffer, &numbers), LOBE_OK);
        assert_buffer(f, buffer, updated ? &numbers : &zeroes);
        lobe_buffer_destroy(&buffer);
    }
}

/// More content than a queue takes of new objects is submitted by itself.
static void large_new_objects_do_not_fill_the_ring(void **state) {
    graph_fixture *f = *state;
    enum { EXTENT = 700 };
    float *texels = lobe_allocate(NULL, EXTENT * EXTENT, 4 * sizeof *texels);
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT, texels};
    lobe_texture *textures[3];
    for (int n = 0; n < 3; n++) {
        texels[EXTENT * EXTENT * 4 - 1] = (float)n;
        assert_int_equal(lobe_graph_create_texture(
                             f->graph, &(lobe_texture_parameters){"large", &image}, &textures[n]),
                         LOBE_OK);
    }
    assert_true(f->graph->kept.uploads.ring.memory.size <= ENGINE_CONTENT_OF_FRAME);
    assert_int_equal(waiting(f), 2);
    assert_int_equal(submissions(f), 3); // two steps of the third
    lobe_resource imported[3];
    lobe_graph_begin(f->graph);
    for (int n = 0; n < 3; n++) {
        imported[n] = lobe_graph_import_texture(f->graph, textures[n]);
        lobe_graph_read_back(f->graph, imported[n], (lobe_range){0});
    }
    graph_fixture_execute(f);
    for (int n = 0; n < 3; n++) {
        const float *data = lobe_graph_data(f->graph, imported[n], NULL);
        assert_float_equal(data[EXTENT * EXTENT * 4 - 1], n, 0);
    }
    lobe_graph_begin(f->graph);
    for (int n = 0; n < 3; n++)
        lobe_texture_destroy(&textures[n]);
    lobe_release(texels);
}

// ---------------------------------------------------------------------------------------------
// Parts

static void copy_part(contents *to, const contents *from, lobe_rectangle part) {
    for (uint32_t y = part.y; y < part.y + part.height; y++)
        for (uint32_t x = part.x; x < part.x + part.width; x++)
            to->texels[y][x] = from->texels[y][x];
}

static void only_the_part_is_copied(void **state) {
    static const lobe_rectangle parts[] = {{0, 0, 1, 1}, {6, 4, 1, 1}, {2, 1, 3, 2},
                                           {0, 3, 7, 1}, {5, 0, 1, 5}, {0, 0, 7, 5}};
    graph_fixture *f = *state;
    contents expected = pattern(1);
    lobe_texture *texture = create_texture(f, &expected);
    assert_texture(f, texture, &expected);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        contents next = pattern(100 * (float)(i + 1));
        update(texture, &next, parts[i]);
        copy_part(&expected, &next, parts[i]);
        assert_int_equal(waiting(f), 1);
        assert_int_equal(f->graph->kept.uploads.copies[0].size,
                         parts[i].width * parts[i].height * 4);
        assert_texture(f, texture, &expected);
    }
    lobe_texture_destroy(&texture);
}

/// In any order and however they overlap, the last content of a texel counts; what they need is
/// bounded.
static void many_parts_before_a_frame(void **state) {
    graph_fixture *f = *state;
    contents expected = pattern(1);
    lobe_texture *texture = create_texture(f, &expected);
    assert_texture(f, texture, &expected);
    uint32_t seed = 1;
    for (int frame = 0; frame < 40; frame++) {
        for (int n = 0; n < 1 + frame % 9; n++) {
            seed = seed * 1664525u + 1013904223u;
            const uint32_t x = seed >> 8 & 3, y = seed >> 12 & 1;
            const lobe_rectangle part = {x, y, 1 + (seed >> 16 & 3), 1 + (seed >> 20 & 3)};
            // The image always holds all of the texture's content.
            contents next = pattern((float)(seed >> 16));
            copy_part(&expected, &next, part);
            update(texture, &expected, part);
            assert_true(waiting(f) <= 3);
        }
        assert_texture(f, texture, &expected);
    }
    lobe_texture_destroy(&texture);
}

/// Each also takes memory for what describes it, which exceeds that of its texels.
static void single_texels_become_all_of_them(void **state) {
    enum { EXTENT = 256 };
    static uint8_t texels[EXTENT][EXTENT];
    const lobe_image image = {LOBE_FORMAT_R8_UNORM, EXTENT, EXTENT, texels};
    graph_fixture *f = *state;
    lobe_texture *texture;
    assert_int_equal(
        lobe_graph_create_texture(f->graph, &(lobe_texture_parameters){"map", &image}, &texture),
        LOBE_OK);
    lobe_graph_begin(f->graph);
    graph_fixture_execute(f);
    size_t most = 0;
    for (uint32_t n = 0; n < EXTENT * EXTENT; n++) {
        const lobe_rectangle part = {n * 7 % EXTENT, n / EXTENT, 1, 1};
        texels[part.y][part.x] = (uint8_t)(n * 31);
        assert_int_equal(lobe_texture_update_part(texture, &image, &part), LOBE_OK);
        most = waiting(f) > most ? waiting(f) : most;
    }
    assert_in_range(most, 10, EXTENT * EXTENT / 100);
    lobe_graph_begin(f->graph);
    const lobe_resource seen = lobe_graph_import_texture(f->graph, texture);
    lobe_graph_read_back(f->graph, seen, (lobe_range){0});
    graph_fixture_execute(f);
    assert_memory_equal(lobe_graph_data(f->graph, seen, NULL), texels, sizeof texels);
    lobe_texture_destroy(&texture);
}

static void parts_outside_are_refused(void **state) {
    static const lobe_rectangle wrong[] = {
        {0, 0, 8, 1}, {0, 0, 1, 6}, {7, 0, 1, 1},          {0, 5, 1, 1},         {3, 3, 0, 1},
        {3, 3, 1, 0}, {1, 0, 7, 1}, {UINT32_MAX, 0, 2, 1}, {0, 2, 1, UINT32_MAX}};
    graph_fixture *f = *state;
    contents first = pattern(1), second = pattern(100);
    const lobe_image image = image_of(&second);
    lobe_texture *texture = create_texture(f, &first), *plain;
    assert_int_equal(
        lobe_texture_create(f->device, &(lobe_texture_parameters){"plain", &image}, &plain),
        LOBE_OK);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(lobe_texture_update_part(texture, &image, &wrong[i]),
                         LOBE_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(f->recorder.last_error, "'map' is 7x5"));
        assert_int_equal(lobe_texture_update_part(plain, &image, &wrong[i]),
                         LOBE_ERROR_INVALID_ARGUMENT);
    }
    assert_int_equal(f->recorder.errors, 2 * sizeof wrong / sizeof *wrong);
    f->recorder.errors = 0;
    assert_texture(f, texture, &first);
    lobe_texture_destroy(&texture);
    lobe_texture_destroy(&plain);
}

/// A texture without a graph is written at once.
static void parts_of_a_plain_texture(void **state) {
    graph_fixture *f = *state;
    contents expected = pattern(1), next = pattern(100);
    const lobe_rectangle part = {2, 1, 4, 3};
    const lobe_image image = image_of(&expected);
    lobe_texture *texture;
    assert_int_equal(
        lobe_texture_create(f->device, &(lobe_texture_parameters){"plain", &image}, &texture),
        LOBE_OK);
    update(texture, &next, part);
    copy_part(&expected, &next, part);
    assert_int_equal(waiting(f), 0);
    assert_texture(f, texture, &expected);
    lobe_texture_destroy(&texture);
}

// ---------------------------------------------------------------------------------------------
// Frames in flight

enum { FRAMES = 3 };

/// One copy of the texture, with the others kept as they are; all are read back in the last frame.
static void declare_frame(graph_fixture *f, const lobe_texture *texture, int number,
                          lobe_resource copies[FRAMES]) {
    static const char *const names[FRAMES] = {"copy 0", "copy 1", "copy 2"};
    lobe_graph_begin(f->graph);
    for (int i = 0; i < FRAMES; i++) {
        copies[i] = declare_copy(f, i == number ? texture : NULL, names[i]);
        if (number == FRAMES - 1)
            lobe_graph_read_back(f->graph, copies[i], (lobe_range){0});
        else if (i == number)
            lobe_graph_output(f->graph, copies[i]);
    }
}

/// Frames that the device cannot begin, each with its own content of one texture: whoever waited
/// for the device would wait forever. `recreate`: the texture is destroyed and created again.
static void check_frames_in_flight(graph_fixture *f, const graph_gate *gate, uint64_t value,
                                   bool recreate, lobe_texture **texture) {
    contents content[FRAMES];
    lobe_resource copies[FRAMES];
    for (int n = 0; n < FRAMES; n++) {
        content[n] = pattern((float)(100 * n) + (float)(1000 * value));
        if (recreate) {
            lobe_texture_destroy(texture);
            *texture = create_texture(f, &content[n]);
        } else {
            update(*texture, &content[n], (lobe_rectangle){0, 0, WIDTH, HEIGHT});
        }
        declare_frame(f, *texture, n, copies);
        graph_gate_submit_behind(f, gate, value);
    }
    graph_gate_open(gate, value);
    assert_int_equal(lobe_graph_wait(f->graph), LOBE_OK);
    for (int n = 0; n < FRAMES; n++)
        assert_data(f, copies[n], &content[n]);
}

static void frames_in_flight_keep_their_content(void **state) {
    graph_fixture *f = *state;
    graph_gate gate = graph_gate_close(f);
    contents first = pattern(1);
    lobe_texture *texture = create_texture(f, &first);
    lobe_resource copies[FRAMES];
    lobe_graph_set_frames_in_flight(f->graph, FRAMES);
    for (int n = 0; n < FRAMES; n++) {
        declare_frame(f, texture, n, copies);
        assert_int_equal(lobe_graph_submit(f->graph, &(lobe_vulkan_submission){0}), LOBE_OK);
    }
    for (uint64_t value = 1; value <= 4; value++)
        check_frames_in_flight(f, &gate, value, value % 2 == 0, &texture);
    lobe_texture_destroy(&texture);
    lobe_graph_destroy(&f->graph);
    graph_gate_destroy(&gate);
}

// ---------------------------------------------------------------------------------------------
// What goes wrong

static void the_frame_after_a_failed_one_copies(void **state) {
    graph_fixture *f = *state;
    contents first = pattern(1), second = pattern(100);
    lobe_texture *texture = create_texture(f, &first);
    assert_texture(f, texture, &first);
    update(texture, &second, (lobe_rectangle){0, 0, WIDTH, HEIGHT});
    lobe_graph_begin(f->graph);
    lobe_graph_fail(f->graph, LOBE_ERROR_GRAPH, "not this one");
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_ERROR_GRAPH);
    assert_int_equal(waiting(f), 1);
    f->recorder.errors = 0;
    assert_texture(f, texture, &second);
    lobe_texture_destroy(&texture);
}

static void other_graphs_may_not_use_them(void **state) {
    graph_fixture *f = *state;
    contents content = pattern(1);
    lobe_texture *texture = create_texture(f, &content);
    lobe_buffer *buffer = create_buffer(f, &content);
    lobe_graph *own = f->graph;
    assert_int_equal(lobe_graph_create(f->device, &f->graph), LOBE_OK);
    lobe_graph_begin(f->graph);
    lobe_graph_import_texture(f->graph, texture);
    GRAPH_EXPECT(f, LOBE_ERROR_GRAPH, "'map'", "another graph");
    f->recorder.errors = 0;
    lobe_graph_begin(f->graph);
    lobe_graph_import_buffer(f->graph, buffer);
    GRAPH_EXPECT(f, LOBE_ERROR_GRAPH, "'numbers'", "another graph");
    lobe_graph_destroy(&f->graph);
    f->graph = own;
    lobe_texture_destroy(&texture);
    lobe_buffer_destroy(&buffer);
}

/// Takes the mapped memory that a device with a limit has left.
static size_t occupy(lobe_device *device, engine_staging staging[], size_t most) {
    size_t count = 0;
    for (VkDeviceSize size = 1 << 20; size >= 1 << 10 && count < most;)
        if (engine_staging_create(device, "occupied", size, ENGINE_MEMORY_UPLOAD,
                                  &staging[count]) == LOBE_OK)
            count++;
        else
            size /= 2;
    return count;
}

/// There is no memory for it to pass through.
static void a_failed_update_leaves_the_content(void **state) {
    (void)state;
    graph_fixture small = {0};
    engine_staging occupied[64];
    contents first = pattern(1), second = pattern(100);
    const lobe_image image = image_of(&second);
    log_recorder_start(&small.recorder);
    const lobe_device_parameters parameters = {.memory_limit = 8 << 20,
                                               .host = &small.recorder.host};
    assert_int_equal(lobe_device_create(&parameters, &small.device), LOBE_OK);
    assert_int_equal(lobe_graph_create(small.device, &small.graph), LOBE_OK);
    lobe_texture *texture = create_texture(&small, &first);
    assert_texture(&small, texture, &first); // which has all other memory made
    size_t count = occupy(small.device, occupied, 64);
    small.recorder.errors = 0;
    assert_int_equal(lobe_texture_update(texture, &image), LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(small.recorder.errors, 1);
    assert_int_equal(waiting(&small), 0);
    small.recorder.errors = 0;
    assert_texture(&small, texture, &first);
    while (count > 0)
        engine_staging_destroy(small.device, &occupied[--count]);
    update(texture, &second, (lobe_rectangle){0, 0, WIDTH, HEIGHT});
    assert_texture(&small, texture, &second);
    lobe_texture_destroy(&texture);
    lobe_graph_destroy(&small.graph);
    lobe_device_destroy(&small.device);
}

/// What is destroyed before its content was copied is not written; the rest is.
static void gone_objects_are_left_out(void **state) {
    graph_fixture *f = *state;
    contents first = pattern(1), second = pattern(100);
    lobe_texture *gone = create_texture(f, &first), *texture = create_texture(f, &second);
    lobe_buffer *buffer = create_buffer(f, &first);
    lobe_texture_destroy(&gone);
    lobe_buffer_destroy(&buffer);
    assert_texture(f, texture, &second);
    update(texture, &first, (lobe_rectangle){1, 1, 2, 2});
    lobe_texture_destroy(&texture);
    lobe_graph_begin(f->graph);
    graph_fixture_execute(f);
}

/// A host that shows nothing for a while may go on: what no frame uses needs no frame to go.
static void objects_come_and_go_between_frames(void **state) {
    enum { OBJECTS = 500, LARGE = 64 << 10 };
    const lobe_buffer_parameters large = {.name = "large", .size = LARGE};
    graph_fixture *f = *state;
    contents content = pattern(1);
    graph_gate gate = graph_gate_close(f);
    lobe_device_memory before, after;
    lobe_texture *kept = create_texture(f, &content);
    assert_texture(f, kept, &content);
    for (uint64_t in_flight = 0; in_flight < 2; in_flight++) {
        lobe_graph_begin(f->graph);
        lobe_graph_output(f->graph, declare_copy(f, kept, "seen"));
        if (in_flight)
            graph_gate_submit_behind(f, &gate, 1);
        update(kept, &content, (lobe_rectangle){0, 0, 1, 1});
        lobe_device_memory_query(f->device, &before);
        for (int n = 0; n < OBJECTS; n++) {
            lobe_texture *texture = create_texture(f, &content);
            lobe_buffer *buffer;
            assert_int_equal(lobe_graph_create_buffer(f->graph, &large, &buffer), LOBE_OK);
            lobe_texture_destroy(&texture);
            lobe_buffer_destroy(&buffer);
        }
        lobe_device_memory_query(f->device, &after);
        assert_true(after.used_bytes < before.used_bytes + (uint64_t)OBJECTS / 20 * LARGE);
        assert_true(f->graph->kept.uploads.ring.discards.count < 5); // the ring has grown
        assert_int_equal(waiting(f), 1);
    }
    graph_gate_open(&gate, 1);
    assert_texture(f, kept, &content);
    lobe_texture_destroy(&kept);
    lobe_graph_destroy(&f->graph);
    graph_gate_destroy(&gate);
}

/// Nothing can fail when an object goes while frames are in flight, so nobody has to wait for them:
/// the host may not even have submitted them.
static void destruction_allocates_nothing(void **state) {
    (void)state;
    enum { OBJECTS = 100 };
    counting_allocator counting;
    graph_fixture f = {0};
    contents content = pattern(1);
    lobe_texture *textures[OBJECTS];
    lobe_buffer *buffers[OBJECTS];
    counting_allocator_start(&counting);
    log_recorder_start(&f.recorder);
    f.recorder.host.allocator = &counting.allocator;
    assert_int_equal(
        lobe_device_create(&(lobe_device_parameters){.host = &f.recorder.host}, &f.device),
        LOBE_OK);
    assert_int_equal(lobe_graph_create(f.device, &f.graph), LOBE_OK);
    for (int n = 0; n < OBJECTS; n++) {
        textures[n] = create_texture(&f, &content);
        buffers[n] = create_buffer(&f, &content);
    }
    graph_gate gate = graph_gate_close(&f);
    lobe_graph_begin(f.graph);
    lobe_graph_output(f.graph, declare_copy(&f, textures[0], "seen"));
    graph_gate_submit_behind(&f, &gate, 1);
    counting.taken = 0;
    for (int n = 0; n < OBJECTS; n++) {
        lobe_texture_destroy(&textures[n]);
        lobe_buffer_destroy(&buffers[n]);
    }
    assert_int_equal(counting.taken, 0);
    graph_gate_open(&gate, 1);
    lobe_graph_destroy(&f.graph);
    graph_gate_destroy(&gate);
    lobe_device_destroy(&f.device);
    assert_nothing_left(&counting);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(the_next_frame_copies),
        TEST(a_buffer_without_data_is_zero),
        TEST(large_new_objects_do_not_fill_the_ring),
        TEST(only_the_part_is_copied),
        TEST(many_parts_before_a_frame),
        TEST(single_texels_become_all_of_them),
        TEST(parts_outside_are_refused),
        TEST(parts_of_a_plain_texture),
        TEST(frames_in_flight_keep_their_content),
        TEST(the_frame_after_a_failed_one_copies),
        TEST(other_graphs_may_not_use_them),
        TEST(a_failed_update_leaves_the_content),
        TEST(gone_objects_are_left_out),
        TEST(objects_come_and_go_between_frames),
        cmocka_unit_test(destruction_allocates_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
