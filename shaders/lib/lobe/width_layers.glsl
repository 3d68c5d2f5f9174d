#ifndef LIB_WIDTH_LAYERS_GLSL
#define LIB_WIDTH_LAYERS_GLSL

// What a map of widths (WIDTH_LAYER_... in interface/material.h) holds of one base lobe of
// microfacets.

#include "interface/material.h"
#include "lib/lobe/plane_lobe.glsl"

// Sums of these are those of several lobes.
struct width_layers {
    vec4 lobes, microfacets;
};

// The variance and, as `mass`, the mass of the lobe in the plane. `as_lobe`: it is evaluated as a
// von Mises-Fisher lobe.
float width_in_plane(uint distribution, bool as_lobe, float parameter, out float mass) {
    uint kind = as_lobe ? DISTRIBUTION_VMF : distribution;
    float own = as_lobe ? base_lobe_concentration(distribution, parameter) : parameter;
    mass = plane_mass(MODEL_MICROFACET, kind, own);
    return plane_variance(kind, own);
}

width_layers layers_of_width(uint distribution, bool as_lobe, float parameter) {
    float concentration = base_lobe_concentration(distribution, parameter);
    float square = 2.0 / max(concentration, 1.0), mass;
    float variance = width_in_plane(distribution, as_lobe, parameter, mass);
    return width_layers(vec4(mass * inversesqrt(variance), mass * variance,
                             mean_resultant_complement(concentration), mass),
                        vec4(concentration, sqrt(square), square, 1.0));
}

#endif
