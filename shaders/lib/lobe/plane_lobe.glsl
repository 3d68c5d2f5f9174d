#ifndef LIB_PLANE_LOBE_GLSL
#define LIB_PLANE_LOBE_GLSL

#include "interface/specialisation.h"
#include "lib/lobe/base_lobe.glsl"
#include "lib/microfacet/normal_distribution.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

// A base lobe as a bell in the Lambert plane: its variance v about its place, and its mass, the
// integral of the bell, chosen so that the peak mass / (2 pi v) is the lobe's own. Distributions of
// microfacet normals have a projected area of one; their mass is therefore above one.

// Broader lobes are treated as this broad and keep their peak.
const float PLANE_VARIANCE_MAXIMUM = 5.0;

// GGX, with sin^2 = x^2 at small x = |q|:
//   D = a/(pi (a + (1 - a) x^2)^2) = 1/(1 - a) (1/(pi e)) (1 + x^2/e)^-2,
//   a = alpha^2, e = a/(1 - a):
// Student's t distribution of two degrees of freedom, of mass 1/(1 - a). Its variance is infinite;
// v = e/2 is that of Beckmann's distribution of the same curvature. At a = 1, D is the same
// everywhere, and both mass and v would be infinite. From GGX_SQUARE_MAXIMUM on, the mass therefore
// stays the same, and v = a mass/2 keeps the peak: it reaches PLANE_VARIANCE_MAXIMUM at a = 1.
const float GGX_SQUARE_MAXIMUM = 0.9;
const float GGX_MASS_MAXIMUM = 1.0 / (1.0 - GGX_SQUARE_MAXIMUM);

float plane_variance(uint distribution, float parameter) {
    if (distribution == DISTRIBUTION_GGX) {
        float square = min(parameter * parameter, 1.0);
        return 0.5 * square / (1.0 - min(square, GGX_SQUARE_MAXIMUM));
    }
    return min(1.0 / base_lobe_concentration(distribution, parameter), PLANE_VARIANCE_MAXIMUM);
}

// The parameter of the base lobe with a given variance, which may have been rounded to 0: an
// infinite concentration has no mass.
float parameter_of_plane_variance(uint distribution, float variance) {
    if (distribution == DISTRIBUTION_GGX)
        return sqrt(min(2.0 * variance / min(1.0 + 2.0 * variance, GGX_MASS_MAXIMUM), 1.0));
    return base_lobe_of_concentration(distribution, 1.0 / max(variance, 1e-12));
}

float plane_mass(uint model, uint distribution, float parameter) {
    float variance = plane_variance(distribution, parameter);
    bool microfacet = model == MODEL_MICROFACET;
    switch (distribution) {
    case DISTRIBUTION_GGX:
        return min(1.0 + 2.0 * variance, GGX_MASS_MAXIMUM);
    case DISTRIBUTION_BECKMANN:
        return 1.0;
    case DISTRIBUTION_BLINN_PHONG:
        return variance * (microfacet ? parameter + 2.0 : parameter + 1.0);
    default:
        return 2.0 * PI * variance * von_mises_fisher_peak(parameter) /
               (microfacet ? von_mises_fisher_projected_area(parameter) : 1.0);
    }
}

// Student's t distribution of two degrees of freedom as a sum of Gaussians, for GGX. Lobes of
// several widths, with deviations sqrt(v) that vary log-normally, are such a sum too. Of term i the
// variance is tail_spread()[i] v, v the median, and the weight tail_weight()[i]; `varies` is the
// variance of log sqrt(v), at most TAIL_VARIES_MAXIMUM. Fitted for the least squared error over
// x/alpha < 10 exp(sqrt(varies)), weighted by x / D.
const float TAIL_VARIES_MAXIMUM = 0.64;

// Beyond that the sum falls off too fast: GGX's own tail takes over where the last term's exponent
// is minus this, near x/alpha = 8.
const float TAIL_BEGINS = 2.0;

vec4 tail_weight(float varies) {
    vec3 weight = vec3(0.2565, 0.4539, 0.2276) + vec3(-0.0722, -0.0617, 0.0977) * varies;
    return vec4(weight, 1.0 - (weight.x + weight.y + weight.z));
}

vec4 tail_spread(float varies) {
    vec4 slope = vec4(-2.545, -0.024, 1.123, 2.069) + vec4(0.863, -0.657, -0.885, -1.146) * varies;
    return vec4(0.4112, 1.4058, 5.6833, 31.7164) * exp(slope * varies);
}

// The density of Student's t distribution, e twice its variance, at a distance d from a middle that
// varies by far less: over Gaussian middles of covariance C, (xx, yy, xy), the mean of |d|^-4 is
// |d|^-4 (1 + (12 <d, C d>/|d|^2 - 2 tr C)/|d|^2 + ...).
float density_of_tail(float e, vec2 d, vec3 covariance) {
    float square = dot(d, d);
    float along = dot(covariance, vec3(d * d, 2.0 * d.x * d.y)) / max(square, 1e-30);
    float nearer = min(6.0 * along - (covariance.x + covariance.y), 0.5 * square);
    float scale = 1.0 / (e + square - nearer);
    return INVERSE_PI * e * scale * scale;
}

#endif
