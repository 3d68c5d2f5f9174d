#ifndef PASSES_FILTERS_MIXTURE_RESTORING_H
#define PASSES_FILTERS_MIXTURE_RESTORING_H

#include "passes/filters/mixture/mixture_file.h"
#include "passes/maps/moment_map.h"

/// A map that was loaded from a file, on the device. All zero: none.
typedef struct stored_mixture {
    lobe_texture *rows;
    lobe_buffer *bins;
} stored_mixture;

/// Uploads a map for frames of this graph. Free it with passes_stored_mixture_free, even after a
/// failure. Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result passes_stored_mixture_create(lobe_graph *graph, const mixture_image *image,
                                         stored_mixture *stored);
/// Zeroes the structure.
void passes_stored_mixture_free(stored_mixture *stored);

/// Adds the passes that copy all levels into a map that was declared.
void passes_mixture_restoring(lobe_graph *graph, const stored_mixture *stored, moment_map *target);

#endif
