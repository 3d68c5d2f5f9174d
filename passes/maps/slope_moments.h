#ifndef PASSES_MAPS_SLOPE_MOMENTS_H
#define PASSES_MAPS_SLOPE_MOMENTS_H

#include "passes/filters/filter.h"
#include "passes/maps/level_reduction.h"

/// Adds the pass that takes moments of a material's slopes, and the reduction of what it writes:
/// how its layers are laid out is in shaders/interface/slope_moments.h. The material has a normal
/// or a width map.
///
/// float32: second moments less squared means are a variance, to about 1e-7 of the mean's square:
/// 1e-3 of the variance of kappa = 1e4 at 45 degrees. float16 leaves 1e-3 of the square: lobes on
/// slopes of 0.1 are good for kappa up to 1e4, on slopes of 1 for kappa up to 100. Base lobes are
/// kept apart and lose 1e-3 at most (6 % above kappa = 1e5).
reduced_map passes_slope_moments(const filter_context *context, uint32_t material);

/// What a filter that shades from such a map does with an instance's material: builds and binds it,
/// with the other maps, and says how they are read.
void passes_slope_moments_build(const filter_context *context, size_t instance,
                                filtered_appearance *appearance);

#endif
