#ifndef PASSES_ENVIRONMENT_KEPT_CACHE_H
#define PASSES_ENVIRONMENT_KEPT_CACHE_H

#include <stdbool.h>

#include <lobe/environment_maps.h>

#include "passes/environment/cube_image.h"

/// Filtered cubes in a folder of files, so that an environment seen before need not be filtered
/// again. Each file is named after what it was made from, and is an OpenEXR file that any viewer
/// opens. Files may be removed at any time.

/// What a cube is made from, as a number. Equal for equal texels, layout and parameters, whatever
/// the environment's name, rotation and intensity.
uint64_t passes_environment_cache_key(const lobe_environment *environment, uint32_t size,
                                      lobe_environment_map map);

/// Finds a cube of this key. False where there is none that is whole: a damaged or foreign file is
/// passed over with a notice. On true the cube is to free by the caller.
bool passes_environment_cache_load(const char *folder, uint64_t key, uint32_t width,
                                   const lobe_host *host, cube_image *cube);

/// Keeps a cube. A folder that does not take it is told in a warning.
void passes_environment_cache_store(const char *folder, uint64_t key, const cube_image *cube,
                                    const lobe_host *host);

#endif
