#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/masking.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    uint distribution = uint(a.x);
    return vec4(smith_lambda(distribution, a.z, a.y), masking(distribution, a.z, a.y),
                masking_shadowing(distribution, a.z, a.w, a.y), tangent_squared(a.z));
}
