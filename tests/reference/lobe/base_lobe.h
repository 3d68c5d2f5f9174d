#ifndef TESTS_REFERENCE_LOBE_BASE_LOBE_H
#define TESTS_REFERENCE_LOBE_BASE_LOBE_H

#include <lobe/scene.h>

/// Widths of base lobes in double precision; see shaders/lib/lobe/base_lobe.glsl. A parameter is
/// alpha for GGX and Beckmann, s for Blinn-Phong, kappa for von Mises-Fisher.

/// The sharpest lobe; wider ones are unchanged.
#define REFERENCE_CONCENTRATION_MAXIMUM 1e6

/// Of what a half-vector material states (exponent or kappa), or for GGX and Beckmann roughness.
double reference_base_lobe_parameter(lobe_distribution distribution, double width);
/// Of the roughness of a microfacet material, whatever its distribution.
double reference_microfacet_parameter(lobe_distribution distribution, double roughness);
/// kappa of the von Mises-Fisher lobe that replaces the base lobe.
double reference_base_lobe_concentration(lobe_distribution distribution, double parameter);
/// Convolved with normals of concentration kappa_N; 0 means none.
double reference_convolved_parameter(lobe_distribution distribution, double parameter,
                                     double normal_concentration);

#endif
