#include "passes/maps/colours/lobe_mask.h"

#include <math.h>

#include "passes/context/sample_pattern.h"
#include "passes/upload/colours/colour_texel.h"
#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/material_lobes.h"

lobe_mask passes_lobe_mask(const device_scene *scene, const device_material *material) {
    lobe_mask mask = {.grid = passes_lobe_grid(material)};
    if (!passes_lobes_are_masked(material))
        return mask;
    const device_map *map = &material->maps[MAP_BASE_COLOUR];
    const lobe_image *image = map->texels;
    float alpha;
    if (image && passes_colour_texel_alpha(image, &mask.grid, 0, 0, &alpha)) {
        mask.image = image;
        mask.use = map->use;
        mask.texels = (lobe_grid){.width = image->width, .height = image->height};
        mask.cuts_texels = passes_mask_cuts_texels(material);
    }
    mask.alpha = passes_mask_alpha(scene, material);
    mask.cutoff = material->material->alpha_cutoff;
    return mask;
}

void passes_lobe_mask_point(const lobe_mask *mask, uint32_t x, uint32_t y, double point[2]) {
    const uint64_t index = 2 * ((uint64_t)y * mask->grid.width + x);
    point[0] = x + (mask->cuts_texels ? passes_hashed_number(index) : 0.5);
    point[1] = y + (mask->cuts_texels ? passes_hashed_number(index + 1) : 0.5);
}

/// Of a texel of the image, which may lie outside it.
static double alpha_of_texel(const lobe_mask *mask, int64_t x, int64_t y) {
    float alpha = 0;
    passes_colour_texel_alpha(
        mask->image, &mask->texels, passes_wrapped_texel(x, mask->texels.width, mask->use->wrap_u),
        passes_wrapped_texel(y, mask->texels.height, mask->use->wrap_v), &alpha);
    return (double)alpha;
}

/// As the image's sampler gives it.
static double alpha_at(const lobe_mask *mask, const double point[2]) {
    const double x = point[0] * mask->texels.width / mask->grid.width;
    const double y = point[1] * mask->texels.height / mask->grid.height;
    if (mask->use->nearest)
        return alpha_of_texel(mask, (int64_t)floor(x), (int64_t)floor(y));
    const double left = floor(x - 0.5), top = floor(y - 0.5);
    const double right_part = x - 0.5 - left, lower_part = y - 0.5 - top;
    double rows[2];
    for (int i = 0; i < 2; i++)
        rows[i] = (1 - right_part) * alpha_of_texel(mask, (int64_t)left, (int64_t)top + i) +
                  right_part * alpha_of_texel(mask, (int64_t)left + 1, (int64_t)top + i);
    return (1 - lower_part) * rows[0] + lower_part * rows[1];
}

bool passes_lobe_mask_cuts(const lobe_mask *mask, const double point[2]) {
    return mask->image && (float)alpha_at(mask, point) * mask->alpha < mask->cutoff;
}

bool passes_lobe_mask_cuts_texel(const lobe_mask *mask, uint32_t x, uint32_t y) {
    double point[2];
    passes_lobe_mask_point(mask, x, y, point);
    return passes_lobe_mask_cuts(mask, point);
}

uint64_t passes_lobe_mask_count_kept(const lobe_mask *mask) {
    uint64_t count = 0;
    for (uint32_t y = 0; y < mask->grid.height; y++)
        for (uint32_t x = 0; x < mask->grid.width; x++)
            count += passes_lobe_mask_cuts_texel(mask, x, y) ? 0 : 1;
    return count;
}
