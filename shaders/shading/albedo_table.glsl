#ifndef ALBEDO_TABLE_GLSL
#define ALBEDO_TABLE_GLSL

// How much microfacets reflect of a white environment (passes/environment/directional_albedo.h).

#include "interface/environment_light.h"
#include "lib/microfacet/directional_albedo.glsl"
#include "shading/surface.glsl"

layout(constant_id = SPECIALISE_MULTIPLE_SCATTERING) const bool MULTIPLE_SCATTERING = false;

layout(set = 0, binding = 30) uniform sampler2D directional_albedo_table;

vec4 albedo_of(float cosine, float parameter) {
    return directional_albedo(directional_albedo_table, DISTRIBUTION, cosine, parameter);
}

// Factor of reflectance that adds light reflected more than once.
vec3 scattering_scale(vec3 f0, float cosine, float parameter) {
    return MULTIPLE_SCATTERING ? multiple_scattering_scale(albedo_of(cosine, parameter), f0)
                               : vec3(1.0);
}

#endif
