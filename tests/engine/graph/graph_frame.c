#include "tests/engine/graph/graph_frame.h"

#include <stdio.h>

#define EXTENT 32 ///< texels of level 0
#define LEVELS 6
#define COUNT  64 ///< floats in a buffer

// ---------------------------------------------------------------------------------------------
// Objects of all frames

static const float triangle[] = {-1, -1, -1, 3, 3, -1};

lobe_result graph_frame_open(lobe_device *device, graph_frame *frame) {
    static float texels[EXTENT * EXTENT];
    const lobe_image image = {LOBE_FORMAT_R32_FLOAT, EXTENT, EXTENT, texels};
    const uint32_t indices[] = {0, 1, 2};
    *frame = (graph_frame){.device = device};
    lobe_result result = lobe_graph_create(device, &frame->graph);
    for (int i = 0; result == LOBE_OK && i < GRAPH_FRAME_TEXTURES; i++)
        result = lobe_texture_create(device, &(lobe_texture_parameters){.image = &image},
                                     &frame->textures[i]);
    if (result == LOBE_OK)
        result = lobe_buffer_create(
            device, &(lobe_buffer_parameters){.size = sizeof triangle, .data = triangle},
            &frame->vertices);
    if (result == LOBE_OK)
        result = lobe_buffer_create(
            device, &(lobe_buffer_parameters){.size = sizeof indices, .data = indices},
            &frame->indices);
    return result;
}

void graph_frame_close(graph_frame *frame) {
    lobe_graph_destroy(&frame->graph);
    for (int i = 0; i < GRAPH_FRAME_TEXTURES; i++)
        lobe_texture_destroy(&frame->textures[i]);
    lobe_buffer_destroy(&frame->vertices);
    lobe_buffer_destroy(&frame->indices);
}

// ---------------------------------------------------------------------------------------------
// Compute: 16 passes from buffer to buffer, 12 along MIP chains, 4 sums

/// Every third buffer is retained.
static lobe_resource add_buffers(graph_frame *frame) {
    const struct {
        float offset;
        uint32_t count;
    } constants = {1, COUNT};
    float values[COUNT];
    for (int i = 0; i < COUNT; i++)
        values[i] = frame->time + (float)i;
    lobe_resource last = lobe_graph_upload(frame->graph, "values", values, sizeof values);
    for (int i = 0; i < 16; i++) {
        char name[32];
        snprintf(name, sizeof name, "buffer %d", i);
        lobe_resource target = lobe_graph_buffer(
            frame->graph, &(lobe_buffer_description){
                              .name = name, .size = sizeof values, .retained = i % 3 == 0});
        lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_COMPUTE, name);
        lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = last});
        last = lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = target});
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_add.comp",
                                                  .threads = {COUNT},
                                                  .constants = &constants,
                                                  .constants_size = sizeof constants});
    }
    return last;
}

static lobe_resource halve(graph_frame *frame, lobe_resource chain, uint32_t level) {
    char name[32];
    snprintf(name, sizeof name, "level %u", level);
    lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass, &(lobe_binding){.name = "source",
                                         .resource = chain,
                                         .range = {level - 1, 1, 0, 0},
                                         .sampler = {.wrap_u = LOBE_WRAP_CLAMP}});
    chain = lobe_pass_write(
        pass, &(lobe_binding){.name = "target", .resource = chain, .range = {level, 1, 0, 0}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_halve.comp",
                                              .threads = {EXTENT >> level, EXTENT >> level, 2}});
    return chain;
}

/// Level 0 is filled in every frame.
static lobe_resource build_chain(graph_frame *frame, const char *name, bool retained) {
    lobe_resource chain =
        lobe_graph_image(frame->graph, &(lobe_image_description){.name = name,
                                                                 .format = LOBE_FORMAT_R32_FLOAT,
                                                                 .width = EXTENT,
                                                                 .height = EXTENT,
                                                                 .layers = 2,
                                                                 .levels = LEVELS,
                                                                 .retained = retained});
    lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_TRANSFER, name);
    chain = lobe_pass_fill(pass, chain, (lobe_range){0, 1, 0, 0}, (float[4]){frame->time});
    for (uint32_t level = 1; level < LEVELS; level++)
        chain = halve(frame, chain, level);
    return chain;
}

/// One retained image, to which each texture is added in every frame.
static lobe_resource sum_textures(graph_frame *frame) {
    lobe_resource sum =
        lobe_graph_image(frame->graph, &(lobe_image_description){.name = "sum",
                                                                 .format = LOBE_FORMAT_R32_FLOAT,
                                                                 .width = EXTENT,
                                                                 .height = EXTENT,
                                                                 .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_TRANSFER, "no sum");
    sum = lobe_pass_fill(pass, sum, (lobe_range){0}, (float[4]){frame->time});
    for (int i = 0; i < GRAPH_FRAME_TEXTURES; i++) {
        pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_COMPUTE, "sum");
        lobe_pass_read(pass, &(lobe_binding){.name = "sample_image",
                                             .resource = lobe_graph_import_texture(
                                                 frame->graph, frame->textures[i])});
        sum = lobe_pass_modify(pass, &(lobe_binding){.name = "sum", .resource = sum});
        lobe_pass_dispatch(
            pass, &(lobe_dispatch){.shader = "graph_accumulate.comp", .threads = {EXTENT, EXTENT}});
    }
    return sum;
}

// ---------------------------------------------------------------------------------------------
// Raster: 12 passes of 8 draws, and 5 copies

static void draw_triangles(graph_frame *frame, lobe_pass *pass) {
    const struct {
        float colour[4];
        float depth;
    } constants = {{frame->time}, 0.5f};
    const lobe_binding vertices = {.name = "vertex_block",
                                   .resource =
                                       lobe_graph_import_buffer(frame->graph, frame->vertices)};
    for (int i = 0; i < 8; i++)
        lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "graph_triangle.vert",
                                          .fragment_shader = "graph_triangle.frag",
                                          .indices = i % 2 ? lobe_graph_import_buffer(
                                                                 frame->graph, frame->indices)
                                                           : (lobe_resource){0},
                                          .index_count = 3,
                                          .depth_test = i % 4 > 1,
                                          .constants = &constants,
                                          .constants_size = 20,
                                          .bindings = &vertices,
                                          .binding_count = 1});
}

static lobe_resource declare_target(graph_frame *frame, lobe_format format, uint32_t samples) {
    return lobe_graph_image(frame->graph, &(lobe_image_description){.name = "target",
                                                                    .format = format,
                                                                    .width = EXTENT,
                                                                    .height = EXTENT,
                                                                    .samples = samples});
}

/// Every other pass is multisampled and resolved.
static lobe_resource draw_all(graph_frame *frame) {
    lobe_resource last = {0};
    for (uint32_t i = 0; i < 12; i++) {
        char name[32];
        snprintf(name, sizeof name, "triangles %u", i);
        const uint32_t samples = i % 2 ? 4 : 1;
        lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_RASTER, name);
        lobe_resource colour = declare_target(frame, LOBE_FORMAT_RGBA32_FLOAT, samples);
        colour = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = colour});
        lobe_resource depth = declare_target(frame, LOBE_FORMAT_D32_FLOAT, samples);
        lobe_pass_depth(pass, &(lobe_attachment){.resource = depth});
        if (samples > 1)
            colour = lobe_pass_resolve(pass, 0, declare_target(frame, LOBE_FORMAT_RGBA32_FLOAT, 1));
        draw_triangles(frame, pass);
        lobe_graph_output(frame->graph, colour);
        last = colour;
    }
    for (int i = 0; i < 5; i++) {
        lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_TRANSFER, "copy");
        lobe_resource copy = declare_target(frame, LOBE_FORMAT_RGBA32_FLOAT, 1);
        last = lobe_pass_copy(pass, last, (lobe_range){0}, copy, (lobe_range){0});
    }
    return last;
}

static void draw_into_target(graph_frame *frame) {
    lobe_resource target = lobe_graph_import_image(frame->graph, frame->target);
    lobe_pass *pass = lobe_graph_add_pass(frame->graph, LOBE_PASS_RASTER, "target");
    target = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = target});
    draw_triangles(frame, pass);
    lobe_graph_output(frame->graph, target);
}

// ---------------------------------------------------------------------------------------------

void graph_frame_declare(graph_frame *frame) {
    lobe_graph *graph = frame->graph;
    lobe_graph_begin(graph);
    frame->mean = add_buffers(frame);
    lobe_graph_read_back(graph, frame->mean, (lobe_range){0});
    lobe_graph_output(graph, build_chain(frame, "chain", false));
    lobe_graph_output(graph, build_chain(frame, "kept chain", true));
    lobe_graph_output(graph, sum_textures(frame));
    lobe_graph_read_back(graph, draw_all(frame), (lobe_range){0});
    if (frame->target)
        draw_into_target(frame);
}
