#include "passes/upload/colours/lobe_mask.h"

#include "passes/upload/colours/mask_alpha.h"

/// passes_image_texel reads no sRGB, whose alpha is linear.
static bool read_alpha(const lobe_image *image, uint32_t x, uint32_t y, float *alpha) {
    float texel[4];
    if (image->texels && image->format == LOBE_FORMAT_RGBA8_SRGB) {
        const size_t texels = (size_t)y * image->width + x;
        *alpha = (float)((const unsigned char *)image->texels)[4 * texels + 3] / 255;
        return true;
    }
    if (!passes_image_texel(image, x, y, texel))
        return false;
    *alpha = texel[3];
    return true;
}

lobe_mask passes_lobe_mask(const device_scene *scene, const device_material *material) {
    lobe_mask mask = {.grid = passes_lobe_grid(material)};
    if (!passes_lobes_are_masked(material))
        return mask;
    const lobe_image *image = material->maps[MAP_BASE_COLOUR].texels;
    float alpha;
    if (image && read_alpha(image, 0, 0, &alpha))
        mask.image = image;
    mask.alpha = passes_mask_alpha(scene, material);
    mask.cutoff = material->material->alpha_cutoff;
    return mask;
}

bool passes_lobe_mask_cuts(const lobe_mask *mask, uint32_t x, uint32_t y) {
    float alpha;
    return mask->image &&
           read_alpha(mask->image, (uint32_t)((uint64_t)x * mask->image->width / mask->grid.width),
                      (uint32_t)((uint64_t)y * mask->image->height / mask->grid.height), &alpha) &&
           alpha * mask->alpha < mask->cutoff;
}

uint64_t passes_lobe_mask_count_kept(const lobe_mask *mask) {
    uint64_t count = 0;
    for (uint32_t y = 0; y < mask->grid.height; y++)
        for (uint32_t x = 0; x < mask->grid.width; x++)
            count += passes_lobe_mask_cuts(mask, x, y) ? 0 : 1;
    return count;
}
