#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/map/normal_map.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(decode_normal(a.xyz, b.x, uint(b.y)), 0.0);
}
