// Draws and dispatches that take their counts from a buffer.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "tests/engine/graph/graph_support.h"

#define SIZE 8

typedef struct argument_constants {
    uint32_t first[4], second[4];
    uint32_t offset;
} argument_constants;

/// A buffer of two records that a pass writes: at byte 0 and byte 20.
static lobe_resource write_arguments(graph_fixture *fixture, const uint32_t first[4],
                                     const uint32_t second[4]) {
    argument_constants constants = {.offset = 5};
    memcpy(constants.first, first, sizeof constants.first);
    memcpy(constants.second, second, sizeof constants.second);
    lobe_resource arguments = graph_fixture_buffer(fixture, "arguments", 40);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "arguments");
    arguments =
        lobe_pass_write(pass, &(lobe_binding){.name = "argument_block", .resource = arguments});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_arguments.comp",
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return arguments;
}

// ---------------------------------------------------------------------------------------------
// Dispatches

/// Fills a buffer with -1, then counts in as many groups of 64 as the arguments say.
static lobe_resource count_indirectly(graph_fixture *fixture, lobe_resource arguments,
                                      size_t offset) {
    const struct {
        float factor;
        uint32_t count;
    } constants = {2, 256};
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 256 * sizeof(float));
    lobe_pass *fill = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
    numbers = lobe_pass_fill(fill, numbers, (lobe_range){0}, (float[4]){-1});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "count");
    numbers = lobe_pass_modify(pass, &(lobe_binding){.name = "target_block", .resource = numbers});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_count.comp",
                                              .threads = {1000, 1000, 1000},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .indirect = arguments,
                                              .indirect_offset = offset});
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    return numbers;
}

static void a_dispatch_has_the_groups_in_the_buffer(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource arguments =
        write_arguments(fixture, (uint32_t[]){2, 1, 1, 0}, (uint32_t[]){3, 1, 1, 0});
    lobe_resource first = count_indirectly(fixture, arguments, 0);
    lobe_resource second = count_indirectly(fixture, arguments, 20);
    graph_fixture_execute(fixture);
    const float *two = lobe_graph_data(fixture->graph, first, NULL);
    const float *three = lobe_graph_data(fixture->graph, second, NULL);
    for (int i = 0; i < 256; i++) {
        assert_true(two[i] == (i < 128 ? 2.0f * (float)i : -1.0f));
        assert_true(three[i] == (i < 192 ? 2.0f * (float)i : -1.0f));
    }
}

static void no_groups_do_nothing(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource arguments =
        write_arguments(fixture, (uint32_t[]){0, 1, 1, 0}, (uint32_t[]){0, 0, 0, 0});
    lobe_resource numbers = count_indirectly(fixture, arguments, 0);
    graph_fixture_execute(fixture);
    const float *data = lobe_graph_data(fixture->graph, numbers, NULL);
    for (int i = 0; i < 256; i++)
        assert_true(data[i] == -1.0f);
}

/// Also from an upload and from an imported buffer.
static void arguments_may_come_from_the_host(void **state) {
    graph_fixture *fixture = *state;
    const lobe_dispatch_arguments groups = {{1, 1, 1}};
    lobe_buffer *buffer = NULL;
    assert_int_equal(
        lobe_buffer_create(
            fixture->device,
            &(lobe_buffer_parameters){.name = "groups", .size = sizeof groups, .data = &groups},
            &buffer),
        LOBE_OK);
    for (int imported = 0; imported < 2; imported++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource arguments =
            imported ? lobe_graph_import_buffer(fixture->graph, buffer)
                     : lobe_graph_upload(fixture->graph, "groups", &groups, sizeof groups);
        lobe_resource numbers = count_indirectly(fixture, arguments, 0);
        graph_fixture_execute(fixture);
        const float *data = lobe_graph_data(fixture->graph, numbers, NULL);
        assert_true(data[63] == 126 && data[64] == -1);
    }
    lobe_graph_begin(fixture->graph);
    lobe_buffer_destroy(&buffer);
}

// ---------------------------------------------------------------------------------------------
// Draws

/// Draws triangles that cover the picture, in red, then half of it, in green. The indices are those
/// of both.
static lobe_resource draw_indirectly(graph_fixture *fixture, lobe_resource arguments,
                                     bool indexed) {
    static const float corners[] = {-1, -1, -1, 3, 3, -1, -1, -1, -1, 1, 1, 1};
    static const uint32_t indices[] = {0, 1, 2, 3, 4, 5};
    static const struct {
        float colour[4], depth;
    } red = {{1, 0, 0, 1}, 0}, green = {{0, 1, 0, 1}, 0};
    // The first upload: in Mesa 22.3, lavapipe's indirect draws ignore where the indices begin.
    lobe_resource index_buffer =
        lobe_graph_upload(fixture->graph, "indices", indices, sizeof indices);
    const lobe_binding vertices = {
        .name = "vertex_block",
        .resource = lobe_graph_upload(fixture->graph, "vertices", corners, sizeof corners)};
    lobe_resource picture =
        graph_fixture_image(fixture, "picture", LOBE_FORMAT_RGBA32_FLOAT, SIZE, SIZE);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "draws");
    picture = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = picture});
    for (int i = 0; i < 2; i++) {
        lobe_draw draw = {
            .vertex_shader = "graph_triangle.vert",
            .fragment_shader = "graph_triangle.frag",
            .constants = i == 0 ? &red : &green,
            .constants_size = sizeof red,
            .bindings = &vertices,
            .binding_count = 1,
            .indirect = arguments,
            .indirect_offset = (size_t)(i * 20),
        };
        if (indexed)
            draw.indices = index_buffer;
        lobe_pass_draw(pass, &draw);
    }
    lobe_graph_read_back(fixture->graph, picture, (lobe_range){0});
    return picture;
}

/// Texel in the corner that both triangles cover (`both`), or in the one that only the first does.
static const float *texel(graph_fixture *fixture, lobe_resource picture, bool both) {
    const float *texels = lobe_graph_data(fixture->graph, picture, NULL);
    assert_non_null(texels);
    return texels + (size_t)4 * (both ? (SIZE - 1) * SIZE : SIZE - 1);
}

static void draws_have_the_counts_in_the_buffer(void **state) {
    graph_fixture *fixture = *state;
    for (int indexed = 0; indexed < 2; indexed++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource arguments =
            write_arguments(fixture, (uint32_t[]){3, 1, 0, 0}, (uint32_t[]){3, 1, 3, 0});
        lobe_resource picture = draw_indirectly(fixture, arguments, indexed);
        graph_fixture_execute(fixture);
        assert_memory_equal(texel(fixture, picture, true), ((float[]){0, 1, 0, 1}), 16);
        assert_memory_equal(texel(fixture, picture, false), ((float[]){1, 0, 0, 1}), 16);
    }
}

static void no_instances_draw_nothing(void **state) {
    graph_fixture *fixture = *state;
    for (int indexed = 0; indexed < 2; indexed++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource arguments =
            write_arguments(fixture, (uint32_t[]){3, 0, 0, 0}, (uint32_t[]){3, 1, 3, 0});
        lobe_resource picture = draw_indirectly(fixture, arguments, indexed);
        graph_fixture_execute(fixture);
        assert_memory_equal(texel(fixture, picture, true), ((float[]){0, 1, 0, 1}), 16);
        assert_memory_equal(texel(fixture, picture, false), ((float[]){0, 0, 0, 0}), 16);
    }
}

// ---------------------------------------------------------------------------------------------
// The graph

/// The buffer's content counts as an input of what is retained.
static void a_retained_result_depends_on_the_counts(void **state) {
    graph_fixture *fixture = *state;
    static const lobe_dispatch_arguments one = {{1, 1, 1}}, two = {{2, 1, 1}};
    static const lobe_dispatch_arguments *const groups[] = {&one, &one, &two, &two};
    static const float expected[] = {-1, -1, 130, 130};
    for (int frame = 0; frame < 4; frame++) {
        const struct {
            float factor;
            uint32_t count;
        } constants = {2, 256};
        lobe_graph_begin(fixture->graph);
        lobe_resource arguments =
            lobe_graph_upload(fixture->graph, "groups", groups[frame], sizeof one);
        lobe_resource numbers = lobe_graph_buffer(
            fixture->graph, &(lobe_buffer_description){
                                .name = "numbers", .size = 256 * sizeof(float), .retained = true});
        lobe_pass *fill = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
        numbers = lobe_pass_fill(fill, numbers, (lobe_range){0}, (float[4]){-1});
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "count");
        numbers =
            lobe_pass_modify(pass, &(lobe_binding){.name = "target_block", .resource = numbers});
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_count.comp",
                                                  .constants = &constants,
                                                  .constants_size = sizeof constants,
                                                  .indirect = arguments});
        lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
        graph_fixture_execute(fixture);
        const float *data = lobe_graph_data(fixture->graph, numbers, NULL);
        assert_true(data[63] == 126 && data[65] == expected[frame]);
        assert_int_equal(graph_fixture_state(fixture, "count"),
                         frame % 2 == 0 ? LOBE_PASS_RUN : LOBE_PASS_SKIPPED);
    }
}

static void wrong_places_are_errors(void **state) {
    graph_fixture *fixture = *state;
    static const size_t offsets[] = {2, 32, SIZE_MAX - 3};
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource arguments =
            write_arguments(fixture, (uint32_t[]){1, 1, 1, 0}, (uint32_t[]){1, 1, 1, 0});
        count_indirectly(fixture, arguments, offsets[i]);
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'count'", "'arguments'", "indirect");
        fixture->recorder.errors = 0;
    }
    lobe_graph_begin(fixture->graph);
    lobe_resource image =
        graph_fixture_image(fixture, "picture", LOBE_FORMAT_RGBA32_FLOAT, SIZE, SIZE);
    count_indirectly(fixture, image, 0);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'count'", "'picture'", "indirect");
    fixture->recorder.errors = 0;
    lobe_graph_begin(fixture->graph);
    count_indirectly(fixture, graph_fixture_buffer(fixture, "arguments", 40), 0);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'count'", "'arguments'");
    fixture->recorder.errors = 0;
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_dispatch_has_the_groups_in_the_buffer),
        TEST(no_groups_do_nothing),
        TEST(arguments_may_come_from_the_host),
        TEST(draws_have_the_counts_in_the_buffer),
        TEST(no_instances_draw_nothing),
        TEST(a_retained_result_depends_on_the_counts),
        TEST(wrong_places_are_errors),
    };
    return cmocka_run_group_tests_name("graph_indirect", tests, NULL, NULL);
}
