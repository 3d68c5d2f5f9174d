#include "passes/upload/colours/mask_alpha.h"

#include <math.h>

#include "passes/upload/material_maps.h"

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

static bool has_bytes(const lobe_image *image) {
    return image->format == LOBE_FORMAT_RGBA8_UNORM || image->format == LOBE_FORMAT_RGBA8_SRGB ||
           image->format == LOBE_FORMAT_BGRA8_UNORM || image->format == LOBE_FORMAT_BGRA8_SRGB;
}

/// Most maps are of bytes.
static float least_alpha_of_row(const lobe_image *image, uint32_t y) {
    float least = INFINITY, texel[4];
    if (has_bytes(image)) {
        const unsigned char *row =
            (const unsigned char *)image->texels + 4 * (size_t)y * image->width;
        unsigned char least_byte = 255;
        for (size_t x = 0; x < image->width; x++)
            least_byte = row[4 * x + 3] < least_byte ? row[4 * x + 3] : least_byte;
        return (float)least_byte / 255;
    }
    for (uint32_t x = 0; x < image->width; x++)
        least = passes_image_texel(image, x, y, texel) ? fminf(least, texel[3]) : 0;
    return least;
}

/// From 0 down all is cut, and the rest need not be read.
static float find_least_alpha(const lobe_scene_image *source) {
    const lobe_image *image = &source->image;
    float least = INFINITY;
    if (source->on_device)
        return 0;
    if (lobe_format_channels(image->format) < 4)
        return 1;
    for (uint32_t y = 0; y < image->height && least > 0; y++)
        least = fminf(least, least_alpha_of_row(image, y));
    return least;
}

static float least_alpha_of_map(device_scene *scene, const device_material *material) {
    const lobe_texture_use *use = material->maps[MAP_BASE_COLOUR].use;
    if (!use)
        return 1;
    image_alpha *alpha = &scene->alphas[use->image];
    if (!alpha->known)
        *alpha = (image_alpha){true, find_least_alpha(&scene->scene->images[use->image])};
    return alpha->least;
}

static bool is_posed(const device_scene *scene, const device_material *material) {
    const lobe_rig *rig = scene->scene->rig;
    for (size_t i = 0; rig && i < rig->material_count; i++)
        if (rig->materials[i].material == material - scene->materials)
            return true;
    return false;
}

static bool has_given_vertices(const device_scene *scene, const device_material *material) {
    for (uint32_t next = material->first_instance; next > 0;
         next = scene->instances[next - 1].next_of_material)
        if (scene->scene->meshes[scene->instances[next - 1].mesh].on_device)
            return true;
    return false;
}

bool passes_mask_may_cut(device_scene *scene, const device_material *material) {
    const lobe_material *source = material->material;
    if (!source->alpha_mask)
        return false;
    if (is_posed(scene, material) || has_given_vertices(scene, material))
        return true;
    // Where the factor alone is below the cutoff, the map need not be read.
    const float factor = source->base_colour[3] * vertex_alphas(scene, material).least;
    return !(factor >= source->alpha_cutoff &&
             factor * least_alpha_of_map(scene, material) >= source->alpha_cutoff);
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
