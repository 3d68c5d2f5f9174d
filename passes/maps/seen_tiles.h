#ifndef PASSES_MAPS_SEEN_TILES_H
#define PASSES_MAPS_SEEN_TILES_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"
#include "shaders/interface/map_tiles.h"

/// Maps of which only the tiles that a frame's pixels read are made
/// (shaders/interface/map_tiles.h). A pass marks these tiles before the maps are built
/// (passes/renderer/tile_marking.h). A tile that was made in an earlier frame, from the same
/// content, is not made again: the graph numbers what it is made from (lobe_dispatch.numbered).

/// Of which tiles a frame's pixels read texels.
typedef struct tile_marks {
    lobe_resource marks; ///< a number for each tile of all maps; above 0: read
    /// Of the map of lobes of each material of the scene, and of each image, filtered; the latter
    /// may be NO_TILE_MARKS.
    const uint32_t *first_marks, *first_image_marks;
    bool rebuild; ///< tiles of earlier frames count as out of date
} tile_marks;

#define NO_TILE_MARKS UINT32_MAX // the map is made whole

/// Tiles of all levels of a map that is made from `width` x `height` texels.
uint32_t passes_map_tile_count(uint32_t width, uint32_t height);
/// Its levels, whose first mark is `first_mark`; returns their number.
uint32_t passes_map_tile_levels(uint32_t width, uint32_t height, uint32_t first_mark,
                                struct tile_level levels[MAP_TILE_LEVELS]);

/// As passes_reduced_map_declare, for a map of a material's lobes, from its lobe_grid. If the frame
/// has tile_marks, adds a pass that lists the tiles to make.
/// `reduced`: tiles are made from those of the finer level, which are then listed, too. Otherwise
/// each level is made from the base maps.
reduced_map passes_seen_map_declare(const filter_context *context, uint32_t material,
                                    const char *name, lobe_format format, uint32_t layers,
                                    bool reduced);
/// The same, reduced, where a pass of this frame decides whether there is a map: no tile is listed
/// where the first number of the buffer `condition` is 0. Version 0: there is a map.
reduced_map passes_seen_map_declare_if(const filter_context *context, uint32_t material,
                                       const char *name, lobe_format format, uint32_t layers,
                                       lobe_resource condition);
/// The same where tiles depend on a buffer, too, which passes of this frame may write: they are
/// made again when its content is another.
reduced_map passes_seen_map_declare_with(const filter_context *context, uint32_t material,
                                         const char *name, lobe_format format, uint32_t layers,
                                         bool reduced, lobe_resource made_with);
/// The same for the filtered image that a material's map is made of, which has one layer and is
/// reduced from the image.
reduced_map passes_seen_image_declare(const filter_context *context,
                                      const device_material *material, uint32_t map,
                                      const char *name, lobe_format format);

#endif
