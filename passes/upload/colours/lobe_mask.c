#include "passes/upload/colours/lobe_mask.h"

#include "passes/upload/colours/colour_texel.h"
#include "passes/upload/colours/mask_alpha.h"

lobe_mask passes_lobe_mask(const device_scene *scene, const device_material *material) {
    lobe_mask mask = {.grid = passes_lobe_grid(material)};
    if (!passes_lobes_are_masked(material))
        return mask;
    const lobe_image *image = material->maps[MAP_BASE_COLOUR].texels;
    float alpha;
    if (image && passes_colour_texel_alpha(image, &mask.grid, 0, 0, &alpha))
        mask.image = image;
    mask.alpha = passes_mask_alpha(scene, material);
    mask.cutoff = material->material->alpha_cutoff;
    return mask;
}

bool passes_lobe_mask_cuts(const lobe_mask *mask, uint32_t x, uint32_t y) {
    float alpha;
    return mask->image && passes_colour_texel_alpha(mask->image, &mask->grid, x, y, &alpha) &&
           alpha * mask->alpha < mask->cutoff;
}

uint64_t passes_lobe_mask_count_kept(const lobe_mask *mask) {
    uint64_t count = 0;
    for (uint32_t y = 0; y < mask->grid.height; y++)
        for (uint32_t x = 0; x < mask->grid.width; x++)
            count += passes_lobe_mask_cuts(mask, x, y) ? 0 : 1;
    return count;
}
