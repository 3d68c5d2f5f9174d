#ifndef PASSES_FILTERS_MOMENTS_FOOTPRINT_H
#define PASSES_FILTERS_MOMENTS_FOOTPRINT_H

#include "passes/filters/moments/mixture_fit.h"

/// The lobes under a pixel, to compare what bins make of them with what they are. Lobes are
/// Gaussians in the Lambert plane.

enum { FOOTPRINT_PLACES = 128 };

typedef struct footprint {
    uint32_t count;
    plane_sample *lobes; ///< weights add up to one
    bool log_normal;     ///< what bins take the deviations of base lobes for: those of GGX
    /// Half vectors, drawn with a density proportional to all lobes.
    double places[FOOTPRINT_PLACES][2];
    double densities[FOOTPRINT_PLACES];
    double truth[FOOTPRINT_PLACES][3]; ///< what the lobes reflect there, by colour
    double colour[3];                  ///< mean specular colour, as averaged maps have it
    double square;                     ///< of what the lobes reflect, integrated over half vectors
    double whites;                     ///< the same of white lobes
    double diffuse_error; ///< of the diffuse colour of averaged maps, relative to all colours
} footprint;

/// Completes a footprint of which the first three are set. `microfacet`: colours are F0.
void passes_footprint_complete(footprint *patch, bool microfacet);

/// Squared errors, integrated over half vectors.
typedef struct footprint_error {
    double mean_colour, bin_colours; ///< bins with the footprint's mean colour, or with their own
} footprint_error;

/// The error of the bins that the mixture makes of the footprint.
footprint_error passes_footprint_compare(const footprint *patch, const plane_mixture *mixture);

#endif
