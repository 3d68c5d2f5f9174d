#ifndef PASSES_FILTERS_MOMENTS_FOOTPRINTS_FOOTPRINT_H
#define PASSES_FILTERS_MOMENTS_FOOTPRINTS_FOOTPRINT_H

#include "passes/filters/moments/footprints/facing.h"
#include "passes/filters/moments/mixture_fit.h"

/// The lobes under a pixel, to compare what bins make of them with what they are. Lobes are
/// Gaussians in the Lambert plane.

enum { FOOTPRINT_PLACES = 128, FOOTPRINT_LIGHTS = 2 };

/// What the lobes reflect of a light.
typedef struct footprint_light {
    double variance; ///< of the light itself, as half vectors see it
    /// Half vectors, drawn with a density proportional to all lobes.
    double places[FOOTPRINT_PLACES][2];
    double densities[FOOTPRINT_PLACES];
    double parts[FOOTPRINT_PLACES];    ///< what sums of squares count each place as
    double truth[FOOTPRINT_PLACES][3]; ///< what the lobes reflect there, by colour
    double shown;                      ///< sum of squares of what they and Lambert's part reflect
    double whites;                     ///< the same of white lobes alone
} footprint_light;

typedef struct footprint {
    uint32_t count;
    plane_sample *lobes;   ///< weights add up to one
    bool log_normal;       ///< what bins take the deviations of base lobes for: those of GGX
    bool microfacet;       ///< colours are F0
    double base_colour[3]; ///< the material's, which its map's texels are multiplied by
    uint32_t light_count;
    /// A lamp and, where there are two, a broad light: under a lamp alone sharp lobes of many
    /// directions are spikes, which no bins match better than others.
    footprint_light lights[FOOTPRINT_LIGHTS];
    double colour[3];     ///< mean specular colour, as averaged maps have it
    double diffuse[3];    ///< what Lambert's part reflects, as densities of lobes do
    facing_light facing;  ///< of all lobes of microfacets
    double diffuse_error; ///< of the diffuse colour of averaged maps, relative to all colours
    bool mirrors_alike;   ///< all lobes mirror as much of their mass
} footprint;

/// Whether lobes of this variance look different under the broad light.
bool passes_footprint_is_sharp(double variance);

/// Scales the weights of lobes so that they add up to one.
void passes_footprint_normalise(plane_sample *lobes, uint32_t count);
/// Completes a footprint of which all up to the number of lights are set.
void passes_footprint_complete(footprint *patch);

/// Squared errors, summed over half vectors.
typedef struct footprint_error {
    double mean_colour, bin_colours; ///< bins with the footprint's mean colour, or with their own
} footprint_error;

/// The errors, by light, of the bins that the mixture makes of some of the footprint's lobes, such
/// as all.
void passes_footprint_compare(const footprint *patch, const plane_sample *lobes, uint32_t count,
                              const plane_mixture *mixture,
                              footprint_error errors[FOOTPRINT_LIGHTS]);

#endif
