#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/finite.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(is_finite(a.x), is_finite(a.xyz), finite_or_zero(a).xw);
}
