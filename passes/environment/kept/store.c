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
        stored_cube_free(&store->cubes[map]);
}

void environment_store_forget(environment_store *store) {
    free_cubes(store);
    *store = (environment_store){0};
}

/// Brings a cube to the device, unless another is missing anyway: `needed`.
static lobe_result take(environment_store *store, lobe_device *device, const char *folder,
                        uint32_t map, bool needed, const lobe_log *log) {
    cube_image cube;
    store->kept[map] = environment_cache_load(folder, store->keys[map],
                                              prefiltered_width(store->size), log, &cube);
    if (!store->kept[map])
        return LOBE_OK;
    lobe_result result = needed ? stored_cube_create(device, &cube, &store->cubes[map]) : LOBE_OK;
    cube_image_free(&cube);
    return result;
}

lobe_result environment_store_look(environment_store *store, lobe_device *device,
                                   const char *folder, const environment_maps_request *request,
                                   const lobe_log *log) {
    if (was_looked_for(store, request))
        return LOBE_OK;
    environment_store_forget(store);
    store->size = request->size;
    bool found = true;
    lobe_result result = LOBE_OK;
    for (uint32_t map = 0; result == LOBE_OK && map < LOBE_ENVIRONMENT_MAP_COUNT; ++map) {
        if (!is_filtered_and_wanted(request, map))
            continue;
        store->wanted[map] = true;
        store->keys[map] =
            environment_cache_key(request->environment, request->size, (lobe_environment_map)map);
        result = take(store, device, folder, map, found, log);
        found = found && store->kept[map];
    }
    if (result != LOBE_OK)
        environment_store_forget(store);
    else if (!found)
        free_cubes(store);
    return result;
}

const stored_cube *environment_store_cubes(const environment_store *store,
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

bool environment_store_lacks(const environment_store *store, const environment_maps *maps,
                             uint32_t map) {
    return store->wanted[map] && !store->kept[map] && maps->cubes[map].version != 0;
}

void environment_store_keep(environment_store *store, const char *folder, const lobe_graph *graph,
                            const environment_maps *maps, uint32_t map, const lobe_log *log) {
    // Only looked at.
    const cube_image cube = {maps->width[map], maps->levels[map],
                             (float *)lobe_graph_data(graph, maps->cubes[map], NULL)};
    environment_cache_store(folder, store->keys[map], &cube, log);
    store->kept[map] = true;
}
