#include "passes/maps/kept/restoring.h"

lobe_result passes_stored_content_create(lobe_graph *graph, const kept_layout *layout,
                                         const kept_content *content, stored_content *stored) {
    *stored = (stored_content){0};
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < layout->image_count; i++)
        result = lobe_graph_create_texture(
            graph, &(lobe_texture_parameters){"cached map", &content->rows[i]}, &stored->rows[i]);
    for (uint32_t i = 0; result == LOBE_OK && i < layout->buffer_count; i++)
        result =
            lobe_graph_create_buffer(graph,
                                     &(lobe_buffer_parameters){.name = "numbers of a cached map",
                                                               .size = layout->buffer_bytes[i],
                                                               .data = content->buffers[i]},
                                     &stored->buffers[i]);
    return result;
}

void passes_stored_content_free(stored_content *stored) {
    for (uint32_t i = 0; i < KEPT_MAXIMUM_IMAGES; i++)
        lobe_texture_destroy(&stored->rows[i]);
    for (uint32_t i = 0; i < KEPT_MAXIMUM_BUFFERS; i++)
        lobe_buffer_destroy(&stored->buffers[i]);
    *stored = (stored_content){0};
}

typedef struct restoring_constants {
    uint32_t width, height; ///< of the tile's level
    uint32_t column, row;
    uint32_t first; ///< texel of the level
} restoring_constants;

void passes_restoring(lobe_graph *graph, const stored_content *stored, uint32_t image,
                      const map_tile *tile, reduced_map *target) {
    const lobe_resource rows = lobe_graph_import_texture(graph, stored->rows[image]);
    restoring_constants constants = {tile->extent.width, tile->extent.height, tile->column,
                                     tile->row, 0};
    for (uint32_t level = 0; level < tile->extent.levels; level++) {
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, PASSES_RESTORING);
        lobe_pass_read(pass, &(lobe_binding){.name = "stored_map", .resource = rows});
        passes_reduced_map_write(target, pass, "target_map", level);
        lobe_pass_dispatch(
            pass, &(lobe_dispatch){.shader = "maps/restoring.comp",
                                   .threads = {constants.width, constants.height, target->layers},
                                   .constants = &constants,
                                   .constants_size = sizeof constants});
        constants.first += constants.width * constants.height * target->layers;
        constants.width = passes_half_extent(constants.width);
        constants.height = passes_half_extent(constants.height);
    }
}

lobe_resource passes_cutting(lobe_graph *graph, const reduced_map *source, const map_tile *tile) {
    const kept_image *extent = &tile->extent;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "map_cutting");
    lobe_pass_read(
        pass, &(lobe_binding){"source_map", source->resource, .range = {0, 1, 0, source->layers}});
    const lobe_resource image = lobe_pass_write(
        pass, &(lobe_binding){.name = "tile_map",
                              .resource = lobe_graph_image(
                                  graph, &(lobe_image_description){.name = "tile of a map",
                                                                   .format = extent->format,
                                                                   .width = extent->width,
                                                                   .height = extent->height,
                                                                   .layers = extent->layers})});
    const uint32_t origin[] = {tile->column, tile->row};
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "maps/cutting.comp",
                                        .threads = {extent->width, extent->height, extent->layers},
                                        .constants = origin,
                                        .constants_size = sizeof origin});
    return image;
}
