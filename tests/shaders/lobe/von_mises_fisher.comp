#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(von_mises_fisher(a.xyz, b.xyz, c.x), von_mises_fisher_peak(c.x), 0.0, 0.0);
    case 1:
        return vec4(mean_resultant_length(a.x), mean_resultant_complement(a.x), 0.0, 0.0);
    case 2:
        return vec4(concentration_from_resultant(a.x, a.y), concentration_from_complement(a.y), 0.0,
                    0.0);
    default: { // there and back
        float complement = mean_resultant_complement(a.x);
        return vec4(concentration_from_complement(complement),
                    concentration_from_resultant(mean_resultant_length(a.x), complement), 0.0, 0.0);
    }
    }
}
