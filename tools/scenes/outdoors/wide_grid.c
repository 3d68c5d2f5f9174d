#include "tools/scenes/outdoors/wide_grid.h"

#include <math.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

static float line_of(const wide_grid *grid, uint32_t index) {
    return (float)(grid->width * sinh(grid->growth * (2.0 * index / grid->cells - 1)));
}

lobe_result wide_grid_add(lobe_scene *scene, const wide_grid *grid, const lobe_host *host) {
    const uint32_t lines = grid->cells + 1;
    lobe_mesh mesh;
    const lobe_result result = scenes_mesh_allocate(&mesh, grid->name, lines * lines,
                                                    (size_t)grid->cells * grid->cells * 6, host);
    if (result != LOBE_OK)
        return result;
    mesh.has_texture_coordinates[0] = true;
    for (uint32_t i = 0; i < lines * lines; i++) {
        const float x = line_of(grid, i % lines), z = line_of(grid, i / lines);
        mesh.vertices[i] = (lobe_scene_vertex){
            .position = {x, (float)grid->height, z},
            .normal = {0, 1, 0},
            .tangent = {1, 0, 0, 1},
            .texture_coordinates = {{(float)(x / grid->tile + grid->middle_of_tile),
                                     (float)(z / grid->tile + grid->middle_of_tile)}},
            .colour = {1, 1, 1, 1}};
    }
    scenes_shape_grid_indices(grid->cells, grid->cells, mesh.indices);
    return scenes_place_mesh(scene, &mesh, 0, host);
}
