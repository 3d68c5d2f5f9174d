#ifndef PASSES_MAPS_COLOURS_MASK_COVERAGE_H
#define PASSES_MAPS_COLOURS_MASK_COVERAGE_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"

/// The filtered base colours of a material with a mask, whose base colour map has more than one
/// texel. RGB: colour of what the mask keeps, times alpha; alpha: the share of the area that it
/// keeps. The base colour's factor of alpha is included, that of colours is not.
///
/// One share is all that a texel holds. Where vertices multiply alpha by factors that differ, it is
/// that of the middle of those factors with which anything can be kept: exact where alpha is 0 or 1
/// in the map, approximate where it changes gradually.
reduced_map passes_mask_coverage(const filter_context *context, uint32_t material);

#endif
