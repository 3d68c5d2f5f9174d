#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/bin_membership.glsl"

// a: place, variance or 1 / width of a hat; b, c: a bin.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(bin_likelihood(moment_bin(b, c, vec4(0.0)), a.xy, a.z));
    case 1:
        return vec4(quarter(0, a.xy, a.z), quarter(1, a.xy, a.z), quarter(2, a.xy, a.z),
                    quarter(3, a.xy, a.z));
    default:
        return vec4(cap(a.xy, a.z), hat(a.x, a.z), hat(-a.x, a.z), 0.0);
    }
}
