#ifndef PASSES_FILTERS_MOMENTS_MIXTURE_FIT_H
#define PASSES_FILTERS_MOMENTS_MIXTURE_FIT_H

#include "passes/filters/moments/survey.h"
#include "shaders/interface/moment_bins.h"

/// Mixtures of Gaussians in the Lambert plane, fitted to samples of lobes.

typedef struct mixture_component {
    double weight, mean[2];
    double covariance[3], inverse[3], determinant; ///< xx, yy, xy
    double offset; ///< the part of the log likelihood that does not depend on the sample
} mixture_component;

typedef struct plane_mixture {
    mixture_component components[MOMENT_MAXIMUM_BINS];
    uint32_t count;
    double points; ///< that a lobe counts as
    double likelihood;
} plane_mixture;

/// Different starts may end in different mixtures: start 0 distinguishes widths, start 1 distances
/// from the middle, the others are random.
enum { MIXTURE_STARTS = 8 };

/// Fits `bins` components by expectation maximisation. Each lobe counts as `points` points drawn
/// from it. Vasconcelos, Lippman 1998, Learning Mixture Hierarchies. `count` is above 0. The result
/// depends on the arguments alone.
void passes_mixture_fit(const plane_sample *samples, uint32_t count, uint32_t bins, double points,
                        uint32_t start, plane_mixture *fitted);

/// The share [0, 1] of each component in a lobe; returns the logarithm of the sum of likelihoods.
double passes_mixture_share(const plane_mixture *mixture, const plane_sample *sample,
                            double members[MOMENT_MAXIMUM_BINS]);

/// Half the trace of the places' covariance.
double passes_plane_spread(const plane_sample *samples, uint32_t count);

#endif
