#ifndef TESTS_SHADERS_SUPPORT_EXACT_H
#define TESTS_SHADERS_SUPPORT_EXACT_H

#include "tests/shaders/support/real.h"

/// Exact values for several tests, in 256 bits. Directions are floats, taken as they are and made
/// unit length.

/// 1 - R(kappa) = 1 - coth kappa + 1/kappa, for kappa >= 0.
real exact_resultant_complement(real kappa);
real exact_resultant(real kappa);
/// kappa with R(kappa) = resultant, in [0, 1).
real exact_concentration(real resultant);

/// kappa / (4 pi sinh kappa) exp(kappa).
real exact_von_mises_fisher_peak(real kappa);
/// kappa (<direction, mean> - 1).
real exact_von_mises_fisher_exponent(const float direction[3], const float mean[3], double kappa);
real exact_von_mises_fisher(const float direction[3], const float mean[3], double kappa);

#endif
