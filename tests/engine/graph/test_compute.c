#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "engine/graph/state.h"
#include "tests/engine/graph/graph_support.h"

static const float *read_floats(graph_fixture *fixture, lobe_resource resource, size_t count) {
    size_t size = 0;
    const float *data = lobe_graph_data(fixture->graph, resource, &size);
    assert_non_null(data);
    assert_int_equal(size, count * sizeof(float));
    return data;
}

static void compute_fills_a_buffer(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    // Not a multiple of the group size of 64.
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 1000 * sizeof(float));
    numbers = graph_fixture_count(fixture, "count", numbers, 3.0f, 1000);
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *data = read_floats(fixture, numbers, 1000);
    for (int i = 0; i < 1000; i++)
        assert_true(data[i] == 3.0f * (float)i);
}

static void passes_see_what_passes_before_wrote(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = graph_fixture_buffer(fixture, "first", 64 * sizeof(float));
    numbers = graph_fixture_count(fixture, "count", numbers, 1.0f, 64);
    for (int i = 0; i < 10; i++) {
        lobe_resource next = graph_fixture_buffer(fixture, "next", 64 * sizeof(float));
        numbers = graph_fixture_add(fixture, "add", numbers, next, 1.0f, 64);
    }
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(read_floats(fixture, numbers, 64)[5] == 15.0f);
    const lobe_graph_report *report = lobe_graph_describe(fixture->graph);
    assert_int_equal(report->pass_count, 11);
    // Two of the eleven buffers are alive at a time.
    assert_true(report->transient_bytes < report->transient_bytes_without_aliasing);
}

/// A buffer may be overwritten once all its readers have run.
static void a_buffer_is_used_again(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource a = graph_fixture_buffer(fixture, "a", 64 * sizeof(float));
    lobe_resource b = graph_fixture_buffer(fixture, "b", 64 * sizeof(float));
    a = graph_fixture_count(fixture, "count", a, 1.0f, 64);
    for (int i = 0; i < 4; i++) {
        b = graph_fixture_add(fixture, "forth", a, b, 1.0f, 64);
        a = graph_fixture_add(fixture, "back", b, a, 1.0f, 64);
    }
    lobe_graph_read_back(fixture->graph, a, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, b, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(read_floats(fixture, a, 64)[63] == 71.0f);
    assert_true(read_floats(fixture, b, 64)[63] == 70.0f);
}

/// Content that is read back before a later pass overwrites it.
static void each_version_can_be_read_back(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 8 * sizeof(float));
    lobe_resource first = graph_fixture_count(fixture, "first", numbers, 1.0f, 8);
    lobe_graph_read_back(fixture->graph, first, (lobe_range){0});
    lobe_resource second = graph_fixture_count(fixture, "second", first, 2.0f, 8);
    lobe_graph_read_back(fixture->graph, second, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(read_floats(fixture, first, 8)[3] == 3.0f);
    assert_true(read_floats(fixture, second, 8)[3] == 6.0f);
    assert_null(lobe_graph_data(fixture->graph, numbers, NULL));
}

static lobe_resource paint(graph_fixture *fixture, lobe_resource image, uint32_t width,
                           uint32_t height, uint32_t layers) {
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "paint");
    image = lobe_pass_write(
        pass, &(lobe_binding){.name = "target", .resource = image, .range = {0, 1, 0, 0}});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "graph_paint.comp", .threads = {width, height, layers}});
    return image;
}

static lobe_resource halve(graph_fixture *fixture, lobe_resource image, uint32_t level,
                           uint32_t size, uint32_t layers) {
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "halve");
    lobe_pass_read(
        pass, &(lobe_binding){.name = "source", .resource = image, .range = {level - 1, 1, 0, 0}});
    image = lobe_pass_write(
        pass, &(lobe_binding){.name = "target", .resource = image, .range = {level, 1, 0, 0}});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "graph_halve.comp", .threads = {size, size, layers}});
    return image;
}

/// Each level is read as a sampled image while the next is written as a storage image.
static void levels_are_made_from_levels(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image =
        lobe_graph_image(fixture->graph, &(lobe_image_description){.name = "pyramid",
                                                                   .format = LOBE_FORMAT_R32_FLOAT,
                                                                   .width = 16,
                                                                   .height = 16,
                                                                   .layers = 3,
                                                                   .levels = 5});
    image = paint(fixture, image, 16, 16, 3);
    for (uint32_t level = 1; level < 5; level++)
        image = halve(fixture, image, level, 16 >> level, 3);
    lobe_graph_read_back(fixture->graph, image, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *texels = read_floats(fixture, image, 3 * (256 + 64 + 16 + 4 + 1));
    for (uint32_t level = 0; level < 5; level++)
        for (uint32_t layer = 0; layer < 3; layer++)
            for (uint32_t i = 0; i < 256u >> (2 * level); i++, texels++) {
                float scale = (float)(1 << level), offset = 0.5f * (scale - 1.0f);
                float x = scale * (float)(i % (16 >> level)) + offset;
                float y = scale * (float)(i / (16 >> level)) + offset;
                assert_float_equal(*texels, x + 100.0f * y + 10000.0f * (float)layer, 1e-2);
            }
}

static void a_range_can_be_read_back(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image =
        lobe_graph_image(fixture->graph, &(lobe_image_description){.name = "pyramid",
                                                                   .format = LOBE_FORMAT_R32_FLOAT,
                                                                   .width = 4,
                                                                   .height = 4,
                                                                   .layers = 3,
                                                                   .levels = 2});
    image = paint(fixture, image, 4, 4, 3);
    image = halve(fixture, image, 1, 2, 3);
    lobe_graph_read_back(fixture->graph, image, (lobe_range){1, 1, 2, 1});
    graph_fixture_execute(fixture);
    assert_float_equal(read_floats(fixture, image, 4)[0], 20050.5, 1e-2);
}

/// Two dispatches of one pass, each with its own bindings for reading.
static void dispatches_have_their_own_bindings(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource source[2], target[2];
    lobe_pass *pass;
    for (int i = 0; i < 2; i++)
        source[i] = graph_fixture_count(
            fixture, "count", graph_fixture_buffer(fixture, "source", 256 * sizeof(float)),
            (float)(i + 1), 256);
    target[0] = graph_fixture_buffer(fixture, "target", 256 * sizeof(float));
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "add");
    target[0] = lobe_pass_modify(pass, &(lobe_binding){.name = "target_block",
                                                       .resource = graph_fixture_count(
                                                           fixture, "zero", target[0], 0.0f, 256)});
    for (uint32_t i = 0; i < 2; i++) {
        const struct {
            float offset;
            uint32_t first, count;
        } constants = {0.5f, 128 * i, 128};
        const lobe_binding binding = {.name = "source_block", .resource = source[i]};
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_add_part.comp",
                                                  .threads = {128},
                                                  .constants = &constants,
                                                  .constants_size = sizeof constants,
                                                  .bindings = &binding,
                                                  .binding_count = 1});
    }
    lobe_graph_read_back(fixture->graph, target[0], (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *data = read_floats(fixture, target[0], 256);
    assert_true(data[100] == 100.5f);
    assert_true(data[200] == 400.5f);
}

static void specialisation_reaches_the_shader(void **state) {
    graph_fixture *fixture = *state;
    const float factor = 2.5f;
    uint32_t count = 100, bits;
    memcpy(&bits, &factor, sizeof bits);
    const lobe_specialisation values[] = {{0, 32}, {1, bits}, {99, 1}};
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", count * sizeof(float));
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "fill");
    numbers = lobe_pass_write(pass, &(lobe_binding){.name = "Target", .resource = numbers});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "fill.comp",
                                              .threads = {count},
                                              .constants = &count,
                                              .constants_size = sizeof count,
                                              .specialisation = values,
                                              .specialisation_count = 3});
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(read_floats(fixture, numbers, count)[99] == 247.5f);
}

static void uploads_and_imports_are_read(void **state) {
    graph_fixture *fixture = *state;
    float uploaded[64], held[64];
    lobe_buffer *buffer = NULL;
    for (int i = 0; i < 64; i++) {
        uploaded[i] = (float)i;
        held[i] = (float)(-i);
    }
    assert_int_equal(
        lobe_buffer_create(fixture->device,
                           &(lobe_buffer_parameters){.name = "held", .size = 256, .data = held},
                           &buffer),
        LOBE_OK);
    for (int frame = 0; frame < 2; frame++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource imported = lobe_graph_import_buffer(fixture->graph, buffer);
        lobe_resource again = lobe_graph_import_buffer(fixture->graph, buffer);
        assert_memory_equal(&imported, &again, sizeof again);
        lobe_resource upload =
            lobe_graph_upload(fixture->graph, "uploaded", uploaded, sizeof uploaded);
        lobe_graph_upload(fixture->graph, "other", uploaded, 12);
        lobe_resource a = graph_fixture_buffer(fixture, "a", 256);
        lobe_resource b = graph_fixture_buffer(fixture, "b", 256);
        a = graph_fixture_add(fixture, "from upload", upload, a, 0.25f, 64);
        b = graph_fixture_add(fixture, "from import", imported, b, 0.25f, 64);
        memset(uploaded, 0, sizeof uploaded); // it was copied
        lobe_graph_read_back(fixture->graph, a, (lobe_range){0});
        lobe_graph_read_back(fixture->graph, b, (lobe_range){0});
        graph_fixture_execute(fixture);
        assert_true(read_floats(fixture, a, 64)[9] == (frame == 0 ? 9.25f : 0.25f));
        assert_true(read_floats(fixture, b, 64)[9] == -8.75f);
    }
    lobe_buffer_destroy(&buffer);
}

static lobe_texture *make_texture(graph_fixture *fixture, uint32_t width, uint32_t height) {
    lobe_texture *texture = NULL;
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_R32_FLOAT, width, height, NULL),
                     LOBE_OK);
    for (uint32_t i = 0; i < width * height; i++)
        ((float *)image.texels)[i] = (float)i;
    assert_int_equal(lobe_texture_create(
                         fixture->device,
                         &(lobe_texture_parameters){.name = "texture", .image = &image}, &texture),
                     LOBE_OK);
    lobe_image_free(&image);
    return texture;
}

/// Sampled by a shader and copied from, alternately: the layout changes back and forth.
static void textures_are_sampled_and_copied(void **state) {
    graph_fixture *fixture = *state;
    lobe_texture *texture = make_texture(fixture, 8, 8);
    for (int frame = 0; frame < 2; frame++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource source = lobe_graph_import_texture(fixture->graph, texture);
        lobe_resource half = graph_fixture_image(fixture, "half", LOBE_FORMAT_R32_FLOAT, 4, 4);
        lobe_resource copy = graph_fixture_image(fixture, "copy", LOBE_FORMAT_R32_FLOAT, 8, 8);
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "halve");
        lobe_pass_read(pass, &(lobe_binding){.name = "source", .resource = source});
        half = lobe_pass_write(pass, &(lobe_binding){.name = "target", .resource = half});
        lobe_pass_dispatch(pass,
                           &(lobe_dispatch){.shader = "graph_halve.comp", .threads = {4, 4, 1}});
        pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "copy");
        copy = lobe_pass_copy(pass, source, (lobe_range){0}, copy, (lobe_range){0});
        lobe_graph_read_back(fixture->graph, half, (lobe_range){0});
        lobe_graph_read_back(fixture->graph, copy, (lobe_range){0});
        lobe_graph_read_back(fixture->graph, source, (lobe_range){0});
        graph_fixture_execute(fixture);
        assert_true(read_floats(fixture, half, 16)[5] == 22.5f);
        assert_true(read_floats(fixture, copy, 64)[63] == 63.0f);
        assert_true(read_floats(fixture, source, 64)[62] == 62.0f);
    }
    lobe_texture_destroy(&texture);
}

/// One pass reads one image both sampled and as a storage image: one layout must allow both.
static void one_pass_reads_one_image_in_two_ways(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_R32_FLOAT, 8, 8);
    lobe_resource sum = graph_fixture_image(fixture, "sum", LOBE_FORMAT_R32_FLOAT, 8, 8);
    image = paint(fixture, image, 8, 8, 1);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "both");
    lobe_pass_read(pass, &(lobe_binding){.name = "sampled", .resource = image});
    lobe_pass_read(pass, &(lobe_binding){.name = "stored", .resource = image});
    sum = lobe_pass_write(pass, &(lobe_binding){.name = "sum", .resource = sum});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_two_ways.comp", .threads = {8, 8}});
    lobe_graph_read_back(fixture->graph, sum, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(read_floats(fixture, sum, 64)[8 * 3 + 5] == 610.0f);
}

static void fills_and_copies(void **state) {
    graph_fixture *fixture = *state;
    const float colour[4] = {0.25f, 0.5f, 0.75f, 1.0f};
    lobe_graph_begin(fixture->graph);
    lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_RGBA32_FLOAT, 5, 3);
    lobe_resource depth = graph_fixture_image(fixture, "depth", LOBE_FORMAT_D32_FLOAT, 5, 3);
    lobe_resource other = graph_fixture_image(fixture, "other", LOBE_FORMAT_RGBA32_FLOAT, 5, 3);
    // Seven bytes, although fills write words.
    lobe_resource buffer = graph_fixture_buffer(fixture, "buffer", 7);
    lobe_resource twin = graph_fixture_buffer(fixture, "twin", 7);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
    image = lobe_pass_fill(pass, image, (lobe_range){0}, colour);
    depth = lobe_pass_fill(pass, depth, (lobe_range){0}, colour);
    buffer = lobe_pass_fill(pass, buffer, (lobe_range){0}, colour);
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "copy");
    other = lobe_pass_copy(pass, image, (lobe_range){0}, other, (lobe_range){0});
    twin = lobe_pass_copy(pass, buffer, (lobe_range){0}, twin, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, other, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, depth, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, twin, (lobe_range){0});
    graph_fixture_execute(fixture);
    size_t size;
    assert_memory_equal(read_floats(fixture, other, 60) + 56, colour, sizeof colour);
    assert_true(read_floats(fixture, depth, 15)[14] == 0.25f);
    assert_memory_equal(lobe_graph_data(fixture->graph, twin, &size), colour, 4);
    assert_int_equal(size, 7);
}

/// One level of an image to another level of another.
static void copies_between_levels(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_image_description description = {
        .name = "large", .format = LOBE_FORMAT_R32_FLOAT, .width = 8, .height = 8, .levels = 2};
    lobe_resource large = lobe_graph_image(fixture->graph, &description);
    lobe_resource small = graph_fixture_image(fixture, "small", LOBE_FORMAT_R32_FLOAT, 4, 4);
    large = paint(fixture, large, 8, 8, 1);
    large = halve(fixture, large, 1, 4, 1);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "copy");
    small = lobe_pass_copy(pass, large, (lobe_range){1, 1, 0, 1}, small, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, small, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(read_floats(fixture, small, 16)[0] == 50.5f);
}

/// Twice into one image, whose other texels stay.
static void copies_parts(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_R32_FLOAT, 8, 8);
    lobe_resource other = graph_fixture_image(fixture, "other", LOBE_FORMAT_R32_FLOAT, 6, 5);
    image = paint(fixture, image, 8, 8, 1);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
    other = lobe_pass_fill(pass, other, (lobe_range){0}, (const float[4]){-1});
    for (uint32_t i = 0; i < 2; i++) {
        pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "copy");
        other =
            lobe_pass_copy_part(pass, image, &(lobe_rectangle){2 + i, 3, 2, 4}, other, 4 * i, i);
    }
    lobe_graph_read_back(fixture->graph, other, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *texels = read_floats(fixture, other, 30);
    for (int y = 0; y < 5; y++)
        for (int x = 0; x < 6; x++) {
            const float first = x < 2 && y < 4 ? (float)(x + 2 + 100 * (y + 3)) : -1;
            const float second = x >= 4 && y >= 1 ? (float)(x - 1 + 100 * (y + 2)) : first;
            assert_true(texels[6 * y + x] == second);
        }
}

/// A series of images, two of them alive at a time, each in memory that others used before.
static void images_share_memory(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_R32_FLOAT, 64, 64);
    image = paint(fixture, image, 64, 64, 1);
    for (int i = 0; i < 12; i++) {
        // Sizes differ, so that places overlap partially.
        uint32_t height = 64 + 32 * (uint32_t)(i % 3);
        lobe_resource next = lobe_graph_image(
            fixture->graph,
            &(lobe_image_description){
                .name = "next", .format = LOBE_FORMAT_R32_FLOAT, .width = 64, .height = height});
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "double");
        lobe_pass_read(pass, &(lobe_binding){.name = "sampled", .resource = image});
        lobe_pass_read(pass, &(lobe_binding){.name = "stored", .resource = image});
        next = lobe_pass_write(pass, &(lobe_binding){.name = "sum", .resource = next});
        lobe_pass_dispatch(
            pass, &(lobe_dispatch){.shader = "graph_two_ways.comp", .threads = {64, height}});
        image = next;
    }
    lobe_graph_read_back(fixture->graph, image, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *texels = read_floats(fixture, image, 64 * 128);
    for (int i = 0; i < 64 * 64; i++)
        assert_true(texels[i] == 4096.0f * (float)(i % 64 + 100 * (i / 64)));
    const lobe_graph_report *report = lobe_graph_describe(fixture->graph);
    assert_true(4 * report->transient_bytes < report->transient_bytes_without_aliasing);
}

static void a_cube_is_read(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource cube = lobe_graph_image(
        fixture->graph,
        &(lobe_image_description){
            .name = "cube", .format = LOBE_FORMAT_R32_FLOAT, .width = 8, .height = 8, .layers = 6});
    cube = paint(fixture, cube, 8, 8, 6);
    lobe_resource faces = graph_fixture_buffer(fixture, "faces", 6 * sizeof(float));
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "look");
    lobe_pass_read(pass, &(lobe_binding){.name = "cube", .resource = cube});
    faces = lobe_pass_write(pass, &(lobe_binding){.name = "face_block", .resource = faces});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_cube.comp", .threads = {6}});
    lobe_graph_read_back(fixture->graph, faces, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *data = read_floats(fixture, faces, 6);
    for (int i = 0; i < 6; i++)
        assert_int_equal((int)data[i] / 10000, i);
}

static void what_no_output_needs_does_not_run(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource wanted = graph_fixture_buffer(fixture, "wanted", 256);
    lobe_resource unwanted = graph_fixture_buffer(fixture, "unwanted", 1 << 20);
    wanted = graph_fixture_count(fixture, "useful", wanted, 1.0f, 64);
    unwanted = graph_fixture_count(fixture, "useless", unwanted, 1.0f, 64);
    lobe_graph_output(fixture->graph, wanted);
    graph_fixture_execute(fixture);
    const lobe_graph_report *report = lobe_graph_describe(fixture->graph);
    assert_int_equal(graph_fixture_state(fixture, "useful"), LOBE_PASS_RUN);
    assert_int_equal(graph_fixture_state(fixture, "useless"), LOBE_PASS_CULLED);
    assert_true(report->transient_bytes < 1 << 20);
    assert_string_equal(report->passes[0].name, "useful");
}

static void a_kept_pass_runs_though_nothing_needs_it(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource buffer = graph_fixture_buffer(fixture, "buffer", 256);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "kept");
    lobe_pass_fill(pass, buffer, (lobe_range){0}, (const float[4]){1.0f});
    lobe_pass_keep(pass);
    graph_fixture_execute(fixture);
    assert_int_equal(graph_fixture_state(fixture, "kept"), LOBE_PASS_RUN);
}

static void an_empty_frame_is_fine(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    graph_fixture_execute(fixture);
    assert_int_equal(lobe_graph_describe(fixture->graph)->pass_count, 0);
}

static lobe_graph_report timed_frame(graph_fixture *fixture, uint32_t count) {
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", count * sizeof(float));
    lobe_resource sums = graph_fixture_buffer(fixture, "sums", count * sizeof(float));
    numbers = graph_fixture_count(fixture, "count", numbers, 1.0f, count);
    sums = graph_fixture_add(fixture, "add", numbers, sums, 1.0f, count);
    lobe_graph_output(fixture->graph, sums);
    graph_fixture_execute(fixture);
    return *lobe_graph_describe(fixture->graph);
}

static void passes_are_timed(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_report report = timed_frame(fixture, 1 << 21);
    double sum = 0.0;
    for (size_t i = 0; i < report.pass_count; i++) {
        assert_true(report.passes[i].milliseconds > 0.01);
        sum += report.passes[i].milliseconds;
    }
    assert_true(report.milliseconds >= sum * 0.999);
    assert_true(report.milliseconds < 60e3);
}

static void a_still_frame_allocates_nothing(void **state) {
    graph_fixture *fixture = *state;
    timed_frame(fixture, 1 << 16);
    // The mark is lost if memory is planned again.
    const uint32_t mark = 12345;
    fixture->graph->kept.transients.requests[0].first = mark;
    const VkDescriptorPool pool = fixture->graph->frame.flight->descriptors;
    const VkQueryPool timestamps = fixture->graph->frame.flight->timestamps;
    timed_frame(fixture, 1 << 16);
    assert_int_equal(fixture->graph->kept.transients.requests[0].first, mark);
    assert_ptr_equal(fixture->graph->frame.flight->descriptors, pool);
    assert_ptr_equal(fixture->graph->frame.flight->timestamps, timestamps);
    timed_frame(fixture, 1 << 17);
    assert_int_not_equal(fixture->graph->kept.transients.requests[0].first, mark);
}

static void compiling_runs_nothing(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 256);
    numbers = graph_fixture_count(fixture, "count", numbers, 1.0f, 64);
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    assert_int_equal(lobe_graph_compile(fixture->graph), LOBE_OK);
    assert_null(lobe_graph_data(fixture->graph, numbers, NULL));
    assert_int_equal(graph_fixture_state(fixture, "count"), LOBE_PASS_RUN);
    assert_true(lobe_graph_describe(fixture->graph)->transient_bytes > 0);
    graph_fixture_execute(fixture);
    assert_non_null(lobe_graph_data(fixture->graph, numbers, NULL));
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(compute_fills_a_buffer),
        TEST(passes_see_what_passes_before_wrote),
        TEST(a_buffer_is_used_again),
        TEST(each_version_can_be_read_back),
        TEST(levels_are_made_from_levels),
        TEST(a_range_can_be_read_back),
        TEST(dispatches_have_their_own_bindings),
        TEST(specialisation_reaches_the_shader),
        TEST(uploads_and_imports_are_read),
        TEST(textures_are_sampled_and_copied),
        TEST(one_pass_reads_one_image_in_two_ways),
        TEST(fills_and_copies),
        TEST(copies_between_levels),
        TEST(copies_parts),
        TEST(images_share_memory),
        TEST(a_cube_is_read),
        TEST(what_no_output_needs_does_not_run),
        TEST(a_kept_pass_runs_though_nothing_needs_it),
        TEST(an_empty_frame_is_fine),
        TEST(passes_are_timed),
        TEST(a_still_frame_allocates_nothing),
        TEST(compiling_runs_nothing),
    };
    return cmocka_run_group_tests_name("graph_compute", tests, NULL, NULL);
}
