#ifndef PASSES_MAPS_KEPT_RESTORING_H
#define PASSES_MAPS_KEPT_RESTORING_H

#include "passes/maps/kept/kept_file.h"
#include "passes/maps/level_reduction.h"

/// What was loaded from a file, on the device. All zero: nothing.
typedef struct stored_content {
    lobe_texture *rows[KEPT_MAXIMUM_IMAGES];
    lobe_buffer *buffers[KEPT_MAXIMUM_BUFFERS]; ///< the first is NULL: nothing
} stored_content;

/// Uploads a file's content for frames of this graph. Free it with passes_stored_content_free, even
/// after a failure. Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result passes_stored_content_create(lobe_graph *graph, const kept_layout *layout,
                                         const kept_content *content, stored_content *stored);
/// Zeroes the structure.
void passes_stored_content_free(stored_content *stored);

/// A part of a map, with as many levels as files have of it.
typedef struct map_tile {
    kept_image extent;
    uint32_t column, row; ///< of its first texel in level 0 of the map; 0 if it has more levels
} map_tile;

/// The name of these passes.
#define PASSES_RESTORING "map_restoring"
/// Adds the passes that copy all levels of an image that was stored into a map that was declared.
void passes_restoring(lobe_graph *graph, const stored_content *stored, uint32_t image,
                      const map_tile *tile, reduced_map *target);
/// The other way round: adds the pass that makes an image of a tile of one level, to be read back.
lobe_resource passes_cutting(lobe_graph *graph, const reduced_map *source, const map_tile *tile);

#endif
