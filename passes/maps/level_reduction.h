#ifndef PASSES_MAPS_LEVEL_REDUCTION_H
#define PASSES_MAPS_LEVEL_REDUCTION_H

#include <lobe/graph.h>

/// An array of linear maps whose levels are means of the level before, over each texel's own extent
/// (shaders/lib/map/box_reduction.glsl), at any size.
typedef struct reduced_map {
    lobe_resource resource;
    uint32_t width, height; ///< texels of level 0
    uint32_t layers, levels;
    /// The tiles of each level that are to be made (shaders/interface/map_tiles.h), where the map
    /// is not made whole; version 0: it is.
    lobe_resource tiles;
    bool keeps; ///< tiles that are not listed keep their content
    /// Where a pass decides whether a map that has no tiles is made: lobe_dispatch_arguments for
    /// each level, 16 bytes apart from this many bytes on; version 0: it is made.
    lobe_resource groups;
    size_t groups_offset;
} reduced_map;

/// Levels of a full chain: floor(log2(max(width, height))) + 1.
uint32_t passes_level_count(uint32_t width, uint32_t height);
/// max(1, floor(size / 2)).
uint32_t passes_half_extent(uint32_t size);
/// Bytes of all levels and layers.
uint64_t passes_reduced_map_bytes(const reduced_map *map, lobe_format format);

/// Declares a retained map with all levels. Level 0 has half the size of `width` x `height`.
/// `whole`: frames make all of it, so that graphs may share it.
reduced_map passes_reduced_map_declare(lobe_graph *graph, const char *name, lobe_format format,
                                       uint32_t width, uint32_t height, uint32_t layers,
                                       bool whole);

/// Binds a level of the map, under the name that the shader gives it, to a pass that makes it.
void passes_reduced_map_write(reduced_map *map, lobe_pass *pass, const char *name, uint32_t level);
/// Adds a dispatch that makes a level: one thread for each texel, or `layers` of them, in groups of
/// 8 x 8. Where the map is not made whole, the groups are those of the listed tiles, and `shader`
/// is a variant that finds them with shaders/maps/target_texel.glsl.
void passes_reduced_map_dispatch(const reduced_map *map, lobe_pass *pass, uint32_t level,
                                 uint32_t layers, lobe_dispatch *dispatch);

/// Adds passes that fill all levels of `map` from level 0 of `source`, whose size is the `width` x
/// `height` that `map` was declared for.
void passes_level_reduction_from(lobe_graph *graph, reduced_map *map, lobe_resource source,
                                 uint32_t width, uint32_t height);
/// Adds passes that fill levels 1 and up of `map` from its level 0.
void passes_level_reduction(lobe_graph *graph, reduced_map *map);

#endif
