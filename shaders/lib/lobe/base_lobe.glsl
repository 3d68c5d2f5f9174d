#ifndef LIB_BASE_LOBE_GLSL
#define LIB_BASE_LOBE_GLSL

#include "interface/specialisation.h"
#include "lib/number/constants.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

// The width of a base lobe: alpha for GGX and Beckmann, the exponent s for Blinn-Phong, kappa for
// von Mises-Fisher; and conversions of it.

// Burley, 2012, Physically-Based Shading at Disney, section 5.4: alpha = roughness^2.
float alpha_from_roughness(float roughness) {
    float clamped = clamp(roughness, 0.0, 1.0);
    return max(clamped * clamped, ALPHA_MINIMUM);
}

// Wang, Ren, Gong, Snyder, Guo, 2009, All-Frequency Rendering of Dynamic, Spatially-Varying
// Reflectance: lobes of equal curvature at the peak. Beckmann's exp(-tan^2/alpha^2) has
// it at kappa/2 = 1/alpha^2, and so has GGX, up to its longer tail.
float concentration_from_alpha(float alpha) {
    return 2.0 / (alpha * alpha);
}

// Xu et al., 2017, Eq. 14: the von Mises-Fisher lobe with the peak of a normalised Blinn-Phong.
float concentration_from_exponent(float exponent) {
    return exponent + 1.0;
}

// What the material states (roughness, exponent or kappa) to the lobe's own parameter, in range.
float base_lobe_parameter(uint distribution, float width) {
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return clamp(width, 0.0, CONCENTRATION_MAXIMUM - 1.0);
    case DISTRIBUTION_VMF:
        return clamp(width, 0.0, CONCENTRATION_MAXIMUM);
    default:
        return alpha_from_roughness(width);
    }
}

// A microfacet material states roughness [0, 1] for every distribution. Walter, Marschner, Li,
// Torrance, 2007, section 5.2: the exponent of equal width is s = 2/alpha^2 - 2.
float microfacet_parameter(uint distribution, float roughness) {
    float alpha = alpha_from_roughness(roughness);
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return max(2.0 / (alpha * alpha) - 2.0, 0.0);
    case DISTRIBUTION_VMF:
        return concentration_from_alpha(alpha);
    default:
        return alpha;
    }
}

// kappa of the von Mises-Fisher lobe that replaces the base lobe.
float base_lobe_concentration(uint distribution, float parameter) {
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return concentration_from_exponent(parameter);
    case DISTRIBUTION_VMF:
        return parameter;
    default:
        return concentration_from_alpha(parameter);
    }
}

// The inverse: the base lobe that a von Mises-Fisher lobe of this concentration replaces.
float base_lobe_of_concentration(uint distribution, float concentration) {
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return max(concentration - 1.0, 0.0);
    case DISTRIBUTION_VMF:
        return concentration;
    default:
        return sqrt(2.0 / max(concentration, 1e-6));
    }
}

// Convolution of a base lobe with normals that are themselves spread, Xu et al., 2017, Eq. 11.

// Xu et al., 2017, Eq. 13, after Han, Sun, Ramamoorthi, Grinspun, 2007, Frequency Domain Normal Map
// Filtering: s' = kappa_N s / (kappa_N + s).
float convolved_exponent(float exponent, float normal_concentration) {
    return exponent / (1.0 + exponent / normal_concentration);
}

// The same in slopes, 1/kappa' = 1/kappa + 1/kappa_N with kappa = 2/alpha^2: variances add
// (Olano, Baker, 2010, LEAN Mapping).
float convolved_alpha(float alpha, float normal_concentration) {
    return sqrt(alpha * alpha + 2.0 / normal_concentration);
}

// Mardia, Jupp, 2000, Directional Statistics, section 9.3: the mean resultant lengths multiply,
// R(kappa') = R(kappa) R(kappa_N), which is exact in the mean direction's length, and so keeps the
// energy where a characteristic vector puts it. The reciprocal sum agrees for narrow lobes only:
// for kappa = kappa_N = 1 it gives 0.5 where the convolution has 0.30.
float convolved_concentration(float concentration, float normal_concentration) {
    float a = mean_resultant_complement(concentration);
    float b = mean_resultant_complement(normal_concentration);
    return concentration_from_resultant(mean_resultant_length(concentration) *
                                            mean_resultant_length(normal_concentration),
                                        a + b - a * b);
}

// Parameter of the convolved lobe. normal_concentration 0 means that the normal is exact.
float convolved_parameter(uint distribution, float parameter, float normal_concentration) {
    if (!(normal_concentration > 0.0)) {
        return parameter;
    }
    switch (distribution) {
    case DISTRIBUTION_BLINN_PHONG:
        return convolved_exponent(parameter, normal_concentration);
    case DISTRIBUTION_VMF:
        return convolved_concentration(parameter, normal_concentration);
    default:
        return convolved_alpha(parameter, normal_concentration);
    }
}

#endif
