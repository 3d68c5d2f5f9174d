#include "passes/displacement/patch_layout.h"

#include <math.h>

#include "passes/upload/heights/map_width.h"
#include "shaders/interface/displacement/displacement.h"

enum { MOST_PATCHES = 1 << 16, MOST_DEPTH = 8 };

static void coordinates_of(const lobe_scene_vertex *vertex, const lobe_texture_use *use,
                           double uv[2]) {
    const float *set = vertex->texture_coordinates[use->texture_coordinates];
    for (int i = 0; i < 2; i++)
        uv[i] = (double)use->transform[i][0] * set[0] + (double)use->transform[i][1] * set[1] +
                use->transform[i][2];
}

/// Texels along the longest edge of a triangle.
static double longest_edge(const lobe_mesh *mesh, size_t first, const lobe_texture_use *use,
                           double width, double height) {
    double uv[3][2], longest = 0;
    for (size_t i = 0; i < 3; i++)
        coordinates_of(&mesh->vertices[mesh->indices[first + i]], use, uv[i]);
    for (int i = 0; i < 3; i++) {
        const double *from = uv[i], *to = uv[(i + 1) % 3];
        longest = fmax(longest, hypot((to[0] - from[0]) * width, (to[1] - from[1]) * height));
    }
    return longest;
}

patch_layout passes_patch_layout(const lobe_mesh *mesh, const lobe_texture_use *use, uint32_t width,
                                 uint32_t height) {
    patch_layout layout = {.unit = passes_map_width(mesh, use),
                           .patches = (uint32_t)(mesh->index_count / 3)};
    const double most = 1 << PATCH_MOST;
    double texels = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3)
        texels = fmax(texels, longest_edge(mesh, i, use, width, height));
    while (texels > most && layout.depth < MOST_DEPTH && 4 * layout.patches <= MOST_PATCHES) {
        ++layout.depth;
        layout.patches *= 4;
        texels /= 2;
    }
    return layout;
}
