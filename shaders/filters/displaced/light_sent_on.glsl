#ifndef LIGHT_SENT_ON_GLSL
#define LIGHT_SENT_ON_GLSL

// Where light comes from that facets of a relief mirror to each other before it reaches the viewer.
// Rough facets send it on as diffuse ones do. Smooth ones of gentle reliefs turn it by little, so
// that it comes from about where a plane would mirror it from, and steep ones from everywhere.

#include "lib/lobe/von_mises_fisher.glsl"

// Of von Mises and Fisher.
struct sent_on_lobe {
    vec3 axis; // unit, tangent frame
    float concentration;
    float share; // [0, 1]; the rest comes as to diffuse facets
    float scale; // of its density, so that none is below the carrier
};

// The lobe whose mean direction is that of the light. Paths over two reliefs (Rock058, and a
// Gaussian one), each with four heights, three roughnesses up to 0.6, and viewers from 10 to 75
// degrees, gave the constants: its level part errs by 0.07, its height by 0.03 (root mean square).
// Of diffuse light the height is 2/3, and the level part 0.
// `excess`: the area of the facets, over that of the carrier, less 1.
sent_on_lobe find_sent_on(vec3 viewer, float excess, float roughness) {
    float alpha = roughness * roughness, x = max(excess, 0.0);
    float level = exp(-(3.2 + 1.3 * viewer.z) * x * (1.0 + 8.5 * alpha * alpha));
    float height = 0.72 - 0.51 * exp(-12.5 * x - 0.65 * alpha) * (1.0 - 0.4 * viewer.z);
    vec3 mean = vec3(-level * viewer.xy, height);
    float resultant = clamp(length(mean), 0.6, 0.98);
    sent_on_lobe lobe;
    lobe.axis = normalize(mean);
    lobe.concentration = concentration_from_resultant(resultant, 1.0 - resultant);
    lobe.share = 1.0 - alpha;
    lobe.scale = 1.0 / normal_below(lobe.axis.z * sqrt(lobe.concentration));
    return lobe;
}

// Per steradian.
float density_of_sent_on(sent_on_lobe lobe, vec3 incoming) {
    return lobe.scale * von_mises_fisher(incoming, lobe.axis, lobe.concentration);
}

#endif
