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

/// Adds the passes that copy all levels of an image into a map that was declared.
void passes_restoring(lobe_graph *graph, const stored_content *stored, uint32_t image,
                      reduced_map *target);

#endif
