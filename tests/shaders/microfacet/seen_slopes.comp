#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/seen_slopes.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    slope_distribution slopes = slope_distribution_of(b.xy, c.xyz);
    vec3 outgoing = a.xyz, incoming = vec3(a.w, b.zw);
    vec2 slope = slope_at(slopes, vec2(c.w, 0.7));
    switch (FUNCTION) {
    case 0:
        return vec4(masking_of_slopes(slopes, outgoing) *
                        shadowing_of_seen_slopes(slopes, incoming, outgoing),
                    masking_shadowing_of_slopes(slopes, incoming, outgoing), 0.0, 0.0);
    case 1:
        return vec4(mean_height(a.x, a.y), part_below(a.x), 0.0, 0.0);
    default:
        return vec4(slope, slope_that_is_seen(slope, slopes, a.w, vec3(a.xyz)));
    }
}
