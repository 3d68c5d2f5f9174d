#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/base_lobe.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    uint distribution = uint(a.x);
    return vec4(base_lobe_parameter(distribution, a.y), microfacet_parameter(distribution, a.y),
                base_lobe_concentration(distribution, a.z),
                convolved_parameter(distribution, a.z, a.w));
}
