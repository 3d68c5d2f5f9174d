#ifndef PASSES_ENVIRONMENT_CACHE_CACHED_CUBES_H
#define PASSES_ENVIRONMENT_CACHE_CACHED_CUBES_H

#include "passes/environment/maps.h"

/// The filtered cubes of one environment in a cache folder (passes/environment/cache/cube_file.h):
/// those that were found, on the device, and those that still have to be saved. All zero: nothing
/// was looked up yet.
typedef struct cached_cubes {
    uint32_t size;                              ///< of the environment's radiance, for all keys
    bool requested[LOBE_ENVIRONMENT_MAP_COUNT]; ///< cubes that were looked up
    bool settled[LOBE_ENVIRONMENT_MAP_COUNT];   ///< found, saved, or tried to save
    uint64_t keys[LOBE_ENVIRONMENT_MAP_COUNT];  ///< of the cubes that were looked up
    cube_textures cubes[LOBE_ENVIRONMENT_MAP_COUNT]; ///< of those that were found
} cached_cubes;

/// Loads the filtered cubes that the request wants for `request->environment`, unless the last call
/// already looked them up. Afterwards the device holds all of them, or none if one is missing or
/// damaged. Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...; `cached` is all zero then.
lobe_result passes_cached_cubes_load(cached_cubes *cached, lobe_device *device, const char *folder,
                                     const environment_maps_request *request,
                                     const lobe_host *host);

/// The loaded cubes for a request, by lobe_environment_map; NULL if a wanted one is missing, or
/// none is wanted.
const cube_textures *passes_cached_cubes_find(const cached_cubes *cached,
                                              const environment_maps_request *request);

/// Whether a cube of this frame should be saved: it was looked up and not found.
bool passes_cached_cubes_lack(const cached_cubes *cached, const environment_maps *maps,
                              uint32_t map);

/// Saves a cube that the last frame of the graph read back. If that fails, logs a warning, and
/// tries to save no other.
void passes_cached_cubes_save(cached_cubes *cached, const char *folder, const lobe_graph *graph,
                              const environment_maps *maps, uint32_t map, const lobe_host *host);

/// Frees everything, for another environment. Waits until the device no longer uses the cubes.
void passes_cached_cubes_forget(cached_cubes *cached);

#endif
