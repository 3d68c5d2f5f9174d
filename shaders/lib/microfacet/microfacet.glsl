#ifndef LIB_MICROFACET_GLSL
#define LIB_MICROFACET_GLSL

#include "lib/number/constants.glsl"
#include "lib/microfacet/fresnel.glsl"
#include "lib/microfacet/masking.glsl"
#include "lib/microfacet/normal_distribution.glsl"

// The microfacet frame. What it returns is to be multiplied by the radiance (or the irradiance of
// a punctual light perpendicular to it): the incident cosine is already in.

// Cook, Torrance, 1982, A Reflectance Model for Computer Graphics; Walter, Marschner, Li, Torrance,
// 2007, Eq. 20: F D G / (4 <n, omega_i> <n, omega_o>), times <n, omega_i>.
vec3 microfacet_specular(vec3 fresnel, float distribution, float masking_shadowing,
                         float outgoing_cosine) {
    // The limit of lambda_...: masking falls as the cosine does, and the quotient stays finite.
    return fresnel *
           (distribution * masking_shadowing / (4.0 * max(outgoing_cosine, COSINE_MINIMUM)));
}

// Lambert, 1760, Photometria, below a surface that reflects F: albedo/pi (1 - F) <n, omega_i>.
vec3 microfacet_diffuse(vec3 albedo, vec3 fresnel, float incident_cosine) {
    return albedo * (1.0 - fresnel) * (INVERSE_PI * max(incident_cosine, 0.0));
}

#endif
