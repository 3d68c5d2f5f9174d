#ifndef TESTS_REFERENCE_LIGHT_SPHERICAL_HARMONICS_H
#define TESTS_REFERENCE_LIGHT_SPHERICAL_HARMONICS_H

/// Spherical harmonics and irradiance in double precision; see
/// shaders/lib/light/spherical_harmonics.glsl and shaders/environment/irradiance_harmonics.comp.
/// Directions of unit length; harmonic l, m has number l (l + 1) + m.

enum { REFERENCE_HARMONICS = 9 };

/// Real, orthonormal over the sphere, for any degree >= 0 and |order| <= degree.
double reference_spherical_harmonic(int degree, int order, const double direction[3]);

/// Sum of the nine, negative or not.
double reference_harmonic_sum(const double coefficients[REFERENCE_HARMONICS],
                              const double direction[3]);

/// Coefficients of irradiance from one texel of a cube, or any light of `power` = radiance times
/// solid angle, added to `coefficients`.
void reference_add_irradiance(const double direction[3], double power,
                              double coefficients[REFERENCE_HARMONICS]);

/// The same of one channel of all texels of a cube of RGBA faces, size x size each.
void reference_irradiance_of_cube(const float *texels, int size, int channel,
                                  double coefficients[REFERENCE_HARMONICS]);

#endif
