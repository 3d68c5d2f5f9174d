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

#endif
