#ifndef PASSES_ENVIRONMENT_CACHE_RESTORING_H
#define PASSES_ENVIRONMENT_CACHE_RESTORING_H

#include <lobe/device.h>

#include "passes/environment/cache/cube_image.h"
#include "passes/maps/level_reduction.h"

/// Levels of the widest cube.
#define CUBE_TEXTURES_MAXIMUM_LEVELS 12

/// A cube that was loaded from a file, on the device: one texture for each level, with the faces
/// below one another. All zero: none.
typedef struct cube_textures {
    lobe_texture *levels[CUBE_TEXTURES_MAXIMUM_LEVELS];
    uint32_t count;
} cube_textures;

/// Uploads a cube. Free it with passes_cube_textures_free, even after a failure.
/// Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result passes_cube_textures_create(lobe_device *device, const cube_image *cube,
                                        cube_textures *textures);
/// Waits until the device no longer uses the textures; zeroes the structure.
void passes_cube_textures_free(cube_textures *textures);

/// Adds the passes that copy all levels into `cube`, which has the same width.
void passes_environment_restoring(lobe_graph *graph, const cube_textures *textures,
                                  reduced_map *cube);

#endif
