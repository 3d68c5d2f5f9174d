#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/facet_pair.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    vec2 slope = b.xy;
    switch (FUNCTION) {
    case 0:
        return vec4(facet_pair_shares(slope, a.xyz), facet_pair_masking(slope, a.xyz),
                    facet_pair_exchange(slope));
    case 1:
        return vec4(facet_pair_exchange_of_microfacets(slope, a.xyz, c.x, 12, 0.4),
                    facet_pair_mean_exchange_of_microfacets(slope, c.x), 0.0, 0.0);
    default:
        return vec4(facet_pair_gain(slope, vec3(c.x), vec3(c.y)), 0.0);
    }
}
