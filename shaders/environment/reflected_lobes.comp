#version 460
#extension GL_GOOGLE_include_directive : require

// The table of interface/environment/reflected_lobes.h, by expectation and maximisation: Banerjee,
// Dhillon, Ghosh, Sra, 2005, Clustering on the Unit Hypersphere using von Mises-Fisher
// Distributions, section 3. The directions that light is reflected from take the place of the data,
// with the light as their weights. Every step keeps their mean, and no weight is negative. No
// environment goes into it.
//
// The lobes are those that one trilinear fetch reads, blends of two von Mises-Fisher lobes four
// times as concentrated as one another: were they von Mises-Fisher lobes themselves, then fetches,
// which are up to 13 % off these, would show what the sum does not say.

#include "interface/environment/reflected_lobes.h"
#include "environment/reflected_rings.glsl"
#include "lib/light/environment_level.glsl"

// More change little, and fewer let neighbouring texels differ less.
const int STEPS = 40;
// Of cubes with faces of 4096 texels.
const float GREATEST_LEVEL = 12.0;

// One workgroup per texel, one invocation per ring.
layout(local_size_x = RINGS) in;

layout(set = 0, binding = 0) uniform writeonly image2DArray reflected_lobes;

struct lobe_pair {
    vec3 axis;   // beside: y >= 0
    float level; // as the table has it
    float weight;
    // Of the finer and the coarser level that are blended:
    vec2 concentration;
    vec2 peak; // of the density, times the weight
};

shared lobe_pair lobes[REFLECTED_LOBES];
shared vec4 ring_sums[REFLECTED_LOBES][RINGS];

float concentration_of_level(float level) {
    return prefiltered_concentration(exp2(level), 0.0);
}

// Whose mean resultant length is 1 - `complement`: what is blended linearly.
lobe_pair lobe_pair_of(vec3 axis, float complement, float weight) {
    float concentration = concentration_from_complement(complement);
    float coarser = clamp(floor(2.0 + 0.5 * log2(concentration)), 0.0, GREATEST_LEVEL - 1.0);
    lobe_pair lobe;
    lobe.axis = axis;
    lobe.weight = weight;
    lobe.concentration =
        vec2(concentration_of_level(coarser + 1.0), concentration_of_level(coarser));
    float finest = mean_resultant_complement(lobe.concentration.x);
    float broadest = mean_resultant_complement(lobe.concentration.y);
    float share = clamp((broadest - complement) / (broadest - finest), 0.0, 1.0);
    lobe.level = coarser + share;
    lobe.peak = weight * vec2(share * von_mises_fisher_peak(lobe.concentration.x),
                              (1.0 - share) * von_mises_fisher_peak(lobe.concentration.y));
    return lobe;
}

// Spread over the angles where most light comes from. The first is broad from the beginning: where
// two narrow ones become the broad one differs between neighbouring texels.
lobe_pair first_guess(int i, float outgoing_angle, float alpha) {
    float reach = 3.0 * atan(alpha);
    float highest = min(outgoing_angle + reach, 1.45);
    float lowest = min(outgoing_angle - reach, highest - 0.3 * reach);
    bool in_plane = i < REFLECTED_LOBES_IN_PLANE;
    float place = in_plane ? float(i) / float(REFLECTED_LOBES_IN_PLANE - 1)
                           : (float(i - REFLECTED_LOBES_IN_PLANE) + 0.5) /
                                 float(REFLECTED_LOBES - REFLECTED_LOBES_IN_PLANE);
    float angle = mix(lowest, highest, place);
    return lobe_pair_of(normalize(vec3(-sin(angle), in_plane ? 0.0 : 2.0 * alpha, cos(angle))),
                        mean_resultant_complement((i == 0 ? 0.2 : 1.0) / (alpha * alpha)),
                        in_plane ? 1.0 : 2.0);
}

// How much of a direction and its mirror image each lobe accounts for: x, that of y by y: the
// difference of both over their sum.
void shares_of_lobes(vec3 direction, out vec2 shares[REFLECTED_LOBES]) {
    float exponents[REFLECTED_LOBES], greatest = -1e30; // those of the coarser levels are greater
    for (int i = 0; i < REFLECTED_LOBES; ++i) {
        exponents[i] = -0.5 * difference_squared(direction, lobes[i].axis);
        greatest = max(greatest, lobes[i].concentration.y * exponents[i]);
    }
    float sum = 0.0;
    for (int i = 0; i < REFLECTED_LOBES; ++i) {
        vec2 concentration = lobes[i].concentration;
        vec2 density = lobes[i].peak * exp(concentration * exponents[i] - greatest);
        vec2 other = i < REFLECTED_LOBES_IN_PLANE
                         ? density
                         : density * exp(-2.0 * concentration * lobes[i].axis.y * direction.y);
        float both = density.x + density.y + other.x + other.y;
        shares[i] = vec2(both, (density.x + density.y - other.x - other.y) / max(both, 1e-30));
        sum += both;
    }
    for (int i = 0; i < REFLECTED_LOBES; ++i)
        shares[i].x /= sum;
}

// The lobe of directions whose sum, and whose weight, are given.
lobe_pair lobe_of_sum(vec4 sum) {
    float weight = max(sum.w, 1e-20), size = max(length(sum.xyz), 1e-20);
    return lobe_pair_of(sum.xyz / size, clamp(1.0 - size / weight, 1e-5, 1.0), sum.w);
}

void main() {
    ivec2 texel = ivec2(gl_WorkGroupID.xy);
    vec2 place = vec2(texel) / float(REFLECTED_LOBES_SIZE - 1);
    float cosine = max(place.x * place.x, 1e-3);
    float sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    float roughness =
        mix(REFLECTED_LOBES_LEAST_ROUGHNESS, REFLECTED_LOBES_GREATEST_ROUGHNESS, place.y);
    float alpha = alpha_from_roughness(roughness);
    int own = int(gl_LocalInvocationID.x);
    vec3 ring = ring_of_half_vectors(own, cosine, sine, alpha);
    vec4 light[AZIMUTHS]; // its direction, on one side of the plane, and how much of it
    for (int i = 0; i < AZIMUTHS; ++i) {
        reflected_light reflected =
            light_of_ring(ring, i, cosine, sine, microfacet_parameter(DISTRIBUTION, roughness),
                          microfacet_parameter(MASKING, roughness));
        float beside = 1.0 - reflected.height * reflected.height -
                       reflected.aside * reflected.aside;
        light[i] = vec4(reflected.aside, sqrt(max(beside, 0.0)), reflected.height,
                        reflected.parts.x + reflected.parts.y);
    }
    if (own < REFLECTED_LOBES)
        lobes[own] = first_guess(own, acos(cosine), alpha);
    barrier();
    for (int step = 0; step < STEPS; ++step) {
        vec4 sums[REFLECTED_LOBES];
        for (int i = 0; i < REFLECTED_LOBES; ++i)
            sums[i] = vec4(0.0);
        for (int k = 0; k < AZIMUTHS; ++k) {
            vec2 shares[REFLECTED_LOBES];
            shares_of_lobes(light[k].xyz, shares);
            for (int i = 0; i < REFLECTED_LOBES; ++i)
                sums[i] += light[k].w * shares[i].x *
                           vec4(light[k].x, light[k].y * shares[i].y, light[k].z, 1.0);
        }
        for (int i = 0; i < REFLECTED_LOBES; ++i)
            ring_sums[i][own] = sums[i];
        barrier();
        if (own < REFLECTED_LOBES) {
            vec4 sum = vec4(0.0);
            for (int i = 0; i < RINGS; ++i)
                sum += ring_sums[own][i];
            lobes[own] = lobe_of_sum(sum);
        }
        barrier();
    }
    if (own >= REFLECTED_LOBES)
        return;
    float weights = 0.0;
    for (int i = 0; i < REFLECTED_LOBES; ++i)
        weights += lobes[i].weight;
    lobe_pair lobe = lobes[own];
    imageStore(reflected_lobes, ivec3(texel, own),
               vec4(atan(-lobe.axis.x, lobe.axis.z) - acos(cosine), lobe.axis.y,
                    lobe.level, lobe.weight / weights));
}
