#ifndef ALBEDO_TABLE_GLSL
#define ALBEDO_TABLE_GLSL

// How much microfacets reflect of a white environment (passes/environment/directional_albedo.h).

#include "interface/environment/environment_light.h"
#include "lib/microfacet/directional_albedo.glsl"
#include "shading/surface.glsl"

layout(constant_id = SPECIALISE_MULTIPLE_SCATTERING) const bool MULTIPLE_SCATTERING = false;

layout(LOBE_DESCRIPTOR(30)) uniform sampler2D directional_albedo_table;

vec4 albedo_of(float cosine, float parameter) {
    return directional_albedo(directional_albedo_table, DISTRIBUTION, cosine, parameter);
}

#ifdef SLOPE_FILTER
// The same for microfacets that the filter has turned into Gaussian slopes.
layout(LOBE_DESCRIPTOR(32)) uniform sampler2D slope_albedo_table;
#endif

// Of a lobe of this kind, by the parameter of the material's distribution.
vec4 albedo_of_lobe(uint kind, float cosine, float parameter) {
#ifdef SLOPE_FILTER
    if (kind == DISTRIBUTION_BECKMANN)
        return directional_albedo(slope_albedo_table, DISTRIBUTION, cosine, parameter);
#endif
    return albedo_of(cosine, parameter);
}

// Factor of reflectance that adds light reflected more than once.
vec3 scattering_scale(vec4 albedo, vec3 f0) {
    return MULTIPLE_SCATTERING ? multiple_scattering_scale(albedo, f0) : vec3(1.0);
}

vec3 scattering_scale(vec3 f0, float cosine, float parameter) {
    return MULTIPLE_SCATTERING ? scattering_scale(albedo_of(cosine, parameter), f0) : vec3(1.0);
}

#endif
