#ifndef PASSES_ENVIRONMENT_HEMISPHERES_IRRADIANCE_HARMONICS_H
#define PASSES_ENVIRONMENT_HEMISPHERES_IRRADIANCE_HARMONICS_H

#include "passes/environment/hemispheres/means.h"

/// An environment's irradiance (shaders/interface/environment/irradiance_harmonics.h); both are
/// retained.
typedef struct irradiance_maps {
    lobe_resource harmonics; ///< a buffer of struct irradiance_harmonics
    lobe_resource remainder; ///< what they miss, by normal
} irradiance_maps;

/// Adds the passes that project an environment's irradiance to nine spherical harmonics
/// (Ramamoorthi, Hanrahan 2001). A graph can hold one of them.
///
/// Reads the first level whose faces are at most 64 texels wide. With faces of 256 texels,
/// coefficients are then off by up to 1.4e-2 of the first for a sun of one texel, whose direction
/// becomes that of the coarser texel's centre, and by 2e-5 for broad lights. Nine harmonics alone
/// miss the irradiance of that sun by 9e-2 of its peak. Filtered radiance is sharpened again.
///
/// What they miss is added up over `means` (those of `source`) for a map of normals, to 3e-3 of the
/// peak of a sun, unless harmonics are windowed.
///
/// `window` [0, 1): how much ringing opposite bright lights is removed, see
/// passes_harmonics_window.
irradiance_maps passes_irradiance_harmonics(lobe_graph *graph, irradiance_source source,
                                            const environment_means *means, double window);

/// lambda >= 0 of Sloan 2008, Stupid Spherical Harmonics Tricks, "Windowing": the irradiance f_w
/// that minimises
///   integral of (f - f_w)^2 + lambda (Laplacian of f_w)^2
/// is f with degree l divided by 1 + lambda l^2 (l + 1)^2. Chosen so that for a single
/// light, which rings most, the root mean square of the irradiance's Laplacian falls to
/// `1 - window` of its value. Independent of the environment, so that the result is linear in it.
double passes_harmonics_window(double window);

#endif
