#ifndef RELIEF_TEXEL_GLSL
#define RELIEF_TEXEL_GLSL

// What a texel of a height map says, as a height of the relief.

#include "interface/displacement/relief.h"
#include "lib/number/finite.glsl"

// In widths of a texel. What is no number is 0.
float height_of_texel(float texel, float scale, float least, float largest) {
    float height = isnan(texel) ? 0.0 : scale * clamp(texel, least, largest);
    return is_finite(height) ? clamp(height, -HEIGHT_MAXIMUM, HEIGHT_MAXIMUM) : 0.0;
}

#endif
