#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/characteristic_vector.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return characteristic_vector(a.xyz, b.x);
    case 1:
        return vec4(resultant_complement(a.xyz, b.x), concentration_of(a.xyz),
                    concentration_of(a.xyz, b.y), 0.0);
    default:
        return vec4(mean_direction(a.xyz, b.xyz), 0.0);
    }
}
