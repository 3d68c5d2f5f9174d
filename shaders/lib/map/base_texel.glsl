#ifndef LIB_BASE_TEXEL_GLSL
#define LIB_BASE_TEXEL_GLSL

#include "lib/number/finite.glsl"

// A material's map at a point. A host's shaders may have written anything to it: what is not finite
// counts as 0.
vec4 base_texel(sampler2D map, vec2 point) {
    return finite_or_zero(textureLod(map, point, 0.0));
}

#endif
