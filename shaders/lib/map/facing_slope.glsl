#ifndef LIB_FACING_SLOPE_GLSL
#define LIB_FACING_SLOPE_GLSL

// What is seen of a displaced surface faces the viewer, as the triangle does that is drawn. A map's
// slope there may not: it is that of the relief between vertices, or of a normal map that does not
// belong to the heights exactly. It moves to the triangle's slope, `drawn`, until it appears at
// least this much as large as the triangle.

#include "lib/microfacet/slope_masking.glsl"

const float LEAST_SHOWN = 0.1;

vec2 facing_slope(vec2 slope, vec2 drawn, vec3 outgoing) {
    float height = height_above_slope(slope, outgoing);
    float shown = max(height_above_slope(drawn, outgoing), 0.0);
    float needed = (LEAST_SHOWN * shown - height) / max(shown - height, 1e-6);
    return mix(slope, drawn, clamp(needed, 0.0, 1.0));
}

// Keeps its length.
vec3 facing_normal(vec3 normal, vec2 drawn, vec3 outgoing) {
    vec2 slope = slope_of_normal(normal);
    vec2 facing = facing_slope(slope, drawn, outgoing);
    return facing == slope ? normal : length(normal) * normal_of_slope(facing);
}

#endif
