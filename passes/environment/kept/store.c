#include "passes/environment/kept/store.h"

#include "passes/environment/kept/cache.h"
#include "passes/environment/prefiltering.h"

static bool is_filtered_and_wanted(const environment_maps_request *request, uint32_t map) {
    return map != LOBE_ENVIRONMENT_RADIANCE && request->wanted[map];
}

static bool was_looked_for(const environment_store *store,
                           const environment_maps_request *request) {
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; ++map) {
        if (is_filtered_and_wanted(request, map) &&
            !(store->wanted[map] && store->size == request->size))
            return false;
    }
    return true;
}

static void free_cubes(environment_store *store) {
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; ++map)
        passes_stored_cube_free(&store->cubes[map]);
}

void passes_environment_store_forget(environment_store *store) {
    free_cubes(store);
    *store = (environment_store){0};
}

/// Brings a cube to the device, unless another is missing anyway: `needed`.
static lobe_result take(environment_store *store, lobe_device *device, const char *folder,
                        uint32_t map, bool needed, const lobe_host *host) {
    cube_image cube;
    store->kept[map] = passes_environment_cache_load(
        folder, store->keys[map], passes_prefiltered_width(store->size), host, &cube);
    if (!store->kept[map])
        return LOBE_OK;
    lobe_result result =
        needed ? passes_stored_cube_create(device, &cube, &store->cubes[map]) : LOBE_OK;
    passes_cube_image_free(&cube);
    return result;
}

lobe_result passes_environment_store_load(environment_store *store, lobe_device *device,
                                          const char *folder,
                                          const environment_maps_request *request,
                                          const lobe_host *host) {
    if (was_looked_for(store, request))
        return LOBE_OK;
    passes_environment_store_forget(store);
    store->size = request->size;
    bool found = true;
    lobe_result result = LOBE_OK;
    for (uint32_t map = 0; result == LOBE_OK && map < LOBE_ENVIRONMENT_MAP_COUNT; ++map) {
        if (!is_filtered_and_wanted(request, map))
            continue;
        store->wanted[map] = true;
        store->keys[map] = passes_environment_cache_key(request->environment, request->size,
                                                        (lobe_environment_map)map);
        result = take(store, device, folder, map, found, host);
        found = found && store->kept[map];
    }
    if (result != LOBE_OK)
        passes_environment_store_forget(store);
    else if (!found)
        free_cubes(store);
    return result;
}

const stored_cube *passes_environment_store_cubes(const environment_store *store,
                                                  const environment_maps_request *request) {
    bool any = false;
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; ++map) {
        if (!is_filtered_and_wanted(request, map))
            continue;
        if (store->size != request->size || store->cubes[map].count == 0)
            return NULL;
        any = true;
    }
    return any ? store->cubes : NULL;
}

bool passes_environment_store_lacks(const environment_store *store, const environment_maps *maps,
                                    uint32_t map) {
    return store->wanted[map] && !store->kept[map] && maps->cubes[map].version != 0;
}

void passes_environment_store_save(environment_store *store, const char *folder,
                                   const lobe_graph *graph, const environment_maps *maps,
                                   uint32_t map, const lobe_host *host) {
    // Only looked at.
    const cube_image cube = {maps->width[map], maps->levels[map],
                             (float *)lobe_graph_data(graph, maps->cubes[map], NULL)};
    passes_environment_cache_store(folder, store->keys[map], &cube, host);
    store->kept[map] = true;
}
