#ifndef LIB_VON_MISES_FISHER_GLSL
#define LIB_VON_MISES_FISHER_GLSL

#include "lib/number/angle.glsl"
#include "lib/number/constants.glsl"
#include "lib/number/exponential.glsl"

// Xu, Wang, Zhao, Bao, 2017, Real-Time Linear BRDF MIP-Mapping, Eq. 6:
//   rho(omega; mu, kappa) = kappa / (4 pi sinh kappa) exp(kappa <mu, omega>)
// rewritten for unit vectors so that nothing overflows or cancels:
//   kappa / (-2 pi expm1(-2 kappa)) exp(-kappa/2 |mu - omega|^2)
// (Eq. 7 leaves out expm1, which is 14 % wrong at kappa = 1.)
// Per steradian; the integral over the sphere is 1. kappa >= 0.

// Its value at the mean direction, where the exponential is 1.
float von_mises_fisher_peak(float concentration) {
    // The quotient tends to 1/(4 pi) for small kappa; 1e-20 avoids 0/0.
    float kappa = max(concentration, 1e-20);
    return kappa / (-2.0 * PI * expm1(-2.0 * kappa));
}

float von_mises_fisher(vec3 direction, vec3 mean, float concentration) {
    return von_mises_fisher_peak(concentration) *
           exp(-0.5 * concentration * difference_squared(direction, mean));
}

// Mean resultant length |E[omega]|, and its complement to 1.
// Mardia, Jupp, 2000, Directional Statistics, section 9.3: R(kappa) = coth kappa - 1/kappa.
//
// Below kappa = 1: the continued fraction kappa/(3 + kappa^2/(5 + kappa^2/(7 + ...))), cut after
// five terms, where its relative error is below 3e-9.
float mean_resultant_length_of_broad_lobe(float kappa) {
    float square = kappa * kappa;
    return kappa * (3465.0 + square * (189.0 + square)) /
           (10395.0 + square * (1260.0 + 21.0 * square));
}

// From kappa = 1 on: 1 - R = 1/kappa - 2/expm1(2 kappa), without overflow.
float mean_resultant_complement_of_narrow_lobe(float kappa) {
    float decay = exp(-2.0 * kappa);
    return 1.0 / kappa - 2.0 * decay / (1.0 - decay);
}

// 1 - R(kappa): the number to keep for narrow lobes, where R is rounded to 1. In (0, 1].
float mean_resultant_complement(float concentration) {
    float narrow = mean_resultant_complement_of_narrow_lobe(max(concentration, 1.0));
    float broad = 1.0 - mean_resultant_length_of_broad_lobe(min(concentration, 1.0));
    return concentration < 1.0 ? broad : narrow;
}

// R(kappa): the number to keep for broad lobes. In [0, 1].
float mean_resultant_length(float concentration) {
    float narrow = 1.0 - mean_resultant_complement_of_narrow_lobe(max(concentration, 1.0));
    float broad = mean_resultant_length_of_broad_lobe(min(concentration, 1.0));
    return concentration < 1.0 ? broad : narrow;
}

// kappa from R and s = 1 - R, both given since each is exact where the other is rounded.
// Xu et al., 2017, Eq. 8 (Banerjee et al., 2005) is up to 4.9 % off the inverse of R(kappa).
// Here kappa s / R, which is 1 at s = 0 and 3 at s = 1, is a quotient of polynomials in s with
// the smallest maximum relative error, 6.6e-6, found by linear programming. One division and no
// exponential: Newton's method on R(kappa) needs both in each step for the same accuracy.
// At most CONCENTRATION_MAXIMUM, up to rounding.
float concentration_from_resultant(float resultant, float complement) {
    float s = clamp(complement, 1.0 / CONCENTRATION_MAXIMUM, 1.0);
    float numerator =
        1.0 +
        s * (-2.74237048 + s * (11.34754033 + s * (4.55964158 + s * 27.16625449)));
    float denominator =
        1.0 + s * (-3.74123073 +
                   s * (14.02611682 + s * (-5.64992463 + s * (14.41285841 - s * 6.27084931))));
    return clamp(resultant, 0.0, 1.0) * numerator / (s * denominator);
}

float concentration_from_complement(float complement) {
    return concentration_from_resultant(1.0 - complement, complement);
}

#endif
