#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/facing_area.glsl"

// Of Gaussian normals, a.xyz: covariance of their places, c.xy: mean; b.xyz: a direction. The area
// that faces it, and the mean of the normals by what they show to it.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    vec3 squares = vec3(c.x * c.x, c.y * c.y, c.x * c.y);
    facet_spread facets = facet_spread_of(normal_spread_of(c.xy, a.xyz + squares), 1.0);
    seen_facets seen = seen_facets_of(facets, b.xyz);
    return vec4(facing_area(facets, b.xyz), seen.mean);
}
