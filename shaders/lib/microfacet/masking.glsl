#ifndef LIB_MASKING_GLSL
#define LIB_MASKING_GLSL

#include "interface/specialisation.h"
#include "lib/number/constants.glsl"

// Masking and shadowing of microfacets after Smith, by Lambda(cosine) of one direction.
// Heitz, 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs.

float tangent_squared(float cosine) {
    float c = max(cosine, COSINE_MINIMUM);
    return max((1.0 - c) * (1.0 + c), 0.0) / (c * c);
}

// Heitz, 2014, Eq. 72: Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2, without its cancellation.
float lambda_ggx(float cosine, float alpha) {
    float square = alpha * alpha * tangent_squared(cosine);
    return 0.5 * square / (1.0 + sqrt(1.0 + square));
}

// Heitz, 2014, Eq. 66, with a = 1/(alpha tan):
//   Lambda = (erf(a) - 1)/2 + exp(-a^2)/(2 a sqrt(pi)) = g(a) exp(-a^2)/(2 a sqrt(pi)),
//   g(a) = 1 - sqrt(pi) a exp(a^2) erfc(a).
// g is a quotient of polynomials with the smallest maximum relative error on [0, 6], 7.7e-6,
// found by linear programming; beyond 6 the exponential leaves nothing. (The usual fit of Walter
// et al., 2007, Eq. 27, is 0.35 % off.)
//
// For any Gaussian slopes: a > 0 is the cotangent above the mean plane, over sqrt(2) times the
// slopes' standard deviation along the direction.
float lambda_gaussian(float cotangent) {
    float a = clamp(cotangent, 1e-9, 1e5);
    float numerator = 1.0 + a * (0.55781488 + a * 0.14587858);
    float denominator =
        1.0 + a * (2.32996631 + a * (2.27929734 + a * (1.13641403 + a * 0.29062669)));
    const float inverse_two_root_pi = 0.282094791773878143;
    return inverse_two_root_pi * exp(-a * a) * numerator / (a * denominator);
}

float lambda_beckmann(float cosine, float alpha) {
    // At normal incidence a is infinite: 1e-10 replaces a tangent of zero.
    return lambda_gaussian(inversesqrt(max(alpha * alpha * tangent_squared(cosine), 1e-10)));
}

// Walter, Marschner, Li, Torrance, 2007, section 5.2: Blinn-Phong is masked as the Beckmann
// distribution of the same width, and so is a von Mises-Fisher lobe.
float alpha_for_masking(uint distribution, float parameter) {
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return sqrt(2.0 / (parameter + 2.0));
    case DISTRIBUTION_VMF:
        return sqrt(2.0 / (parameter + 1.0));
    default:
        return parameter;
    }
}

float smith_lambda(uint distribution, float cosine, float parameter) {
    float alpha = alpha_for_masking(distribution, parameter);
    return distribution == DISTRIBUTION_GGX ? lambda_ggx(cosine, alpha)
                                            : lambda_beckmann(cosine, alpha);
}

// G1: fraction of the microfacets facing a direction that it sees. Heitz, 2014, Eq. 43.
float masking(uint distribution, float cosine, float parameter) {
    return cosine > 0.0 ? 1.0 / (1.0 + smith_lambda(distribution, cosine, parameter)) : 0.0;
}

// G2: fraction that both directions see, heights correlated. Heitz, 2014, Eq. 99; of GGX with
// Lambda multiplied out.
float masking_shadowing(uint distribution, float incident_cosine, float outgoing_cosine,
                        float parameter) {
    bool seen = incident_cosine > 0.0 && outgoing_cosine > 0.0;
    if (distribution == DISTRIBUTION_GGX) {
        vec2 c = clamp(vec2(incident_cosine, outgoing_cosine), COSINE_MINIMUM, 1.0);
        vec2 root = sqrt(c * c + parameter * parameter * (1.0 - c) * (1.0 + c));
        return seen ? 2.0 * c.x * c.y / (c.x * root.y + c.y * root.x) : 0.0;
    }
    return seen ? 1.0 / (1.0 + smith_lambda(distribution, incident_cosine, parameter) +
                         smith_lambda(distribution, outgoing_cosine, parameter))
                : 0.0;
}

#endif
