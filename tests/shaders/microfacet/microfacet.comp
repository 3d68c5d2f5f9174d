#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/number/angle.glsl"
#include "lib/microfacet/microfacet.glsl"

// The whole frame about the normal (0, 0, 1), as a shading pass puts it together.
vec3 frame(vec3 outgoing, vec3 incoming, uint distribution, float parameter, vec3 f0) {
    const vec3 normal = vec3(0.0, 0.0, 1.0);
    vec3 halfway = half_vector(incoming, outgoing);
    return microfacet_specular(
        fresnel_schlick(f0, vec3(1.0), dot(incoming, halfway)),
        normal_distribution(distribution, normal, halfway, parameter),
        masking_shadowing(distribution, incoming.z, outgoing.z, parameter), outgoing.z);
}

// What the microfacets of normal h contribute to a direction's visible area, times 1/<n, omega_o>.
float visible_area(vec3 outgoing, vec3 facet, uint distribution, float parameter) {
    return normal_distribution(distribution, vec3(0.0, 0.0, 1.0), facet, parameter) *
           masking(distribution, outgoing.z, parameter) * max(dot(outgoing, facet), 0.0) /
           outgoing.z;
}

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(microfacet_specular(a.xyz, b.x, b.y, b.z), 0.0);
    case 1:
        return vec4(microfacet_diffuse(a.xyz, b.xyz, c.x), 0.0);
    case 2:
        return vec4(frame(a.xyz, b.xyz, uint(c.x), c.y, vec3(c.z)), 0.0);
    default:
        return vec4(visible_area(a.xyz, b.xyz, uint(c.x), c.y), 0.0, 0.0, 0.0);
    }
}
