#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/light.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(distance_attenuation(a.w, b.w), cone_attenuation(a.xyz, b.xyz, c.x, c.y), 0.0, 0.0);
}
