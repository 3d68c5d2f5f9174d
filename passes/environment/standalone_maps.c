#include "passes/environment/standalone_maps.h"

#include <string.h>

#include "passes/context/pass_times.h"
#include "passes/environment/cache/cached_cubes.h"

struct lobe_environment_maps {
    lobe_device *device;
    lobe_host host;
    lobe_graph *graph;
    lobe_texture *texture;
    lobe_environment shape; ///< layout and extent, without texels
    environment_maps_request request;
    environment_maps_progress progress;
    bool (*report)(void *user, double part);
    void *user;
    lobe_frame times;
    lobe_environment_maps_information information;
    char *cache; ///< NULL: none
    cached_cubes store;
};

// ---------------------------------------------------------------------------------------------
// Building

static lobe_result out_of_memory(const lobe_host *host) {
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "environment maps: out of memory");
}

static lobe_result take_times(lobe_environment_maps *maps) {
    if (passes_pass_times_add(&maps->times, lobe_graph_describe(maps->graph), maps->host.allocator))
        return LOBE_OK;
    return out_of_memory(&maps->host);
}

static void update_information(lobe_environment_maps *maps, const environment_maps *made) {
    maps->information = (lobe_environment_maps_information){
        .milliseconds = maps->times.milliseconds,
        .submissions = maps->times.submissions,
        .cached = maps->request.cached != NULL,
        .passes = maps->times.passes,
        .pass_count = maps->times.pass_count,
    };
    memcpy(maps->information.width, made->width, sizeof made->width);
    memcpy(maps->information.levels, made->levels, sizeof made->levels);
}

/// Unfinished cubes are retained unchanged.
static void mark_outputs(lobe_graph *graph, const environment_maps *made) {
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (made->cubes[map].version != 0)
            lobe_graph_output(graph, made->cubes[map]);
    }
}

lobe_graph *passes_standalone_maps_begin(lobe_environment_maps *maps, environment_maps *cubes) {
    lobe_graph_begin(maps->graph);
    *cubes = passes_environment_maps_declare(maps->graph, &maps->request, &maps->progress);
    return maps->graph;
}

/// Submits frames until all maps are complete, or the caller stops: `*stopped`.
static lobe_result build(lobe_environment_maps *maps, bool *stopped) {
    *stopped = false;
    lobe_frame_free(&maps->times);
    maps->information = (lobe_environment_maps_information){0};
    for (environment_maps made = {0}; !made.up_to_date && !*stopped;) {
        passes_standalone_maps_begin(maps, &made);
        mark_outputs(maps->graph, &made);
        lobe_result result = lobe_graph_execute(maps->graph);
        if (result == LOBE_OK)
            result = take_times(maps);
        if (result != LOBE_OK)
            return result;
        update_information(maps, &made);
        double part = made.part_count > 0 ? (double)made.parts_done / made.part_count : 1;
        *stopped = maps->report && !maps->report(maps->user, part);
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Cache

static lobe_result load_from_cache(lobe_environment_maps *maps,
                                   const lobe_environment *environment) {
    environment_maps_request request = maps->request;
    request.environment = environment;
    passes_cached_cubes_forget(&maps->store);
    lobe_result result = LOBE_OK;
    if (maps->cache)
        result = passes_cached_cubes_load(&maps->store, maps->device, maps->cache, &request,
                                          &maps->host);
    maps->request.cached = passes_cached_cubes_find(&maps->store, &maps->request);
    return result;
}

/// One cube per frame, so that host memory holds only one at a time.
static lobe_result save_to_cache(lobe_environment_maps *maps) {
    lobe_result result = LOBE_OK;
    for (uint32_t map = 0; result == LOBE_OK && map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        environment_maps cubes;
        lobe_graph *graph = passes_standalone_maps_begin(maps, &cubes);
        if (!passes_cached_cubes_lack(&maps->store, &cubes, map))
            continue;
        lobe_graph_read_back(graph, cubes.cubes[map], (lobe_range){0});
        result = lobe_graph_execute(graph);
        if (result == LOBE_OK)
            passes_cached_cubes_save(&maps->store, maps->cache, graph, &cubes, map, &maps->host);
    }
    return result;
}

/// Builds the maps, or loads them from the cache.
static lobe_result prepare(lobe_environment_maps *maps, const lobe_environment *environment,
                           bool *stopped) {
    lobe_result result = load_from_cache(maps, environment);
    if (result == LOBE_OK)
        result = build(maps, stopped);
    bool missing = maps->cache && !maps->request.cached;
    return result == LOBE_OK && missing && !*stopped ? save_to_cache(maps) : result;
}

// ---------------------------------------------------------------------------------------------
// Creating and updating

static lobe_result check(const lobe_environment_maps *maps, const lobe_environment *environment) {
    double position[2];
    uint32_t size = maps->request.size;
    if (size < 16 || size > 2048 || (size & (size - 1)) != 0)
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: a cube face of %u texels; expected a power of two in [16, 2048]",
                              environment->name, size);
    if (environment->image.format != LOBE_FORMAT_RGBA32_FLOAT ||
        !lobe_environment_position(environment, (double[3]){1, 0, 0}, position))
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: %ux%u texels of %s do not fit the environment's layout",
                              environment->name, environment->image.width,
                              environment->image.height,
                              lobe_format_name(environment->image.format));
    return LOBE_OK;
}

static void set_up(lobe_environment_maps *maps, lobe_device *device,
                   const lobe_environment_maps_parameters *parameters) {
    maps->device = device;
    if (parameters->host)
        maps->host = *parameters->host;
    maps->host.allocator = lobe_device_allocator(device);
    maps->shape = *parameters->environment;
    maps->shape.name = NULL;
    maps->shape.image.texels = NULL;
    maps->report = parameters->progress;
    maps->user = parameters->user;
    maps->request = (environment_maps_request){
        .environment = &maps->shape,
        .size = parameters->size ? parameters->size : 256,
        .parts = parameters->parts_per_submission,
    };
    memcpy(maps->request.wanted, parameters->wanted, sizeof maps->request.wanted);
}

static lobe_result fill(lobe_environment_maps *maps, const lobe_environment *environment,
                        bool *stopped) {
    lobe_result result = check(maps, environment);
    if (result == LOBE_OK)
        result = lobe_texture_create(
            maps->device, &(lobe_texture_parameters){environment->name, &environment->image},
            &maps->texture);
    if (result == LOBE_OK)
        result = lobe_graph_create(maps->device, &maps->graph);
    maps->request.texture = maps->texture;
    return result == LOBE_OK ? prepare(maps, environment, stopped) : result;
}

static bool copy_cache(lobe_environment_maps *maps, const char *cache) {
    maps->cache = cache ? lobe_copy_text(maps->host.allocator, cache) : NULL;
    return !cache || maps->cache;
}

lobe_result lobe_environment_maps_create(lobe_device *device,
                                         const lobe_environment_maps_parameters *parameters,
                                         lobe_environment_maps **maps) {
    if (maps)
        *maps = NULL;
    if (!device || !parameters || !parameters->environment || !maps)
        return lobe_host_fail(parameters ? parameters->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_environment_maps_create: device, parameters, their environment "
                              "and maps must not be NULL");
    bool stopped = false;
    *maps = lobe_allocate(lobe_device_allocator(device), 1, sizeof **maps);
    if (!*maps)
        return out_of_memory(parameters->host);
    set_up(*maps, device, parameters);
    lobe_result result =
        copy_cache(*maps, parameters->cache) ? LOBE_OK : out_of_memory(&(*maps)->host);
    if (result == LOBE_OK)
        result = fill(*maps, parameters->environment, &stopped);
    if (result != LOBE_OK || stopped)
        lobe_environment_maps_destroy(maps);
    return result;
}

void lobe_environment_maps_destroy(lobe_environment_maps **maps) {
    if (!maps || !*maps)
        return;
    lobe_graph_destroy(&(*maps)->graph);
    passes_cached_cubes_forget(&(*maps)->store);
    lobe_release((*maps)->cache);
    lobe_texture_destroy(&(*maps)->texture);
    lobe_frame_free(&(*maps)->times);
    lobe_release(*maps);
    *maps = NULL;
}

lobe_result lobe_environment_maps_update(lobe_environment_maps *maps,
                                         const lobe_environment *environment) {
    if (!maps)
        return LOBE_ERROR_INVALID_ARGUMENT;
    lobe_result result = LOBE_OK;
    if (environment && (environment->layout != maps->shape.layout ||
                        environment->image.width != maps->shape.image.width ||
                        environment->image.height != maps->shape.image.height))
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: its layout or extent differs from the current environment",
                              environment->name);
    if (environment)
        result = lobe_texture_update(maps->texture, &environment->image);
    if (result != LOBE_OK)
        return result;
    bool stopped;
    lobe_graph_invalidate(maps->graph);
    maps->progress.done = 0;
    return environment ? prepare(maps, environment, &stopped) : build(maps, &stopped);
}

// ---------------------------------------------------------------------------------------------
// Access

const lobe_environment_maps_information *
lobe_environment_maps_describe(const lobe_environment_maps *maps) {
    if (!maps)
        return NULL;
    return &maps->information;
}

lobe_result lobe_environment_maps_read(lobe_environment_maps *maps, lobe_environment_map map,
                                       uint32_t level, uint32_t face, lobe_image *image) {
    if (image)
        *image = (lobe_image){0};
    if (!maps || !image)
        return lobe_host_fail(maps ? &maps->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_environment_maps_read: maps and image must not be NULL");
    if ((unsigned)map >= LOBE_ENVIRONMENT_MAP_COUNT || level >= maps->information.levels[map] ||
        face >= 6)
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "environment maps: there is no level %u, face %u of map %d", level,
                              face, (int)map);
    environment_maps made;
    passes_standalone_maps_begin(maps, &made);
    lobe_graph_read_back(maps->graph, made.cubes[map], (lobe_range){level, 1, face, 1});
    lobe_result result = lobe_graph_execute(maps->graph);
    uint32_t width = maps->information.width[map] >> level;
    if (result == LOBE_OK)
        result = lobe_image_allocate(image, LOBE_FORMAT_RGBA32_FLOAT, width, width, &maps->host);
    if (result == LOBE_OK)
        memcpy(image->texels, lobe_graph_data(maps->graph, made.cubes[map], NULL),
               (size_t)width * width * lobe_format_size(LOBE_FORMAT_RGBA32_FLOAT));
    return result;
}
