#ifndef TESTS_REFERENCE_LOBE_HALF_VECTOR_LOBE_H
#define TESTS_REFERENCE_LOBE_HALF_VECTOR_LOBE_H

#include <lobe/scene.h>

/// Lobes of the half vector in double precision; see shaders/lib/lobe/half_vector_lobe.glsl.

/// rho(h): Blinn-Phong with (s+1)/2pi, or von Mises-Fisher.
double reference_half_vector_lobe(lobe_distribution distribution, const double half_vector[3],
                                  const double mean[3], double parameter);

/// The smallest rotation that takes (0, 0, 1) to `normal`, applied to `local`. At the opposite
/// pole the half turn about x.
void reference_rotate_from_pole(const double normal[3], const double local[3], double rotated[3]);

#endif
