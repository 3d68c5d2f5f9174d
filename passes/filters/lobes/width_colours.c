#include "passes/filters/lobes/width_colours.h"

#include <lobe/colour.h>
#include <math.h>

#include "passes/filters/lobes/base_widths.h"
#include "shaders/interface/mirrored.h"

/// Colours differ if one width's is in some channel at least this part brighter or darker than the
/// footprint's, root mean square over patches. Where it is 0.11 or 0.14, errors of pictures fall by
/// less than a hundredth, where it is 0.5 by up to a third, at 1 to a half and less.
static const double least_difference = 0.2;

/// F0 with the material's factors, blended with white (shaders/maps/mirrored_luminance.glsl).
static void mirrored_colour(const device_material *material, const material_colours *colours,
                            float mirrored[3]) {
    for (int c = 0; c < 3; c++) {
        const double albedo = colours->albedo[c] * (double)material->material->base_colour[c];
        const double specular = passes_reflectance_of(albedo, colours->metallic);
        mirrored[c] = (float)((1 - LEAST_MIRRORED) * specular + LEAST_MIRRORED);
    }
}

/// Means over a patch, by what texels mirror, of F0 over its luminance, and of that times u.
typedef struct colour_means {
    double colour[3], product[3];
} colour_means;

/// Weights the patch's lobes by what they mirror with the material's factors.
static colour_means take_means(const device_material *material, material_patch *patch) {
    double sum = 0;
    colour_means means = {0};
    for (size_t i = 0; i < patch->count; i++) {
        float mirrored[3];
        mirrored_colour(material, &patch->colours[i], mirrored);
        patch->lobes[i].weight = (double)lobe_luminance(mirrored);
        sum += patch->lobes[i].weight;
        for (int c = 0; c < 3; c++) {
            means.colour[c] += (double)mirrored[c];
            means.product[c] += (double)mirrored[c] * passes_lobe_width(&patch->lobes[i]);
        }
    }
    for (size_t i = 0; i < patch->count; i++)
        patch->lobes[i].weight /= sum;
    for (int c = 0; c < 3; c++) {
        means.colour[c] /= sum;
        means.product[c] /= sum;
    }
    return means;
}

/// How much one width's colour differs from that of both [0, 1], in the channel where most. It
/// hardly shows if both are about as wide.
static double difference_of(const device_material *material, material_patch *patch) {
    const colour_means means = take_means(material, patch);
    const base_widths widths = passes_base_widths(patch, 2);
    double largest = 0;
    for (int c = 0; c < 3 && widths.count > 1; c++) {
        const double moved =
            fabs(means.product[c] / means.colour[c] - widths.mean) / widths.distance;
        largest = fmax(largest, moved / fmin(widths.parts[0], widths.parts[1]));
    }
    return fmin(largest, 1) * (1 - exp(-5 * widths.distance));
}

static bool has_hue(const lobe_material *material) {
    const float *colour = material->base_colour;
    return colour[0] != colour[1] || colour[1] != colour[2];
}

bool passes_widths_have_colours(const device_scene *scene, const device_material *material) {
    const lobe_mask mask = passes_lobe_mask(scene, material);
    double sum = 0;
    material_patch patch;
    if (!material->maps[MAP_BASE_COLOUR].use && !has_hue(material->material))
        return false;
    for (uint32_t i = 0; i < MATERIAL_PATCHES; i++) {
        if (!passes_material_patch_read(scene, material, &mask, i, &patch) || !patch.has_colours)
            return true;
        const double difference = patch.count > 0 ? difference_of(material, &patch) : 0;
        sum += difference * difference;
    }
    return sum > MATERIAL_PATCHES * least_difference * least_difference;
}
