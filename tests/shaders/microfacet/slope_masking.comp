#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/angle.glsl"
#include "lib/microfacet/slope_masking.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    slope_distribution slopes = slope_distribution_of(b.xy, c.xyz);
    vec3 outgoing = a.xyz, incoming = vec3(a.w, b.zw);
    switch (FUNCTION) {
    case 0:
        return vec4(lambda_of_slopes(slopes, outgoing), height_above_slope(b.xy, outgoing),
                    masking_shadowing_of_slopes(slopes, incoming, outgoing), 0.0);
    default:
        // Dupuy et al., 2013, Eq. 17 without shadowing and Fresnel.
        return vec4(distribution_of_slopes(slopes, half_vector(incoming, outgoing)) /
                        (4.0 * height_above_slope(b.xy, outgoing) *
                         (1.0 + lambda_of_slopes(slopes, outgoing))),
                    0.0, 0.0, 0.0);
    }
}
