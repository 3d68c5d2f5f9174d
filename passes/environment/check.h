#ifndef PASSES_ENVIRONMENT_CHECK_H
#define PASSES_ENVIRONMENT_CHECK_H

#include "passes/environment/maps.h"
#include "shaders/interface/environment_check.h"

/// The light that von Mises-Fisher lobes about given directions get from an environment, by each of
/// the methods there are and exactly: for measuring the methods' errors and times.

/// Directions of which every part of the sphere gets its share: Swinbank, Purser 2006, "Fibonacci
/// grids: A novel approach to global modelling". Four floats each, the last 0.
void passes_environment_check_directions(uint32_t count, float (*directions)[4]);

typedef struct environment_check_request {
    uint32_t method;          ///< METHOD_...
    double concentration;     ///< kappa > 0
    uint32_t samples;         ///< METHOD_SAMPLED: at least 1
    lobe_resource directions; ///< a buffer of as many float4
    uint32_t count;
    /// Everything is looked up so often, for timing what would else be over too soon.
    uint32_t rounds;
} environment_check_request;

/// Adds the pass that looks light up; returns a buffer of float4: RGB for each direction of the
/// first round, then of the second, ... The maps have radiance and von Mises-Fisher lobes, and for
/// METHOD_BLENDED those in between.
lobe_resource passes_environment_check(lobe_graph *graph, const environment_maps *maps,
                                       const environment_check_request *request);

/// Adds the pass that adds up what `texel_count` texels of the radiance from `first_texel` on (both
/// multiples of CHECK_GROUP_SIZE) give to CHECK_LOBES lobes about each direction. Returns a buffer
/// of float4: for each direction the first lobe's sum, then the second's, ... The sum of all texels
/// times passes_environment_check_peak() is the light.
lobe_resource passes_environment_check_exact(lobe_graph *graph, const environment_maps *maps,
                                             const environment_check_request *request,
                                             const double concentrations[CHECK_LOBES],
                                             uint32_t first_texel, uint32_t texel_count);

/// The value of a von Mises-Fisher lobe at its direction, per steradian.
double passes_environment_check_peak(double concentration);

#endif
