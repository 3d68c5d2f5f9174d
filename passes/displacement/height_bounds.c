#include "passes/displacement/height_bounds.h"

#include <stdio.h>

#include "shaders/interface/displacement/displacement.h"

static uint32_t half_of(uint32_t count) {
    return (count + 1) / 2;
}

/// Of squares on all levels.
static uint32_t count_squares(uint32_t columns, uint32_t rows, uint32_t *levels) {
    uint32_t count = columns * rows;
    for (*levels = 1; columns > 1 || rows > 1; ++*levels) {
        columns = half_of(columns);
        rows = half_of(rows);
        count += columns * rows;
    }
    return count;
}

height_bounds passes_height_bounds(lobe_graph *graph, lobe_resource heights, uint32_t width,
                                   uint32_t height, int32_t image) {
    char name[64];
    height_bounds result;
    struct height_bounds_constants constants = {
        .width = width,
        .height = height,
        .columns = (width + HEIGHT_BOUNDS_TEXELS - 1) / HEIGHT_BOUNDS_TEXELS,
        .rows = (height + HEIGHT_BOUNDS_TEXELS - 1) / HEIGHT_BOUNDS_TEXELS,
    };
    const uint32_t count = count_squares(constants.columns, constants.rows, &result.levels);
    snprintf(name, sizeof name, "height bounds of image %d", (int)image);
    result.buffer = lobe_graph_buffer(
        graph, &(lobe_buffer_description){
                   .name = name, .size = (size_t)count * 4 * sizeof(float), .retained = true});
    for (uint32_t level = 0; level < result.levels; level++) {
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "height_bounds");
        const lobe_binding bounds = {.name = "bounds_block", .resource = result.buffer};
        lobe_pass_read(pass, &(lobe_binding){.name = "height_map", .resource = heights});
        result.buffer =
            level == 0 ? lobe_pass_write(pass, &bounds) : lobe_pass_modify(pass, &bounds);
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "displacement/height_bounds.comp",
                                                  .threads = {constants.columns, constants.rows},
                                                  .constants = &constants,
                                                  .constants_size = sizeof constants});
        constants.source = constants.target;
        constants.source_columns = constants.columns;
        constants.source_rows = constants.rows;
        constants.target += constants.columns * constants.rows;
        constants.columns = half_of(constants.columns);
        constants.rows = half_of(constants.rows);
    }
    return result;
}
