#include "passes/upload/colours/mask_alpha.h"

#include <math.h>

/// Just below one: what rounding makes of the last threshold must not cut away an alpha of one.
#define LARGEST_THRESHOLD 0.9999f

typedef struct alpha_range {
    float least, largest;
} alpha_range;

/// The factors by which the vertices of all meshes with the material multiply its alpha.
static alpha_range vertex_alphas(const device_scene *scene, const device_material *material) {
    alpha_range range = {INFINITY, -INFINITY};
    uint32_t next = material->first_instance;
    while (next > 0) {
        const device_instance *instance = &scene->instances[next - 1];
        next = instance->next_of_material;
        range.least = fminf(range.least, scene->measures[instance->mesh].least_alpha);
        range.largest = fmaxf(range.largest, scene->measures[instance->mesh].largest_alpha);
    }
    return range;
}

float passes_mask_alpha(const device_scene *scene, const device_material *material) {
    return material->material->base_colour[3] * vertex_alphas(scene, material).largest;
}

mask_range passes_mask_range(const device_scene *scene, const device_material *material) {
    const alpha_range vertices = vertex_alphas(scene, material);
    const float cutoff = material->material->alpha_cutoff,
                factor = material->material->base_colour[3];
    mask_range range = {.least = cutoff / (factor * vertices.largest),
                        .largest = LARGEST_THRESHOLD};
    if (vertices.least > 0)
        range.largest = fminf(range.largest, cutoff / (factor * vertices.least));
    // Also where nothing is kept, or all.
    if (!(range.least > 0 && range.largest > range.least))
        range.largest = range.least;
    return range;
}
