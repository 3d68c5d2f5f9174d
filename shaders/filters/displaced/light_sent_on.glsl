#ifndef LIGHT_SENT_ON_GLSL
#define LIGHT_SENT_ON_GLSL

// Where light comes from that facets of a relief mirror to each other before it reaches the
// viewer. Smooth facets of gentle reliefs turn it by little, so that it comes from about where a
// plane would mirror it from, and steep or rough ones from everywhere: a lobe of von Mises and
// Fisher. Light and viewer may change places, so that its density also falls towards the horizon
// with the cosine, and once more with what the relief sends on, which is little of low light: that
// only reaches tops. With z the height of a direction, it is z^2 times the lobe.

#include "lib/lobe/direction_lobe.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

struct sent_on_lobe {
    vec3 axis; // unit, tangent frame
    float concentration;
    float scale; // of z^2 times the lobe, whose integral is then 1
    // The lobe of the same mean direction, without z^2.
    vec3 mean_axis;
    float mean_concentration;
    float share; // [0, 1]; the rest comes as to diffuse facets
};

// The integral of z^2 times the lobe, and the mean direction, if z is a normal number, cut off at
// the horizon: within 7 %, and 0.08, for the lobes of find_sent_on().
void weigh_sent_on(inout sent_on_lobe lobe) {
    float resultant = mean_resultant_length(lobe.concentration);
    // Covariances of directions: `across` the axis, and `along` more along it.
    float across = resultant / lobe.concentration;
    float along = 1.0 - resultant * resultant - 3.0 * across;
    float mean = resultant * lobe.axis.z;
    float variance = across + along * lobe.axis.z * lobe.axis.z, deviation = sqrt(variance);
    float above = normal_below(mean / deviation);
    float density = deviation * normal_density(mean / deviation);
    float second = (mean * mean + variance) * above + mean * density;
    float third = mean * (mean * mean + 3.0 * variance) * above +
                  (mean * mean + 2.0 * variance) * density;
    lobe.scale = 1.0 / second;
    // The normal number's upper end lies beyond 1.
    float height = third / second * (1.0 - 0.6 * across);
    float moved = along * lobe.axis.z / variance * (height - mean);
    vec3 weighted = vec3((resultant + moved) * lobe.axis.xy, height);
    resultant = clamp(length(weighted), 0.6, 0.98);
    lobe.mean_axis = normalize(weighted);
    lobe.mean_concentration = concentration_from_resultant(resultant, 1.0 - resultant);
}

// The constants have the most likelihood for the light that `displaced-reference` sends on, beyond
// its direct light, from 30 directions to three viewers, of Rock058, three Gaussian reliefs of
// slopes 0.3 to 1 and waves of slope 0.2, with roughnesses from 0.2 to 0.6.
// `excess`: the area of the facets, over that of the carrier, less 1.
sent_on_lobe find_sent_on(vec3 viewer, float excess, float roughness) {
    float alpha = roughness * roughness;
    float level = length(viewer.xy);
    float forward = 55.0 * pow(max(level, 1e-3), 1.264) *
                    exp(-15.2 * max(excess, 0.0) - 7.0 * alpha);
    vec3 factor = vec3(-forward / max(level, 1e-3) * viewer.xy, 0.88 + 0.22 * forward);
    sent_on_lobe lobe;
    lobe.concentration = length(factor);
    lobe.axis = factor / lobe.concentration;
    lobe.share = 1.0 - alpha;
    weigh_sent_on(lobe);
    return lobe;
}

// Per steradian.
float density_of_sent_on(sent_on_lobe lobe, vec3 incoming) {
    return lobe.scale * incoming.z * incoming.z *
           von_mises_fisher(incoming, lobe.axis, lobe.concentration);
}

#endif
