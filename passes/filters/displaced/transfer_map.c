#include "passes/filters/displaced/transfer_map.h"

#include <stdio.h>

#include "passes/filters/displaced/cells.h"

uint64_t passes_transfer_facets(const transfer_kind *kind) {
    const uint64_t limit = passes_window_limit();
    return kind->most_facets > 0 && kind->most_facets < limit ? kind->most_facets : limit;
}

window_grid passes_transfer_grid(const device_material *material, const transfer_kind *kind) {
    return passes_window_grid(&material->maps[MAP_HEIGHT], passes_transfer_facets(kind));
}

bool passes_transfer_is_whole(const device_material *material, const transfer_kind *kind) {
    const window_grid grid = passes_transfer_grid(material, kind);
    return grid.columns * grid.rows == 1;
}

static facet_range all_facets(const facet_window *window) {
    return (facet_range){0, passes_window_facets(window)};
}

static uint32_t part_count(const facet_window *window, const transfer_kind *kind) {
    return passes_facets_part_count(all_facets(window), kind) + 1;
}

/// Tiles of the map of transfer, and of that of facets' normals.
static map_tile tile_of(const facet_window *window, const transfer_kind *kind, uint32_t image) {
    const uint32_t layers = image == 0 ? passes_transfer_layers(kind) : passes_facet_layers(kind);
    return (map_tile){{kind->format, window->columns, window->rows, layers, 1},
                      window->first_column,
                      window->first_row};
}

kept_tile passes_transfer_tile(const device_material *material, const transfer_kind *kind,
                               uint32_t index) {
    const window_grid grid = passes_transfer_grid(material, kind);
    const uint32_t count = grid.columns * grid.rows;
    const facet_window window = passes_window(&grid, index);
    kept_tile tile = {
        .layout = {.what = "relief",
                   .image_count = kind->normals ? 2 : 1,
                   .buffer_bytes = {sizeof(struct transfer_basis_constants), HEIGHT_EXTENT_BYTES},
                   .buffer_count = 2,
                   .tile = count > 1 ? index + 1 : 0,
                   .tiles = count > 1 ? count : 0},
        .parts = part_count(&window, kind)};
    for (uint32_t i = 0; i < tile.layout.image_count; i++)
        tile.layout.images[i] = tile_of(&window, kind, i).extent;
    return tile;
}

/// The largest window of a grid: the first.
static uint32_t most_facets(const window_grid *grid) {
    const facet_window window = passes_window(grid, 0);
    return passes_window_facets(&window);
}

uint64_t passes_transfer_bytes(const device_material *material, const transfer_kind *kind) {
    const device_map *heights = &material->maps[MAP_HEIGHT];
    reduced_map map = {.width = passes_half_extent(heights->width),
                       .height = passes_half_extent(heights->height),
                       .layers = passes_transfer_layers(kind) +
                                 (kind->normals ? passes_facet_layers(kind) : 0)};
    map.levels = passes_level_count(map.width, map.height);
    return passes_reduced_map_bytes(&map, kind->format);
}

/// What facets see, three steps of light between them, and colours.
uint64_t passes_transfer_making_bytes(const device_material *material, const transfer_kind *kind) {
    const window_grid grid = passes_transfer_grid(material, kind);
    const uint64_t words = TRANSFER_WORDS(kind->order) + TRANSFER_LINKS + 3 * TRANSFER_INDIRECT +
                           (kind->coloured || kind->emissive ? TRANSFER_COLOUR_WORDS : 0);
    return most_facets(&grid) * words * sizeof(uint32_t);
}

// ---------------------------------------------------------------------------------------------
// Tiles

/// What the passes between the relief and the map share, of one window at a time.
typedef struct transfer_build {
    const transfer_request *request;
    lobe_graph *graph;
    relief relief;
    window_grid grid;
    facets_request facets;
    seen_facets seen; ///< of the window
    facet_window window;
} transfer_build;

static uint32_t tile_count(const transfer_build *build) {
    return build->grid.columns * build->grid.rows;
}

/// The functions of directions and the extent of heights of the first tile that is stored: others
/// are made with these.
static void take_stored(transfer_build *build) {
    const transfer_request *request = build->request;
    const stored_content *stored = NULL;
    for (uint32_t i = 0; !stored && i < tile_count(build); i++)
        stored = passes_kept_stored(request->context, request->record, i);
    if (!stored)
        return;
    build->facets.basis = lobe_graph_import_buffer(build->graph, stored->buffers[0]);
    build->relief.extent = lobe_graph_import_buffer(build->graph, stored->buffers[1]);
}

static void begin(const transfer_request *request, transfer_build *build) {
    const filter_context *context = request->context;
    const device_material *material = &context->scene->materials[request->material];
    *build = (transfer_build){.request = request, .graph = context->graph};
    build->grid = passes_transfer_grid(material, request->kind);
    if (request->relief)
        build->relief = *request->relief;
    build->facets = (facets_request){.graph = context->graph,
                                     .material = request->material,
                                     .relief = &build->relief,
                                     .kind = request->kind,
                                     .in_parts = request->in_parts};
}

/// What facets see, where that is not there.
static void begin_facets(transfer_build *build) {
    const transfer_request *request = build->request;
    if (request->seen)
        build->seen = *request->seen;
    else if (request->relief)
        build->seen = passes_facets_begin(&build->facets, most_facets(&build->grid));
    else
        build->seen.basis = build->facets.basis;
}

static cell_passes add_cells(const transfer_build *build, const cells_target *target) {
    const transfer_request *request = build->request;
    return passes_cells_add(&(cells_source){request->context, request->material, request->kind,
                                            &build->relief, &build->seen, &build->window},
                            target);
}

static void read_back(const transfer_build *build, uint32_t index, const reduced_map images[2]) {
    const lobe_resource resources[] = {images[0].resource, images[1].resource},
                        buffers[] = {build->seen.basis, build->relief.extent};
    passes_kept_read_back(build->request->context, build->request->record, index, resources,
                          buffers);
}

/// As images of their own, unless they are all of the map.
static void save_tile(const transfer_build *build, uint32_t index, const transfer_map *map) {
    const transfer_kind *kind = build->request->kind;
    reduced_map images[2] = {map->map, map->facets};
    for (uint32_t i = 0; i < 2 && tile_count(build) > 1; i++) {
        const map_tile tile = tile_of(&build->window, kind, i);
        if (i == 0 || kind->normals)
            images[i].resource = passes_cutting(build->graph, &images[i], &tile);
    }
    read_back(build, index, images);
}

static void restore_tile(const transfer_build *build, const stored_content *stored,
                         transfer_map *map) {
    for (uint32_t i = 0; i < (build->request->kind->normals ? 2u : 1u); i++) {
        const map_tile tile = tile_of(&build->window, build->request->kind, i);
        passes_restoring(build->graph, stored, i, &tile, i == 0 ? &map->map : &map->facets);
    }
}

/// Adds up to `*parts` parts of what the window's facets see. False: some parts are left, of it or
/// of the tile.
static bool see(transfer_build *build, uint32_t *parts) {
    const transfer_request *request = build->request;
    const uint32_t needed = part_count(&build->window, request->kind);
    passes_facets_add(&build->facets, &build->window, all_facets(&build->window), *parts,
                      request->in_parts && *parts <= needed, &build->seen);
    if (*parts < needed)
        return false;
    *parts -= *parts == UINT32_MAX ? 0 : needed;
    return true;
}

// ---------------------------------------------------------------------------------------------
// The map

/// One window after the other, as far as parts go. False: some are left.
static bool add_windows(transfer_build *build, transfer_map *map) {
    const transfer_request *request = build->request;
    uint32_t parts = request->parts;
    cell_passes last = {.count = 0}; // of the windows before, whose facets are no longer there
    for (uint32_t i = 0; i < tile_count(build); i++) {
        const stored_content *stored = passes_kept_stored(request->context, request->record, i);
        build->window = passes_window(&build->grid, i);
        map->map.keeps = map->facets.keeps = i > 0;
        if (stored) {
            restore_tile(build, stored, map);
            continue;
        }
        if (!request->seen && !see(build, &parts)) {
            for (uint32_t k = 0; request->in_parts && k < last.count; k++)
                lobe_pass_keep(last.passes[k]);
            return false;
        }
        last = add_cells(build, &(cells_target){&map->map, &map->facets, 0, 0});
        if (passes_kept_wants(request->context, request->record, i))
            save_tile(build, i, map);
    }
    map->map.keeps = map->facets.keeps = false;
    return true;
}

static void add_closure(const transfer_build *build, transfer_map *transfer) {
    const reduced_map *map = &transfer->map;
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "transfer_closure");
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_map",
                                         .resource = map->resource,
                                         .range = {map->levels - 1, 1, 0, map->layers}});
    lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = build->seen.basis});
    transfer->closure = lobe_pass_write(
        pass, &(lobe_binding){.name = "closure_block", .resource = transfer->closure});
    const kind_specialisation kind = passes_transfer_specialisation(build->request->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_closure.comp",
                                              .specialisation = kind.items,
                                              .specialisation_count = KIND_CONSTANTS});
}

transfer_map passes_transfer_declare(const filter_context *context, uint32_t index,
                                     const transfer_kind *kind) {
    const device_map *heights = &context->scene->materials[index].maps[MAP_HEIGHT];
    lobe_graph *graph = context->graph;
    char name[64];
    snprintf(name, sizeof name, "transfer of material %u", index);
    transfer_map map = {.map = passes_reduced_map_declare(graph, name, kind->format, heights->width,
                                                          heights->height,
                                                          passes_transfer_layers(kind), true)};
    snprintf(name, sizeof name, "closure of material %u", index);
    map.closure = lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name,
                                          .size = sizeof(struct transfer_closure_constants),
                                          .retained = true});
    if (!kind->normals)
        return map;
    snprintf(name, sizeof name, "normals of facets of material %u", index);
    map.facets = passes_reduced_map_declare(graph, name, kind->format, heights->width,
                                            heights->height, passes_facet_layers(kind), true);
    return map;
}

bool passes_transfer_has_content(const lobe_graph *graph, const transfer_kind *kind,
                                 const transfer_map *map) {
    return lobe_graph_has_content(graph, map->map.resource) &&
           lobe_graph_has_content(graph, map->closure) &&
           (!kind->normals || lobe_graph_has_content(graph, map->facets.resource));
}

void passes_transfer_map(const transfer_request *request, transfer_map *map) {
    transfer_build build;
    begin(request, &build);
    take_stored(&build);
    begin_facets(&build);
    if (!add_windows(&build, map))
        return;
    passes_level_reduction(build.graph, &map->map);
    if (request->kind->normals)
        passes_level_reduction(build.graph, &map->facets);
    add_closure(&build, map);
}

// ---------------------------------------------------------------------------------------------
// Tiles alone

static reduced_map declare_tile(const transfer_build *build, uint32_t image) {
    const kept_image extent = tile_of(&build->window, build->request->kind, image).extent;
    return (reduced_map){
        .resource = lobe_graph_image(
            build->graph, &(lobe_image_description){.name = image == 0 ? "tile of transfer"
                                                                       : "tile of facets' normals",
                                                    .format = extent.format,
                                                    .width = extent.width,
                                                    .height = extent.height,
                                                    .layers = extent.layers}),
        .width = extent.width,
        .height = extent.height,
        .layers = extent.layers,
        .levels = 1};
}

static void add_tile(const transfer_build *build, uint32_t tile) {
    const transfer_request *request = build->request;
    reduced_map images[2] = {declare_tile(build, 0)};
    if (request->kind->normals)
        images[1] = declare_tile(build, 1);
    add_cells(build, &(cells_target){&images[0], &images[1], build->window.first_column,
                                     build->window.first_row});
    read_back(build, tile, images);
}

void passes_transfer_tiles(const transfer_request *request, uint32_t first, uint32_t step) {
    const kept_record *record = request->record;
    transfer_build build;
    begin(request, &build);
    begin_facets(&build);
    uint32_t parts = request->parts, tile = 0;
    for (uint32_t i = first; i < tile_count(&build); i += step, tile++) {
        build.window = passes_window(&build.grid, i);
        if (passes_kept_is_settled(record, tile))
            parts -= parts == UINT32_MAX ? 0 : passes_kept_tile_parts(record, tile);
        else if (!see(&build, &parts))
            break;
        else if (passes_kept_wants(request->context, record, tile))
            add_tile(&build, tile);
    }
}
