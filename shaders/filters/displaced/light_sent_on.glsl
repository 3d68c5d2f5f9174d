#ifndef LIGHT_SENT_ON_GLSL
#define LIGHT_SENT_ON_GLSL

// Where light comes from that facets of a relief mirror to each other before it reaches the
// viewer: a lobe of von Mises and Fisher. The ways of light are followed from the viewer to a
// second facet, as if that were any that faces the way. The relief also hides light from low
// directions, by as much as they are below a height that grows with its slopes.

#include "lib/lobe/direction_lobe.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

struct sent_on_lobe {
    vec3 axis; // unit, tangent frame
    float concentration;
    float open;  // height of directions, as a cosine, from which on nothing is hidden
    float scale; // of the lobe less what is hidden, whose integral is then 1
    // The lobe of the same mean direction in which nothing is hidden.
    vec3 mean_axis;
    float mean_concentration;
    float share; // [0, 1]; the rest comes as to diffuse facets
};

// Means of a normal number and of its square, both 0 where it is negative.
vec2 positive_moments(float mean, float deviation) {
    float above = normal_below(mean / deviation);
    float density = deviation * normal_density(mean / deviation);
    return vec2(mean * above + density, (mean * mean + deviation * deviation) * above +
                                            mean * density);
}

// The integral of the lobe less what is hidden, and its mean direction, if the height of directions
// is a normal number: within 8 %, but for lobes that are almost all below the horizon.
void weigh_sent_on(inout sent_on_lobe lobe) {
    float resultant = mean_resultant_length(lobe.concentration);
    // Covariances of directions: `across` the axis, and `along` more along it.
    float across = resultant / lobe.concentration;
    float along = 1.0 - resultant * resultant - 3.0 * across;
    float mean = resultant * lobe.axis.z;
    float variance = across + along * lobe.axis.z * lobe.axis.z, deviation = sqrt(variance);
    vec2 above = positive_moments(mean, deviation),
         above_open = positive_moments(mean - lobe.open, deviation);
    float part = max(above.x - above_open.x, 1e-6 * lobe.open);
    float height = clamp((above.y - above_open.y) / part - lobe.open * above_open.x / part, 0.01,
                         1.0);
    lobe.scale = lobe.open / (part * (1.0 + 0.25 * across));
    float moved = along * lobe.axis.z / variance * (height - mean);
    vec3 weighted = vec3((resultant + moved) * lobe.axis.xy, height);
    resultant = clamp(length(weighted), 0.1, 0.98);
    lobe.mean_axis = normalize(weighted);
    lobe.mean_concentration = concentration_from_resultant(resultant, 1.0 - resultant);
}

// `mean`: of the directions to which light goes from a second facet. `slope`: the rms of the
// relief's, each way. The constants were chosen on seven reliefs of roughness 0.35 (Gaussian slopes
// of 0.3, 0.6 and 1, ridges, cobbles, waves and scales): not the least error of all light, which
// broader lobes have, but little of light to the side, and of low light on waves of slope 0.2.
sent_on_lobe find_sent_on(vec3 mean, float slope, float roughness) {
    float alpha = roughness * roughness;
    // Two facets turn light by their microfacets, the first of which are not in the mean yet.
    float resultant = clamp(length(mean) * exp(-3.0 * alpha * alpha), 0.1, 0.98);
    sent_on_lobe lobe;
    lobe.axis = normalize(mean + vec3(0.0, 0.0, 1e-4));
    lobe.concentration = concentration_from_resultant(resultant, 1.0 - resultant);
    lobe.open = clamp(2.0 * slope, 0.02, 1.0);
    lobe.share = 1.0 - alpha;
    weigh_sent_on(lobe);
    return lobe;
}

// Per steradian.
float density_of_sent_on(sent_on_lobe lobe, vec3 incoming) {
    return lobe.scale * clamp(incoming.z / lobe.open, 0.0, 1.0) *
           von_mises_fisher(incoming, lobe.axis, lobe.concentration);
}

#endif
