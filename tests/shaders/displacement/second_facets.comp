#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/displacement/second_facets.glsl"

// A polynomial of second degree.
vec3 known(vec3 d) {
    return vec3(0.3 * d.x - 0.2 * d.y * d.z + 0.1, d.z * d.z - 0.4 * d.y + 0.25 * d.x * d.y,
                0.7 * d.z - 0.5 * d.x * d.x + d.z * d.x);
}

// Function 0: what is left of the polynomial less its fit for facets of the normal b.xyz, at the
// direction a.xyz; `seconds` are those of areas that differ. Function 1: where facets about the
// normal b.xyz send light from a.xyz; w: the area that it meets.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    vec4 groups[2 * FACET_BINS], seconds[FACET_DIRECTIONS], factors[SECOND_FACTORS * FACET_BINS];
    for (uint k = 0u; k < 2u * FACET_BINS; ++k)
        groups[k] = vec4(0.0);
    groups[0] = vec4(plane_from_direction(b.xyz), 0.0, 1.0);
    groups[1] = vec4(1e6, 1e6, 0.0, 1e-12);
    if (FUNCTION == 1u)
        return seconds_of_direction(groups, a.xyz);
    for (uint i = 0u; i < FACET_DIRECTIONS; ++i) {
        vec3 d = second_direction(i);
        float area = 1.2 - d.z;
        seconds[i] = area * vec4(known(d), 1.0);
    }
    vec3 found[SECOND_FACTORS];
    fit_second(seconds, b.xyz, found);
    for (uint i = 0u; i < SECOND_FACTORS; ++i)
        factors[i] = vec4(found[i], 0.0);
    light_moments light = no_moments();
    add_moments(light, 1.0, a.xyz);
    return vec4(directions_from_second(light, factors, 0u) - known(a.xyz), 0.0);
}
