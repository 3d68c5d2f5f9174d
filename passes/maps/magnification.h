#ifndef PASSES_MAPS_MAGNIFICATION_H
#define PASSES_MAPS_MAGNIFICATION_H

#include "passes/context/filter.h"

/// Whether any pixel of the picture may see level 0 of a map of `width` x `height` texels on
/// instances of the material: a pixel at the nearest point that the picture shows of their bounds,
/// facing the viewer where the map is laid out most coarsely, covers fewer than two texels (less a
/// sixteenth of a level). Conservative: true if in doubt.
/// `probes` and `bias`: as for the level in shaders/lib/map/footprint.glsl.
bool passes_may_be_magnified(const filter_context *context, uint32_t material, uint32_t map,
                             uint32_t width, uint32_t height, double probes, double bias);

#endif
