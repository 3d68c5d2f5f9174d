#include "tests/reference/lobe/plane_lobe.h"

#include <math.h>

#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/microfacet/microfacet.h"

/// Broader lobes are taken to be this broad.
static const double variance_maximum = 5;

static double ggx_square(double alpha) {
    return fmin(alpha * alpha, REFERENCE_GGX_SQUARE_MAXIMUM);
}

double reference_plane_variance(lobe_distribution distribution, double parameter) {
    if (distribution == LOBE_DISTRIBUTION_GGX)
        return 0.5 / (1 / ggx_square(parameter) - 1);
    return fmin(1 / reference_base_lobe_concentration(distribution, parameter), variance_maximum);
}

double reference_plane_mass(lobe_material_model model, lobe_distribution distribution,
                            double parameter) {
    static const double pole[3] = {0, 0, 1};
    double sharp = parameter;
    if (distribution == LOBE_DISTRIBUTION_GGX)
        sharp = sqrt(ggx_square(parameter));
    double peak = model == LOBE_MATERIAL_MICROFACET
                      ? reference_normal_distribution(distribution, pole, pole, sharp)
                      : reference_half_vector_lobe(distribution, pole, pole, sharp);
    return 2 * M_PI * reference_plane_variance(distribution, parameter) * peak;
}

double reference_parameter_of_plane_variance(lobe_distribution distribution, double variance) {
    switch (distribution) {
    case LOBE_DISTRIBUTION_GGX:
        return sqrt(2 * variance / (1 + 2 * variance));
    case LOBE_DISTRIBUTION_BECKMANN:
        return sqrt(2 * variance);
    case LOBE_DISTRIBUTION_BLINN_PHONG:
        return fmax(1 / variance - 1, 0);
    default:
        return 1 / variance;
    }
}
