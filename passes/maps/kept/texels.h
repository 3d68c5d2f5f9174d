#ifndef PASSES_MAPS_KEPT_TEXELS_H
#define PASSES_MAPS_KEPT_TEXELS_H

#include "passes/context/filter.h"

/// Digests of maps of a material, for those of what is made from them.

/// Whether the host has a map's texels. Those that it gives on the device may be others in every
/// frame.
bool passes_kept_has_texels(const filter_context *context, const device_map *map);

/// A digest that goes on with the map's texels and how they are read. The host must have them.
uint64_t passes_kept_map_digest(const device_map *map, uint64_t digest);

#endif
