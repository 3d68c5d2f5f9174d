#include "passes/environment/maps.h"

#include <stdio.h>

#include "passes/environment/cube.h"
#include "passes/environment/mixture.h"
#include "passes/environment/prefiltering.h"
#include "passes/environment/reduction.h"

// Levels at least this wide are made face by face.
#define FACE_BY_FACE_WIDTH 128

typedef enum part_kind { PART_LOBES, PART_BETWEEN, PART_MIXTURE } part_kind;

/// The state of one call of passes_environment_maps_declare.
typedef struct declaration {
    lobe_graph *graph;
    const environment_maps_request *request;
    uint32_t set;
    bool keep; ///< keep passes whose results nothing reads yet
    prefiltering_sources sources;
    reduced_map cubes[3]; ///< by part_kind
} declaration;

// ---------------------------------------------------------------------------------------------
// Parts of the work: levels, or faces of large levels, cube by cube

static uint32_t parts_of_level(uint32_t width, uint32_t level) {
    return width >> level >= FACE_BY_FACE_WIDTH ? 6 : 1;
}

static uint32_t parts_of_cube(uint32_t width) {
    uint32_t count = 0;
    for (uint32_t level = 0; width >> level > 0; level++)
        count += parts_of_level(width, level);
    return count;
}

static void add_part(declaration *d, part_kind kind, uint32_t level, uint32_t first_face,
                     uint32_t face_count) {
    reduced_map *cube = &d->cubes[kind];
    double concentration = lobe_environment_level_concentration(cube->width, level);
    lobe_pass *pass;
    if (kind == PART_MIXTURE)
        pass = passes_environment_mixture(d->graph, &d->sources, &d->cubes[PART_LOBES],
                                          &d->cubes[PART_BETWEEN], cube, level, first_face,
                                          face_count);
    else
        pass = passes_environment_prefiltering(
            d->graph, &d->sources, cube, level, first_face, face_count,
            kind == PART_BETWEEN ? 2 * concentration : concentration);
    if (d->keep)
        lobe_pass_keep(pass);
}

/// Adds the first `*left` parts of a cube, and subtracts them from `*left`.
static void add_parts(declaration *d, part_kind kind, uint32_t *left) {
    for (uint32_t level = 0; level < d->cubes[kind].levels; level++) {
        uint32_t parts = parts_of_level(d->cubes[kind].width, level);
        for (uint32_t part = 0; part<parts && * left> 0; part++, --*left)
            add_part(d, kind, level, part * (6 / parts), 6 / parts);
    }
}

// ---------------------------------------------------------------------------------------------
// Cubes

static reduced_map declare_cube(lobe_graph *graph, const char *name, uint32_t width) {
    reduced_map cube = {
        .width = width, .height = width, .layers = 6, .levels = passes_level_count(width, width)};
    cube.resource = lobe_graph_image(graph, &(lobe_image_description){
                                                .name = name,
                                                .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                .width = width,
                                                .height = width,
                                                .layers = 6,
                                                .levels = cube.levels,
                                                .retained = true,
                                                .shared = true,
                                            });
    return cube;
}

static reduced_map declare_filtered(lobe_graph *graph, part_kind kind, uint32_t set,
                                    uint32_t size) {
    static const char *const names[] = {"lobes", "lobes in between", "GGX lobes"};
    char name[64];
    snprintf(name, sizeof name, ENVIRONMENT_MAP_PREFIX "filtered with %s, %u", names[kind], set);
    return declare_cube(graph, name, passes_prefiltered_width(size));
}

static void set_map(environment_maps *maps, lobe_environment_map map, const reduced_map *cube) {
    maps->cubes[map] = cube->resource;
    maps->width[map] = cube->width;
    maps->levels[map] = cube->levels;
}

static reduced_map declare_radiance(lobe_graph *graph, const environment_maps_request *request) {
    reduced_map cube = declare_cube(graph, ENVIRONMENT_MAP_PREFIX "radiance", request->size);
    cube.resource = passes_environment_cube(graph, request->environment, request->texture,
                                            cube.resource, request->size);
    passes_environment_reduction(graph, &cube);
    return cube;
}

/// This environment's cube if all of them are finished, otherwise the last environment's, if any:
/// they change together.
static void set_filtered_map(declaration *d, lobe_environment_map map, part_kind kind,
                             const environment_maps_progress *progress, environment_maps *maps) {
    if (maps->up_to_date) {
        set_map(maps, map, &d->cubes[kind]);
    } else if (progress->former[map]) {
        reduced_map former = declare_filtered(d->graph, kind, 1 - d->set, d->request->size);
        set_map(maps, map, &former);
    } else {
        maps->complete = false;
    }
}

/// The number of kinds of parts needed, in their order: each kind needs those before it.
static uint32_t kinds_wanted(const environment_maps_request *request) {
    return request->wanted[LOBE_ENVIRONMENT_GGX]                ? 3
           : request->wanted[LOBE_ENVIRONMENT_BETWEEN]          ? 2
           : request->wanted[LOBE_ENVIRONMENT_VON_MISES_FISHER] ? 1
                                                                : 0;
}

static void declare_lobes(declaration *d, const environment_maps_progress *progress,
                          environment_maps *maps) {
    static const lobe_environment_map made[] = {LOBE_ENVIRONMENT_VON_MISES_FISHER,
                                                LOBE_ENVIRONMENT_BETWEEN, LOBE_ENVIRONMENT_GGX};
    uint32_t left = maps->parts_done;
    d->sources = passes_environment_smoothing(d->graph, maps->cubes[LOBE_ENVIRONMENT_RADIANCE],
                                              d->request->size, d->request->parts > 0);
    for (uint32_t kind = 0; kind < kinds_wanted(d->request); kind++) {
        d->cubes[kind] = declare_filtered(d->graph, kind, d->set, d->request->size);
        add_parts(d, kind, &left);
        if (d->request->wanted[made[kind]])
            set_filtered_map(d, made[kind], kind, progress, maps);
    }
}

static void declare_cached(declaration *d, environment_maps *maps) {
    static const part_kind kinds[LOBE_ENVIRONMENT_MAP_COUNT] = {
        [LOBE_ENVIRONMENT_VON_MISES_FISHER] = PART_LOBES,
        [LOBE_ENVIRONMENT_BETWEEN] = PART_BETWEEN,
        [LOBE_ENVIRONMENT_GGX] = PART_MIXTURE};
    for (uint32_t map = LOBE_ENVIRONMENT_RADIANCE + 1; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (!d->request->wanted[map])
            continue;
        reduced_map cube = declare_filtered(d->graph, kinds[map], d->set, d->request->size);
        passes_environment_restoring(d->graph, &d->request->cached[map], &cube);
        set_map(maps, (lobe_environment_map)map, &cube);
    }
}

static uint32_t parts_wanted(const environment_maps_request *request) {
    return request->cached
               ? 0
               : kinds_wanted(request) * parts_of_cube(passes_prefiltered_width(request->size));
}

uint32_t passes_environment_maps_parts_left(const environment_maps_request *request,
                                            const environment_maps_progress *progress) {
    const uint32_t count = parts_wanted(request);
    const uint32_t done = progress->size == request->size ? progress->done : 0;
    return count > done ? count - done : 0;
}

static uint32_t advance(const environment_maps_request *request, uint32_t part_count,
                        environment_maps_progress *progress) {
    if (progress->size != request->size)
        *progress = (environment_maps_progress){.size = request->size};
    const uint32_t left = passes_environment_maps_parts_left(request, progress);
    progress->done += request->parts > 0 && request->parts < left ? request->parts : left;
    return progress->done < part_count ? progress->done : part_count;
}

environment_maps passes_environment_maps_declare(lobe_graph *graph,
                                                 const environment_maps_request *request,
                                                 environment_maps_progress *progress) {
    environment_maps maps = {.complete = true, .part_count = parts_wanted(request)};
    bool goes_on = progress->size != request->size || progress->done < maps.part_count;
    maps.parts_done = advance(request, maps.part_count, progress);
    maps.up_to_date = maps.parts_done == maps.part_count;
    reduced_map radiance = declare_radiance(graph, request);
    set_map(&maps, LOBE_ENVIRONMENT_RADIANCE, &radiance);
    declaration d = {.graph = graph, .request = request, .set = progress->set, .keep = goes_on};
    if (request->cached)
        declare_cached(&d, &maps);
    else if (maps.part_count > 0)
        declare_lobes(&d, progress, &maps);
    if (maps.up_to_date)
        for (uint32_t i = 0; i < LOBE_ENVIRONMENT_MAP_COUNT; i++)
            progress->former[i] = false;
    return maps;
}

void passes_environment_maps_invalidate(const environment_maps *last,
                                        environment_maps_progress *progress) {
    progress->done = 0;
    if (!last->up_to_date)
        return;
    progress->set = 1 - progress->set;
    for (uint32_t i = 0; i < LOBE_ENVIRONMENT_MAP_COUNT; i++)
        progress->former[i] = last->cubes[i].version != 0;
}
