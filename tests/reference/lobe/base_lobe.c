#include "tests/reference/lobe/base_lobe.h"

#include <math.h>

#include "tests/reference/lobe/von_mises_fisher.h"

static double clamp(double x, double low, double high) {
    return fmin(fmax(x, low), high);
}

static double alpha_from_roughness(double roughness) {
    double clamped = clamp(roughness, 0, 1);
    return fmax(clamped * clamped, sqrt(2 / REFERENCE_CONCENTRATION_MAXIMUM));
}

double reference_base_lobe_parameter(lobe_distribution distribution, double width) {
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return clamp(width, 0, REFERENCE_CONCENTRATION_MAXIMUM - 1);
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return clamp(width, 0, REFERENCE_CONCENTRATION_MAXIMUM);
    return alpha_from_roughness(width);
}

double reference_microfacet_parameter(lobe_distribution distribution, double roughness) {
    double alpha = alpha_from_roughness(roughness);
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return fmax(2 / (alpha * alpha) - 2, 0);
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return 2 / (alpha * alpha);
    return alpha;
}

double reference_base_lobe_concentration(lobe_distribution distribution, double parameter) {
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return parameter + 1;
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return parameter;
    return 2 / (parameter * parameter);
}

static double convolved_concentration(double kappa, double normal_concentration) {
    double length = reference_mean_resultant_length(kappa) *
                    reference_mean_resultant_length(normal_concentration);
    // Series of the inverse, for lobes so broad that 1 - R holds no digits of R.
    if (length < 1e-3)
        return 3 * length + 1.8 * pow(length, 3);
    double s = reference_mean_resultant_complement(kappa);
    double t = reference_mean_resultant_complement(normal_concentration);
    return reference_concentration_from_complement(s + t - s * t);
}

double reference_convolved_parameter(lobe_distribution distribution, double parameter,
                                     double normal_concentration) {
    if (!(normal_concentration > 0))
        return parameter;
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return normal_concentration * parameter / (normal_concentration + parameter);
    if (distribution == LOBE_DISTRIBUTION_VMF)
        return convolved_concentration(parameter, normal_concentration);
    return sqrt(parameter * parameter + 2 / normal_concentration);
}
