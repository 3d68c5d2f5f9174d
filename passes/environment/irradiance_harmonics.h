#ifndef PASSES_ENVIRONMENT_IRRADIANCE_HARMONICS_H
#define PASSES_ENVIRONMENT_IRRADIANCE_HARMONICS_H

#include <stdbool.h>

#include <lobe/graph.h>

/// An environment cube: `levels` of six square layers, faces in Vulkan's order and orientation,
/// linear radiance. Every level holds means over solid angle of the one above, or radiance filtered
/// with von Mises-Fisher lobes of lobe_environment_level_concentration().
typedef struct irradiance_source {
    lobe_resource cube;
    uint32_t size; ///< texels along a face's edge at level 0, above 0
    uint32_t levels;
    bool filtered;
} irradiance_source;

/// Adds the passes that project an environment's irradiance to nine spherical harmonics
/// (Ramamoorthi, Hanrahan 2001): a retained buffer of struct irradiance_harmonics
/// (shaders/interface/environment/irradiance_harmonics.h). A graph can hold one of them.
///
/// Reads the first level whose faces are at most 64 texels wide. With faces of 256 texels,
/// coefficients are then off by up to 1.4e-2 of the first for a sun of one texel, whose direction
/// becomes that of the coarser texel's centre, and by 2e-5 for broad lights. Nine harmonics alone
/// miss the irradiance of that sun by 9e-2 of its peak. Filtered radiance is sharpened again.
///
/// `window` [0, 1): how much ringing opposite bright lights is removed, see
/// passes_harmonics_window.
lobe_resource passes_irradiance_harmonics(lobe_graph *graph, irradiance_source source,
                                          double window);

/// lambda >= 0 of Sloan 2008, Stupid Spherical Harmonics Tricks, "Windowing": the irradiance f_w
/// that minimises
///   integral of (f - f_w)^2 + lambda (Laplacian of f_w)^2
/// is f with degree l divided by 1 + lambda l^2 (l + 1)^2. Chosen so that for a single
/// light, which rings most, the root mean square of the irradiance's Laplacian falls to
/// `1 - window` of its value. Independent of the environment, so that the result is linear in it.
double passes_harmonics_window(double window);

#endif
