#include "passes/renderer/samples/picture_key.h"

#include "shaders/interface/picture/sample_choice.h"

static uint32_t tiles(uint32_t extent) {
    return (extent + KEY_TILE - 1) / KEY_TILE;
}

uint32_t passes_picture_key_tiles(uint32_t width, uint32_t height) {
    return tiles(width) * tiles(height);
}

lobe_resource passes_picture_key(lobe_graph *graph, lobe_resource radiance, uint32_t width,
                                 uint32_t height) {
    const uint32_t columns = tiles(width), rows = tiles(height);
    lobe_resource sums = lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = "key sums",
                                          .size = (size_t)columns * rows * sizeof(struct key_sum)});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "picture_key");
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance", .resource = radiance});
    sums = lobe_pass_write(pass, &(lobe_binding){.name = "sum_block", .resource = sums});
    // Each group of invocations sums a tile.
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "shading/samples/picture_key.comp",
                                        .threads = {columns * KEY_GROUP, rows * KEY_GROUP, 1}});
    return sums;
}
