#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/normal_distribution.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(normal_distribution(uint(c.x), a.xyz, b.xyz, c.y), 0.0, 0.0, 0.0);
    default:
        return vec4(von_mises_fisher_projected_area(c.y), 0.0, 0.0, 0.0);
    }
}
