#include "passes/environment/cache/restoring.h"

#include <lobe/graph.h>

lobe_result passes_cube_textures_create(lobe_device *device, const cube_image *cube,
                                        cube_textures *textures) {
    *textures = (cube_textures){0};
    lobe_result result = LOBE_OK;
    for (uint32_t level = 0; result == LOBE_OK && level < cube->levels; level++) {
        uint32_t width = cube->width >> level;
        const lobe_image faces = {LOBE_FORMAT_RGBA32_FLOAT, width, 6 * width,
                                  passes_cube_image_face(cube, level, 0)};
        result =
            lobe_texture_create(device, &(lobe_texture_parameters){"cached environment", &faces},
                                &textures->levels[textures->count++]);
    }
    return result;
}

void passes_cube_textures_free(cube_textures *textures) {
    for (uint32_t level = 0; level < textures->count; level++)
        lobe_texture_destroy(&textures->levels[level]);
    *textures = (cube_textures){0};
}

void passes_environment_restoring(lobe_graph *graph, const cube_textures *textures,
                                  reduced_map *cube) {
    for (uint32_t level = 0; level < cube->levels && level < textures->count; level++) {
        uint32_t width = cube->width >> level;
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_restoring");
        lobe_pass_read(pass, &(lobe_binding){.name = "faces",
                                             .resource = lobe_graph_import_texture(
                                                 graph, textures->levels[level])});
        cube->resource = lobe_pass_write(
            pass, &(lobe_binding){"target", cube->resource, .range = {level, 1, 0, 6}});
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/cache/restoring.comp",
                                                  .threads = {width, width, 6}});
    }
}
