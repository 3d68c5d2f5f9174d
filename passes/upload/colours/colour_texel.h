#ifndef PASSES_UPLOAD_COLOURS_COLOUR_TEXEL_H
#define PASSES_UPLOAD_COLOURS_COLOUR_TEXEL_H

#include "passes/upload/material_maps.h"

/// Texels of colour maps on the host, linear: only these maps have the sRGB curve. `x`, `y`: a
/// texel of the grid, under which that of the image lies. False as for passes_image_texel.

bool passes_colour_texel(const lobe_image *image, const lobe_grid *grid, uint32_t x, uint32_t y,
                         float value[4]);
/// Alpha alone, which is linear in sRGB, too: nothing is decoded.
bool passes_colour_texel_alpha(const lobe_image *image, const lobe_grid *grid, uint32_t x,
                               uint32_t y, float *alpha);

#endif
