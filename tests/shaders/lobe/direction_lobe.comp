#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/direction_lobe.glsl"

// a: axis, unit. b, c: displacements, perpendicular to it; b.w: which of the results' vectors; with
// reflection a.w and c.w turn the outgoing direction.
vec3 outgoing_of(vec4 a, vec4 c) {
    return normalize(vec3(sin(a.w) * cos(c.w), sin(a.w) * sin(c.w), cos(a.w)));
}

vec4 member(direction_lobe lobe, float which) {
    return vec4(which < 0.5 ? lobe.axis : which < 1.5 ? lobe.first : lobe.second, 0.0);
}

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    direction_lobe lobe = direction_lobe(a.xyz, b.xyz, c.xyz);
    switch (FUNCTION) {
    case 0:
        return member(reflected_lobe(lobe, outgoing_of(a, c)), b.w);
    case 1:
        return member(principal_lobe(lobe), b.w);
    case 2:
        return member(lobe_above(lobe, vec3(0.0, 0.0, 1.0)), b.w);
    case 3:
        return vec4(normal_below(a.x), mean_above_zero(a.x, a.y), 0.0, 0.0);
    default:
        return vec4(lobe_variance(lobe), lobe_share_above(lobe, vec3(0.0, 0.0, 1.0)), 0.0, 0.0);
    }
}
