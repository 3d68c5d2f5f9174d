#ifndef LIGHT_SENT_ON_GLSL
#define LIGHT_SENT_ON_GLSL

// Where light comes from that facets of a relief mirror to each other before it reaches the
// viewer: a lobe of von Mises and Fisher. The ways of light are followed from the viewer to a
// second facet, as if that were any that faces the way. The relief also hides light from low
// directions: below a height that grows with its slopes, the lobe falls with the square of the
// light's height. With the first power light and viewer could change places, almost, but low suns
// would be too bright.

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

// Means of a normal number, of its square and its cube, all 0 where it is negative.
vec3 positive_moments(float mean, float deviation) {
    float above = normal_below(mean / deviation), variance = deviation * deviation;
    float density = deviation * normal_density(mean / deviation);
    return above * vec3(mean, mean * mean + variance, mean * (mean * mean + 3.0 * variance)) +
           density * vec3(1.0, mean, mean * mean + 2.0 * variance);
}

// The integral of the lobe less what is hidden, and its mean direction, if the height of directions
// is a normal number: within 8 %, but for broad lobes that go down, 30 %.
void weigh_sent_on(inout sent_on_lobe lobe) {
    float resultant = mean_resultant_length(lobe.concentration);
    // Covariances of directions: `across` the axis, and `along` more along it.
    float across = resultant / lobe.concentration;
    float along = 1.0 - resultant * resultant - 3.0 * across;
    float mean = resultant * lobe.axis.z, open = lobe.open;
    float variance = across + along * lobe.axis.z * lobe.axis.z, deviation = sqrt(variance);
    vec3 above = positive_moments(mean, deviation),
         beyond = positive_moments(mean - open, deviation);
    vec3 scaled = (above - beyond) / (open * open);
    float part = max(scaled.y - 2.0 * beyond.x / open, 1e-6);
    float height = (scaled.z - 3.0 * beyond.y / open - 2.0 * beyond.x) / part;
    height = clamp(height, 0.01, 1.0);
    lobe.scale = 1.0 / (part * (1.0 + 0.6 * open * across));
    float moved = along * lobe.axis.z / variance * (height - mean);
    vec3 weighted = vec3((resultant + moved) * lobe.axis.xy, height);
    resultant = clamp(length(weighted), 0.1, 0.98);
    lobe.mean_axis = normalize(weighted);
    lobe.mean_concentration = concentration_from_resultant(resultant, 1.0 - resultant);
}

// `mean`: of the directions to which light goes from a second facet. `slope`: the rms of the
// relief's, each way. `share`: of such light, see sent_on_lobe. The constants were chosen on ten
// reliefs (docs/displacement.md): broader lobes make grooves too bright to the side, and lobes that
// fall off less, low suns.
sent_on_lobe find_sent_on(vec3 mean, float slope, float roughness, float share) {
    float alpha = roughness * roughness;
    // Two facets turn light by their microfacets, the first of which are not in the mean yet.
    float resultant = clamp(length(mean) * exp(-3.0 * alpha * alpha), 0.1, 0.98);
    sent_on_lobe lobe;
    lobe.axis = normalize(mean + vec3(0.0, 0.0, 1e-4));
    lobe.concentration = concentration_from_resultant(resultant, 1.0 - resultant);
    // What goes down meets a third facet, and comes from above in the end: the axis is at most 0.6
    // deviations below the horizon.
    float lowest = -0.6 * inversesqrt(lobe.concentration * resultant);
    if (lobe.axis.z < lowest)
        lobe.axis = vec3(sqrt(1.0 - lowest * lowest) * normalize(lobe.axis.xy + 1e-6), lowest);
    lobe.open = clamp(2.0 * slope, 0.02, 1.0);
    lobe.share = share;
    weigh_sent_on(lobe);
    return lobe;
}

// Per steradian.
float density_of_sent_on(sent_on_lobe lobe, vec3 incoming) {
    float open = clamp(incoming.z / lobe.open, 0.0, 1.0);
    return lobe.scale * open * open *
           von_mises_fisher(incoming, lobe.axis, lobe.concentration);
}

#endif
