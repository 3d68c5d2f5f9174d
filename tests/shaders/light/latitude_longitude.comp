#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/latitude_longitude.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(latitude_longitude(a.xyz), arctangent_of_quotient(a.x, a.y), 0.0);
}
