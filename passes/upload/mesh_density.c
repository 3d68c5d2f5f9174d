#include "passes/upload/mesh_density.h"

#include <math.h>

static double triangle_area(const lobe_scene_vertex *corners[3]) {
    double a[3], b[3];
    for (int i = 0; i < 3; ++i) {
        a[i] = (double)corners[1]->position[i] - corners[0]->position[i];
        b[i] = (double)corners[2]->position[i] - corners[0]->position[i];
    }
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2],
           z = a[0] * b[1] - a[1] * b[0];
    return 0.5 * sqrt(x * x + y * y + z * z);
}

static double coordinates_area(const lobe_scene_vertex *corners[3], int set) {
    const float *a = corners[0]->texture_coordinates[set];
    const float *b = corners[1]->texture_coordinates[set];
    const float *c = corners[2]->texture_coordinates[set];
    return 0.5 * fabs(((double)b[0] - a[0]) * ((double)c[1] - a[1]) -
                      ((double)b[1] - a[1]) * ((double)c[0] - a[0]));
}

mesh_density passes_mesh_density_measure(const lobe_mesh *mesh) {
    mesh_density density = {{INFINITY, INFINITY}};
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const lobe_scene_vertex *corners[3];
        for (size_t corner = 0; corner < 3; ++corner)
            corners[corner] = &mesh->vertices[mesh->indices[i + corner]];
        double area = triangle_area(corners);
        for (int set = 0; area > 0 && set < 2; ++set)
            density.least[set] =
                fminf(density.least[set], (float)sqrt(coordinates_area(corners, set) / area));
    }
    return density;
}
