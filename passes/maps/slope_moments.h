#ifndef PASSES_MAPS_SLOPE_MOMENTS_H
#define PASSES_MAPS_SLOPE_MOMENTS_H

#include "passes/context/filter.h"
#include "passes/maps/lobe_map.h"

/// Moments of a material's slopes, in the layers of shaders/interface/slope_moments.h.
///
/// Precision: a variance is the second moment less the squared mean. In float32 its error is about
/// 1e-7 of the squared mean, which is 1e-3 of the variance of kappa = 1e4 at 45 degrees. In float16
/// it is 1e-3 of the squared mean: lobes on slopes of 0.1 are accurate for kappa up to 1e4, on
/// slopes of 1 for kappa up to 100. Base lobes are stored apart and lose at most 1e-3 (6 % above
/// kappa = 1e5).
extern const lobe_map_kind passes_slope_moments;

/// The `build` of a filter that shades from this map (shaders/shading/slope_maps.glsl).
void passes_slope_moments_build(const filter_context *context, size_t instance,
                                const void *prepared, filtered_appearance *appearance);

#endif
