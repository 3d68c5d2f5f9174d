#ifndef LIB_POWER_OF_COSINE_GLSL
#define LIB_POWER_OF_COSINE_GLSL

#include "lib/number/angle.glsl"
#include "lib/number/exponential.glsl"

// <a,b>^exponent for unit vectors, 0 below the horizon; exponent >= 0. For large exponents only
// the neighbourhood of 1 counts, and there log <a,b> comes from |a - b|^2: see
// lib/number/angle.glsl.
float power_of_cosine(vec3 a, vec3 b, float exponent) {
    float cosine = dot(a, b);
    // 1e-30 avoids the logarithm of zero, even where its product is unused.
    float logarithm = cosine > 0.5 ? log1p(-0.5 * difference_squared(a, b))
                                   : log(max(cosine, 1e-30));
    return cosine > 0.0 ? exp(exponent * logarithm) : 0.0;
}

#endif
