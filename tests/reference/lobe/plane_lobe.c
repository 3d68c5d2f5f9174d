#include "tests/reference/lobe/plane_lobe.h"

#include <math.h>

#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/microfacet/microfacet.h"

/// Broader lobes are taken to be this broad.
static const double variance_maximum = 5;

/// From alpha^2 = 0.9 on.
static const double ggx_mass_maximum = 10;

static double ggx_mass(double alpha) {
    return alpha < 1 ? fmin(1 / (1 - alpha * alpha), ggx_mass_maximum) : ggx_mass_maximum;
}

double reference_plane_variance(lobe_distribution distribution, double parameter) {
    if (distribution == LOBE_DISTRIBUTION_GGX)
        return 0.5 * parameter * parameter * ggx_mass(parameter);
    return fmin(1 / reference_base_lobe_concentration(distribution, parameter), variance_maximum);
}

double reference_plane_mass(lobe_material_model model, lobe_distribution distribution,
                            double parameter) {
    static const double pole[3] = {0, 0, 1};
    double peak = model == LOBE_MATERIAL_MICROFACET
                      ? reference_normal_distribution(distribution, pole, pole, parameter)
                      : reference_half_vector_lobe(distribution, pole, pole, parameter);
    return 2 * M_PI * reference_plane_variance(distribution, parameter) * peak;
}

double reference_parameter_of_plane_variance(lobe_distribution distribution, double variance) {
    switch (distribution) {
    case LOBE_DISTRIBUTION_GGX:
        return fmin(sqrt(2 * variance / fmin(1 + 2 * variance, ggx_mass_maximum)), 1);
    case LOBE_DISTRIBUTION_BECKMANN:
        return sqrt(2 * variance);
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return fmax(1 / variance - 1, 0);
    default:
        return 1 / variance;
    }
}

void reference_plane_tail(double varies, double weights[4], double spreads[4]) {
    static const double weight[] = {0.2565, 0.4539, 0.2276, 0.0620};
    static const double weight_slope[] = {-0.0722, -0.0617, 0.0977, 0.0362};
    static const double spread[] = {0.4112, 1.4058, 5.6833, 31.7164};
    static const double slope[] = {-2.545, -0.024, 1.123, 2.069};
    static const double bend[] = {0.863, -0.657, -0.885, -1.146};
    for (int i = 0; i < 4; i++) {
        weights[i] = weight[i] + weight_slope[i] * varies;
        spreads[i] = spread[i] * exp((slope[i] + bend[i] * varies) * varies);
    }
}
