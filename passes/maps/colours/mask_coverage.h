#ifndef PASSES_MAPS_COLOURS_MASK_COVERAGE_H
#define PASSES_MAPS_COLOURS_MASK_COVERAGE_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"
#include "shaders/interface/colours/mask.h"

/// The filtered base colours of a material with a mask, whose base colour map has more than one
/// texel. RGB: colour of what the mask keeps, times alpha; alpha: the share of the area that it
/// keeps. The base colour's factor of alpha is included, that of colours is not.
///
/// Where vertices multiply alpha by factors that differ, it has several layers, each for another
/// threshold of the map's alpha.
reduced_map passes_mask_coverage(const filter_context *context, uint32_t material);

/// Whether the material has a mask, of which vertices' alpha makes several.
bool passes_mask_varies(const device_scene *scene, const device_material *material);
/// The thresholds of a mask's layers: of its only one, where it does not vary.
struct mask_thresholds passes_mask_thresholds(const device_scene *scene,
                                              const device_material *material);

#endif
