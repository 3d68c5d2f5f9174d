#ifndef TESTS_REFERENCE_LOBE_PLANE_LOBE_H
#define TESTS_REFERENCE_LOBE_PLANE_LOBE_H

#include <lobe/scene.h>

/// Base lobes as bells in the Lambert plane, in double precision; see
/// shaders/lib/lobe/plane_lobe.glsl. A parameter as in base_lobe.h.

double reference_plane_variance(lobe_distribution distribution, double parameter);
/// So that the bell's peak, mass / (2 pi variance), is the lobe's own.
double reference_plane_mass(lobe_material_model model, lobe_distribution distribution,
                            double parameter);
/// The parameter that a variance belongs to.
double reference_parameter_of_plane_variance(lobe_distribution distribution, double variance);

/// GGX as a sum of four Gaussians: weights, and variances in those of the lobe. `varies`: variance
/// of the logarithm of the deviation [0, 0.64], of lobes of several widths.
void reference_plane_tail(double varies, double weights[4], double spreads[4]);

#endif
