#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/facing_normals.glsl"

// Gaussian normals about the pole, a.xyz: covariance of their places; b.xyz: incoming, c.xyz:
// outgoing direction. Gradients: a.xy: place; b.xyz: direction.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    if (FUNCTION == 1)
        return vec4(cosine_gradient(a.xy, b.xyz), 0.0, 0.0);
    normal_spread normals = normal_spread_of(vec2(0.0), a.xyz);
    facing_cosines both = facing_cosines_of(normals, b.xyz, c.xyz);
    float share;
    normal_spread seen = facing_normals(normals, c.xyz, share);
    return vec4(both.share, both.incoming, both.outgoing,
                share * mean_facing_cosine(seen, b.xyz));
}
