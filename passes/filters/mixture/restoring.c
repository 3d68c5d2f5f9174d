#include "passes/filters/mixture/restoring.h"

#include "shaders/interface/gaussian_mixture.h"

lobe_result passes_stored_mixture_create(lobe_graph *graph, const mixture_image *image,
                                         stored_mixture *stored) {
    *stored = (stored_mixture){0};
    const lobe_result result = lobe_graph_create_texture(
        graph, &(lobe_texture_parameters){"cached mixture", &image->rows}, &stored->rows);
    return result ? result
                  : lobe_graph_create_buffer(
                        graph,
                        &(lobe_buffer_parameters){.name = "units of a cached mixture",
                                                  .size = sizeof image->bins,
                                                  .data = &image->bins},
                        &stored->bins);
}

void passes_stored_mixture_free(stored_mixture *stored) {
    lobe_texture_destroy(&stored->rows);
    lobe_buffer_destroy(&stored->bins);
    *stored = (stored_mixture){0};
}

void passes_mixture_restoring(lobe_graph *graph, const stored_mixture *stored, moment_map *target) {
    reduced_map *map = &target->map;
    const lobe_resource rows = lobe_graph_import_texture(graph, stored->rows);
    struct mixture_restoring_constants constants = {0};
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 0; level < map->levels; level++) {
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "mixture_restoring");
        lobe_pass_read(pass, &(lobe_binding){.name = "stored_map", .resource = rows});
        passes_reduced_map_write(map, pass, "moment_map", level);
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/mixture/restoring.comp",
                                                  .threads = {width, height, map->layers},
                                                  .constants = &constants,
                                                  .constants_size = sizeof constants});
        constants.first += width * height * map->layers;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
    target->bins = lobe_graph_import_buffer(graph, stored->bins);
}
