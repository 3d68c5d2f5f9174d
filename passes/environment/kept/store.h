#ifndef PASSES_ENVIRONMENT_KEPT_STORE_H
#define PASSES_ENVIRONMENT_KEPT_STORE_H

#include "passes/environment/maps.h"

/// Filtered cubes of one environment that a folder keeps (passes/environment/kept/cache.h): what
/// was found there, on the device, and what is to be added. All zero: nothing was looked for.
typedef struct environment_store {
    uint32_t size;                             ///< of the cubes looked for
    bool wanted[LOBE_ENVIRONMENT_MAP_COUNT];   ///< those looked for
    bool kept[LOBE_ENVIRONMENT_MAP_COUNT];     ///< those that the folder has, or does not take
    uint64_t keys[LOBE_ENVIRONMENT_MAP_COUNT]; ///< of those looked for
    stored_cube cubes[LOBE_ENVIRONMENT_MAP_COUNT];
} environment_store;

/// Looks for the filtered cubes that are wanted of `request->environment`, unless these were looked
/// for before. The device holds all of them afterwards, or none where one is missing or damaged.
/// Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...: nothing was looked for then.
lobe_result passes_environment_store_load(environment_store *store, lobe_device *device,
                                          const char *folder,
                                          const environment_maps_request *request,
                                          const lobe_host *host);

/// The cubes for a request; NULL where one is wanted that is not there, or none is wanted.
const stored_cube *passes_environment_store_cubes(const environment_store *store,
                                                  const environment_maps_request *request);

/// Whether a cube of this frame is to be kept: it was looked for and not found.
bool passes_environment_store_lacks(const environment_store *store, const environment_maps *maps,
                                    uint32_t map);

/// Keeps a cube that the last frame of the graph read back. A folder that does not take it is told
/// in a warning, once.
void passes_environment_store_save(environment_store *store, const char *folder,
                                   const lobe_graph *graph, const environment_maps *maps,
                                   uint32_t map, const lobe_host *host);

/// The environment is another, or gone. Waits until the device has finished with the cubes.
void passes_environment_store_forget(environment_store *store);

#endif
