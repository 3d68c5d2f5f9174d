#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/ordered_dither.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(ordered_dither(uvec2(a.xy), uint(a.z)), 0.0, 0.0, 0.0);
}
