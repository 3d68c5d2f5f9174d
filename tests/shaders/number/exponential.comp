#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/exponential.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(expm1(a.x), log1p(a.y), 0.0, 0.0);
}
