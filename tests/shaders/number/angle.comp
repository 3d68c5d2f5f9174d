#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/angle.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(half_vector(a.xyz, b.xyz), 0.0);
    default:
        return vec4(difference_squared(a.xyz, b.xyz), sine_squared_between(a.xyz, b.xyz), 0.0, 0.0);
    }
}
