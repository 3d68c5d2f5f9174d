#include "passes/upload/heights/map_width.h"

#include <math.h>

static void coordinates_of(const lobe_scene_vertex *vertex, const lobe_texture_use *use,
                           double uv[2]) {
    const float *set = vertex->texture_coordinates[use->texture_coordinates];
    for (int i = 0; i < 2; i++)
        uv[i] = (double)use->transform[i][0] * set[0] + (double)use->transform[i][1] * set[1] +
                use->transform[i][2];
}

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// Of one triangle.
typedef struct triangle_width {
    double area;  ///< the object's; 0 if it has none in the map
    double width; ///< |S_u|
} triangle_width;

static triangle_width measure(const lobe_scene_vertex *const corners[3],
                              const lobe_texture_use *use) {
    double uv[3][2], a[3], b[3], along_u[3];
    for (int i = 0; i < 3; i++)
        coordinates_of(corners[i], use, uv[i]);
    const double first[2] = {uv[1][0] - uv[0][0], uv[1][1] - uv[0][1]},
                 second[2] = {uv[2][0] - uv[0][0], uv[2][1] - uv[0][1]},
                 determinant = first[0] * second[1] - first[1] * second[0];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)corners[1]->position[i] - corners[0]->position[i];
        b[i] = (double)corners[2]->position[i] - corners[0]->position[i];
        along_u[i] = (a[i] * second[1] - b[i] * first[1]) / determinant;
    }
    const double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
    const double width = length_of(along_u);
    return isfinite(width) ? (triangle_width){0.5 * length_of(normal), width} : (triangle_width){0};
}

double passes_map_width(const lobe_mesh *mesh, const lobe_texture_use *use) {
    double area = 0, sum = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const uint32_t *indices = mesh->indices + i;
        const lobe_scene_vertex *const corners[3] = {
            &mesh->vertices[indices[0]], &mesh->vertices[indices[1]], &mesh->vertices[indices[2]]};
        const triangle_width triangle = measure(corners, use);
        sum += triangle.area * triangle.width;
        area += triangle.area;
    }
    return area > 0 ? sum / area : 0;
}
