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

void passes_restoring(lobe_graph *graph, const stored_content *stored, uint32_t image,
                      reduced_map *target) {
    const lobe_resource rows = lobe_graph_import_texture(graph, stored->rows[image]);
    uint32_t first = 0; // texel of the level
    uint32_t width = target->width, height = target->height;
    for (uint32_t level = 0; level < target->levels; level++) {
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "map_restoring");
        lobe_pass_read(pass, &(lobe_binding){.name = "stored_map", .resource = rows});
        passes_reduced_map_write(target, pass, "target_map", level);
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "maps/restoring.comp",
                                                  .threads = {width, height, target->layers},
                                                  .constants = &first,
                                                  .constants_size = sizeof first});
        first += width * height * target->layers;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
}
