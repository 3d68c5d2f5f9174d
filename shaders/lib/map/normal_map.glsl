#ifndef LIB_NORMAL_MAP_GLSL
#define LIB_NORMAL_MAP_GLSL

#include "interface/specialisation.h"
#include "lib/number/finite.glsl"

// What a texel stores, by NORMALS_...: a normal as it is or as (n + 1)/2, with z or without. Where
// z is lacking, x and y may be too long for a unit vector: z is 0 then.
vec3 stored_normal(vec3 texel, uint encoding) {
    bool is_signed = encoding == NORMALS_SIGNED || encoding == NORMALS_SIGNED_XY;
    vec3 normal = is_signed ? texel : 2.0 * texel - 1.0;
    if (encoding == NORMALS_UNSIGNED_XY || encoding == NORMALS_SIGNED_XY)
        normal.z = sqrt(max(0.0, 1.0 - dot(normal.xy, normal.xy)));
    return normal;
}

// Unit normal of a normal map's texel, with x and y multiplied by `scale` (Khronos Group, 2021,
// glTF 2.0, section 3.9.3). The flat normal (0, 0, 1) if the texel is infinite, NaN or of length 0.
vec3 decode_normal(vec3 texel, float scale, uint encoding) {
    vec3 normal = stored_normal(texel, encoding) * vec3(scale, scale, 1.0);
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
