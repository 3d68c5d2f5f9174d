#ifndef TESTS_REFERENCE_LOBE_VON_MISES_FISHER_H
#define TESTS_REFERENCE_LOBE_VON_MISES_FISHER_H

/// Von Mises-Fisher lobes in double precision; the plain formulas behind
/// shaders/lib/lobe/von_mises_fisher.glsl. kappa >= 0, directions of unit length.

/// rho = kappa / (4 pi sinh kappa) exp(kappa cos), per steradian.
double reference_von_mises_fisher(const double direction[3], const double mean[3], double kappa);

/// R = coth kappa - 1/kappa, and 1 - R.
double reference_mean_resultant_length(double kappa);
double reference_mean_resultant_complement(double kappa);

/// kappa with 1 - R(kappa) = complement, for a complement in (0, 1].
double reference_concentration_from_complement(double complement);

#endif
