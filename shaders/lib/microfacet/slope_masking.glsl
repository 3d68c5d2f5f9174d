#ifndef LIB_SLOPE_MASKING_GLSL
#define LIB_SLOPE_MASKING_GLSL

#include "lib/microfacet/masking.glsl"
#include "lib/microfacet/slope_distribution.glsl"

// Masking and shadowing of a surface whose slopes are Gaussian about any mean, anisotropic or not.
// Dupuy, Heitz, Iehl, Poulin, Neyret, Ostromoukhov, 2013, Linear Efficient Antialiased Displacement
// and Reflectance Mapping, section 4.3.

// The height of a direction above the mean plane, <omega, (-E[x], -E[y], 1)>: its cosine to the
// mean normal over that normal's own z. Not above 0: behind the surface.
float height_above_slope(vec2 mean, vec3 direction) {
    return direction.z - dot(mean, direction.xy);
}

// Smith's Lambda with the shifted mean, between Eqs. 15 and 16: that of
//   nu = (cot theta - mu(phi))/(sigma(phi) sqrt 2) = height/sqrt(2 omega_xy^T Sigma omega_xy),
// where both parts are multiplied by sin theta, which is 0 from above.
float lambda_of_variance(float height, float variance) {
    return lambda_gaussian(height * inversesqrt(max(2.0 * variance, 1e-30)));
}

float lambda_of_slopes(slope_distribution slopes, vec3 direction) {
    return lambda_of_variance(height_above_slope(slopes.mean, direction),
                              slope_variance_along(slopes, direction.xy));
}

// Eq. 13: the part of the surface that both directions see, heights correlated.
float masking_shadowing_of_slopes(slope_distribution slopes, vec3 incoming, vec3 outgoing) {
    bool above = height_above_slope(slopes.mean, incoming) > 0.0 &&
                 height_above_slope(slopes.mean, outgoing) > 0.0;
    return above ? 1.0 / (1.0 + lambda_of_slopes(slopes, incoming) +
                          lambda_of_slopes(slopes, outgoing))
                 : 0.0;
}

#endif
