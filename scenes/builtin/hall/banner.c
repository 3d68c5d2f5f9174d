#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/noise.h"
#include "scenes/mesh/circle.h"
#include "scenes/mesh/grid_mesh.h"

// The folds deepen downwards; the lower end is swallow-tailed.
static void place_banner(const void *unused, double u, double v, lobe_scene_vertex *vertex) {
    (void)unused;
    static const double width = 1.2, length = 2.7; // metres
    double wave[2], drift = 0.25 * scenes_noise_gradient(u * 2 + 4, v * 2 + 4, 16, 41, NULL);
    scenes_circle_point(u * 3.5 + drift, wave);
    double aside = u < 0.5 ? u : 1 - u, fall = v * (length - 0.8 * aside);
    double depth = 0.02 + 0.06 * v;
    vertex->position[0] = (float)((u - 0.5) * width * (1 - 0.06 * v));
    vertex->position[1] = (float)-fall;
    vertex->position[2] =
        (float)(depth * wave[1] +
                0.1 * v * scenes_noise_gradient(u * 3 + 4, v * 3 + 4, 16, 42, NULL));
    vertex->texture_coordinates[0][0] = (float)(u * width / HALL_CLOTH_TILE);
    vertex->texture_coordinates[0][1] = (float)(fall / HALL_CLOTH_TILE);
}

lobe_result scenes_hall_make_banner(const lobe_host *host, lobe_mesh *mesh) {
    static const grid_mesh grid = {
        .name = "banner", .rows = 36, .columns = 30, .place = place_banner};
    return scenes_grid_mesh_make(&grid, host, mesh);
}
