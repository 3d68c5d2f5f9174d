#ifndef SHADOW_SLOPE_GLSL
#define SHADOW_SLOPE_GLSL

// How depth changes across what a light sees, from texel to texel and as a part of the depth, so
// that half floats have room for it.

// Of the triangle that is drawn. Where control flow is uniform.
vec2 shadow_slope() {
    vec2 change = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    return clamp(change / max(gl_FragCoord.z, 1e-30), -65504.0, 65504.0);
}

#endif
