#ifndef PLANE_LOBES_GLSL
#define PLANE_LOBES_GLSL

// A material's base lobes in the Lambert plane, with their colours, for the passes that sort lobes.

#include "interface/mirrored.h"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/lobe/plane_lobe.glsl"
#include "maps/base_maps.glsl"

layout(constant_id = SPECIALISE_BASE_AS_LOBE) const bool BASE_AS_LOBE = false;
layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = true;

layout(set = 0, binding = 7) uniform sampler2D specular_map;

// A base lobe of a texel.
struct plane_lobe {
    vec2 place;
    float variance;
    float mass;
    vec4 colour; // of microfacets: of metal, and what is not metal
};

vec4 value_at(int map, sampler2D image, vec2 point) {
    return has_map(map) ? base_texel(image, point) : vec4(1.0);
}

// Specular: of microfacets the part of F0 that is metal's, and the fraction that is not metal; or
// the factor of the lobes' colours. Diffuse: what is below, times what they let through at normal
// incidence. `base_colour`: of the map at the point; white without one.
void colours_at(vec2 point, vec3 base_colour, out vec4 specular, out vec3 diffuse) {
    diffuse = material.base_colour.rgb * base_colour;
    if (MODEL == MODEL_MICROFACET) {
        float metallic = material.metallic;
        if (METALLIC_MAP)
            metallic *= value_at(MAP_WIDTH, width_map, point).b;
        specular = vec4(diffuse * metallic, 1.0 - metallic);
        diffuse *= (1.0 - metallic) * (1.0 - DIELECTRIC_F0 * specular.a - specular.rgb);
    } else {
        specular = vec4(value_at(MAP_SPECULAR, specular_map, point).rgb, 0.0);
    }
}

// Base lobe `i`; `specular`: as colours_at gives it, in any unit.
plane_lobe make_lobe(int i, vec3 normal, float factor, vec4 specular) {
    bool microfacet = MODEL == MODEL_MICROFACET;
    float parameter = base_parameter(i, factor);
    uint distribution = DISTRIBUTION;
    if (BASE_AS_LOBE) {
        parameter = base_lobe_concentration(DISTRIBUTION, parameter);
        distribution = DISTRIBUTION_VMF;
    }
    float share = microfacet ? 1.0 : material.lobe_colour[i].w;
    plane_lobe lobe;
    lobe.place = plane_from_direction(
        microfacet ? normal : rotate_from_pole(normal, material.lobe_direction[i].xyz));
    lobe.variance = plane_variance(distribution, parameter);
    lobe.mass = share * plane_mass(MODEL, distribution, parameter);
    lobe.colour = specular;
    if (!microfacet)
        lobe.colour.rgb *= material.lobe_colour[i].rgb / max(share, 1e-6);
    return lobe;
}

#endif
