#ifndef PASSES_ENVIRONMENT_CACHE_CUBE_FILE_H
#define PASSES_ENVIRONMENT_CACHE_CUBE_FILE_H

#include <stdbool.h>

#include <lobe/environment_maps.h>

#include "passes/environment/cache/cube_image.h"

/// Filtered cubes as files of a folder, so that an environment need not be filtered again. A file
/// is named after a hash of what its cube was made from, and is an OpenEXR file that any viewer
/// opens. Files may be removed at any time.

/// A hash of what a cube is made from: texels, layout and parameters. It does not depend on the
/// environment's name, rotation and intensity.
uint64_t passes_cube_file_key(const lobe_environment *environment, uint32_t size,
                              lobe_environment_map map);

/// Loads the cube of a key. False if the folder has none, or (with a notice) only a damaged or
/// foreign file. On true the caller frees the cube with passes_cube_image_free.
bool passes_cube_file_load(const char *folder, uint64_t key, uint32_t width, const lobe_host *host,
                           cube_image *cube);

/// Saves a cube. False, with a warning, if that fails.
bool passes_cube_file_save(const char *folder, uint64_t key, const cube_image *cube,
                           const lobe_host *host);

#endif
