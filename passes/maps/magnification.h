#ifndef PASSES_MAPS_MAGNIFICATION_H
#define PASSES_MAPS_MAGNIFICATION_H

#include "passes/filters/filter.h"

/// Whether any pixel of the picture may see level 0 of a map of `width` x `height` texels on
/// instances of the material: their nearest point, seen straight on, where the map is laid out
/// most coarsely, has fewer than two texels to a pixel. Errs on the side of yes.
/// `probes` and `bias` are those of shaders/lib/map/footprint.glsl's level.
bool passes_may_be_magnified(const filter_context *context, uint32_t material, uint32_t map,
                             uint32_t width, uint32_t height, double probes, double bias);

#endif
