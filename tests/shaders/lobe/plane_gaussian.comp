#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/plane_gaussian.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    plane_gaussian bell = make_plane_gaussian(a.xyz, a.w);
    switch (FUNCTION) {
    case 0:
        return vec4(bell.peak, bell.exponent);
    case 1:
        return vec4(evaluate_plane_gaussian(bell, b.xy));
    default:
        return vec4(covariance_of(b.xy, c.xyz), 0.0);
    }
}
