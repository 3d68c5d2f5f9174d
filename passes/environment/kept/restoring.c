#include "passes/environment/kept/restoring.h"

#include <lobe/graph.h>

lobe_result passes_stored_cube_create(lobe_device *device, const cube_image *cube,
                                      stored_cube *stored) {
    *stored = (stored_cube){0};
    lobe_result result = LOBE_OK;
    for (uint32_t level = 0; result == LOBE_OK && level < cube->levels; ++level) {
        uint32_t width = cube->width >> level;
        const lobe_image faces = {LOBE_FORMAT_RGBA32_FLOAT, width, 6 * width,
                                  passes_cube_image_face(cube, level, 0)};
        result = lobe_texture_create(
            device, &(lobe_texture_parameters){"environment filtered before", &faces},
            &stored->levels[stored->count++]);
    }
    return result;
}

void passes_stored_cube_free(stored_cube *stored) {
    for (uint32_t level = 0; level < stored->count; ++level)
        lobe_texture_destroy(&stored->levels[level]);
    *stored = (stored_cube){0};
}

void passes_environment_restoring(lobe_graph *graph, const stored_cube *stored, reduced_map *cube) {
    for (uint32_t level = 0; level < cube->levels && level < stored->count; ++level) {
        uint32_t width = cube->width >> level;
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_restoring");
        lobe_pass_read(pass, &(lobe_binding){.name = "faces",
                                             .resource = lobe_graph_import_texture(
                                                 graph, stored->levels[level])});
        cube->resource = lobe_pass_write(
            pass, &(lobe_binding){"target", cube->resource, .range = {level, 1, 0, 6}});
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/kept/restoring.comp",
                                                  .threads = {width, width, 6}});
    }
}
