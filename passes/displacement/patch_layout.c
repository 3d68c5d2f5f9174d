#include "passes/displacement/patch_layout.h"

#include <math.h>

#include "shaders/interface/displacement/displacement.h"

enum { MOST_PATCHES = 1 << 16, MOST_DEPTH = 8 };

static void coordinates_of(const lobe_scene_vertex *vertex, const lobe_texture_use *use,
                           double uv[2]) {
    const float *set = vertex->texture_coordinates[use->texture_coordinates];
    for (int i = 0; i < 2; i++)
        uv[i] = (double)use->transform[i][0] * set[0] + (double)use->transform[i][1] * set[1] +
                use->transform[i][2];
}

/// Of one triangle.
typedef struct triangle_measure {
    double area;   ///< the object's; 0 if it has none in the map
    double unit;   ///< |S_u|
    double texels; ///< along its longest edge
} triangle_measure;

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double longest_edge(const double a[2], const double b[2], double width, double height) {
    const double first = hypot(a[0] * width, a[1] * height),
                 second = hypot(b[0] * width, b[1] * height),
                 third = hypot((b[0] - a[0]) * width, (b[1] - a[1]) * height);
    return fmax(first, fmax(second, third));
}

static triangle_measure measure(const lobe_mesh *mesh, size_t first, const lobe_texture_use *use,
                                double width, double height) {
    double uv[3][2], a[3], b[3], duv[2][2], along_u[3];
    const lobe_scene_vertex *corners[3];
    for (size_t i = 0; i < 3; i++) {
        corners[i] = &mesh->vertices[mesh->indices[first + i]];
        coordinates_of(corners[i], use, uv[i]);
    }
    for (int i = 0; i < 2; i++) {
        duv[0][i] = uv[1][i] - uv[0][i];
        duv[1][i] = uv[2][i] - uv[0][i];
    }
    const double determinant = duv[0][0] * duv[1][1] - duv[0][1] * duv[1][0];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)corners[1]->position[i] - corners[0]->position[i];
        b[i] = (double)corners[2]->position[i] - corners[0]->position[i];
        along_u[i] = (a[i] * duv[1][1] - b[i] * duv[0][1]) / determinant;
    }
    const double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
    const double unit = length_of(along_u);
    return (triangle_measure){.area = isfinite(unit) ? 0.5 * length_of(normal) : 0,
                              .unit = isfinite(unit) ? unit : 0,
                              .texels = longest_edge(duv[0], duv[1], width, height)};
}

patch_layout passes_patch_layout(const lobe_mesh *mesh, const lobe_texture_use *use, uint32_t width,
                                 uint32_t height) {
    patch_layout layout = {.patches = (uint32_t)(mesh->index_count / 3)};
    const double most = 1 << PATCH_MOST;
    double area = 0, texels = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const triangle_measure triangle = measure(mesh, i, use, width, height);
        layout.unit += triangle.area * triangle.unit;
        area += triangle.area;
        texels = fmax(texels, triangle.texels);
    }
    layout.unit = area > 0 ? layout.unit / area : 0;
    while (texels > most && layout.depth < MOST_DEPTH && 4 * layout.patches <= MOST_PATCHES) {
        ++layout.depth;
        layout.patches *= 4;
        texels /= 2;
    }
    layout.level = texels > most ? (float)log2(texels / most) : 0;
    return layout;
}
