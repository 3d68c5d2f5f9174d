#ifndef TOOLS_ENVIRONMENT_CHECK_PASSES_H
#define TOOLS_ENVIRONMENT_CHECK_PASSES_H

#include "passes/environment/maps.h"
#include "tools/environment/shaders/check.h"

/// Passes that measure the light that von Mises-Fisher lobes about given directions receive from an
/// environment: by each fast method, and exactly.

/// Registers the passes' shaders with the device: call it once, before the first of them runs.
lobe_result environment_check_add_shaders(lobe_device *device);

/// Directions spread evenly over the sphere: Swinbank, Purser 2006, "Fibonacci
/// grids: A novel approach to global modelling". Four floats each, the last 0.
void environment_check_directions(uint32_t count, float (*directions)[4]);

typedef struct environment_check_request {
    uint32_t method;          ///< METHOD_...
    double concentration;     ///< kappa > 0
    uint32_t samples;         ///< METHOD_SAMPLED: at least 1
    lobe_resource directions; ///< a buffer of as many float4
    uint32_t count;
    uint32_t rounds; ///< repeats every look-up, to time what would be too short otherwise
} environment_check_request;

/// Adds the pass that looks light up; returns a buffer of float4: RGB for each direction of the
/// first round, then of the second, ... The maps have radiance and von Mises-Fisher lobes, and with
/// METHOD_BLENDED also LOBE_ENVIRONMENT_BETWEEN.
lobe_resource environment_check_look_up(lobe_graph *graph, const environment_maps *maps,
                                        const environment_check_request *request);

/// Adds the pass that sums the light of `texel_count` texels of the radiance, from `first_texel` on
/// (both multiples of CHECK_GROUP_SIZE), for CHECK_LOBES lobes about each direction. Returns a
/// buffer of float4: the first lobe's sum for each direction, then the second's, ... The sum over
/// all texels times environment_check_peak() is the light.
lobe_resource environment_check_exact(lobe_graph *graph, const environment_maps *maps,
                                      const environment_check_request *request,
                                      const double concentrations[CHECK_LOBES],
                                      uint32_t first_texel, uint32_t texel_count);

/// The value of a von Mises-Fisher lobe at its direction, per steradian.
double environment_check_peak(double concentration);

#endif
