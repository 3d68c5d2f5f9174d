#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/power_of_cosine.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(power_of_cosine(a.xyz, b.xyz, c.x), 0.0, 0.0, 0.0);
}
