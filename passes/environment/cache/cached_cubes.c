#include "passes/environment/cache/cached_cubes.h"

#include "passes/environment/cache/cube_file.h"
#include "passes/environment/prefiltering.h"

static bool wants_filtered(const environment_maps_request *request, uint32_t map) {
    return map != LOBE_ENVIRONMENT_RADIANCE && request->wanted[map];
}

static bool was_looked_up(const cached_cubes *cached, const environment_maps_request *request) {
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (wants_filtered(request, map) &&
            !(cached->requested[map] && cached->size == request->size))
            return false;
    }
    return true;
}

static void free_cubes(cached_cubes *cached) {
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; map++)
        passes_cube_textures_free(&cached->cubes[map]);
}

void passes_cached_cubes_forget(cached_cubes *cached) {
    free_cubes(cached);
    *cached = (cached_cubes){0};
}

/// Reads a cube's file. `upload`: also uploads it, which is needless once another cube is missing.
static lobe_result load_cube(cached_cubes *cached, lobe_device *device, const char *folder,
                             uint32_t map, bool upload, const lobe_host *host) {
    cube_image cube;
    cached->settled[map] = passes_cube_file_load(
        folder, cached->keys[map], passes_prefiltered_width(cached->size), host, &cube);
    if (!cached->settled[map])
        return LOBE_OK;
    lobe_result result =
        upload ? passes_cube_textures_create(device, &cube, &cached->cubes[map]) : LOBE_OK;
    passes_cube_image_free(&cube);
    return result;
}

lobe_result passes_cached_cubes_load(cached_cubes *cached, lobe_device *device, const char *folder,
                                     const environment_maps_request *request,
                                     const lobe_host *host) {
    if (was_looked_up(cached, request))
        return LOBE_OK;
    passes_cached_cubes_forget(cached);
    cached->size = request->size;
    bool found = true;
    lobe_result result = LOBE_OK;
    for (uint32_t map = 0; result == LOBE_OK && map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (!wants_filtered(request, map))
            continue;
        cached->requested[map] = true;
        cached->keys[map] =
            passes_cube_file_key(request->environment, request->size, (lobe_environment_map)map);
        result = load_cube(cached, device, folder, map, found, host);
        found = found && cached->settled[map];
    }
    if (result != LOBE_OK)
        passes_cached_cubes_forget(cached);
    else if (!found)
        free_cubes(cached);
    return result;
}

const cube_textures *passes_cached_cubes_find(const cached_cubes *cached,
                                              const environment_maps_request *request) {
    bool any = false;
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (!wants_filtered(request, map))
            continue;
        if (cached->size != request->size || cached->cubes[map].count == 0)
            return NULL;
        any = true;
    }
    return any ? cached->cubes : NULL;
}

bool passes_cached_cubes_lack(const cached_cubes *cached, const environment_maps *maps,
                              uint32_t map) {
    return cached->requested[map] && !cached->settled[map] && maps->cubes[map].version != 0;
}

void passes_cached_cubes_save(cached_cubes *cached, const char *folder, const lobe_graph *graph,
                              const environment_maps *maps, uint32_t map, const lobe_host *host) {
    // Only read, despite the cast.
    const cube_image cube = {maps->width[map], maps->levels[map],
                             (float *)lobe_graph_data(graph, maps->cubes[map], NULL)};
    const bool saved = passes_cube_file_save(folder, cached->keys[map], &cube, host);
    for (uint32_t other = 0; other < LOBE_ENVIRONMENT_MAP_COUNT; other++)
        cached->settled[other] |= other == map || !saved; // all of them would fail alike
}
