#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include "tests/engine/graph/graph_support.h"

#define SIZE 16

typedef struct triangle_constants {
    float colour[4];
    float depth;
} triangle_constants;

/// Covers the lower left half of the picture; y points down. Counter-clockwise as seen.
static const float half_picture[] = {-1, -1, -1, 1, 1, 1};
/// Covers the whole picture.
static const float whole_picture[] = {-1, -1, -1, 3, 3, -1};

static void draw(graph_fixture *fixture, lobe_pass *pass, const char *fragment_shader,
                 const float vertices[6], const triangle_constants *constants, lobe_draw draw) {
    const lobe_binding binding = {
        .name = "vertex_block",
        .resource = lobe_graph_upload(fixture->graph, "vertices", vertices, 6 * sizeof *vertices)};
    draw.vertex_shader = "graph_triangle.vert";
    draw.fragment_shader = fragment_shader;
    draw.index_count = 3;
    draw.constants = constants;
    draw.constants_size = sizeof *constants;
    draw.bindings = &binding;
    draw.binding_count = 1;
    lobe_pass_draw(pass, &draw);
}

static const float *texel(graph_fixture *fixture, lobe_resource image, uint32_t channels,
                          uint32_t x, uint32_t y) {
    const float *texels = lobe_graph_data(fixture->graph, image, NULL);
    assert_non_null(texels);
    return texels + channels * (y * SIZE + x);
}

static lobe_resource picture(graph_fixture *fixture, const char *name, uint32_t samples) {
    return lobe_graph_image(fixture->graph,
                            &(lobe_image_description){.name = name,
                                                      .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                      .width = SIZE,
                                                      .height = SIZE,
                                                      .samples = samples});
}

static void a_triangle_covers_its_half(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    colour =
        lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour, .clear = {0, 0, 1, 1}});
    draw(fixture, pass, "graph_triangle.frag", half_picture,
         &(triangle_constants){{1, 0.5f, 0, 1}, 0}, (lobe_draw){0});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_memory_equal(texel(fixture, colour, 4, 2, 12), ((float[]){1, 0.5f, 0, 1}), 16);
    assert_memory_equal(texel(fixture, colour, 4, 12, 2), ((float[]){0, 0, 1, 1}), 16);
}

/// Whether the triangle that covers half the picture, counter-clockwise, is drawn.
static bool survives(graph_fixture *fixture, lobe_cull cull, bool mirrored) {
    float vertices[6];
    memcpy(vertices, half_picture, sizeof vertices);
    if (mirrored)
        for (int i = 0; i < 3; i++)
            vertices[2 * i] = -vertices[2 * i];
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
    draw(fixture, pass, "graph_triangle.frag", vertices, &(triangle_constants){{1, 1, 1, 1}, 0},
         (lobe_draw){.cull = cull});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    return texel(fixture, colour, 4, mirrored ? 13 : 2, 12)[0] == 1;
}

static void counter_clockwise_is_the_front(void **state) {
    graph_fixture *fixture = *state;
    assert_true(survives(fixture, LOBE_CULL_NONE, false));
    assert_true(survives(fixture, LOBE_CULL_NONE, true));
    assert_true(survives(fixture, LOBE_CULL_BACK, false));
    assert_false(survives(fixture, LOBE_CULL_BACK, true));
    assert_false(survives(fixture, LOBE_CULL_FRONT, false));
    assert_true(survives(fixture, LOBE_CULL_FRONT, true));
}

static void the_greater_depth_wins(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_resource depth = graph_fixture_image(fixture, "depth", LOBE_FORMAT_D32_FLOAT, SIZE, SIZE);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangles");
    colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
    depth = lobe_pass_depth(pass, &(lobe_attachment){.resource = depth, .clear = {0.25f}});
    const lobe_draw tested = {.depth_test = true, .depth_write = true};
    draw(fixture, pass, "graph_triangle.frag", half_picture,
         &(triangle_constants){{1, 0, 0, 1}, 0.75f}, tested);
    draw(fixture, pass, "graph_triangle.frag", whole_picture,
         &(triangle_constants){{0, 1, 0, 1}, 0.5f}, tested);
    draw(fixture, pass, "graph_triangle.frag", whole_picture,
         &(triangle_constants){{0, 0, 1, 1}, 0.125f}, tested);
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, depth, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_memory_equal(texel(fixture, colour, 4, 2, 12), ((float[]){1, 0, 0, 1}), 16);
    assert_memory_equal(texel(fixture, colour, 4, 12, 2), ((float[]){0, 1, 0, 1}), 16);
    assert_true(texel(fixture, depth, 1, 2, 12)[0] == 0.75f);
    assert_true(texel(fixture, depth, 1, 12, 2)[0] == 0.5f);
}

/// First depth only, then colour where the depth is equal.
static void a_depth_pass_comes_first(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_resource depth = graph_fixture_image(fixture, "depth", LOBE_FORMAT_D32_FLOAT, SIZE, SIZE);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "depth");
    depth = lobe_pass_depth(pass, &(lobe_attachment){.resource = depth});
    draw(fixture, pass, NULL, half_picture, &(triangle_constants){{0}, 0.75f},
         (lobe_draw){.depth_test = true, .depth_write = true});
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "colour");
    colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
    depth = lobe_pass_depth(pass, &(lobe_attachment){.resource = depth, .load = LOBE_LOAD_KEEP});
    draw(fixture, pass, "graph_triangle.frag", whole_picture,
         &(triangle_constants){{1, 1, 1, 1}, 0.5f}, (lobe_draw){.depth_test = true});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(texel(fixture, colour, 4, 2, 12)[0] == 0);
    assert_true(texel(fixture, colour, 4, 12, 2)[0] == 1);
}

/// Neither what is nearer nor what is farther.
static void equal_depths_are_drawn_over(void **state) {
    static const float depths[] = {0.75f, 0.5f, 0.25f};
    graph_fixture *fixture = *state;
    for (int i = 0; i < 3; i++) {
        lobe_graph_begin(fixture->graph);
        lobe_resource colour = picture(fixture, "colour", 0);
        lobe_resource depth =
            graph_fixture_image(fixture, "depth", LOBE_FORMAT_D32_FLOAT, SIZE, SIZE);
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "equal");
        colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
        depth = lobe_pass_depth(pass, &(lobe_attachment){.resource = depth});
        draw(fixture, pass, "graph_triangle.frag", half_picture,
             &(triangle_constants){{1, 0, 0, 1}, 0.5f},
             (lobe_draw){.depth_test = true, .depth_write = true});
        draw(fixture, pass, "graph_triangle.frag", whole_picture,
             &(triangle_constants){{0, 1, 0, 1}, depths[i]},
             (lobe_draw){.depth_test = true, .depth_equal = true});
        lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
        graph_fixture_execute(fixture);
        assert_true(texel(fixture, colour, 4, 2, 12)[1] == (depths[i] == 0.5f));
        assert_true(texel(fixture, colour, 4, 12, 2)[1] == 0);
    }
}

static void samples_are_resolved_to_their_mean(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource samples = picture(fixture, "samples", 4);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = samples});
    colour = lobe_pass_resolve(pass, 0, colour);
    draw(fixture, pass, "graph_triangle.frag", half_picture, &(triangle_constants){{1, 1, 1, 1}, 0},
         (lobe_draw){0});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(texel(fixture, colour, 4, 2, 12)[0] == 1);
    assert_true(texel(fixture, colour, 4, 12, 2)[0] == 0);
    // The diagonal cuts through its pixels.
    float cut = 4 * texel(fixture, colour, 4, 5, 5)[0];
    assert_true(cut > 0 && cut < 4 && cut == floorf(cut));
}

static void samples_can_be_read_by_a_shader(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource samples = picture(fixture, "samples", 4);
    lobe_resource mean = picture(fixture, "mean", 0);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    samples = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = samples});
    draw(fixture, pass, "graph_triangle.frag", half_picture, &(triangle_constants){{1, 1, 1, 1}, 0},
         (lobe_draw){0});
    pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "mean");
    lobe_pass_read(pass, &(lobe_binding){.name = "samples", .resource = samples});
    mean = lobe_pass_write(pass, &(lobe_binding){.name = "mean", .resource = mean});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "graph_mean_of_samples.comp", .threads = {SIZE, SIZE}});
    lobe_graph_read_back(fixture->graph, mean, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(texel(fixture, mean, 4, 2, 12)[0] == 1);
    float cut = 4 * texel(fixture, mean, 4, 5, 5)[0];
    assert_true(cut > 0 && cut < 4);
}

static void a_second_output_goes_to_the_second_attachment(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_resource position =
        graph_fixture_image(fixture, "position", LOBE_FORMAT_RG32_FLOAT, SIZE, SIZE);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
    position = lobe_pass_colour(pass, 2, &(lobe_attachment){.resource = position});
    draw(fixture, pass, "graph_triangle_position.frag", whole_picture,
         &(triangle_constants){{1, 1, 1, 1}, 0}, (lobe_draw){0});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    lobe_graph_read_back(fixture->graph, position, (lobe_range){0});
    graph_fixture_execute(fixture);
    // y points down: the first row is the top.
    assert_memory_equal(texel(fixture, position, 2, 3, 7), ((float[]){3.5f, 7.5f}), 8);
}

static void blending_adds_and_covers(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangles");
    colour =
        lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour, .clear = {1, 1, 1, 1}});
    draw(fixture, pass, "graph_triangle.frag", whole_picture,
         &(triangle_constants){{0.5f, 0, 0, 0.5f}, 0}, (lobe_draw){.blend = LOBE_BLEND_ALPHA});
    draw(fixture, pass, "graph_triangle.frag", half_picture,
         &(triangle_constants){{0.25f, 0, 0, 0}, 0}, (lobe_draw){.blend = LOBE_BLEND_ADD});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_memory_equal(texel(fixture, colour, 4, 12, 2), ((float[]){1, 0.5f, 0.5f, 1}), 16);
    assert_memory_equal(texel(fixture, colour, 4, 2, 12), ((float[]){1.25f, 0.5f, 0.5f, 1}), 16);
}

static void indices_choose_vertices(void **state) {
    graph_fixture *fixture = *state;
    // The last three stand for the lower left half.
    const uint32_t indices[] = {0, 0, 0, 0, 2, 1};
    const triangle_constants constants = {{1, 1, 1, 1}, 0};
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    lobe_resource vertices =
        lobe_graph_upload(fixture->graph, "vertices", half_picture, sizeof half_picture);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    lobe_pass_read(pass, &(lobe_binding){.name = "vertex_block", .resource = vertices});
    colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "graph_triangle.vert",
                                      .fragment_shader = "graph_triangle.frag",
                                      .indices = lobe_graph_upload(fixture->graph, "indices",
                                                                   indices, sizeof indices),
                                      .first_index = 3,
                                      .index_count = 3,
                                      .constants = &constants,
                                      .constants_size = sizeof constants});
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_true(texel(fixture, colour, 4, 2, 12)[0] == 1);
    assert_true(texel(fixture, colour, 4, 12, 2)[0] == 0);
}

/// Into level 1 of layer 1 only, then sampled by the next pass.
static void one_level_of_one_layer_is_drawn_to(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource image = lobe_graph_image(
        fixture->graph, &(lobe_image_description){.name = "layers",
                                                  .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                  .width = 2 * SIZE,
                                                  .height = 2 * SIZE,
                                                  .layers = 2,
                                                  .levels = 2});
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "triangle");
    image =
        lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = image, .level = 1, .layer = 1});
    draw(fixture, pass, "graph_triangle.frag", half_picture, &(triangle_constants){{1, 1, 1, 1}, 0},
         (lobe_draw){0});
    lobe_graph_read_back(fixture->graph, image, (lobe_range){1, 1, 1, 1});
    graph_fixture_execute(fixture);
    assert_true(texel(fixture, image, 4, 2, 12)[0] == 1);
    assert_true(texel(fixture, image, 4, 12, 2)[0] == 0);
}

/// Two passes draw to one attachment, a third loads it without drawing.
static void content_is_kept_between_passes(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource colour = picture(fixture, "colour", 0);
    for (int i = 0; i < 3; i++) {
        lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "add");
        colour = lobe_pass_colour(
            pass, 0,
            &(lobe_attachment){.resource = colour, .load = i ? LOBE_LOAD_KEEP : LOBE_LOAD_CLEAR});
        if (i < 2)
            draw(fixture, pass, "graph_triangle.frag", whole_picture,
                 &(triangle_constants){{1, 2, 3, 4}, 0}, (lobe_draw){.blend = LOBE_BLEND_ADD});
    }
    lobe_graph_read_back(fixture->graph, colour, (lobe_range){0});
    graph_fixture_execute(fixture);
    assert_memory_equal(texel(fixture, colour, 4, 9, 9), ((float[]){2, 4, 6, 8}), 16);
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_triangle_covers_its_half),
        TEST(counter_clockwise_is_the_front),
        TEST(the_greater_depth_wins),
        TEST(a_depth_pass_comes_first),
        TEST(equal_depths_are_drawn_over),
        TEST(samples_are_resolved_to_their_mean),
        TEST(samples_can_be_read_by_a_shader),
        TEST(a_second_output_goes_to_the_second_attachment),
        TEST(blending_adds_and_covers),
        TEST(indices_choose_vertices),
        TEST(one_level_of_one_layer_is_drawn_to),
        TEST(content_is_kept_between_passes),
    };
    return cmocka_run_group_tests_name("graph_raster", tests, NULL, NULL);
}
