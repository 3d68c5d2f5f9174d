#ifndef LIB_DIRECTIONAL_ALBEDO_GLSL
#define LIB_DIRECTIONAL_ALBEDO_GLSL

#include "interface/environment/directional_albedo.h"
#include "interface/specialisation.h"

// The table that shaders/environment/directional_albedo.comp fills for one distribution, and what
// it is for.

// Roughness [0, 1] with this parameter: the inverse of microfacet_parameter
// (lib/lobe/base_lobe.glsl).
// Lobes broader than any material's count as roughness 1.
float roughness_from_parameter(uint distribution, float parameter) {
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return min(pow(2.0 / (max(parameter, 0.0) + 2.0), 0.25), 1.0);
    case DISTRIBUTION_VMF:
        return min(pow(2.0 / max(parameter, 1e-6), 0.25), 1.0);
    default:
        return min(sqrt(max(parameter, 0.0)), 1.0);
    }
}

// Texture coordinates: between the centres of the first and the last texel.
vec2 directional_albedo_position(uint distribution, float outgoing_cosine, float parameter) {
    vec2 place = vec2(sqrt(clamp(outgoing_cosine, 0.0, 1.0)),
                      roughness_from_parameter(distribution, parameter));
    const float size = float(DIRECTIONAL_ALBEDO_SIZE);
    return (place * (size - 1.0) + 0.5) / size;
}

// The sampler is linear and clamped.
vec4 directional_albedo(sampler2D table, uint distribution, float outgoing_cosine,
                        float parameter) {
    return textureLod(table, directional_albedo_position(distribution, outgoing_cosine, parameter),
                      0.0);
}

// The fraction of uniform light that the microfacets reflect (once).
// Karis, 2013, Real Shading in Unreal Engine 4, Eq. 8: F_0 and F_90 factored out.
vec3 specular_albedo(vec4 albedo, vec3 f0, vec3 f90) {
    return f0 * albedo.x + f90 * albedo.y;
}

// The same of the Lambert part below them, whose surface lets 1 - F through.
vec3 diffuse_albedo(vec4 albedo, vec3 diffuse, vec3 f0, vec3 f90) {
    return diffuse * (1.0 - mix(f0, f90, albedo.z));
}

// Turquin, 2019, Practical Multiple Scattering Compensation for Microfacet Models: light that is
// reflected more than once is assumed to leave like the rest,
//   rho_ms = rho_ss (1 + F_0 (1 - E)/E)
// with E the albedo at F = 1, so that nothing is lost at F_0 = 1. Below 1 where masking derived for
// another distribution lets E exceed 1 (broad Blinn-Phong and von Mises-Fisher lobes).
vec3 multiple_scattering_scale(vec4 albedo, vec3 f0) {
    float reflected = albedo.x + albedo.y;
    return 1.0 + f0 * ((1.0 - reflected) / reflected);
}

#endif
