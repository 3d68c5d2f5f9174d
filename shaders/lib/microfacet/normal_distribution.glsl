#ifndef LIB_NORMAL_DISTRIBUTION_GLSL
#define LIB_NORMAL_DISTRIBUTION_GLSL

#include "interface/specialisation.h"
#include "lib/number/angle.glsl"
#include "lib/number/constants.glsl"
#include "lib/number/power_of_cosine.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

// Distributions D(h) of microfacet normals about n, per steradian, normalised so that the
// projected area is one: integral over the hemisphere of D(h) <n, h> dh = 1. Zero below the
// horizon.
// All angles through |n - h|^2 (lib/number/angle.glsl): accurate for alpha from 1e-4 up.

// Walter, Marschner, Li, Torrance, 2007, Microfacet Models for Refraction through Rough Surfaces,
// Eq. 33, with tan^2 multiplied out:
//   D = alpha^2 / (pi (alpha^2 cos^2 + sin^2)^2)
float distribution_ggx(vec3 normal, vec3 half_vector, float alpha) {
    float cosine = dot(normal, half_vector);
    float scaled = alpha * cosine;
    float quotient = alpha / (scaled * scaled + sine_squared_between(normal, half_vector));
    return cosine > 0.0 ? INVERSE_PI * quotient * quotient : 0.0;
}

// Walter et al., 2007, Eq. 25: D = exp(-tan^2/alpha^2) / (pi alpha^2 cos^4).
float distribution_beckmann(vec3 normal, vec3 half_vector, float alpha) {
    float cosine = dot(normal, half_vector);
    float cosine_squared = max(cosine * cosine, COSINE_MINIMUM * COSINE_MINIMUM);
    float slope = sine_squared_between(normal, half_vector) / (cosine_squared * alpha * alpha);
    float scale = alpha * cosine_squared;
    return cosine > 0.0 ? INVERSE_PI * exp(-slope) / (scale * scale) : 0.0;
}

// Walter et al., 2007, Eq. 30: D = (s + 2)/(2 pi) cos^s.
float distribution_blinn_phong(vec3 normal, vec3 half_vector, float exponent) {
    return (exponent + 2.0) * (0.5 * INVERSE_PI) *
           power_of_cosine(half_vector, normal, exponent);
}

// Projected area of a von Mises-Fisher lobe about its own axis, integral of rho(h) <mu, h> over the
// hemisphere of mu:
//   N(kappa) = (1 - (1 - exp(-kappa))/kappa) / (1 - exp(-2 kappa))
//            = (1 + R(kappa/2)) / (2 (1 + exp(-kappa))),
// the second form without cancellation. It is R(kappa) except for the part of the lobe below the
// horizon, and 1/4 for the uniform lobe.
// A mean of base lobes about different axes is divided by the area of the *base* lobes, not by that
// of the broader lobes that the mean was turned into.
float von_mises_fisher_projected_area(float concentration) {
    return 0.5 * (1.0 + mean_resultant_length(0.5 * concentration)) /
           (1.0 + exp(-concentration));
}

float distribution_von_mises_fisher(vec3 normal, vec3 half_vector, float concentration) {
    return dot(normal, half_vector) > 0.0
               ? von_mises_fisher(half_vector, normal, concentration) /
                     von_mises_fisher_projected_area(concentration)
               : 0.0;
}

// Any of them, by its own parameter (lib/lobe/base_lobe.glsl).
float normal_distribution(uint distribution, vec3 normal, vec3 half_vector, float parameter) {
    switch (distribution) {
    case DISTRIBUTION_BECKMANN:
        return distribution_beckmann(normal, half_vector, parameter);
    case DISTRIBUTION_BLINN_PHONG:
        return distribution_blinn_phong(normal, half_vector, parameter);
    case DISTRIBUTION_VMF:
        return distribution_von_mises_fisher(normal, half_vector, parameter);
    default:
        return distribution_ggx(normal, half_vector, parameter);
    }
}

#endif
