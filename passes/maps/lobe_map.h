#ifndef PASSES_MAPS_LOBE_MAP_H
#define PASSES_MAPS_LOBE_MAP_H

#include "passes/context/filter.h"
#include "passes/maps/base_maps.h"

/// Maps that filters make of a material's lobes: built from its lobe_grid, reduced to all levels,
/// and bound to the shading with the wrapping of the grid.

/// Binds a map of a material's lobes to the shading, counts its size, and adds the filtered colour
/// maps. `map`: NULL if there is nothing to filter; a white texel is bound instead.
void passes_lobe_map_bind(const filter_context *context, uint32_t material, const char *binding,
                          const reduced_map *map, lobe_format format,
                          filtered_appearance *appearance);

/// A complete `build` for a filter with one map, in the format of the knob "storage": makes it if
/// the material's lobes vary, binds it, and adds the filtered colour maps.
void passes_lobe_map_build(const filter_context *context, size_t instance,
                           const lobe_map_kind *kind, filtered_appearance *appearance);

#endif
