#ifndef LIB_NORMAL_MAP_GLSL
#define LIB_NORMAL_MAP_GLSL

#include "lib/number/finite.glsl"

// Unit normal of a normal map's texel, (n + 1)/2, with x and y multiplied by `scale`
// (Khronos Group, 2021, glTF 2.0, section 3.9.3). The flat normal (0, 0, 1) if the texel is
// infinite, NaN or of length 0.
vec3 decode_normal(vec3 texel, float scale) {
    vec3 normal = (2.0 * texel - 1.0) * vec3(scale, scale, 1.0);
    if (!is_finite(normal)) {
        return vec3(0.0, 0.0, 1.0);
    }
    // Scaled first, so that squares neither overflow nor vanish.
    float largest = max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    if (largest < 1e-6) { // 8-bit texels come no closer to zero than 1/255
        return vec3(0.0, 0.0, 1.0);
    }
    return normalize(normal / largest);
}

#endif
