#ifndef PASSES_UPLOAD_IMAGE_TEXEL_H
#define PASSES_UPLOAD_IMAGE_TEXEL_H

#include <stdbool.h>

#include <lobe/image.h>

/// Reads a texel as the device would, sRGB apart: missing channels are 0, alpha 1. False for
/// formats that no map of lobes has (half floats, sRGB, depth).
bool passes_image_texel(const lobe_image *image, uint32_t x, uint32_t y, float value[4]);

#endif
