#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/microfacet/reflection_lobe.glsl"

vec4 numbers_of(reflection_lobe lobe) {
    return vec4(lobe.angle, lobe.along, lobe.across, lobe.diffuse_share);
}

reflection_lobe lobe_of(vec4 numbers) {
    return reflection_lobe(numbers.x, numbers.y, numbers.z, numbers.w);
}

// The tails of GGX [0, 1]: a.x; the cosine to the viewer: a.y; roughness: a.z. Or two lobes: a, b;
// the share of the second: c.x. Or a lobe: a; the cosine to the viewer, roughness, how far
// completed: b.xyz.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return numbers_of(lobe_of_reflection(a.x, a.y, a.z));
    case 1:
        return numbers_of(lobe_of_grazing_reflection(a.y, a.z));
    case 3:
        return numbers_of(completed_lobe(lobe_of(a), b.x, b.y));
    default:
        return numbers_of(mixed_lobe(lobe_of(a), lobe_of(b), c.x));
    }
}
