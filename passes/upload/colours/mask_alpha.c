#include "passes/upload/colours/mask_alpha.h"

#include <math.h>

/// The factor by which the vertices of all meshes with the material multiply its alpha.
static float vertex_alpha(const device_scene *scene, const device_material *material) {
    const lobe_material *source = material->material;
    float least = INFINITY, largest = -INFINITY;
    uint32_t next = material->first_instance;
    while (next > 0) {
        const device_instance *instance = &scene->instances[next - 1];
        next = instance->next_of_material;
        least = fminf(least, scene->measures[instance->mesh].least_alpha);
        largest = fmaxf(largest, scene->measures[instance->mesh].largest_alpha);
    }
    // Below this, nothing is kept even where the map's alpha is 1.
    float needed = source->alpha_cutoff / source->base_colour[3];
    if (needed > least && needed < largest)
        least = needed;
    return least == largest ? least : 0.5f * (least + largest);
}

float passes_mask_alpha(const device_scene *scene, const device_material *material) {
    return material->material->base_colour[3] * vertex_alpha(scene, material);
}
