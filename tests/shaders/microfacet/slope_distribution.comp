#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/slope_distribution.glsl"
#include "lib/microfacet/tilted_slopes.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    slope_distribution slopes = slope_distribution_of(b.xy, c.xyz);
    switch (FUNCTION) {
    case 0:
        return vec4(distribution_of_slopes(slopes, a.xyz), lobe_of_slopes(slopes, a.xyz),
                    slope_of_normal(a.xyz));
    case 1:
        return vec4(slopes.root, slope_variance_along(slopes, a.xy));
    case 2:
        return vec4(slope_at(slopes, standardised_slope(slopes, a.xy)),
                    standardised_slope(slopes, a.xy));
    case 3:
        return vec4(covariance_of_moments(a.xy, c.xyz), 0.0);
    case 4:
        return vec4(transformed_covariance(tilted_from_flat_slopes(b.xy), c.xyz), 0.0);
    case 5:
        return vec4(flat_covariance_of_tilted(b.xy, a.x), 0.0);
    case 6:
        vec2 tilted = transformed_slope(tilted_from_flat_slopes(b.xy), a.xy);
        return vec4(transformed_slope(flat_from_tilted_slopes(b.xy), tilted), 0.0, 0.0);
    default:
        return vec4(normal_of_slope(a.xy), 0.0);
    }
}
