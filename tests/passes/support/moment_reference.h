#ifndef TESTS_PASSES_SUPPORT_MOMENT_REFERENCE_H
#define TESTS_PASSES_SUPPORT_MOMENT_REFERENCE_H

#include <lobe/scene.h>

#include "passes/filters/moments/partition.h"
#include "tests/reference/mixture/moment_bins.h"

/// What moment_binning computes and the filter "moments" makes of it, in double precision.

reference_moment_bins moment_bins_of(const moment_partition *partition, double colour_scale);

/// The moments of every texel of a material's maps: the layers of shaders/interface/moment_bins.h.
/// `as_lobe`: base lobes are turned into von Mises-Fisher lobes. To free by the caller.
reference_layers moments_of_texels(const lobe_scene *scene, const lobe_material *material,
                                   const reference_moment_bins *partition, bool as_lobe);

/// Radiance, for an irradiance of one perpendicular to the light, of a material without colour maps
/// (except for microfacets' metal, whose means are the bins') from the means over a footprint,
/// layer after layer. Directions of unit length, in the tangent frame.
void shade_moments(const lobe_material *material, const reference_moment_bins *partition,
                   const double *moments, const double outgoing[3], const double incoming[3],
                   double radiance[3]);

#endif
