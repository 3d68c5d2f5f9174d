#ifndef PASSES_MAPS_LOBE_MAP_H
#define PASSES_MAPS_LOBE_MAP_H

#include "passes/context/filter.h"
#include "passes/maps/base_maps.h"
#include "passes/maps/level_reduction.h"

/// Maps that filters make of a material's lobes: built from its lobe_grid, reduced to all levels,
/// and bound to the shading with the wrapping of the grid.

/// Binds a map of a material's lobes to the shading, counts its size, and adds the filtered colour
/// maps. `map`: NULL if there is nothing to filter; a white texel is bound instead.
void passes_lobe_map_bind(const filter_context *context, uint32_t material, const char *binding,
                          const reduced_map *map, lobe_format format,
                          filtered_appearance *appearance);

/// A map of numbers, in the format of the knob "storage", whose level 0 one compute pass makes from
/// the base maps. Its push constants are the grid's width and height.
typedef struct lobe_map_kind {
    const char *content;     ///< what it holds; part of its name
    const char *pass;        ///< name of the pass
    const char *shader;      ///< of the pass
    const char *seen_shader; ///< its variant SEEN_TILES, see passes/maps/seen_tiles.h
    const char *binding;     ///< of the map, in that shader and in shading
    uint32_t layers;         ///< of the map
    /// Binds and specialises what the shader reads beside the base maps. NULL: nothing.
    void (*read_more)(const filter_context *context, const device_material *material,
                      lobe_pass *pass, specialisation_list *list);
} lobe_map_kind;

/// Adds the pass that makes the map, and the reduction. The material has a normal or a width map.
reduced_map passes_lobe_map(const filter_context *context, uint32_t material,
                            const lobe_map_kind *kind);

/// A complete `build` for a filter with one such map: makes it if the material's lobes vary, binds
/// it, and adds the filtered colour maps.
void passes_lobe_map_build(const filter_context *context, size_t instance,
                           const lobe_map_kind *kind, filtered_appearance *appearance);

#endif
