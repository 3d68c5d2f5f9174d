#include "passes/upload/colours/colour_texel.h"

#include <lobe/colour.h>

static uint32_t place_of(uint32_t place, uint32_t extent, uint32_t grid_extent) {
    return (uint32_t)((uint64_t)place * extent / grid_extent);
}

/// Of an image in sRGB; NULL: it is in another format.
static const unsigned char *srgb_texel(const lobe_image *image, uint32_t x, uint32_t y) {
    const unsigned char *texels = image->texels;
    return texels && image->format == LOBE_FORMAT_RGBA8_SRGB
               ? texels + 4 * ((size_t)y * image->width + x)
               : NULL;
}

bool passes_colour_texel(const lobe_image *image, const lobe_grid *grid, uint32_t x, uint32_t y,
                         float value[4]) {
    x = place_of(x, image->width, grid->width);
    y = place_of(y, image->height, grid->height);
    const unsigned char *texel = srgb_texel(image, x, y);
    if (!texel)
        return passes_image_texel(image, x, y, value);
    for (int i = 0; i < 3; i++)
        value[i] = lobe_srgb_decode((float)texel[i] / 255);
    value[3] = (float)texel[3] / 255;
    return true;
}

bool passes_colour_texel_alpha(const lobe_image *image, const lobe_grid *grid, uint32_t x,
                               uint32_t y, float *alpha) {
    x = place_of(x, image->width, grid->width);
    y = place_of(y, image->height, grid->height);
    const unsigned char *texel = srgb_texel(image, x, y);
    float value[4] = {0};
    const bool read = texel || passes_image_texel(image, x, y, value);
    *alpha = texel ? (float)texel[3] / 255 : value[3];
    return read;
}
