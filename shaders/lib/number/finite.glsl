#ifndef LIB_FINITE_GLSL
#define LIB_FINITE_GLSL

// Neither infinite nor NaN. Tests the bits, because a compiler that assumes finite numbers may drop
// isnan() as well as comparisons.
bool is_finite(float x) {
    const uint exponent = 0x7f800000u;
    return (floatBitsToUint(x) & exponent) != exponent;
}

bool is_finite(vec3 v) {
    return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// What is not finite becomes 0.
vec4 finite_or_zero(vec4 v) {
    const uvec4 exponent = uvec4(0x7f800000u);
    return mix(v, vec4(0.0), equal(floatBitsToUint(v) & exponent, exponent));
}

#endif
