#ifndef PASSES_ENVIRONMENT_KEPT_RESTORING_H
#define PASSES_ENVIRONMENT_KEPT_RESTORING_H

#include <lobe/device.h>

#include "passes/environment/cube_image.h"
#include "passes/maps/level_reduction.h"

/// Levels of the widest cube there is.
#define STORED_CUBE_LEVELS 12

/// A cube that was made before, on the device: an image for each level. All zero: none.
typedef struct stored_cube {
    lobe_texture *levels[STORED_CUBE_LEVELS];
    uint32_t count;
} stored_cube;

/// Free it with passes_stored_cube_free, after a failure too.
lobe_result passes_stored_cube_create(lobe_device *device, const cube_image *cube,
                                      stored_cube *stored);
/// Waits until the device has finished with it; zeroes the structure.
void passes_stored_cube_free(stored_cube *stored);

/// Adds the passes that fill all levels of `cube`, which has the stored cube's width.
void passes_environment_restoring(lobe_graph *graph, const stored_cube *stored, reduced_map *cube);

#endif
